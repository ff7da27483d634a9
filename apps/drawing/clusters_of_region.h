// The clusters of a region that was baked with them: ready to be chosen from, and checked.
#pragma once

#include <cstddef>
#include <memory>

#include "core/cluster_frame/region_clusters.h"
#include "geo/region/region.h"

namespace oro {

// A region with more posts is read page by page, some 64 MB of it at a time.
inline constexpr std::size_t most_posts_read_at_once = 8'000'000;

// grid: one with clusters. occluder: of its horizon. Reads all posts, and of the clusters what each group
// says of itself, nothing below that. Errors: damage; clusters of other posts.
Result<std::unique_ptr<RegionClusters>> clusters_of_region(
    const RegionGrid& grid, const HorizonOccluder& occluder,
    std::size_t most_read_at_once = most_posts_read_at_once);

// Reads all of a region's clusters, and asks whether they are a graph over its posts (ClusterFile::check()).
// Keeps 5 bytes a post, and what that takes. Errors: damage; what is no graph.
Result<void> check_clusters_of_region(const RegionGrid& grid,
                                      std::size_t most_read_at_once = most_posts_read_at_once);

}  // namespace oro
