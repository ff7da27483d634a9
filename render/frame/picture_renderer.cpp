#include "render/frame/picture_renderer.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/frame/tile_order.h"
#include "core/growth/growth_plan.h"
#include "render/frame/settled_frame.h"

namespace oro {
namespace {

constexpr int preferred_tile_px = 4096;
// Around a tile of a picture of one sample: an edge depends on the next pixel (shaders/shade/edges.comp).
// Light depends on the shadows in the next pixel (shaders/cast/cast_on.glsl), and those on shadows 3 px away
// (shaders/cast/shares.comp). Multiples of 4, so that shadows are looked for in the same pixels first.
// Far forests reach up into pixels above them (shaders/growth/raise_canopy.comp), the farther the more their
// ground is exaggerated.
int margin_of(const gpu::FrameStyle& style, const Camera& camera, const PictureOptions& options,
              double exaggeration) {
    constexpr int edges_px = 4, shadows_px = 8;
    int margin_px = 0;
    if (options.samples == 1)
        margin_px = style.shadows != 0 ? shadows_px : style.smooth_edges != 0 ? edges_px : 0;
    if ((style.materials.on & gpu::materials_with_trees) == 0) return margin_px;
    const double rise_px = std::ceil(std::max(exaggeration, 1.0) * canopy_rise_px(camera, options.tau_px));
    const int most_px = std::min(static_cast<int>(gpu::canopy_search_px), static_cast<int>(rise_px));
    return std::max(margin_px, (most_px + 3) / 4 * 4);
}

double exaggeration_of(Scene& scene) {
    double most = 1.0;
    for (const GridScene& grid : scene.grids())
        most = std::max(most, grid.pages().facts().shape.exaggeration);
    return most;
}

// Whether water mirrors what other tiles show.
bool mirrors_tiles(const gpu::FrameStyle& style, const PictureOptions& options) {
    return (style.materials.on & gpu::materials_with_trees) != 0 && style.water.on != 0 &&
           options.show == gpu::show_colours && (!options.keep_depths || options.depths_of_growth);
}

// What a tile draws: counted once, not for each sample.
void add_culled(PictureReport& sum, const FramePlan& plan) {
    for (const GridPlan& grid : plan.grids) {
        sum.pages_beyond_frustum += grid.pages_beyond_frustum;
        sum.pages_beyond_horizon += grid.pages_beyond_horizon;
    }
}
void add_counts(PictureReport& sum, const FrameReport& part) {
    sum.meshlets_beyond_frustum += part.counts.meshlets_beyond_frustum;
    sum.meshlets_beyond_horizon += part.counts.meshlets_beyond_horizon;
    sum.mesh_groups += part.counts.mesh_groups;
    sum.meshlets_drawn += part.counts.meshlets_drawn;
    sum.triangles_drawn += part.counts.triangles_drawn;
    sum.pages_drawn += part.counts.pages_live;
}

// What all samples of a tile took, and whether they told anything new of what shows.
struct TileSamples {
    PictureReport report;
    bool is_news{false};
};

Result<TileSamples> draw_samples(Scene& scene, const Camera& camera, const gpu::FrameStyle& style,
                                 const PictureOptions& options, Tile tile, FrameRenderer& renderer) {
    TileSamples samples;
    PictureReport& report = samples.report;
    for (int i = 0; i < options.samples; ++i) {
        tile.sample_px = sample_place(i, options.samples);
        ORO_TRY(FramePlan plan, scene.settled_plan({camera, tile, options.tau_px, options.model}));
        const bool whole = plan.is_settled();
        report.settled = report.settled && plan.shows_all();
        if (i == 0) add_culled(report, plan);
        ORO_TRY(const FrameReport drawn,
                renderer.draw(std::move(plan), style, static_cast<std::uint32_t>(i),
                              static_cast<std::uint32_t>(options.samples), scene.drapes()));
        if (!whole) samples.is_news = scene.apply_feedback(drawn.feedback) || samples.is_news;
        report.images_settled = report.images_settled && drawn.images_settled;
        if (i == 0) add_counts(report, drawn);
        report.choose_s += drawn.choose_s;
        report.raster_s += drawn.raster_s;
        report.shade_s += drawn.shade_s;
    }
    return samples;
}

// Draws one tile, all its samples; its pixels stay in the renderer. Counts are those of the first sample.
// Where the GPU cannot hold all that it asks for, it is drawn until nothing new is told of what shows
// (settled_frame.h).
Result<void> draw_tile(Scene& scene, const Camera& camera, const gpu::FrameStyle& style,
                       const PictureOptions& options, const Tile& tile, FrameRenderer& renderer,
                       PictureReport& report) {
    TileSamples drawn;
    for (int frame = 0; frame == 0 || (drawn.is_news && frame < most_settling_frames); ++frame) {
        ORO_TRY(drawn, draw_samples(scene, camera, style, options, tile, renderer));
    }
    drawn.report.settled = drawn.report.settled && !drawn.is_news;
    drawn.report.tiles = 1;
    drawn.report.path = report.path;
    report.add(drawn.report);
    return {};
}

// Pixels with ground, as the picture's fourth channel tells them.
std::uint64_t ground_pixels(const std::vector<std::uint8_t>& rgba) {
    std::uint64_t count = 0;
    for (std::size_t i = 3; i < rgba.size(); i += 4) count += rgba[i] != 0;
    return count;
}

void copy_rgb(const std::vector<std::uint8_t>& rgba, const Tile& tile, int picture_width,
              std::vector<std::uint8_t>& band) {
    for (int y = 0; y < tile.height_px; ++y) {
        const std::uint8_t* from = rgba.data() + std::size_t{4} * static_cast<std::size_t>(y) *
                                                     static_cast<std::size_t>(tile.width_px);
        std::uint8_t* to =
            band.data() + 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture_width) +
                               static_cast<std::size_t>(tile.x_px));
        for (int x = 0; x < tile.width_px; ++x, from += 4, to += 3) std::copy_n(from, 3, to);
    }
}

// The part of a tile's pixels that is its own, without the margin around it.
std::vector<std::uint8_t> inner_pixels(const std::vector<std::uint8_t>& rgba, const Tile& drawn,
                                       const Tile& own) {
    if (drawn.width_px == own.width_px && drawn.height_px == own.height_px) return rgba;
    std::vector<std::uint8_t> inner;
    inner.reserve(std::size_t{4} * static_cast<std::size_t>(own.width_px) *
                  static_cast<std::size_t>(own.height_px));
    for (int y = 0; y < own.height_px; ++y) {
        const auto from =
            rgba.begin() + std::ptrdiff_t{4} * ((own.y_px - drawn.y_px + y) * std::ptrdiff_t{drawn.width_px} +
                                                own.x_px - drawn.x_px);
        inner.insert(inner.end(), from, from + std::ptrdiff_t{4} * own.width_px);
    }
    return inner;
}

// What two rectangles of a picture share; of no size, or less, where that is nothing.
Tile common_to(const Tile& a, const Tile& b) {
    Tile common = a;
    common.x_px = std::max(a.x_px, b.x_px);
    common.y_px = std::max(a.y_px, b.y_px);
    common.width_px = std::min(a.x_px + a.width_px, b.x_px + b.width_px) - common.x_px;
    common.height_px = std::min(a.y_px + a.height_px, b.y_px + b.height_px) - common.y_px;
    return common;
}

// Where a part of a tile is in it.
VkRect2D rectangle_in(const Tile& tile, const Tile& part) {
    return {{part.x_px - tile.x_px, part.y_px - tile.y_px},
            {static_cast<std::uint32_t>(part.width_px), static_cast<std::uint32_t>(part.height_px)}};
}

VkExtent2D extent_of(const Camera& camera) {
    return {static_cast<std::uint32_t>(camera.width_px), static_cast<std::uint32_t>(camera.height_px)};
}

// A tile with its margin, as far as the picture goes.
Tile with_margin(const Tile& own, int margin_px, const Camera& camera) {
    Tile drawn = own;
    drawn.x_px = std::max(0, own.x_px - margin_px);
    drawn.y_px = std::max(0, own.y_px - margin_px);
    drawn.width_px = std::min(camera.width_px, own.x_px + own.width_px + margin_px) - drawn.x_px;
    drawn.height_px = std::min(camera.height_px, own.y_px + own.height_px + margin_px) - drawn.y_px;
    return drawn;
}

}  // namespace

void PictureReport::add(const PictureReport& part) {
    meshlets_drawn += part.meshlets_drawn;
    meshlets_beyond_frustum += part.meshlets_beyond_frustum;
    meshlets_beyond_horizon += part.meshlets_beyond_horizon;
    mesh_groups += part.mesh_groups;
    triangles_drawn += part.triangles_drawn;
    ground_px += part.ground_px;
    near_tree_px += part.near_tree_px;
    pages_drawn += part.pages_drawn;
    pages_beyond_frustum += part.pages_beyond_frustum;
    pages_beyond_horizon += part.pages_beyond_horizon;
    settled = settled && part.settled;
    images_settled = images_settled && part.images_settled;
    choose_s += part.choose_s;
    raster_s += part.raster_s;
    shade_s += part.shade_s;
    tiles += part.tiles;
    path = part.path;
}

VkExtent2D tile_extent(const Gpu& gpu, const Camera& camera, int largest_tile_px) {
    int side = static_cast<int>(std::min<std::uint32_t>(gpu.report().max_picture_side_px, preferred_tile_px));
    if (largest_tile_px > 0) side = std::min(side, largest_tile_px);
    return {static_cast<std::uint32_t>(std::min(camera.width_px, side)),
            static_cast<std::uint32_t>(std::min(camera.height_px, side))};
}

glm::dvec2 sample_place(int index, int count) {
    if (count == 1) return {0.5, 0.5};
    constexpr double plastic = 1.32471795724474602596;
    const auto at = [&](double step) {
        double whole = 0.0;
        return std::modf(0.5 + step * static_cast<double>(index + 1), &whole);
    };
    return {at(1.0 / plastic), at(1.0 / (plastic * plastic))};
}

Result<PictureRenderer> PictureRenderer::create(const Gpu& gpu, const Camera& camera,
                                                const gpu::FrameStyle& style, const PictureOptions& options) {
    FrameRendererOptions renderer_options;
    renderer_options.extent = tile_extent(gpu, camera, options.largest_tile_px);
    renderer_options.several_samples = options.samples > 1;
    renderer_options.smooth_edges = options.samples == 1 && style.smooth_edges != 0;
    renderer_options.path = options.path;
    renderer_options.show = options.show;
    renderer_options.occlusion = options.occlusion;
    renderer_options.keep_depths = options.keep_depths;
    renderer_options.depths_of_growth = options.depths_of_growth;
    ORO_TRY(FrameRenderer renderer, FrameRenderer::create(gpu, renderer_options));
    return PictureRenderer(options, std::move(renderer));
}

Result<void> PictureRenderer::keep_depths(const Tile& drawn, const Tile& own, int picture_width) {
    ORO_TRY(const std::vector<float> depths,
            renderer_.read_depths(static_cast<std::uint32_t>(drawn.width_px),
                                  static_cast<std::uint32_t>(drawn.height_px)));
    for (int y = 0; y < own.height_px; ++y) {
        const auto from = depths.begin() + std::ptrdiff_t{own.y_px - drawn.y_px + y} * drawn.width_px +
                          (own.x_px - drawn.x_px);
        std::copy_n(from, own.width_px,
                    depths_.begin() + std::ptrdiff_t{own.y_px + y} * picture_width + own.x_px);
    }
    return {};
}

// Of a tile's own pixels.
Result<std::uint32_t> PictureRenderer::near_tree_pixels(const Tile& drawn, const Tile& own) {
    ORO_TRY(const std::vector<std::uint8_t> shown,
            renderer_.read_near_trees(static_cast<std::uint32_t>(drawn.width_px),
                                      static_cast<std::uint32_t>(drawn.height_px)));
    std::uint32_t count = 0;
    for (int y = 0; y < own.height_px; ++y) {
        const auto from = shown.begin() + std::ptrdiff_t{own.y_px - drawn.y_px + y} * drawn.width_px +
                          (own.x_px - drawn.x_px);
        count += static_cast<std::uint32_t>(std::count(from, from + own.width_px, std::uint8_t{1}));
    }
    return count;
}

// What a tile shows that is drawn, of the part that is its own.
Result<std::vector<std::uint8_t>> PictureRenderer::read_own(const Tile& drawn, const Tile& own,
                                                            int picture_width, PictureReport& report) {
    ORO_TRY(const std::vector<std::uint8_t> pixels,
            renderer_.read_picture(static_cast<std::uint32_t>(drawn.width_px),
                                   static_cast<std::uint32_t>(drawn.height_px)));
    if (options_.keep_depths) ORO_CHECK(keep_depths(drawn, own, picture_width));
    if (options_.counts_near_trees) {
        ORO_TRY(const std::uint32_t near_px, near_tree_pixels(drawn, own));
        report.near_tree_px += near_px;
    }
    std::vector<std::uint8_t> rgba = inner_pixels(pixels, drawn, own);
    report.ground_px += ground_pixels(rgba);
    return rgba;
}

Result<PictureReport> PictureRenderer::draw(Scene& scene, const Camera& camera, const gpu::FrameStyle& style,
                                            const RowSink& sink, const RenderProgress& progress) {
    return draw_part(scene, camera, {0, 0, camera.width_px, camera.height_px}, style, sink, progress);
}

Result<PictureReport> PictureRenderer::draw_part(Scene& scene, const Camera& camera, const Tile& part,
                                                 const gpu::FrameStyle& style, const RowSink& sink,
                                                 const RenderProgress& progress) {
    int tile_width = static_cast<int>(renderer_.extent().width);
    int tile_height = static_cast<int>(renderer_.extent().height);
    const int margin_px = margin_of(style, camera, options_, exaggeration_of(scene));
    if (tile_width < camera.width_px) tile_width -= 2 * margin_px;
    if (tile_height < camera.height_px) tile_height -= 2 * margin_px;
    assert(tile_width > 0 && tile_height > 0);
    const bool mirrors =
        (tile_width < camera.width_px || tile_height < camera.height_px) && mirrors_tiles(style, options_);
    renderer_.end_tiled_picture();
    if (mirrors) ORO_CHECK(renderer_.begin_tiled_picture(extent_of(camera)));
    const std::vector<int> columns = columns_by_uprights(camera, tile_width);

    scene.require_fields(style);
    PictureReport report;
    report.path = options_.path;
    if (options_.keep_depths)
        depths_.assign(static_cast<std::size_t>(camera.width_px) * static_cast<std::size_t>(camera.height_px),
                       0.0F);
    const std::size_t row_bytes = std::size_t{3} * static_cast<std::size_t>(part.width_px);
    std::vector<std::uint8_t> band(row_bytes * static_cast<std::size_t>(tile_height));
    for (int y = 0; y < camera.height_px; y += tile_height) {
        const int height_px = std::min(tile_height, camera.height_px - y);
        int rows = 0;
        for (const int x : columns) {
            const Tile tile{x, y, std::min(tile_width, camera.width_px - x), height_px};
            const Tile own = common_to(tile, part);
            const bool is_asked = own.width_px > 0 && own.height_px > 0;
            // Water in the part mirrors what is above it.
            if (!is_asked && !(mirrors && y < part.y_px + part.height_px)) continue;
            const Tile drawn = with_margin(tile, margin_px, camera);
            if (mirrors)
                renderer_.keep_for_tiles(rectangle_in(drawn, tile));
            else if (own.width_px < tile.width_px || own.height_px < tile.height_px)
                renderer_.colour_only(rectangle_in(drawn, own));
            const Result<void> done = draw_tile(scene, camera, style, options_, drawn, renderer_, report);
            renderer_.colour_only({});
            ORO_CHECK(done);
            if (!is_asked) continue;
            rows = own.height_px;
            ORO_TRY(const std::vector<std::uint8_t> rgba, read_own(drawn, own, camera.width_px, report));
            copy_rgb(rgba, {own.x_px - part.x_px, 0, own.width_px, own.height_px}, part.width_px, band);
        }
        for (int i = 0; i < rows; ++i) {
            ORO_CHECK(sink(std::span<const std::uint8_t>(band).subspan(
                static_cast<std::size_t>(i) * row_bytes, row_bytes)));
        }
        if (progress) progress(static_cast<double>(y + height_px) / camera.height_px);
    }
    return report;
}

Result<PictureReport> render_picture(const Gpu& gpu, Scene& scene, const Camera& camera,
                                     const gpu::FrameStyle& style, const PictureOptions& options,
                                     const RowSink& sink, const RenderProgress& progress) {
    assert(camera.width_px > 0 && camera.height_px > 0 && options.samples > 0);
    ORO_TRY(PictureRenderer renderer, PictureRenderer::create(gpu, camera, style, options));
    return renderer.draw(scene, camera, style, sink, progress);
}

}  // namespace oro
