// A file that is read and written by place: for core's own formats, which are read piece by piece.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "core/base/result.h"

namespace oro {

// An open file and its name. Reading and writing move no cursor, so that several threads may read at once.
class OpenFile {
  public:
    enum class Use {
        read,     // the file must be there; it is remembered as one that was read (files_read.h)
        write,    // and read; it is made when it is not there; no link is followed
        read_own  // as read, of a file that the program keeps for itself, which is not remembered
    };
    // Errors: no such file or folder, no right to it, anything that is no plain file.
    static Result<OpenFile> open(const std::string& path, Use use);
    OpenFile(OpenFile&& other) noexcept;
    OpenFile& operator=(OpenFile&& other) noexcept;
    OpenFile(const OpenFile&) = delete;
    OpenFile& operator=(const OpenFile&) = delete;
    ~OpenFile();

    [[nodiscard]] const std::string& path() const { return path_; }
    [[nodiscard]] int descriptor() const { return descriptor_; }
    [[nodiscard]] Result<std::uint64_t> size() const;
    // Fills `bytes` from byte `offset` on; a file that ends before is an error.
    Result<void> read(std::uint64_t offset, std::span<std::byte> bytes) const;
    Result<void> write(std::uint64_t offset, std::span<const std::byte> bytes);
    // Cuts the file off at, or fills it with zeros up to, this many bytes.
    Result<void> resize(std::uint64_t bytes);
    // Puts all that was written on the disk.
    Result<void> sync();

    // The error of a file that is not as it should be, from byte `offset` on.
    [[nodiscard]] Error damaged(std::uint64_t offset, const std::string& what) const;

  private:
    OpenFile(int descriptor, std::string path) : descriptor_(descriptor), path_(std::move(path)) {}
    [[nodiscard]] Error fault(const std::string& what, int error_number) const;

    int descriptor_{-1};
    std::string path_;
};

// The system's words for an error number.
[[nodiscard]] std::string system_reason(int error_number);

}  // namespace oro
