#include <png.h>

#include <algorithm>
#include <csetjmp>
#include <vector>

#include "geo/pixels/picture_rows.h"

namespace oro {
namespace {

// As in picture_png.cpp: libpng jumps over whatever stands in a lambda given to guarded().
class PngRows final : public PictureRows {
  public:
    PngRows(InputStream stream, const RowsWanted& wanted)
        : PictureRows(wanted.width_px, wanted.height_px), stream_(std::move(stream)), wanted_(wanted) {}
    ~PngRows() override {
        if (png_) png_destroy_read_struct(&png_, &info_, nullptr);
    }
    PngRows(const PngRows&) = delete;
    PngRows& operator=(const PngRows&) = delete;

    Result<void> begin();
    Result<void> read_row(std::span<std::uint8_t> rgb) override;

  private:
    template <class Step>
    bool guarded(Step&& step) {
        if (setjmp(png_jmpbuf(png_)) != 0) return false;
        step();
        return true;
    }
    [[noreturn]] static void on_error(png_structp png, png_const_charp message) {
        static_cast<PngRows*>(png_get_error_ptr(png))->fault_ = message;
        png_longjmp(png, 1);
    }
    static void on_warning(png_structp, png_const_charp) {}
    [[nodiscard]] Error fault() const { return wanted_.fault("PNG: " + fault_); }
    void to_rgba();

    InputStream stream_;
    RowsWanted wanted_;
    png_structp png_{nullptr};
    png_infop info_{nullptr};
    std::string fault_;
    std::vector<std::uint8_t> rgba_;  // a row; all of an interlaced picture
    std::vector<png_bytep> all_rows_;
    int next_{0};
};

// Whatever it holds, it comes as 8-bit red, green, blue and alpha.
void PngRows::to_rgba() {
    png_set_expand(png_);
    png_set_scale_16(png_);
    png_set_gray_to_rgb(png_);
    png_set_add_alpha(png_, 0xFF, PNG_FILLER_AFTER);
}

Result<void> PngRows::begin() {
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, on_error, on_warning);
    if (png_) info_ = png_create_info_struct(png_);
    if (!info_) return wanted_.fault("PNG: no memory");
    if (!guarded([&] {
            png_init_io(png_, stream_.get());
            png_read_info(png_, info_);
        }))
        return fault();
    ORO_CHECK(wanted_.check_size(png_get_image_width(png_, info_), png_get_image_height(png_, info_)));
    width_px_ = static_cast<int>(png_get_image_width(png_, info_));
    height_px_ = static_cast<int>(png_get_image_height(png_, info_));
    const bool interlaced = png_get_interlace_type(png_, info_) != PNG_INTERLACE_NONE;
    if (!guarded([&] {
            to_rgba();
            if (interlaced) png_set_interlace_handling(png_);
            png_read_update_info(png_, info_);
        }))
        return fault();
    const auto row_bytes = static_cast<std::size_t>(width_px_) * 4;
    if (png_get_rowbytes(png_, info_) != row_bytes) return wanted_.fault("PNG: pixels of an unknown kind");
    rgba_.resize(interlaced ? row_bytes * static_cast<std::size_t>(height_px_) : row_bytes);
    if (!interlaced) return {};
    for (std::size_t at = 0; at < rgba_.size(); at += row_bytes) all_rows_.push_back(rgba_.data() + at);
    if (!guarded([&] { png_read_image(png_, all_rows_.data()); })) return fault();
    return {};
}

Result<void> PngRows::read_row(std::span<std::uint8_t> rgb) {
    std::uint8_t* row = rgba_.data();
    if (!all_rows_.empty())
        row = all_rows_[static_cast<std::size_t>(next_)];
    else if (!guarded([&] { png_read_row(png_, row, nullptr); }))
        return fault();
    if (++next_ == height_px_ && !guarded([&] { png_read_end(png_, nullptr); })) return fault();
    for (std::size_t pixel = 0; pixel < static_cast<std::size_t>(width_px_); ++pixel) {
        const unsigned alpha = wanted_.takes_any_size() ? 255U : row[4 * pixel + 3];
        for (std::size_t c = 0; c < 3; ++c)
            rgb[3 * pixel + c] = static_cast<std::uint8_t>((row[4 * pixel + c] * alpha + 127) / 255);
    }
    return {};
}

}  // namespace

Result<std::unique_ptr<PictureRows>> open_png_rows(InputStream stream, const RowsWanted& wanted) {
    auto rows = std::make_unique<PngRows>(std::move(stream), wanted);
    ORO_CHECK(rows->begin());
    return std::unique_ptr<PictureRows>(std::move(rows));
}

}  // namespace oro
