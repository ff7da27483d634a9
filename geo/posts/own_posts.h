// A region whose posts are those of its files, in a CRS of their own: nothing is resampled.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/terrain/post_grid.h"
#include "geo/datum/vertical_datum.h"
#include "geo/posts/seams.h"
#include "geo/region/region.h"
#include "geo/sources/source.h"

namespace oro {

// Where a source's first post lies among those of the region.
struct OwnPart {
    int row{};
    int column{};
};

// The posts that a region is made of, and where they lie.
struct OwnPosts {
    PostGrid grid;
    PostsCrs crs;
    bool upside_down{};          // rows of the sources run northwards, and the region's the other way
    std::vector<OwnPart> parts;  // of each source; by the source's own rows, the region's are counted from
                                 // below where they are upside down
    std::string why_not;         // where it is not "", they cannot be kept, and all else is empty
};

// All posts of sources that share one lattice (CRS, spacing, turn, and places a whole number of posts apart),
// or those around a box (whole rows and columns). Places are PROJ's to 0.02 mm
// (core/net/lattice_georeference.h). They cannot be kept where sources share none, where PROJ cannot turn the
// CRS into WGS84, where places jump from one post to the next (kinks of a grid of shifts are kept), and where
// they reach some 5,000 km from their middle. Errors: more posts than memory holds; nothing in the box
// (no_data).
Result<OwnPosts> own_posts(std::span<const Source> sources, const std::optional<BoundingBox>& box);

// Whether the posts of a source in a CRS of its own are on the lattice of another's: the same CRS, spacing
// and turn.
bool is_on_lattice(const Source& source, const Source& other);

// Rows and columns of a net that a box (unwrapped) touches, and a post more on each side where it has one;
// none of those where it touches none.
PostWindow posts_in_box(const LatticeGeoreference& net, const BoundingBox& box);

// Reads them and lays them into the surface, in order of precedence, as mosaic_sources() does. Puts N of each
// post into `N_of_posts_m`, unless N is 0 everywhere.
struct OwnMosaicTarget {
    const OwnPosts& posts;
    const UndulationField& undulation;
    const GeoidOfRegion& geoid;
    bool strict_datum{};
};
Result<void> mosaic_own_posts(std::vector<Source>& sources, const OwnMosaicTarget& target,
                              JoinedSurface& surface, std::vector<float>& N_of_posts_m,
                              std::vector<std::string>& notes, const Progress& progress);

}  // namespace oro
