#include "render/frame/cylinder_picture.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <utility>

#include "core/base/parallel.h"
#include "core/frame/ridge_lines.h"

namespace oro {
namespace {

// Tiles that show much of the same ground follow each other: column by column.
std::vector<CylinderTile> in_columns(std::vector<CylinderTile> tiles) {
    std::ranges::stable_sort(tiles, {}, &CylinderTile::x_px);
    return tiles;
}

std::uint64_t bytes_of_pages(const Scene& scene) {
    std::uint64_t bytes = 0;
    for (const GridScene& grid : scene.grids()) bytes += grid.store().bytes();
    return bytes;
}

double area_of(int width_px, int height_px) {
    return static_cast<double>(width_px) * height_px;
}

// Lets pages of columns that are drawn make room for those of the next; buffers stay.
void let_go_of_pages(Scene& scene) {
    for (GridScene& grid : scene.grids()) {
        grid.store().clear();
        grid.store().begin_frame();
    }
}

}  // namespace

Result<CylinderPicture> render_cylinder(const Gpu& gpu, Scene& scene, const Geodetic& eye,
                                        const Cylinder& around, const CylinderCut& cut,
                                        const gpu::FrameStyle& style, const PictureOptions& options,
                                        const CylinderExtras& extras, const RenderProgress& progress) {
    const std::vector<CylinderTile> tiles = in_columns(cylinder_tiles(around, eye, cut));
    assert(!tiles.empty());
    const Camera& first = tiles.front().camera;
    PictureOptions tile_options = options;
    tile_options.tau_px *= cut.oversampling;
    tile_options.keep_depths = tile_options.depths_of_growth = extras.ridges;
    gpu::FrameStyle tile_style = style;
    tile_style.contours.width_px *= static_cast<float>(cut.oversampling);
    ORO_TRY(PictureRenderer renderer, PictureRenderer::create(gpu, first, tile_style, tile_options));
    CylinderPicture picture;
    picture.tiles = static_cast<int>(tiles.size());
    picture.rgb.resize(std::size_t{3} * static_cast<std::size_t>(around.width_px) *
                       static_cast<std::size_t>(around.height_px()));
    std::vector<std::uint8_t> drawn;
    double done = 0.0;
    int column_px = tiles.front().x_px;
    for (const CylinderTile& tile : tiles) {
        const bool is_next_column = std::exchange(column_px, tile.x_px) != tile.x_px;
        if (is_next_column && bytes_of_pages(scene) > extras.kept_page_bytes) let_go_of_pages(scene);
        const Tile& part = tile.part;
        const auto width_px = static_cast<std::size_t>(tile.camera.width_px);
        drawn.assign(3 * width_px * static_cast<std::size_t>(tile.camera.height_px), 0);
        auto to = drawn.begin() +
                  std::ptrdiff_t{3} * (std::ptrdiff_t{part.y_px} * tile.camera.width_px + part.x_px);
        ORO_TRY(const PictureReport report,
                renderer.draw_part(
                    scene, tile.camera, part, tile_style,
                    [&](std::span<const std::uint8_t> row) {
                        std::ranges::copy(row, to);
                        to += std::ptrdiff_t{3} * tile.camera.width_px;
                        return Result<void>();
                    },
                    [&](double share) {
                        if (progress) progress((done + share) / static_cast<double>(tiles.size()));
                    }));
        picture.report.add(report);
        // Of all that the tile drew, a little more than what it is for.
        picture.near_trees_share +=
            report.near_tree_px * area_of(tile.width_px, tile.height_px) /
            (area_of(part.width_px, part.height_px) * area_of(around.width_px, around.height_px()));
        if (extras.ridges)
            draw_ridges({renderer.depths(), tile.camera.width_px, tile.camera.height_px}, drawn,
                        thread_count());
        if (extras.over) ORO_CHECK(extras.over(tile, drawn));
        unroll(around, tile, drawn, picture.rgb, thread_count());
        done += 1.0;
        picture.page_bytes = std::max(picture.page_bytes, bytes_of_pages(scene));
    }
    return picture;
}

}  // namespace oro
