#include <tiffio.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <system_error>
#include <vector>

#include "geo/pictures/picture_formats.h"

namespace oro {
namespace {

constexpr std::uint64_t strip_bytes = 1 << 18;

class TiffPicture final : public EncodedPicture {
  public:
    explicit TiffPicture(PictureParts parts) : EncodedPicture(std::move(parts)) {}
    ~TiffPicture() override { TiffPicture::release(); }
    TiffPicture(const TiffPicture&) = delete;
    TiffPicture& operator=(const TiffPicture&) = delete;

    bool begin() override;
    bool encode_row(const std::uint8_t* rgb) override {
        // The predictor works in the row that it is given: one that may be spoilt.
        row_copy_.assign(rgb, rgb + static_cast<std::size_t>(parts().width_px) *
                                        static_cast<std::size_t>(parts().channels));
        return TIFFWriteScanline(tiff_, row_copy_.data(), row_++, 0) == 1 && !faulty();
    }
    bool end() override { return TIFFWriteDirectory(tiff_) == 1 && !faulty(); }
    void release() noexcept override {
        if (tiff_) TIFFClose(tiff_);
        tiff_ = nullptr;
    }

    static Result<std::unique_ptr<PictureWriter>> create(PictureParts parts) {
        return started(std::make_unique<TiffPicture>(std::move(parts)));
    }

  private:
    static TiffPicture& of(thandle_t handle) { return *static_cast<TiffPicture*>(handle); }
    static tmsize_t on_read(thandle_t handle, void* to, tmsize_t count);
    static tmsize_t on_write(thandle_t handle, void* from, tmsize_t count) {
        return of(handle).put(from, static_cast<std::size_t>(count)) ? count : -1;
    }
    static toff_t on_seek(thandle_t handle, toff_t offset, int whence);
    static int on_close(thandle_t) { return 0; }  // the file is closed when it is committed or abandoned
    static toff_t on_size(thandle_t handle);
    static int on_error(TIFF*, void* picture, const char*, const char* format, va_list arguments);
    static int on_warning(TIFF*, void*, const char*, const char*, va_list) { return 1; }

    bool open();
    bool set(const ExifField& field);
    // Writes a directory apart from the picture's own; its place in the file, or 0.
    std::uint64_t write_directory(const std::vector<ExifField>& fields);
    void describe_pixels();
    void describe_place(const GeoTiffTags& place);

    TIFF* tiff_{nullptr};
    std::vector<std::uint8_t> row_copy_;
    std::uint32_t row_{0};
};

tmsize_t TiffPicture::on_read(thandle_t handle, void* to, tmsize_t count) {
    if (of(handle).faulty()) return -1;
    return static_cast<tmsize_t>(std::fread(to, 1, static_cast<std::size_t>(count), of(handle).stream()));
}

toff_t TiffPicture::on_seek(thandle_t handle, toff_t offset, int whence) {
    constexpr auto nowhere = static_cast<toff_t>(-1);
    TiffPicture& picture = of(handle);
    if (picture.faulty()) return nowhere;
    // Seeking flushes: a full disk may show here.
    if (fseeko(picture.stream(), static_cast<off_t>(offset), whence) != 0) {
        picture.note("cannot be written: " + std::generic_category().message(errno));
        return nowhere;
    }
    return static_cast<toff_t>(ftello(picture.stream()));
}

toff_t TiffPicture::on_size(thandle_t handle) {
    if (of(handle).faulty()) return 0;
    std::FILE* const stream = of(handle).stream();
    const off_t place = ftello(stream);
    if (fseeko(stream, 0, SEEK_END) != 0) return 0;
    const off_t size = ftello(stream);
    return fseeko(stream, place, SEEK_SET) == 0 ? static_cast<toff_t>(size) : 0;
}

int TiffPicture::on_error(TIFF*, void* picture, const char*, const char* format, va_list arguments) {
    std::array<char, 512> message{};
    std::vsnprintf(message.data(), message.size(), format, arguments);
    static_cast<TiffPicture*>(picture)->note(std::string("TIFF: ") + message.data());
    return 1;  // and no global handler
}

bool TiffPicture::open() {
    TIFFOpenOptions* const options = TIFFOpenOptionsAlloc();
    if (!options) return note("TIFF: no memory"), false;
    TIFFOpenOptionsSetErrorHandlerExtR(options, on_error, this);
    TIFFOpenOptionsSetWarningHandlerExtR(options, on_warning, this);
    // Deflate makes noise larger by less than a thousandth.
    const double bytes = 1.0 * parts().channels * parts().width_px * parts().height_px * 1.001 +
                         static_cast<double>(parts().xmp.size());
    const bool big = bytes > 4.0e9;
    // Little-endian on every machine.
    tiff_ = TIFFClientOpenExt(parts().path.c_str(), big ? "wl8" : "wl", this, on_read, on_write, on_seek,
                              on_close, on_size, nullptr, nullptr, options);
    TIFFOpenOptionsFree(options);
    return tiff_ != nullptr;
}

// libtiff takes rationals as doubles and finds fractions for them; every value of ours is one with a
// denominator that 32 bits hold, and comes back within a part in 1e9.
bool TiffPicture::set(const ExifField& field) {
    const std::uint32_t tag = field.tag;
    if (const auto* text = std::get_if<std::string>(&field.value))
        return TIFFSetField(tiff_, tag, text->c_str()) == 1;
    if (const auto* bytes = std::get_if<std::vector<std::uint8_t>>(&field.value)) {
        if (bytes->size() == 1) return TIFFSetField(tiff_, tag, bytes->front()) == 1;
        const TIFFField* const kind = TIFFFieldWithTag(tiff_, tag);
        if (kind && TIFFFieldPassCount(kind) != 0)
            return TIFFSetField(tiff_, tag, static_cast<std::uint32_t>(bytes->size()), bytes->data()) == 1;
        return TIFFSetField(tiff_, tag, bytes->data()) == 1;
    }
    if (const auto* integers = std::get_if<std::vector<std::uint32_t>>(&field.value))
        return TIFFSetField(tiff_, tag, integers->front()) == 1;
    std::vector<double> values;
    for (const ExifRational& value : std::get<ExifRationals>(field.value))
        values.push_back(static_cast<double>(value.numerator) / value.denominator);
    return (values.size() == 1 ? TIFFSetField(tiff_, tag, values.front())
                               : TIFFSetField(tiff_, tag, values.data())) == 1;
}

std::uint64_t TiffPicture::write_directory(const std::vector<ExifField>& fields) {
    // Of a JPEG's YCbCr; a TIFF has its size elsewhere.
    static constexpr std::array<std::uint16_t, 3> foreign{EXIFTAG_COMPONENTSCONFIGURATION,
                                                          EXIFTAG_PIXELXDIMENSION, EXIFTAG_PIXELYDIMENSION};
    for (const ExifField& field : fields)
        if (std::find(foreign.begin(), foreign.end(), field.tag) == foreign.end() && !set(field)) return 0;
    std::uint64_t place = 0;
    const bool written = TIFFWriteCustomDirectory(tiff_, &place) == 1;
    TIFFFreeDirectory(tiff_);  // what makes the next directory forgets this one's values without freeing them
    return written ? place : 0;
}

void TiffPicture::describe_pixels() {
    const auto row_bytes =
        static_cast<std::uint64_t>(parts().width_px) * static_cast<std::uint64_t>(parts().channels);
    TIFFSetField(tiff_, TIFFTAG_IMAGEWIDTH, static_cast<std::uint32_t>(parts().width_px));
    TIFFSetField(tiff_, TIFFTAG_IMAGELENGTH, static_cast<std::uint32_t>(parts().height_px));
    TIFFSetField(tiff_, TIFFTAG_BITSPERSAMPLE, 8);
    TIFFSetField(tiff_, TIFFTAG_SAMPLESPERPIXEL, parts().channels);
    if (parts().channels == 4) {
        const std::array<std::uint16_t, 1> kind{EXTRASAMPLE_UNASSALPHA};
        TIFFSetField(tiff_, TIFFTAG_EXTRASAMPLES, 1, kind.data());
    }
    TIFFSetField(tiff_, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
    TIFFSetField(tiff_, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_RGB);
    TIFFSetField(tiff_, TIFFTAG_ORIENTATION, ORIENTATION_TOPLEFT);
    TIFFSetField(tiff_, TIFFTAG_COMPRESSION, COMPRESSION_ADOBE_DEFLATE);
    TIFFSetField(tiff_, TIFFTAG_PREDICTOR, PREDICTOR_HORIZONTAL);
    TIFFSetField(tiff_, TIFFTAG_ROWSPERSTRIP,
                 static_cast<std::uint32_t>(std::max<std::uint64_t>(1, strip_bytes / row_bytes)));
}

// libtiff knows them only when it is told. Source: OGC 19-008r4, GeoTIFF standard 1.1, annex B.
void TiffPicture::describe_place(const GeoTiffTags& place) {
    static std::array<char[32], 6> names{"GeoPixelScale",   "GeoTiePoints",    "GeoTransformation",
                                         "GeoKeyDirectory", "GeoDoubleParams", "GeoAsciiParams"};
    static const std::array<TIFFFieldInfo, 6> fields{
        {{33550, -1, -1, TIFF_DOUBLE, FIELD_CUSTOM, 1, 1, names[0]},
         {33922, -1, -1, TIFF_DOUBLE, FIELD_CUSTOM, 1, 1, names[1]},
         {34264, -1, -1, TIFF_DOUBLE, FIELD_CUSTOM, 1, 1, names[2]},
         {34735, -1, -1, TIFF_SHORT, FIELD_CUSTOM, 1, 1, names[3]},
         {34736, -1, -1, TIFF_DOUBLE, FIELD_CUSTOM, 1, 1, names[4]},
         {34737, -1, -1, TIFF_ASCII, FIELD_CUSTOM, 1, 0, names[5]}}};
    TIFFMergeFieldInfo(tiff_, fields.data(), static_cast<std::uint32_t>(fields.size()));
    const auto set_all = [&](std::uint32_t tag, const auto& values) {
        if (!values.empty())
            TIFFSetField(tiff_, tag, static_cast<std::uint16_t>(values.size()), values.data());
    };
    set_all(33550, place.pixel_scale);
    set_all(33922, place.tie_points);
    set_all(34264, place.transformation);
    set_all(34735, place.keys);
    set_all(34736, place.doubles);
    if (!place.text.empty()) TIFFSetField(tiff_, 34737, place.text.c_str());
}

// The EXIF and GPS directories stand before the pixels, so that nothing of the picture's directory is written
// twice.
bool TiffPicture::begin() {
    if (!open()) return false;
    if (TIFFCreateEXIFDirectory(tiff_) != 0) return false;
    const std::uint64_t exif = write_directory(parts().exif.photo);
    if (exif == 0 || TIFFCreateGPSDirectory(tiff_) != 0) return false;
    const std::uint64_t gps = write_directory(parts().exif.gps);
    if (gps == 0 || TIFFCreateDirectory(tiff_) != 0) return false;
    describe_pixels();
    if (parts().place) describe_place(*parts().place);
    for (const ExifField& field : parts().exif.image)
        if (!set(field)) return false;
    TIFFSetField(tiff_, TIFFTAG_EXIFIFD, exif);
    TIFFSetField(tiff_, TIFFTAG_GPSIFD, gps);
    TIFFSetField(tiff_, TIFFTAG_XMLPACKET, static_cast<std::uint32_t>(parts().xmp.size()),
                 parts().xmp.data());
    return !faulty();
}

}  // namespace

Result<std::unique_ptr<PictureWriter>> create_tiff(PictureParts parts) {
    return TiffPicture::create(std::move(parts));
}

}  // namespace oro
