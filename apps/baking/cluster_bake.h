// From a region that was read to a file of it with clusters.
#pragma once

#include <functional>
#include <span>
#include <string>

#include "core/baked/bake.h"
#include "geo/region/region.h"

namespace oro {

// Posts that are built in one go; regions with more are built window by window (core/cluster_windows), to the
// same bytes. Also what is done with all of a graph at a time.
inline constexpr std::size_t most_posts_in_one_go = 8'000'000;
// Posts that a cluster file can number.
inline constexpr std::size_t most_clustered_posts = 4'000'000'000;

struct ClusterBakeReport {
    BakeReport region;
    std::size_t levels{};
    std::size_t triangles{};  // above the leaves
    double build_s{};         // of the graph alone
};

// Whether a region can be baked with clusters: one grid of posts on latitudes and longitudes, of at most
// most_clustered_posts, or most_posts_in_one_go where it goes round the Earth. Errors: it cannot, in a line
// that tells why.
Result<void> check_clusters(const Region& region);

// Bakes a grid that goes into a larger file, to how.path beside it, unless a bake that was broken off has
// left it there whole. Errors: those of bake_region(); somebody else's file of that name.
Result<BakeReport> bake_part(const HeightField& field, const BakeOptions& how, const BakeProgress& progress);

// Bakes the region as bake_region() does, then its graph, and puts both into how.path, which the caller
// holds (BakeHold). What is done already of a bake that was broken off is not done again. on_progress: how
// far it is, 0..1, and what is being done. beside: files that go into it, too, and are removed.
Result<ClusterBakeReport> bake_clusters(const HeightField& field, const BakeOptions& how,
                                        const std::function<void(double, const char*)>& on_progress,
                                        std::span<const ContainerPart> beside = {});

}  // namespace oro
