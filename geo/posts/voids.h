// Filling posts that have no height.
#pragma once

#include <cstdint>

#include "core/base/result.h"
#include "geo/posts/seams.h"

namespace oro {

// Fills the void posts that sources cover from posts up to 100 away; says how many. What no source covers
// stays a hole.
Result<std::uint64_t> fill_voids(JoinedSurface& surface, const PostGrid& grid);

}  // namespace oro
