// A picture's file held against a fresh drawing, pixel by pixel.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/checksum.h"
#include "core/base/result.h"
#include "geo/pixels/picture_rows.h"

namespace oro {

// Fingerprint of a picture's size and pixels (rgb rows from the top): the same in each format that keeps
// them.
class PixelFingerprint {
  public:
    PixelFingerprint(int width_px, int height_px);
    void add(std::span<const std::uint8_t> rgb) { sum_.add(std::as_bytes(rgb)); }
    [[nodiscard]] std::uint64_t value() const { return sum_.sum(); }

  private:
    RunningChecksum sum_;
};
// The fingerprint of a file's pixels as they come out of it; nothing of a lossy file's, which are not those
// that were put in. Errors: those of open_picture_rows.
Result<std::optional<std::uint64_t>> fingerprint_of_pixels(const std::string& path, int width_px,
                                                           int height_px);

// Pixels of which one of three colours differs by more than so much, of 255.
struct PixelsOff {
    std::uint64_t count{};
    // The box that holds them all.
    int left{}, top{}, right{-1}, bottom{-1};
    // The most of them in one of the squares of 8 x 8 pixels that the picture is made of.
    int most_in_a_square{};
};

struct PictureDifference {
    std::uint64_t pixels{};
    bool lossy{};                                   // the file is
    std::uint64_t drawn_fingerprint{};              // PixelFingerprint of what was drawn
    std::optional<std::uint64_t> file_fingerprint;  // and of the file, where that means something
    PixelsOff any;                                  // off by 1 or more
    PixelsOff beyond;                               // off by more than the slack
    int largest{};                                  // of 255
};

// How far a pixel may be off by `slack` before it is `beyond`.
struct PixelSlack {
    int lossless{};
    int lossy{};
};

// Takes a drawn picture, row by row, and reads its file along. What was drawn is given a lossy file's loss
// before it is compared.
class PictureComparison {
  public:
    // Errors: those of open_picture_rows.
    static Result<PictureComparison> open(const std::string& path, int width_px, int height_px,
                                          PixelSlack slack);
    Result<void> add_drawn_row(std::span<const std::uint8_t> rgb);
    // After the last row.
    Result<PictureDifference> finish();

  private:
    PictureComparison(std::unique_ptr<PictureRows> file, PixelSlack slack);
    Result<void> compare_next(std::span<const std::uint8_t> drawn);
    void count(PixelsOff& off, std::vector<int>& in_squares, int x) const;
    void end_squares();

    std::unique_ptr<PictureRows> file_;
    int slack_;
    PixelFingerprint drawn_fingerprint_, file_fingerprint_;
    std::vector<std::uint8_t> row_;
    std::vector<int> any_in_squares_, beyond_in_squares_;  // of the squares that the row is in
    int y_{0};
    PictureDifference found_;
};

}  // namespace oro
