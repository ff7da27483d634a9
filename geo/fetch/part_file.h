// A file that is on its way from a server: kept while it is not whole, so that a later run goes on with it.
#pragma once

#include <cstdint>
#include <string>

#include "core/base/result.h"

namespace oro {

// NAME.part beside the file NAME, and NAME.part-etag, which says which version of which address the bytes are
// of. It is locked while it is open, so that two programs never write the same one. What is in it is never
// taken for the file: NAME appears on commit(), whole.
class PartFile {
  public:
    // Opens or makes the part of the file `path`. Where another program has it open, that is waited for, up
    // to `wait_s` seconds. Errors: the system's; another program has it open.
    static Result<PartFile> open(const std::string& path, double wait_s = 0.0);
    PartFile(PartFile&& other) noexcept;
    PartFile& operator=(PartFile&& other) noexcept;
    PartFile(const PartFile&) = delete;
    PartFile& operator=(const PartFile&) = delete;
    // Keeps what is there and can be gone on with; removes it where it cannot.
    ~PartFile();

    [[nodiscard]] const std::string& path() const { return part_; }
    [[nodiscard]] std::uint64_t bytes() const { return bytes_; }
    // The version (a strong ETag) of `url` that the bytes belong to; "" where they cannot be gone on with.
    [[nodiscard]] std::string version_of(const std::string& url) const;
    // Empties it, and remembers of which version of which address what follows is; "" for none: then it
    // cannot be gone on with.
    Result<void> begin(const std::string& url, const std::string& etag);
    // Adds bytes at its end. Errors: the system's (a full disk).
    Result<void> append(const char* bytes, std::size_t count);
    // Puts it on the disk and gives it the file's name. Errors: the name was taken meanwhile; the system's.
    Result<void> commit();
    // Removes it.
    void discard() noexcept;

  private:
    PartFile() = default;
    [[nodiscard]] Error fault(const std::string& file, const std::string& what) const;
    void close() noexcept;

    int descriptor_{-1};
    std::uint64_t bytes_{0};
    std::string path_;
    std::string part_;
    std::string etag_file_;
    std::string url_;   // of the bytes; "" where unknown
    std::string etag_;  // strong, or ""
};

}  // namespace oro
