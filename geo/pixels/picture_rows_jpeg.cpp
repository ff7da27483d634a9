#include <cstdio>  // jpeglib.h needs FILE

#include <jpeglib.h>

#include <array>
#include <csetjmp>
#include <cstdlib>
#include <vector>

#include "geo/pixels/picture_rows.h"

namespace oro {
namespace {

// What libjpeg calls instead of ending the program: it jumps. As in picture_jpeg.cpp, every call of libjpeg
// stands in a lambda given to guarded(), and what is jumped over needs no destructor.
struct JpegFaults {
    jpeg_error_mgr manager{};  // first: libjpeg knows this alone
    std::jmp_buf jump{};
    std::array<char, JMSG_LENGTH_MAX> message{};

    jpeg_error_mgr* begin() {
        jpeg_std_error(&manager);
        manager.error_exit = on_error;
        manager.output_message = [](j_common_ptr) {};
        // A warning is damage: bytes that are missing come as grey.
        manager.emit_message = [](j_common_ptr codec, int level) {
            if (level < 0) on_error(codec);
        };
        return &manager;
    }
    [[noreturn]] static void on_error(j_common_ptr codec) {
        auto& faults = *reinterpret_cast<JpegFaults*>(codec->err);
        codec->err->format_message(codec, faults.message.data());
        std::longjmp(faults.jump, 1);
    }
    template <class Step>
    bool guarded(Step&& step) {
        if (setjmp(jump) != 0) return false;
        step();
        return true;
    }
};

// A JPEG in memory, which libjpeg lets grow.
struct JpegBytes {
    unsigned char* bytes{nullptr};
    unsigned long count{0};

    JpegBytes() = default;
    JpegBytes(const JpegBytes&) = delete;
    JpegBytes& operator=(const JpegBytes&) = delete;
    ~JpegBytes() { std::free(bytes); }
};

class JpegRows final : public PictureRows {
  public:
    JpegRows(InputStream stream, std::unique_ptr<JpegBytes> bytes, const RowsWanted& wanted)
        : PictureRows(wanted.width_px, wanted.height_px),
          wanted_(wanted),
          stream_(std::move(stream)),
          bytes_(std::move(bytes)) {}
    ~JpegRows() override {
        if (opened_) jpeg_destroy_decompress(&decoder_);
        if (losing_) jpeg_destroy_compress(&encoder_);
    }
    JpegRows(const JpegRows&) = delete;
    JpegRows& operator=(const JpegRows&) = delete;

    Result<void> begin();
    [[nodiscard]] bool is_lossy() const override { return true; }
    Result<void> read_row(std::span<std::uint8_t> rgb) override;
    Result<void> lose_row(std::span<const std::uint8_t> rgb) override;
    Result<std::unique_ptr<PictureRows>> lost() override;

  private:
    [[nodiscard]] Error fault() const {
        return wanted_.fault(std::string("JPEG: ") + faults_.message.data());
    }
    void begin_losing();

    RowsWanted wanted_;
    InputStream stream_;                // either this
    std::unique_ptr<JpegBytes> bytes_;  // or that
    JpegFaults faults_;
    jpeg_decompress_struct decoder_{};
    jpeg_compress_struct encoder_{};
    std::unique_ptr<JpegBytes> lost_;
    bool opened_{false}, losing_{false};
};

Result<void> JpegRows::begin() {
    decoder_.err = encoder_.err = faults_.begin();
    if (!faults_.guarded([&] {
            jpeg_create_decompress(&decoder_);
            opened_ = true;
            if (stream_)
                jpeg_stdio_src(&decoder_, stream_.get());
            else
                jpeg_mem_src(&decoder_, bytes_->bytes, bytes_->count);
            jpeg_read_header(&decoder_, TRUE);
        }))
        return fault();
    ORO_CHECK(wanted_.check_size(decoder_.image_width, decoder_.image_height));
    width_px_ = static_cast<int>(decoder_.image_width), height_px_ = static_cast<int>(decoder_.image_height);
    if (decoder_.num_components != 1 && decoder_.num_components != 3)
        return wanted_.fault("JPEG: " + std::to_string(decoder_.num_components) + " colours");
    if (!faults_.guarded([&] {
            decoder_.out_color_space = JCS_RGB;
            jpeg_start_decompress(&decoder_);
        }))
        return fault();
    return {};
}

Result<void> JpegRows::read_row(std::span<std::uint8_t> rgb) {
    JSAMPLE* row = rgb.data();
    if (!faults_.guarded([&] { jpeg_read_scanlines(&decoder_, &row, 1); })) return fault();
    return {};
}

void JpegRows::begin_losing() {
    jpeg_create_compress(&encoder_);
    losing_ = true;
    jpeg_mem_dest(&encoder_, &lost_->bytes, &lost_->count);
    jpeg_copy_critical_parameters(&decoder_, &encoder_);
    encoder_.in_color_space = JCS_RGB;
    encoder_.input_components = 3;
    jpeg_start_compress(&encoder_, TRUE);
}

Result<void> JpegRows::lose_row(std::span<const std::uint8_t> rgb) {
    if (!lost_) lost_ = std::make_unique<JpegBytes>();
    // libjpeg reads the row only, whatever its type says.
    auto* row = const_cast<JSAMPLE*>(rgb.data());
    if (!faults_.guarded([&] {
            if (!losing_) begin_losing();
            jpeg_write_scanlines(&encoder_, &row, 1);
        }))
        return fault();
    return {};
}

Result<std::unique_ptr<PictureRows>> JpegRows::lost() {
    if (!faults_.guarded([&] { jpeg_finish_compress(&encoder_); })) return fault();
    auto rows = std::make_unique<JpegRows>(nullptr, std::move(lost_), wanted_);
    ORO_CHECK(rows->begin());
    return std::unique_ptr<PictureRows>(std::move(rows));
}

}  // namespace

Result<std::unique_ptr<PictureRows>> open_jpeg_rows(InputStream stream, const RowsWanted& wanted) {
    auto rows = std::make_unique<JpegRows>(std::move(stream), nullptr, wanted);
    ORO_CHECK(rows->begin());
    return std::unique_ptr<PictureRows>(std::move(rows));
}

}  // namespace oro
