#include "render/frame/depth_picture.h"

#include <algorithm>
#include <cassert>

#include "render/frame/picture_renderer.h"
#include "render/frame/settled_frame.h"

namespace oro {
namespace {

std::size_t pixels_of(const Camera& camera) {
    return static_cast<std::size_t>(camera.width_px) * static_cast<std::size_t>(camera.height_px);
}

void add(FrameReport& sum, const FrameReport& part) {
    sum.counts.pages_live += part.counts.pages_live;
    sum.counts.nodes_chosen += part.counts.nodes_chosen;
    sum.counts.meshlets_beyond_frustum += part.counts.meshlets_beyond_frustum;
    sum.counts.meshlets_beyond_horizon += part.counts.meshlets_beyond_horizon;
    sum.counts.meshlets_drawn += part.counts.meshlets_drawn;
    sum.counts.triangles_drawn += part.counts.triangles_drawn;
    sum.counts.mesh_groups += part.counts.mesh_groups;
    sum.counts.task_groups += part.counts.task_groups;
    sum.counts.meshlets_tested += part.counts.meshlets_tested;
    sum.counts.meshlets_hidden += part.counts.meshlets_hidden;
    sum.counts.meshlets_drawn_later += part.counts.meshlets_drawn_later;
    sum.pages += part.pages;
    sum.choose_s += part.choose_s;
    sum.raster_s += part.raster_s;
    sum.shade_s += part.shade_s;
}

// Copies a tile's values, `each` to a pixel, to its place in a picture.
template <class Value>
void place_tile(const std::vector<Value>& values, const Tile& tile, int picture_width_px, std::size_t each,
                std::vector<Value>& picture) {
    const std::size_t row_values = each * static_cast<std::size_t>(tile.width_px);
    for (int y = 0; y < tile.height_px; ++y) {
        const std::size_t pixel =
            static_cast<std::size_t>(tile.y_px + y) * static_cast<std::size_t>(picture_width_px) +
            static_cast<std::size_t>(tile.x_px);
        std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(y) * row_values),
                    row_values, picture.begin() + static_cast<std::ptrdiff_t>(each * pixel));
    }
}

}  // namespace

std::vector<DrawnDepths> DepthPicture::skylines() const {
    std::vector<DrawnDepths> samples;
    for (int i = 0; i < skyline_samples; ++i) {
        const std::vector<float>& drawn = skyline_depths[static_cast<std::size_t>(i)];
        if (!drawn.empty()) samples.push_back({drawn, {0.5, (i + 0.5) / skyline_samples}});
    }
    return samples;
}

Result<void> DepthPainter::prepare(VkExtent2D extent) {
    if (renderer_ && renderer_->extent().width == extent.width && renderer_->extent().height == extent.height)
        return {};
    if (renderer_) return renderer_->resize(extent);
    FrameRendererOptions options;
    options.extent = extent;
    options.keep_depths = true;
    options.keep_triangles = true;
    options.path = path_;
    options.occlusion = occlusion_;
    ORO_TRY(FrameRenderer renderer, FrameRenderer::create(*gpu_, options));
    renderer_.emplace(std::move(renderer));
    return {};
}

Result<SettledFrame> DepthPainter::draw_sample(Scene& scene, const Camera& camera,
                                               const gpu::FrameStyle& style,
                                               const DepthPictureOptions& options, const Tile& tile,
                                               DepthPicture& picture, std::vector<float>& depths) {
    ORO_TRY(SettledFrame frame,
            draw_settled(scene, *renderer_, {camera, tile, options.tau_px, options.model}, style));
    picture.settled = picture.settled && frame.settled;
    ORO_TRY(const std::vector<float> drawn,
            renderer_->read_depths(static_cast<std::uint32_t>(tile.width_px),
                                   static_cast<std::uint32_t>(tile.height_px)));
    place_tile(drawn, tile, camera.width_px, 1, depths);
    return frame;
}

Result<std::vector<DrawnPoint>> read_points(FrameRenderer& renderer, const Camera& camera, const Tile& tile) {
    const glm::dvec2 tangent = camera.half_fov_tangent();
    const auto ray_through = [&](double x_px, double y_px) {
        return glm::dvec3((2.0 * x_px / camera.width_px - 1.0) * tangent.x,
                          (1.0 - 2.0 * y_px / camera.height_px) * tangent.y, -1.0);
    };
    std::vector<DrawnPoint> points;
    points.reserve(static_cast<std::size_t>(tile.width_px) * static_cast<std::size_t>(tile.height_px));
    const int step = static_cast<int>(renderer.triangle_rows());
    for (int first = 0; first < tile.height_px; first += step) {
        const int rows = std::min(step, tile.height_px - first);
        ORO_TRY(const std::vector<ShownTriangle> triangles,
                renderer.read_triangles(static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(rows)));
        for (std::size_t i = 0; i < triangles.size(); ++i) {
            const int x = tile.x_px + static_cast<int>(i) % tile.width_px;
            const int y = tile.y_px + first + static_cast<int>(i) / tile.width_px;
            points.push_back(
                drawn_point(triangles[i], ray_through(x + tile.sample_px.x, y + tile.sample_px.y)));
        }
    }
    return points;
}

Result<void> DepthPainter::draw_tile(Scene& scene, const Camera& camera, const gpu::FrameStyle& style,
                                     const DepthPictureOptions& options, const Tile& tile,
                                     DepthPicture& picture) {
    ORO_TRY(const SettledFrame frame,
            draw_sample(scene, camera, style, options, tile, picture, picture.depths));
    ORO_TRY(const std::vector<DrawnPoint> points, read_points(*renderer_, camera, tile));
    place_tile(points, tile, camera.width_px, 1, picture.points);
    add(picture.report, frame.report);
    picture.page_bytes += frame.page_bytes;
    ++picture.tiles;
    ORO_TRY(const std::vector<std::uint8_t> rgba,
            renderer_->read_picture(static_cast<std::uint32_t>(tile.width_px),
                                    static_cast<std::uint32_t>(tile.height_px)));
    place_tile(rgba, tile, camera.width_px, 4, picture.rgba);
    for (int i = 0; options.skyline && i < skyline_samples; ++i) {
        Tile sampled = tile;
        sampled.sample_px = {0.5, (i + 0.5) / skyline_samples};
        ORO_CHECK(draw_sample(scene, camera, style, options, sampled, picture,
                              picture.skyline_depths[static_cast<std::size_t>(i)]));
    }
    return {};
}

Result<DepthPicture> DepthPainter::draw(Scene& scene, const Camera& camera, const gpu::FrameStyle& style,
                                        const DepthPictureOptions& options) {
    assert(camera.width_px > 0 && camera.height_px > 0);
    scene.require_fields(style);
    const VkExtent2D extent = tile_extent(*gpu_, camera, options.largest_tile_px);
    const int tile_width = static_cast<int>(extent.width), tile_height = static_cast<int>(extent.height);
    ORO_CHECK(prepare(extent));

    DepthPicture picture;
    picture.width_px = camera.width_px;
    picture.height_px = camera.height_px;
    picture.rgba.resize(4 * pixels_of(camera));
    picture.depths.resize(pixels_of(camera));
    picture.points.resize(pixels_of(camera));
    for (std::vector<float>& depths : picture.skyline_depths) {
        if (options.skyline) depths.resize(pixels_of(camera));
    }
    for (int y = 0; y < camera.height_px; y += tile_height) {
        for (int x = 0; x < camera.width_px; x += tile_width) {
            const Tile tile{x,
                            y,
                            std::min(tile_width, camera.width_px - x),
                            std::min(tile_height, camera.height_px - y),
                            {0.5, 0.5}};
            ORO_CHECK(draw_tile(scene, camera, style, options, tile, picture));
        }
    }
    return picture;
}

}  // namespace oro
