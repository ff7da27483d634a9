// The lines of a text file, one after the other, without all of it in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "core/base/open_file.h"
#include "core/base/result.h"

namespace oro {

// A line may be so long: those of GeoNames have 20,000 bytes at most.
inline constexpr std::size_t longest_text_line = std::size_t{1} << 16U;

class TextLines {
  public:
    // Errors: no such file, no right to it, no plain file.
    static Result<TextLines> of(const std::string& path);

    // The next line, without its end (LF or CR LF) and without a byte order mark; false after the last. Of a
    // line longer than longest_text_line its beginning: is_cut() then. Errors: a file that cannot be read.
    Result<bool> next(std::string& line);
    // Of the line that next() gave, from 1.
    [[nodiscard]] std::size_t number() const { return number_; }
    [[nodiscard]] bool is_cut() const { return is_cut_; }

  private:
    TextLines(OpenFile file, std::uint64_t size) : file_(std::move(file)), size_(size) {}
    Result<void> fill();

    OpenFile file_;
    std::uint64_t size_{};
    std::uint64_t read_{};  // bytes of the file
    std::string block_;
    std::size_t at_{};  // in the block
    std::size_t number_{};
    bool is_cut_{};
};

}  // namespace oro
