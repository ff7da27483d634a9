// Sources that lie together and whose posts are not each other's: a grid each.
#pragma once

#include <optional>
#include <vector>

#include "geo/region/region.h"
#include "geo/sources/source.h"

namespace oro {

// Whether the posts of two sources are those of one grid: the same CRS, spacing and turn, and a whole number
// of posts apart, to 0.01 of a post.
bool share_lattice(const Source& one, const Source& other);

// The sources by their lattices, in the order that they had; all of them in one group where one grid of
// latitudes and longitudes does for them: where all lie on such, and it has less than apart_factor
// (lying_apart.h) times their posts.
std::vector<std::vector<Source>> by_lattice(std::vector<Source> sources,
                                            const std::optional<BoundingBox>& box);

}  // namespace oro
