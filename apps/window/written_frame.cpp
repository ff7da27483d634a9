#include "apps/window/written_frame.h"

#include <vector>

namespace oro {

Result<void> write_over_frame(const Gpu& gpu, Scene& scene, const View& view, const TrueGround& ground,
                              const Style& style, RasterPath path, FrameRenderer& renderer) {
    ORO_TRY(ViewWriting writing, find_writing(gpu, scene, view, ground, style, path));
    if (writing.is_empty()) return {};
    const auto width = static_cast<std::uint32_t>(view.camera.width_px);
    const auto height = static_cast<std::uint32_t>(view.camera.height_px);
    ORO_TRY(std::vector<std::uint8_t> rgba, renderer.read_picture(width, height));
    std::size_t out = 0;
    const RowSink rows = written_rows(writing, view.camera, [&](std::span<const std::uint8_t> rgb) {
        for (std::size_t i = 0; i < rgb.size(); i += 3, out += 4)
            std::copy_n(rgb.begin() + static_cast<std::ptrdiff_t>(i), 3,
                        rgba.begin() + static_cast<std::ptrdiff_t>(out));
        return Result<void>();
    });
    const std::vector<std::uint8_t> drawn = rgba;
    std::vector<std::uint8_t> row(std::size_t{3} * width);
    for (std::size_t at = 0; at < drawn.size(); at += std::size_t{4} * width) {
        for (std::size_t x = 0; x < width; ++x)
            std::copy_n(drawn.begin() + static_cast<std::ptrdiff_t>(at + 4 * x), 3,
                        row.begin() + static_cast<std::ptrdiff_t>(3 * x));
        ORO_CHECK(rows(row));
    }
    return renderer.replace_picture(rgba, width, height);
}

}  // namespace oro
