// The view inside a picture, from any source of bytes: not for use outside picture*.cpp and its fuzzer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "core/base/open_file.h"
#include "core/base/result.h"

namespace oro {

// Bytes by offset: a file, or a test's memory.
class PictureBytes {
  public:
    virtual ~PictureBytes() = default;
    [[nodiscard]] virtual std::uint64_t size() const = 0;
    // All `count` bytes from `offset`, or false.
    virtual bool read(std::uint64_t offset, void* to, std::size_t count) = 0;
};

// Those of a file of so many bytes, which outlives them.
class FileBytes final : public PictureBytes {
  public:
    FileBytes(const OpenFile& file, std::uint64_t size) : file_(file), size_(size) {}
    [[nodiscard]] std::uint64_t size() const override { return size_; }
    bool read(std::uint64_t offset, void* to, std::size_t count) override {
        return file_.read(offset, std::as_writable_bytes(std::span(static_cast<char*>(to), count))).ok();
    }

  private:
    const OpenFile& file_;
    std::uint64_t size_;
};

// As read_view_json; `path` is named in errors. Never reads outside [0, size()), and takes at most 64 MiB of
// XMP.
Result<std::string> find_view_json(PictureBytes& bytes, const std::string& path);

// Where a picture's XMP lies, and what sum depends on it.
struct XmpPlace {
    std::uint64_t at{};
    std::string packet;
    // Where a PNG's chunk is: from its type on, so many bytes, and the CRC behind them; 0 bytes elsewhere.
    std::uint64_t chunk_at{}, chunk_bytes{};
};
Result<XmpPlace> find_xmp(PictureBytes& bytes, const std::string& path);

}  // namespace oro
