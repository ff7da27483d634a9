#include "geo/pixels/picture_difference.h"

#include <algorithm>
#include <cstdlib>

namespace oro {
namespace {

constexpr int square_px = 8;

std::size_t row_bytes(const PictureRows& rows) {
    return static_cast<std::size_t>(rows.width_px()) * 3;
}

}  // namespace

PixelFingerprint::PixelFingerprint(int width_px, int height_px) {
    const std::array<std::int32_t, 2> size{width_px, height_px};
    sum_.add(std::as_bytes(std::span(size)));
}

Result<std::optional<std::uint64_t>> fingerprint_of_pixels(const std::string& path, int width_px,
                                                           int height_px) {
    ORO_TRY(const std::unique_ptr<PictureRows> rows, open_picture_rows(path, width_px, height_px));
    if (rows->is_lossy()) return std::optional<std::uint64_t>();
    PixelFingerprint fingerprint(width_px, height_px);
    std::vector<std::uint8_t> row(row_bytes(*rows));
    for (int y = 0; y < height_px; ++y) {
        ORO_CHECK(rows->read_row(row));
        fingerprint.add(row);
    }
    return std::optional<std::uint64_t>(fingerprint.value());
}

PictureComparison::PictureComparison(std::unique_ptr<PictureRows> file, PixelSlack slack)
    : file_(std::move(file)),
      slack_(file_->is_lossy() ? slack.lossy : slack.lossless),
      drawn_fingerprint_(file_->width_px(), file_->height_px()),
      file_fingerprint_(file_->width_px(), file_->height_px()),
      row_(row_bytes(*file_)),
      any_in_squares_(static_cast<std::size_t>(file_->width_px() / square_px + 1)),
      beyond_in_squares_(any_in_squares_.size()) {
    found_.lossy = file_->is_lossy();
    found_.pixels =
        static_cast<std::uint64_t>(file_->width_px()) * static_cast<std::uint64_t>(file_->height_px());
}

Result<PictureComparison> PictureComparison::open(const std::string& path, int width_px, int height_px,
                                                  PixelSlack slack) {
    ORO_TRY(std::unique_ptr<PictureRows> file, open_picture_rows(path, width_px, height_px));
    return PictureComparison(std::move(file), slack);
}

Result<void> PictureComparison::add_drawn_row(std::span<const std::uint8_t> rgb) {
    drawn_fingerprint_.add(rgb);
    return found_.lossy ? file_->lose_row(rgb) : compare_next(rgb);
}

void PictureComparison::count(PixelsOff& off, std::vector<int>& in_squares, int x) const {
    if (off.count++ == 0) off = {1, x, y_, x, y_, off.most_in_a_square};
    off.left = std::min(off.left, x);
    off.right = std::max(off.right, x);
    off.bottom = y_;
    ++in_squares[static_cast<std::size_t>(x / square_px)];
}

void PictureComparison::end_squares() {
    for (const auto& [off, in_squares] :
         {std::pair{&found_.any, &any_in_squares_}, std::pair{&found_.beyond, &beyond_in_squares_}}) {
        off->most_in_a_square = std::max(off->most_in_a_square, *std::ranges::max_element(*in_squares));
        std::ranges::fill(*in_squares, 0);
    }
}

Result<void> PictureComparison::compare_next(std::span<const std::uint8_t> drawn) {
    ORO_CHECK(file_->read_row(row_));
    if (!found_.lossy) file_fingerprint_.add(row_);
    for (int x = 0; x < file_->width_px(); ++x) {
        int most = 0;
        for (std::size_t i = 3 * static_cast<std::size_t>(x); i < 3 * static_cast<std::size_t>(x) + 3; ++i)
            most = std::max(most, std::abs(int{row_[i]} - int{drawn[i]}));
        if (most == 0) continue;
        found_.largest = std::max(found_.largest, most);
        count(found_.any, any_in_squares_, x);
        if (most > slack_) count(found_.beyond, beyond_in_squares_, x);
    }
    if (++y_ % square_px == 0) end_squares();
    return {};
}

Result<PictureDifference> PictureComparison::finish() {
    if (found_.lossy) {
        ORO_TRY(const std::unique_ptr<PictureRows> drawn, file_->lost());
        std::vector<std::uint8_t> row(row_.size());
        for (int y = 0; y < file_->height_px(); ++y) {
            ORO_CHECK(drawn->read_row(row));
            ORO_CHECK(compare_next(row));
        }
    }
    end_squares();
    found_.drawn_fingerprint = drawn_fingerprint_.value();
    if (!found_.lossy) found_.file_fingerprint = file_fingerprint_.value();
    return found_;
}

}  // namespace oro
