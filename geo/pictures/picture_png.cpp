#include <png.h>

#include <csetjmp>
#include <vector>

#include "geo/pictures/picture_formats.h"

namespace oro {
namespace {

// libpng reports a fault by longjmp. What it jumps over must need no destructor: every call of libpng stands
// in a lambda given to guarded(), and its callbacks end their own objects before they call png_error.
class PngPicture final : public EncodedPicture {
  public:
    explicit PngPicture(PictureParts parts) : EncodedPicture(std::move(parts)) {}
    ~PngPicture() override { PngPicture::release(); }
    PngPicture(const PngPicture&) = delete;
    PngPicture& operator=(const PngPicture&) = delete;

    bool begin() override;
    bool encode_row(const std::uint8_t* rgb) override {
        return guarded([&] { png_write_row(png_, rgb); });
    }
    bool end() override {
        // With an info structure here, libpng 1.6 writes eXIf a second time.
        return guarded([&] { png_write_end(png_, nullptr); });
    }
    void release() noexcept override {
        if (png_) png_destroy_write_struct(&png_, &info_);
        png_ = nullptr;
        info_ = nullptr;
    }

    static Result<std::unique_ptr<PictureWriter>> create(PictureParts parts) {
        return started(std::make_unique<PngPicture>(std::move(parts)));
    }

  private:
    template <class Step>
    bool guarded(Step&& step) {
        if (setjmp(png_jmpbuf(png_)) != 0) return false;
        step();
        return !faulty();
    }

    [[noreturn]] static void on_error(png_structp png, png_const_charp message) {
        static_cast<PngPicture*>(png_get_error_ptr(png))->note(std::string("PNG: ") + message);
        png_longjmp(png, 1);
    }
    static void on_warning(png_structp, png_const_charp) {}
    static void on_write(png_structp png, png_bytep bytes, png_size_t count) {
        if (!static_cast<PngPicture*>(png_get_io_ptr(png))->put(bytes, count)) png_error(png, "the file");
    }
    static void on_flush(png_structp) {}
    void write_header(png_bytep exif, png_uint_32 exif_size, png_text* xmp);

    png_structp png_{nullptr};
    png_infop info_{nullptr};
};

void PngPicture::write_header(png_bytep exif, png_uint_32 exif_size, png_text* xmp) {
    png_set_write_fn(png_, this, on_write, on_flush);
    png_set_IHDR(png_, info_, static_cast<png_uint_32>(parts().width_px),
                 static_cast<png_uint_32>(parts().height_px), 8,
                 parts().channels == 4 ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB_gAMA_and_cHRM(png_, info_, PNG_sRGB_INTENT_PERCEPTUAL);
    png_set_eXIf_1(png_, info_, exif_size, exif);
    png_set_text(png_, info_, xmp, 1);
    // It leaves out a tag that it has no memory for, and warns alone.
    if (png_get_valid(png_, info_, PNG_INFO_eXIf) == 0 || png_get_text(png_, info_, nullptr, nullptr) != 1)
        png_error(png_, "no memory for the tags");
    png_write_info(png_, info_);
}

bool PngPicture::begin() {
    ExifFields fields = parts().exif;
    Result<std::vector<std::uint8_t>> exif = exif_block(fields);
    if (!exif.ok()) return note(exif.error().line()), false;
    png_ = png_create_write_struct(PNG_LIBPNG_VER_STRING, this, on_error, on_warning);
    if (png_) info_ = png_create_info_struct(png_);
    if (!info_) return note("PNG: no memory"), false;
    std::string keyword = "XML:com.adobe.xmp";
    std::string packet = parts().xmp;
    png_text xmp{};
    xmp.compression = PNG_ITXT_COMPRESSION_NONE;  // the XMP specification, part 3, asks for it
    xmp.key = keyword.data();
    xmp.text = packet.data();
    xmp.itxt_length = packet.size();
    std::uint8_t* const block = exif->data();
    const auto block_size = static_cast<png_uint_32>(exif->size());
    return guarded([&] { write_header(block, block_size, &xmp); });
}

}  // namespace

Result<std::unique_ptr<PictureWriter>> create_png(PictureParts parts) {
    constexpr int most = 1'000'000;  // libpng's own limit, PNG_USER_WIDTH_MAX
    if (parts.width_px > most || parts.height_px > most)
        return Error{ErrorKind::usage, parts.path, "a PNG is at most 1000000 pixels wide and high; use TIFF"};
    return PngPicture::create(std::move(parts));
}

}  // namespace oro
