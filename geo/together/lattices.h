// Sources that lie together and whose posts are not each other's: a grid each.
#pragma once

#include <optional>
#include <vector>

#include "geo/places/bounding_box.h"
#include "geo/sources/region_request.h"
#include "geo/sources/source.h"

namespace oro {

// Whether the posts of two sources are those of one grid: the same CRS, spacing and turn, and a whole number
// of posts apart, to 0.01 of a post.
bool share_lattice(const Source& one, const Source& other);

// The sources by their lattices, in the order that they had; all of them in one group where one grid of
// latitudes and longitudes does for them: where all lie on such, and it has less than apart_factor
// (disjoint_sources.h) times their posts.
std::vector<std::vector<Source>> by_lattice(std::vector<Source> sources,
                                            const std::optional<BoundingBox>& box);

// Sources that are to be a grid each: those that lie far apart, and of those that lie together those whose
// posts are not each other's; all of them one where there would be more than groups_max, or the request wants
// one (allow_multiple_grids).
std::vector<std::vector<Source>> grids_of_sources(std::vector<Source> sources, const RegionRequest& request);

}  // namespace oro
