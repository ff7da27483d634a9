#include "apps/baking/cluster_bake.h"

#include <optional>
#include <vector>

#include "apps/report/figures.h"
#include "core/baked/region_file.h"
#include "core/base/elapsed.h"
#include "core/base/parallel.h"
#include "core/cluster_file/cluster_file.h"
#include "core/cluster_windows/windowed_graph.h"
#include "core/clusters/graph_builder.h"
#include "core/surface/grid_surface.h"
#include "geo/together/baked_parts.h"

namespace oro {

Result<void> check_clusters(const Region& region) {
    const auto refused = [](const std::string& what) {
        return Error{ErrorKind::usage, "--mesh clusters",
                     what + ": bake it without, or a part of it (--bbox)"};
    };
    if (region.grids.size() > 1)
        return refused("takes one grid of posts, and here are " + std::to_string(region.grids.size()));
    const PostGrid& grid = region.grids.front().field.grid;
    if (grid.net)
        return refused("takes posts on latitudes and longitudes, and these lie in a CRS of their own");
    const std::size_t most = grid.wraps_longitude() ? most_posts_in_one_go : most_clustered_posts;
    if (grid.post_count() > most)
        return refused("takes regions of up to " + grouped(most) + " posts" +
                       (grid.wraps_longitude() ? " where they go round the Earth" : "") + ", and this has " +
                       grouped(grid.post_count()));
    return {};
}

namespace {

using StepProgress = std::function<void(double, const char*)>;

Result<void> build(const HeightField& field, const std::string& path, std::uint64_t fingerprint,
                   const StepProgress& on_progress) {
    if (field.grid.post_count() > most_posts_in_one_go) {
        WindowedBake how;
        how.path = path;
        how.fingerprint = fingerprint;
        how.overwrite = true;
        how.threads = thread_count();
        how.progress = [&](double share) { on_progress(share, "building clusters"); };
        return bake_in_windows(field, how);
    }
    const DrawnHeights heights = drawn_heights(field, 1.0, thread_count());
    const GridSurface surface(heights, {.wraps_longitude = field.grid.wraps_longitude()});
    const GridBounds bounds(field.grid, heights.highest_steps);
    const ClusterGraph graph = build_cluster_graph(surface, bounds, {.threads = thread_count()});
    return write_cluster_graph(path, graph, {heights.rows, heights.columns}, fingerprint, true,
                               thread_count());
}

}  // namespace

Result<BakeReport> bake_part(const HeightField& field, const BakeOptions& how, const BakeProgress& progress) {
    ORO_CHECK(check_path_of_part(how.path));
    const std::optional<RegionFile> there = baked_grid(how.path, how.fingerprint, how.description);
    if (!there) return bake_region(field, how, progress);
    return BakeReport{there->order().count(), there->order().count(), there->outline().triangles};
}

Result<ClusterBakeReport> bake_clusters(const HeightField& field, const BakeOptions& how,
                                        const std::function<void(double, const char*)>& on_progress,
                                        std::span<const ContainerPart> beside) {
    const std::string clusters_path = path_of_clusters(how.path);
    ORO_CHECK(check_path_of_part(clusters_path));
    BakeOptions grid = how;
    grid.path = path_of_grid(how.path, 0);
    grid.overwrite = true;
    ClusterBakeReport report;
    ORO_TRY(report.region, bake_part(field, grid, [&](double share) {
                on_progress(share, "baking");
                return true;
            }));
    const auto building = Clock::now();
    on_progress(0.0, "building clusters");
    std::optional<ClusterFile> clusters = baked_clusters(clusters_path, how.fingerprint);
    if (!clusters) {
        ORO_CHECK(build(field, clusters_path, how.fingerprint, on_progress));
        ORO_TRY(clusters, ClusterFile::open(clusters_path));
    }
    report.build_s = seconds_since(building);
    report.levels = clusters->outline().levels.size();
    report.triangles = static_cast<std::size_t>(clusters->outline().triangles);
    clusters.reset();
    std::vector<ContainerPart> parts{{grid.path, 0}, {clusters_path, 0}};
    parts.insert(parts.end(), beside.begin(), beside.end());
    ORO_CHECK(join_parts(how.path, how.overwrite, parts));
    return report;
}

}  // namespace oro
