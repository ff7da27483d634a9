// Sources that lie far apart: a region each, instead of one grid over all that is between them.
#pragma once

#include <optional>
#include <vector>

#include "geo/places/bounding_box.h"
#include "geo/sources/source.h"

namespace oro {

// The sources in groups whose surfaces touch: more than one group where one grid over all of them would have
// apart_factor times the posts of a grid for each, and there are at most groups_max. Each group and each
// source keeps the order that it had. `box`: what was asked for; the sources meet it.
inline constexpr double apart_factor = 4.0;
inline constexpr std::size_t groups_max = 4096;
std::vector<std::vector<Source>> disjoint_sources(std::vector<Source> sources,
                                                  const std::optional<BoundingBox>& box);

}  // namespace oro
