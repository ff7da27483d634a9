// Files that are written whole or not at all.
#pragma once

#include <cstdio>
#include <initializer_list>
#include <span>
#include <string>

#include "core/base/result.h"
#include "geo/files/temporary_file.h"

namespace oro {

// For files that a reader must never find half written: a file without a name, or under a temporary one, in
// the same folder, which takes its real name on commit().
//     ORO_TRY(WholeFile file, WholeFile::create(path, overwrite));
//     ORO_CHECK(file.write(bytes.data(), bytes.size()));
//     ORO_CHECK(file.commit());
// Destroyed without commit, it is removed and whatever had the name before is untouched.
// A path on a network (network_paths.h) has its file in the machine's folder for temporary files until
// commit(), which copies it there.
class WholeFile {
  public:
    // Errors: unwritable folder, a folder of that name, an existing file when overwrite is false; a path on a
    // network where those are not allowed, or that does not answer.
    static Result<WholeFile> create(const std::string& path, bool overwrite,
                                    Temporary kind = Temporary::nameless);
    WholeFile(WholeFile&& other) noexcept;
    WholeFile& operator=(WholeFile&& other) noexcept;
    WholeFile(const WholeFile&) = delete;
    WholeFile& operator=(const WholeFile&) = delete;
    ~WholeFile();

    [[nodiscard]] std::FILE* stream() const { return stream_; }
    // Appends; reports the system's reason (a full disk, a file size limit).
    Result<void> write(const void* bytes, std::size_t count);
    // Puts what was written so far on the disk, so that of commit() only the renaming is left: for files that
    // must appear together.
    Result<void> settle();
    // Flushes, syncs, closes and renames over the real name (fails, when overwrite is false and the name was
    // taken since).
    Result<void> commit();
    // commit() of a file that the program keeps for itself (settings): no matter which files it has read, and
    // whether they were changed meanwhile.
    Result<void> commit_own();
    // commit_own() of one of very many files that can be made again: none is put on the disk by itself, and a
    // power cut may take it.
    Result<void> commit_unsynced();

  private:
    WholeFile() = default;
    friend Result<void> commit_together(std::span<WholeFile* const> files);
    void abandon() noexcept;
    // What is left of commit() when all is on the disk. 0, or the system's error number.
    int take_name();
    void give_back(TemporaryFile& before, bool was_there);
    // Copies a file of a path on a network there. `before` takes what had the path, where it shall be kept.
    Result<void> send(TemporaryFile& before, bool keeps, bool& was_there);
    void take_back(const TemporaryFile& before, bool was_there);
    [[nodiscard]] bool is_on_network() const;

    std::FILE* stream_{nullptr};
    std::string path_;
    TemporaryFile temporary_;
    bool overwrite_{false};
};

// commit() of files that belong together: all have their names after it, or none has: what had them before
// has them again. Only a power cut between two renamings, which take no time, leaves some; the last file is
// the one that matters. Files on a network are copied there first, and taken back where a later one fails.
// Errors, beside those of writing: a file that the program has read would be replaced (usage), or one that it
// has read was changed meanwhile (core/base/files_read.h).
Result<void> commit_together(std::span<WholeFile* const> files);
inline Result<void> commit_together(std::initializer_list<WholeFile*> files) {
    return commit_together(std::span<WholeFile* const>(files.begin(), files.size()));
}

// Writes a whole text file in one go.
Result<void> write_whole_file(const std::string& path, const std::string& text, bool overwrite);

}  // namespace oro
