#include "render/frame/shown_ground.h"

#include <algorithm>
#include <cassert>

#include "render/frame/settled_frame.h"

namespace oro {
namespace {

// The rows of a tile that were read at a time.
struct ReadRows {
    const std::vector<ShownTriangle>& triangles;
    int first;
    int count;
};

void tell_rows(const ReadRows& rows, const Camera& camera, const Tile& tile, int step_px,
               const GroundSink& sink) {
    const glm::dvec2 tangent = camera.half_fov_tangent();
    for (int row = 0; row < rows.count; ++row) {
        const int y = tile.y_px + rows.first + row;
        if (y % step_px != 0) continue;
        for (int column = 0; column < tile.width_px; ++column) {
            const int x = tile.x_px + column;
            if (x % step_px != 0) continue;
            const glm::dvec3 ray((2.0 * (x + 0.5) / camera.width_px - 1.0) * tangent.x,
                                 (1.0 - 2.0 * (y + 0.5) / camera.height_px) * tangent.y, -1.0);
            const auto at = static_cast<std::size_t>(row) * static_cast<std::size_t>(tile.width_px) +
                            static_cast<std::size_t>(column);
            sink(x, y, drawn_point(rows.triangles[at], ray));
        }
    }
}

}  // namespace

Result<void> shown_ground(const Gpu& gpu, Scene& scene, const Camera& camera, const PictureOptions& options,
                          int step_px, const GroundSink& sink) {
    assert(step_px > 0);
    return shown_triangles(
        gpu, scene, camera, options,
        [&](const Tile& tile, int first_row, int rows, const std::vector<ShownTriangle>& triangles) {
            tell_rows({triangles, first_row, rows}, camera, tile, step_px, sink);
        });
}

Result<void> shown_triangles(const Gpu& gpu, Scene& scene, const Camera& camera,
                             const PictureOptions& options, const TriangleSink& sink) {
    FrameRendererOptions renderer_options;
    renderer_options.extent = tile_extent(gpu, camera, options.largest_tile_px);
    renderer_options.keep_triangles = true;
    renderer_options.shades = false;
    renderer_options.path = options.path;
    ORO_TRY(FrameRenderer renderer, FrameRenderer::create(gpu, renderer_options));
    scene.set_shadow_request({});
    const int tile_width = static_cast<int>(renderer_options.extent.width),
              tile_height = static_cast<int>(renderer_options.extent.height),
              rows_at_once = static_cast<int>(renderer.triangle_rows());
    for (int y = 0; y < camera.height_px; y += tile_height) {
        for (int x = 0; x < camera.width_px; x += tile_width) {
            const Tile tile{x,
                            y,
                            std::min(tile_width, camera.width_px - x),
                            std::min(tile_height, camera.height_px - y),
                            {0.5, 0.5}};
            ORO_CHECK(draw_settled(scene, renderer, {camera, tile, options.tau_px, options.model}, {}));
            for (int first = 0; first < tile.height_px; first += rows_at_once) {
                const int count = std::min(rows_at_once, tile.height_px - first);
                ORO_TRY(const std::vector<ShownTriangle> triangles,
                        renderer.read_triangles(static_cast<std::uint32_t>(first),
                                                static_cast<std::uint32_t>(count)));
                sink(tile, first, count, triangles);
            }
        }
    }
    return {};
}

}  // namespace oro
