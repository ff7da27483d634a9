#include "apps/drawing/clusters_of_region.h"

#include <cstdint>
#include <vector>

#include "core/baked/file_pages.h"
#include "core/base/parallel.h"
#include "core/surface/grid_surface.h"

namespace oro {

namespace {

Result<HeightField> posts_of(const RegionGrid& grid, std::size_t most_read_at_once) {
    constexpr std::size_t kept_bytes = std::size_t{64} << 20U;
    if (grid.field.grid.post_count() > most_read_at_once) return field_of_file(grid.file, kept_bytes);
    return field_in_memory(*grid.file);
}

}  // namespace

Result<std::unique_ptr<RegionClusters>> clusters_of_region(const RegionGrid& grid,
                                                           const HorizonOccluder& occluder,
                                                           std::size_t most_read_at_once) {
    ORO_TRY(const HeightField field, posts_of(grid, most_read_at_once));
    Result<std::unique_ptr<RegionClusters>> clusters =
        clusters_of_file(grid.clusters, grid.file->fingerprint(), field, occluder);
    // A page that cannot be read is void meanwhile.
    ORO_CHECK(field.health());
    return clusters;
}

Result<void> check_clusters_of_region(const RegionGrid& grid, std::size_t most_read_at_once) {
    ORO_TRY(HeightField field, posts_of(grid, most_read_at_once));
    const DrawnHeights heights = drawn_heights(field, 1.0, thread_count());
    ORO_CHECK(field.health());
    field.H_m = {};
    const GridSurface surface(heights, {.wraps_longitude = field.grid.wraps_longitude()});
    const GridBounds bounds(field.grid, heights.highest_steps);
    const std::vector<std::uint32_t> nodes = surface.leaf_nodes();
    const LeavesOneByOne leaves{static_cast<std::uint32_t>(nodes.size()),
                                [&](std::uint32_t leaf) { return surface.leaf(nodes[leaf]); }};
    return grid.clusters->check(surface, bounds, leaves, thread_count());
}

}  // namespace oro
