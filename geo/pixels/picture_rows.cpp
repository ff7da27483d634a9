#include "geo/pixels/picture_rows.h"

#include <unistd.h>

#include <array>
#include <cassert>
#include <string_view>

#include "core/base/open_file.h"

namespace oro {

Result<void> PictureRows::lose_row(std::span<const std::uint8_t>) {
    assert(false && "this picture has no loss");
    return {};
}

Result<std::unique_ptr<PictureRows>> PictureRows::lost() {
    assert(false && "this picture has no loss");
    return Error{ErrorKind::failed, "", "this picture has no loss"};
}

Result<void> RowsWanted::check_size(std::uint64_t width, std::uint64_t height) const {
    if (takes_any_size()) {
        if (width > 0 && height > 0 && width <= most_pixels / height) return {};
        return fault("has " + std::to_string(width) + "x" + std::to_string(height) +
                     " pixels: a picture may have " + std::to_string(most_pixels));
    }
    if (width == static_cast<std::uint64_t>(width_px) && height == static_cast<std::uint64_t>(height_px))
        return {};
    return fault("has " + std::to_string(width) + "x" + std::to_string(height) + " pixels, and its view " +
                 std::to_string(width_px) + "x" + std::to_string(height_px));
}

Result<std::unique_ptr<PictureRows>> open_picture_rows(const std::string& path, int width_px, int height_px) {
    const RowsWanted wanted{path, width_px, height_px};
    // OpenFile refuses what is no plain file, and waits for nobody.
    ORO_TRY(const OpenFile file, OpenFile::open(path, OpenFile::Use::read));
    ORO_TRY(const std::uint64_t size, file.size());
    std::array<char, 4> start{};
    if (size < start.size()) return wanted.fault("is no PNG, JPEG or TIFF picture");
    ORO_CHECK(file.read(0, std::as_writable_bytes(std::span(start))));
    const int descriptor = dup(file.descriptor());
    InputStream stream(descriptor < 0 ? nullptr : fdopen(descriptor, "rb"));
    if (!stream) {
        if (descriptor >= 0) close(descriptor);
        return wanted.fault("cannot be opened a second time");
    }
    const std::string_view magic(start.data(), start.size());
    if (magic == "\x89PNG") return open_png_rows(std::move(stream), wanted);
    if (magic.starts_with("\xFF\xD8\xFF")) return open_jpeg_rows(std::move(stream), wanted);
    if (magic.starts_with("II") || magic.starts_with("MM")) return open_tiff_rows(std::move(stream), wanted);
    return wanted.fault("is no PNG, JPEG or TIFF picture");
}

bool is_picture(std::string_view bytes) {
    return bytes.starts_with("\x89PNG") || bytes.starts_with("\xFF\xD8\xFF");
}

Result<std::unique_ptr<PictureRows>> open_picture_bytes(std::string_view bytes, const std::string& name,
                                                        std::uint64_t most_pixels) {
    const RowsWanted wanted{name, 0, 0, most_pixels};
    if (!is_picture(bytes)) return wanted.fault("is no PNG and no JPEG");
    // It is opened for reading alone, whatever the type says.
    InputStream stream(fmemopen(const_cast<char*>(bytes.data()), bytes.size(), "rb"));
    if (!stream) return wanted.fault("cannot be opened in memory");
    if (bytes.starts_with("\x89PNG")) return open_png_rows(std::move(stream), wanted);
    return open_jpeg_rows(std::move(stream), wanted);
}

}  // namespace oro
