#include "render/frame/cylinder_picture.h"

#include <cassert>

#include "core/base/parallel.h"
#include "core/frame/ridge_lines.h"

namespace oro {
Result<CylinderPicture> render_cylinder(const Gpu& gpu, Scene& scene, const Geodetic& eye,
                                        const Cylinder& around, const CylinderCut& cut,
                                        const gpu::FrameStyle& style, const PictureOptions& options,
                                        const CylinderExtras& extras, const RenderProgress& progress) {
    const std::vector<CylinderTile> tiles = cylinder_tiles(around, eye, cut);
    assert(!tiles.empty());
    const Camera& first = tiles.front().camera;
    PictureOptions tile_options = options;
    tile_options.tau_px *= cut.oversampling;
    tile_options.keep_depths = extras.ridges;
    gpu::FrameStyle tile_style = style;
    tile_style.contours.width_px *= static_cast<float>(cut.oversampling);
    ORO_TRY(PictureRenderer renderer, PictureRenderer::create(gpu, first, tile_style, tile_options));
    CylinderPicture picture;
    picture.tiles = static_cast<int>(tiles.size());
    picture.rgb.resize(std::size_t{3} * static_cast<std::size_t>(around.width_px) *
                       static_cast<std::size_t>(around.height_px()));
    std::vector<std::uint8_t> drawn;
    double done = 0.0;
    for (const CylinderTile& tile : tiles) {
        drawn.clear();
        ORO_TRY(const PictureReport report,
                renderer.draw(
                    scene, tile.camera, tile_style,
                    [&](std::span<const std::uint8_t> row) {
                        drawn.insert(drawn.end(), row.begin(), row.end());
                        return Result<void>();
                    },
                    [&](double share) {
                        if (progress) progress((done + share) / static_cast<double>(tiles.size()));
                    }));
        picture.report.add(report);
        if (extras.ridges)
            draw_ridges({renderer.depths(), tile.camera.width_px, tile.camera.height_px}, drawn,
                        thread_count());
        if (extras.over) ORO_CHECK(extras.over(tile, drawn));
        unroll(around, tile, drawn, picture.rgb, thread_count());
        done += 1.0;
    }
    return picture;
}

}  // namespace oro
