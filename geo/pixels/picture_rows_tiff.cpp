#include <tiffio.h>

#include <algorithm>
#include <array>
#include <cstdarg>
#include <cstdio>
#include <vector>

#include "geo/pixels/picture_rows.h"

namespace oro {
namespace {

constexpr std::uint64_t most_bytes_at_once = 256U << 20U;

class TiffRows final : public PictureRows {
  public:
    TiffRows(InputStream stream, const RowsWanted& wanted)
        : PictureRows(wanted.width_px, wanted.height_px), stream_(std::move(stream)), wanted_(wanted) {}
    ~TiffRows() override {
        if (begun_) TIFFRGBAImageEnd(&image_);
        if (tiff_) TIFFClose(tiff_);
    }
    TiffRows(const TiffRows&) = delete;
    TiffRows& operator=(const TiffRows&) = delete;

    Result<void> begin();
    Result<void> read_row(std::span<std::uint8_t> rgb) override;

  private:
    static TiffRows& of(thandle_t handle) { return *static_cast<TiffRows*>(handle); }
    static tmsize_t on_read(thandle_t handle, void* to, tmsize_t count) {
        return static_cast<tmsize_t>(
            std::fread(to, 1, static_cast<std::size_t>(count), of(handle).stream_.get()));
    }
    static tmsize_t on_write(thandle_t, void*, tmsize_t) { return -1; }
    static toff_t on_seek(thandle_t handle, toff_t offset, int whence) {
        std::FILE* const stream = of(handle).stream_.get();
        if (fseeko(stream, static_cast<off_t>(offset), whence) != 0) return static_cast<toff_t>(-1);
        return static_cast<toff_t>(ftello(stream));
    }
    static int on_close(thandle_t) { return 0; }
    static toff_t on_size(thandle_t handle) {
        std::FILE* const stream = of(handle).stream_.get();
        const off_t place = ftello(stream);
        if (fseeko(stream, 0, SEEK_END) != 0) return 0;
        const off_t size = ftello(stream);
        return fseeko(stream, place, SEEK_SET) == 0 ? static_cast<toff_t>(size) : 0;
    }
    static int on_error(TIFF*, void* rows, const char*, const char* format, va_list arguments) {
        std::array<char, 512> message{};
        std::vsnprintf(message.data(), message.size(), format, arguments);
        std::string& fault = static_cast<TiffRows*>(rows)->fault_;
        if (fault.empty()) fault = message.data();
        return 1;  // and no global handler
    }
    static int on_warning(TIFF*, void*, const char*, const char*, va_list) { return 1; }
    [[nodiscard]] Error fault(const std::string& otherwise) const {
        return wanted_.fault("TIFF: " + (fault_.empty() ? otherwise : fault_));
    }
    Result<void> read_block();

    InputStream stream_;
    RowsWanted wanted_;
    TIFF* tiff_{nullptr};
    TIFFRGBAImage image_{};
    bool begun_{false};
    std::string fault_;
    std::vector<std::uint32_t> block_;  // rows that are decoded together
    int rows_at_once_{1};
    int first_in_block_{0}, rows_in_block_{0};
    int next_{0};
};

Result<void> TiffRows::begin() {
    TIFFOpenOptions* const options = TIFFOpenOptionsAlloc();
    if (!options) return wanted_.fault("TIFF: no memory");
    TIFFOpenOptionsSetErrorHandlerExtR(options, on_error, this);
    TIFFOpenOptionsSetWarningHandlerExtR(options, on_warning, this);
    tiff_ = TIFFClientOpenExt(wanted_.path.c_str(), "r", this, on_read, on_write, on_seek, on_close, on_size,
                              nullptr, nullptr, options);
    TIFFOpenOptionsFree(options);
    if (!tiff_) return fault("cannot be opened");
    std::uint32_t width = 0, height = 0, together = 0;
    TIFFGetField(tiff_, TIFFTAG_IMAGEWIDTH, &width);
    TIFFGetField(tiff_, TIFFTAG_IMAGELENGTH, &height);
    ORO_CHECK(wanted_.check_size(width, height));
    std::array<char, 1024> reason{};
    if (TIFFRGBAImageBegin(&image_, tiff_, 1, reason.data()) == 0) return fault(reason.data());
    begun_ = true;
    image_.req_orientation = ORIENTATION_TOPLEFT;
    TIFFGetFieldDefaulted(tiff_, TIFFIsTiled(tiff_) != 0 ? TIFFTAG_TILELENGTH : TIFFTAG_ROWSPERSTRIP,
                          &together);
    const std::uint64_t most = std::max<std::uint64_t>(1, most_bytes_at_once / (std::uint64_t{width} * 4));
    rows_at_once_ =
        static_cast<int>(std::clamp<std::uint64_t>(together, 1, std::min<std::uint64_t>(most, height)));
    block_.resize(static_cast<std::size_t>(rows_at_once_) * width);
    return {};
}

Result<void> TiffRows::read_block() {
    first_in_block_ = next_;
    rows_in_block_ = std::min(rows_at_once_, height_px_ - next_);
    image_.row_offset = next_;
    image_.col_offset = 0;
    if (TIFFRGBAImageGet(&image_, block_.data(), static_cast<std::uint32_t>(width_px_),
                         static_cast<std::uint32_t>(rows_in_block_)) == 0 ||
        !fault_.empty())
        return fault("cannot be read");
    return {};
}

Result<void> TiffRows::read_row(std::span<std::uint8_t> rgb) {
    if (next_ >= first_in_block_ + rows_in_block_) ORO_CHECK(read_block());
    const std::uint32_t* const row = block_.data() + static_cast<std::size_t>(next_ - first_in_block_) *
                                                         static_cast<std::size_t>(width_px_);
    for (std::size_t pixel = 0; pixel < static_cast<std::size_t>(width_px_); ++pixel) {
        // libtiff has multiplied by alpha already.
        rgb[3 * pixel] = static_cast<std::uint8_t>(TIFFGetR(row[pixel]));
        rgb[3 * pixel + 1] = static_cast<std::uint8_t>(TIFFGetG(row[pixel]));
        rgb[3 * pixel + 2] = static_cast<std::uint8_t>(TIFFGetB(row[pixel]));
    }
    ++next_;
    return {};
}

}  // namespace

Result<std::unique_ptr<PictureRows>> open_tiff_rows(InputStream stream, const RowsWanted& wanted) {
    auto rows = std::make_unique<TiffRows>(std::move(stream), wanted);
    ORO_CHECK(rows->begin());
    return std::unique_ptr<PictureRows>(std::move(rows));
}

}  // namespace oro
