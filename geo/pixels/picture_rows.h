// The pixels of a picture, row by row: ours, or what another program has made of one.
#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace oro {

// Rows from the top, width * 3 bytes each: 8 bits a channel, sRGB, over black where a pixel is not opaque.
class PictureRows {
  public:
    virtual ~PictureRows() = default;
    [[nodiscard]] int width_px() const { return width_px_; }
    [[nodiscard]] int height_px() const { return height_px_; }
    // True of JPEG: pixels come back near to what they were.
    [[nodiscard]] virtual bool is_lossy() const { return false; }
    // The next row; not to be asked for more than there are. Errors: a damaged or cut file, with its name.
    virtual Result<void> read_row(std::span<std::uint8_t> rgb) = 0;
    // Of lossy pictures alone: takes the rows of another picture of this size, one after the other, and gives
    // them back with the loss that this file's own settings (quantization, subsampling) bring.
    virtual Result<void> lose_row(std::span<const std::uint8_t> rgb);
    virtual Result<std::unique_ptr<PictureRows>> lost();

  protected:
    PictureRows(int width_px, int height_px) : width_px_(width_px), height_px_(height_px) {}

    int width_px_;  // of one that takes any size: once it is open
    int height_px_;
};

// Opens a PNG, JPEG or TIFF, told by content, whose size is as expected: memory is taken for no other.
// Errors: no such file, no such picture, another size.
Result<std::unique_ptr<PictureRows>> open_picture_rows(const std::string& path, int width_px, int height_px);

// Whether bytes begin as those of a PNG or a JPEG do.
bool is_picture(std::string_view bytes);
// Opens a PNG or JPEG that lies in memory, of any size up to so many pixels. Its opacity is passed over: a
// pixel has the colour that stands in the file. The bytes outlive it. name: what errors call it. Errors: no
// such picture, or a larger one.
Result<std::unique_ptr<PictureRows>> open_picture_bytes(std::string_view bytes, const std::string& name,
                                                        std::uint64_t most_pixels);

// Not for use outside picture_rows*.cpp: of each format, for a file of that content.
struct RowsWanted {
    std::string path;
    int width_px{};
    int height_px{};
    std::uint64_t most_pixels{};  // not 0: any size up to so many, and opacity is passed over

    // An error of the file.
    [[nodiscard]] Error fault(const std::string& what) const { return {ErrorKind::failed, path, what}; }
    // That a picture has this size, or one that may be.
    [[nodiscard]] Result<void> check_size(std::uint64_t width, std::uint64_t height) const;
    [[nodiscard]] bool takes_any_size() const { return most_pixels > 0; }
};
struct CloseStream {
    void operator()(std::FILE* stream) const { std::fclose(stream); }
};
using InputStream = std::unique_ptr<std::FILE, CloseStream>;
Result<std::unique_ptr<PictureRows>> open_png_rows(InputStream stream, const RowsWanted& wanted);
Result<std::unique_ptr<PictureRows>> open_jpeg_rows(InputStream stream, const RowsWanted& wanted);
Result<std::unique_ptr<PictureRows>> open_tiff_rows(InputStream stream, const RowsWanted& wanted);

}  // namespace oro
