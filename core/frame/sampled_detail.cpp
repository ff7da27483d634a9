#include "core/frame/sampled_detail.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/lod/levels_gpu.h"

namespace oro {

// Its nodes, and where they are.
struct SampledDetail::Page {
    PageSummary summary;
    std::array<gpu::MeshletBounds, gpu::meshlets_per_page> nodes;
};

SampledDetail::SampledDetail(const RegionPages& pages, const Camera& camera, double tau_px,
                             const Refraction& light)
    : pages_(pages),
      view_(level_view(camera, tau_px)),
      view_from_ecef_(camera.view_from_ecef()),
      eye_(camera.eye_ecef()),
      light_(light) {}

SampledDetail::~SampledDetail() = default;

Result<const SampledDetail::Page*> SampledDetail::page(const PageIndex& index) {
    std::unique_ptr<Page>& kept = kept_[{index.level, index.row, index.column}];
    if (kept) return static_cast<const Page*>(kept.get());
    ORO_TRY(const PageRecord record, pages_.record(index));
    const auto block = std::make_unique<gpu::PageBlock>();
    ORO_CHECK(pages_.load(index, *block));
    kept = std::make_unique<Page>();
    kept->summary = record.summary;
    std::copy_n(block->meshlets, gpu::meshlets_per_page, kept->nodes.begin());
    return static_cast<const Page*>(kept.get());
}

Result<SampledDetail::Bound> SampledDetail::node_at(int row, int column) {
    constexpr int quads = static_cast<int>(gpu::page_quads), side = static_cast<int>(gpu::meshlets_per_side);
    for (int level = pages_.levels() - 1; level > 0; --level) {
        const int quad_row = row >> level, quad_column = column >> level;
        ORO_TRY(const Page* const here, page({quad_row / quads, quad_column / quads, level}));
        const int node = quad_row % quads / static_cast<int>(gpu::meshlet_quads) * side +
                         quad_column % quads / static_cast<int>(gpu::meshlet_quads);
        gpu::MeshletBounds bounds = here->nodes[static_cast<std::size_t>(node)];
        glm::dvec3 offset_m =
            here->summary.origin_ecef.m + here->summary.ecef_from_page * glm::dvec3(bounds.centre) - eye_.m;
        if (!light_.straight()) {
            // As shaders/place/bend.glsl, bend_node.
            const double across_m = glm::length(offset_m - glm::dot(offset_m, light_.up()) * light_.up());
            const double c = std::abs(light_.curvature_per_m()), r = static_cast<double>(bounds.lod_radius);
            bounds.error_m *= static_cast<float>(1.0 + c * (across_m + r));
            bounds.lod_radius = static_cast<float>(r + c * r * (across_m + 0.5 * r));
            offset_m = light_.apparent_m(offset_m);
        }
        const gpu::vec3 centre_view(view_from_ecef_ * offset_m);
        if (!gpu::node_acceptable(static_cast<gpu::uint>(level), bounds, centre_view,
                                  view_.pixels_per_tangent, view_.corner_tangent, view_.tau_px))
            continue;
        return Bound{
            level, static_cast<double>(bounds.error_m),
            static_cast<double>(gpu::projected_error_px(centre_view, bounds.lod_radius, bounds.error_m,
                                                        view_.pixels_per_tangent, view_.corner_tangent))};
    }
    return Bound{};
}

// Along its rim a node's triangles go to the posts of a coarser one beside it: what is off there, is off
// here.
Result<SampledDetail::Bound> SampledDetail::at(int row, int column) {
    constexpr int side = static_cast<int>(gpu::meshlet_quads);
    ORO_TRY(Bound worst, node_at(row, column));
    const PostGrid& grid = pages_.facts().grid;
    const int quad_row = (row >> worst.level) % side, quad_column = (column >> worst.level) % side;
    const int step = 1 << worst.level;
    const auto neighbour = [&](int down, int right) -> Result<void> {
        const int next_row = row + down * step, round = grid.columns() - 1;
        int next_column = column + right * step;
        if (pages_.wraps_longitude()) next_column = (next_column + round) % round;
        if (next_row < 0 || next_column < 0 || next_row >= grid.rows() - 1 ||
            next_column >= grid.columns() - 1)
            return {};
        ORO_TRY(const Bound there, node_at(next_row, next_column));
        if (there.level <= worst.level) return {};
        worst.error_m = std::max(worst.error_m, there.error_m);
        worst.error_px = std::max(worst.error_px, there.error_px);
        return {};
    };
    if (quad_row == 0) ORO_CHECK(neighbour(-1, 0));
    if (quad_row == side - 1) ORO_CHECK(neighbour(1, 0));
    if (quad_column == 0) ORO_CHECK(neighbour(0, -1));
    if (quad_column == side - 1) ORO_CHECK(neighbour(0, 1));
    return worst;
}

}  // namespace oro
