// The grids of a region that lie over each other, made one surface.
#pragma once

#include <array>
#include <vector>

#include "core/base/result.h"
#include "core/seam/seam.h"
#include "geo/region/region.h"
#include "geo/together/coverage_rim.h"
#include "geo/together/grid_clip.h"

namespace oro {

// A post of one of a region's grids, by the grid's number.
struct BridgePost {
    std::size_t grid{};
    GridPost post{};
    bool operator==(const BridgePost&) const = default;
};

// Anticlockwise, seen from above; its corners are posts on the rims of two grids.
struct GapBridge {
    std::array<BridgePost, 3> posts;
};

// Rims that are farther apart than so many posts, of the coarser grid, stay apart.
inline constexpr double widest_gap_posts = 2.0;

// What joins the rims of a region's grids where they are no farther apart than that, and no grid has ground
// between them: tiles whose posts are the middles of their cells, two UTM zones that meet. It holds no height
// that the data do not. Takes each post of grids that lie near others once. Errors: what GEOS says.
Result<std::vector<GapBridge>> gap_bridges(const Region& region);

// Those that cut a part out of one of them, in the order that GridClip counts them from 1.
std::vector<const RegionGrid*> finer_than(const Region& region, const RegionGrid& one);

// What those cut out of it; empty where there are none. Errors: as clip_by_finer().
Result<GridClip> cut_of(const Region& region, const RegionGrid& one);

// What makes the grids of a region one surface.
struct RegionCuts {
    std::vector<GridClip> grids;     // what is cut out of each by those with a smaller rank
    std::vector<GapBridge> bridges;  // ... and what joins those that lie next to each other
};
// Errors: as clip_by_finer() and gap_bridges().
Result<RegionCuts> cut_regions(const Region& region);

// What is drawn between them, and the region's meshes. meshes: what is drawn in the place of these
// (geo/together/mesh_detail.h); null: themselves.
Seam seam_between(const Region& region, const RegionCuts& cuts, double exaggeration,
                  const std::vector<PlacedMesh>* meshes = nullptr);

}  // namespace oro
