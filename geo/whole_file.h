// Files that are written whole or not at all.
#pragma once

#include <cstdio>
#include <string>

#include "core/result.h"

namespace oro {

// A file under a temporary name in the same folder, which takes its real name on commit(). Destroyed without commit, it is
// removed and whatever had the name before is untouched.
class WholeFile {
  public:
    // Errors: unwritable folder, a folder of that name, an existing file when overwrite is false.
    static Result<WholeFile> create(const std::string& path, bool overwrite);
    WholeFile(WholeFile&& other) noexcept;
    WholeFile& operator=(WholeFile&& other) noexcept;
    WholeFile(const WholeFile&) = delete;
    WholeFile& operator=(const WholeFile&) = delete;
    ~WholeFile();

    [[nodiscard]] std::FILE* stream() const { return stream_; }
    [[nodiscard]] const std::string& temporary_path() const { return temporary_path_; }
    // Appends; reports the system's reason (a full disk, a file size limit).
    Result<void> write(const void* bytes, std::size_t count);
    // Puts what was written so far on the disk, so that of commit() only the renaming is left: for files that
    // must appear together.
    Result<void> settle();
    // Flushes, syncs, closes and renames over the real name (fails, when overwrite is false and the name was taken since).
    Result<void> commit();

  private:
    WholeFile() = default;
    void abandon() noexcept;

    std::FILE* stream_{nullptr};
    std::string path_;
    std::string temporary_path_;
    bool overwrite_{false};
};

// For a program that a signal ends: removes the temporary files of all unfinished WholeFiles, and lets no new
// one appear (a thread that wants one waits). The program must end after it. From any thread; not from a signal
// handler.
void remove_unfinished_files();

// Writes a whole text file in one go.
Result<void> write_whole_file(const std::string& path, const std::string& text, bool overwrite);

}  // namespace oro
