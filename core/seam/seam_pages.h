// A seam as pages that are drawn beside those of its grids.
#pragma once

#include <memory>

#include "core/base/result.h"
#include "core/frame/region_pages.h"
#include "core/seam/seam.h"

namespace oro {

// Pages of one level, a row of them, all of which a frame draws that sees them: pieces first, then closers.
// Pieces of meshes are not among them (core/seam/mesh_pages.h); null where nothing else is there.
// Each piece or skirt is one quad of a page, with an empty row and an empty column after it; these hold what
// its four posts have beside a place (shaders/place/seam.glsl). 480 KB a page of 1,849 of them. N is that of
// `undulation`. shape: of the grids. Errors: a seam that reaches over more than 60 degrees.
Result<std::unique_ptr<RegionPages>> seam_pages(const Seam& seam, const UndulationField& undulation,
                                                const RegionShape& shape);

// How a page is laid out: quads along a side, and posts from one to the next.
inline constexpr int seam_quads = 43;
inline constexpr int seam_stride = static_cast<int>(gpu::seam_stride);

}  // namespace oro
