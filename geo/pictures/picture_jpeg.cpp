#include <cstdio>  // jpeglib.h needs FILE

#include <jpeglib.h>

#include <array>
#include <csetjmp>
#include <vector>

#include "geo/pictures/picture_formats.h"

namespace oro {
namespace {

constexpr int quality = 92;
constexpr std::size_t largest_segment = 65533;  // a marker's length counts itself, two bytes, in sixteen bits

// libjpeg reports a fault by a call that must not return; here it jumps. What it jumps over must need no
// destructor: every call of libjpeg stands in a lambda given to guarded().
class JpegPicture final : public EncodedPicture {
  public:
    explicit JpegPicture(PictureParts parts) : EncodedPicture(std::move(parts)) {}
    ~JpegPicture() override { JpegPicture::release(); }
    JpegPicture(const JpegPicture&) = delete;
    JpegPicture& operator=(const JpegPicture&) = delete;

    bool begin() override;
    bool encode_row(const std::uint8_t* rgb) override {
        // libjpeg reads the row only, whatever its type says.
        auto* row = const_cast<JSAMPLE*>(rgb);
        return guarded([&] { jpeg_write_scanlines(&codec_, &row, 1); });
    }
    bool end() override {
        return guarded([&] { jpeg_finish_compress(&codec_); });
    }
    void release() noexcept override {
        if (created_) jpeg_destroy_compress(&codec_);
        created_ = false;
    }

    static Result<std::unique_ptr<PictureWriter>> create(PictureParts parts) {
        return started(std::make_unique<JpegPicture>(std::move(parts)));
    }

  private:
    template <class Step>
    bool guarded(Step&& step) {
        if (setjmp(jump_) != 0) return false;
        step();
        return !faulty();
    }

    static JpegPicture& of(j_common_ptr codec) { return *static_cast<JpegPicture*>(codec->client_data); }
    [[noreturn]] static void on_error(j_common_ptr codec) {
        JpegPicture& picture = of(codec);
        {
            std::array<char, JMSG_LENGTH_MAX> message{};
            codec->err->format_message(codec, message.data());
            picture.note(std::string("JPEG: ") + message.data());
        }
        std::longjmp(picture.jump_, 1);
    }
    static void on_message(j_common_ptr) {}

    // The destination: a buffer that goes to the file when it is full.
    void refill() {
        target_.next_output_byte = buffer_.data();
        target_.free_in_buffer = buffer_.size();
    }
    static void on_start(j_compress_ptr codec) { of(reinterpret_cast<j_common_ptr>(codec)).refill(); }
    static boolean on_full(j_compress_ptr codec) {
        JpegPicture& picture = of(reinterpret_cast<j_common_ptr>(codec));
        if (!picture.put(picture.buffer_.data(), picture.buffer_.size())) std::longjmp(picture.jump_, 1);
        picture.refill();
        return TRUE;
    }
    static void on_end(j_compress_ptr codec) {
        JpegPicture& picture = of(reinterpret_cast<j_common_ptr>(codec));
        const std::size_t count = picture.buffer_.size() - picture.target_.free_in_buffer;
        if (!picture.put(picture.buffer_.data(), count)) std::longjmp(picture.jump_, 1);
    }
    void write_header(const std::string& exif, const std::string& xmp);
    void write_app1(const std::string& bytes);

    jpeg_compress_struct codec_{};
    jpeg_error_mgr errors_{};
    jpeg_destination_mgr target_{};
    std::jmp_buf jump_{};
    std::array<JOCTET, 65536> buffer_{};
    bool created_{false};
};

void JpegPicture::write_header(const std::string& exif, const std::string& xmp) {
    jpeg_create_compress(&codec_);
    created_ = true;
    codec_.client_data = this;
    target_.init_destination = on_start;
    target_.empty_output_buffer = on_full;
    target_.term_destination = on_end;
    codec_.dest = &target_;
    codec_.image_width = static_cast<JDIMENSION>(parts().width_px);
    codec_.image_height = static_cast<JDIMENSION>(parts().height_px);
    codec_.input_components = 3;
    codec_.in_color_space = JCS_RGB;
    jpeg_set_defaults(&codec_);
    jpeg_set_quality(&codec_, quality, TRUE);
    codec_.comp_info[0].h_samp_factor = 1;  // 4:4:4: ridges against the sky keep their colour
    codec_.comp_info[0].v_samp_factor = 1;
    codec_.write_JFIF_header = FALSE;  // EXIF wants its APP1 first, and says all that JFIF does
    jpeg_start_compress(&codec_, TRUE);
    write_app1(exif);
    write_app1(xmp);
}

void JpegPicture::write_app1(const std::string& bytes) {
    jpeg_write_marker(&codec_, JPEG_APP0 + 1, reinterpret_cast<const JOCTET*>(bytes.data()),
                      static_cast<unsigned>(bytes.size()));
}

bool JpegPicture::begin() {
    ExifFields fields = parts().exif;
    fields.image.push_back(
        {0x0213, ExifType::short_integer, std::vector<std::uint32_t>{1}});  // YCbCrPositioning
    Result<std::vector<std::uint8_t>> block = exif_block(fields);
    if (!block.ok()) return note(block.error().line()), false;
    const std::string exif = std::string("Exif\0\0", 6) + std::string(block->begin(), block->end());
    const std::string xmp = std::string("http://ns.adobe.com/xap/1.0/") + '\0' + parts().xmp;
    for (const auto& [name, size] : {std::pair{"EXIF", exif.size()}, {"XMP", xmp.size()}})
        if (size > largest_segment) {
            note("the picture's " + std::string(name) + " takes " + std::to_string(size) +
                 " bytes, a JPEG holds at most " + std::to_string(largest_segment) + "; use PNG or TIFF");
            return false;
        }
    codec_.err = jpeg_std_error(&errors_);
    errors_.error_exit = on_error;
    errors_.output_message = on_message;
    codec_.client_data = this;
    return guarded([&] { write_header(exif, xmp); });
}

}  // namespace

Result<std::unique_ptr<PictureWriter>> create_jpeg(PictureParts parts) {
    if (parts.width_px > JPEG_MAX_DIMENSION || parts.height_px > JPEG_MAX_DIMENSION)
        return Error{ErrorKind::usage, parts.path,
                     "a JPEG is at most " + std::to_string(JPEG_MAX_DIMENSION) +
                         " pixels wide and high; use PNG or TIFF"};
    return JpegPicture::create(std::move(parts));
}

}  // namespace oro
