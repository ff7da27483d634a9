#include "apps/accuracy/mesh_forecast.h"

#include <algorithm>
#include <array>

#include "apps/drawing/mesh_choice.h"
#include "core/cluster_frame/cluster_choice.h"
#include "core/cluster_frame/group_rule.h"
#include "core/frame/lazy_pyramid.h"
#include "core/lod/levels.h"

namespace oro {
namespace {

Tile whole_picture(const Camera& camera) {
    return {0, 0, camera.width_px, camera.height_px, {0.5, 0.5}};
}

Result<MeshForecast> forecast_blocks(const RegionPages& all, const Camera& camera, double tau_px) {
    const LazyPyramid pages(all);
    const std::array<Plane, 5> planes =
        frustum_planes_view(projection_of_tile(camera, whole_picture(camera)));
    const glm::dmat3 view_from_ecef = camera.view_from_ecef();
    const LevelView level_of = level_view(camera, tau_px);
    MeshForecast forecast;
    for (const DrawnNode& drawn : select_nodes(pages, camera, whole_picture(camera), tau_px).nodes) {
        const LevelGrid& grid = pages.grid(drawn.level);
        const PyramidPage& whole = pages.page_of_node(drawn.level, drawn.row, drawn.column);
        const PageSummary& page = whole.summary;
        const gpu::MeshletBounds& node = whole.node(drawn.row, drawn.column);
        const glm::dvec3 centre = view_from_ecef * (page.origin_ecef.m - camera.eye_ecef().m +
                                                    page.ecef_from_page * glm::dvec3(node.centre));
        if (node.radius < 0.0F || beyond_frustum(planes, centre, static_cast<double>(node.radius))) continue;
        forecast.triangles += static_cast<std::uint64_t>(2 * grid.row.quads_of_node(drawn.row) *
                                                         grid.column.quads_of_node(drawn.column));
        if (drawn.level == 0) continue;
        forecast.worst_m = std::max(forecast.worst_m, static_cast<double>(node.error_m));
        forecast.worst_px =
            std::max(forecast.worst_px, static_cast<double>(gpu::projected_error_px(
                                            gpu::vec3(centre), node.lod_radius, node.error_m,
                                            level_of.pixels_per_tangent, level_of.corner_tangent)));
    }
    ORO_CHECK(pages.health());
    return forecast;
}

Result<MeshForecast> forecast_clusters(RegionClusters& clusters, const View& view,
                                       const HorizonOccluder& occluder) {
    ORO_TRY(const ClusterChoice choice, choose_clusters(clusters, view.camera, whole_picture(view.camera),
                                                        view.tau_px, view.model, occluder, {}));
    const GroupRule rule(view.camera, view.tau_px, view.model.air);
    MeshForecast forecast;
    for (const std::uint32_t cluster : choice.clusters) {
        ORO_TRY(const std::uint32_t triangles, clusters.triangle_count(cluster));
        forecast.triangles += triangles;
        const std::uint32_t maker = clusters.maker(cluster);
        if (maker == no_group) continue;
        const ClusterGroup& group = clusters.groups()[maker];
        forecast.worst_m = std::max(forecast.worst_m, group.error_m);
        forecast.worst_px = std::max(forecast.worst_px, rule.error_px(group));
    }
    return forecast;
}

}  // namespace

Result<std::optional<MeshForecasts>> mesh_forecasts(const View& view, const Region& region,
                                                    const RegionPages& pages, std::size_t most_read_at_once) {
    if (!has_clusters(region, view)) return std::optional<MeshForecasts>();
    MeshForecasts forecasts;
    ORO_TRY(forecasts.blocks, forecast_blocks(pages, view.camera, view.tau_px));
    const HorizonOccluder& occluder = pages.facts().shape.occluder;
    ORO_TRY(const std::unique_ptr<RegionClusters> clusters,
            clusters_of_region(region.grids.front(), occluder, most_read_at_once));
    ORO_TRY(forecasts.clusters, forecast_clusters(*clusters, view, occluder));
    return std::optional(forecasts);
}

}  // namespace oro
