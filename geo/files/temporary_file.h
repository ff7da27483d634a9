// A file on its way to a name: without any name as long as the file system can do that, so that whatever ends
// the program leaves nothing of it. Not for use outside whole_file.cpp and its tests, but for
// remove_unfinished_files().
#pragma once

#include <string>

namespace oro {

enum class Temporary {
    nameless,  // where the file system can (O_TMPFILE); elsewhere as below
    named,     // ".orograph-..." from the beginning
};

// Open for reading and writing, and locked (flock) until it is destroyed: a file of such a name that nobody
// holds locked was left by a program that was killed. The first of a folder removes those.
class TemporaryFile {
  public:
    TemporaryFile() = default;
    TemporaryFile(TemporaryFile&& other) noexcept;
    TemporaryFile& operator=(TemporaryFile&& other) noexcept;
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    ~TemporaryFile();

    // Makes it in a folder. 0, or the system's error number.
    [[nodiscard]] int make(const std::string& folder, Temporary kind);
    // A name in its folder, if it has none yet. 0, or the system's error number.
    [[nodiscard]] int take_temporary_name();
    // A second name for the file `path` in the same folder, to bring it back by: this is then no file of its
    // own.
    [[nodiscard]] int keep(const std::string& path);

    [[nodiscard]] int descriptor() const { return descriptor_; }
    [[nodiscard]] const std::string& path() const { return path_; }
    // Its name is another's now.
    void forget_name();

  private:
    void remove() noexcept;

    int descriptor_{-1};
    std::string folder_;
    std::string path_;
};

// While one lives, remove_unfinished_files() waits: for names that are taken together.
class NamesHeld {
  public:
    NamesHeld();
    ~NamesHeld();
    NamesHeld(const NamesHeld&) = delete;
    NamesHeld& operator=(const NamesHeld&) = delete;
};

// For a program that a signal ends: removes all temporary files that have names, and lets no new one appear
// (a thread that wants one waits). The program must end after it. From any thread; not from a signal handler.
void remove_unfinished_files();

}  // namespace oro
