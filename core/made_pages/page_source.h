// What a GPU makes the heights of a page of made terrain from (shaders/made/page_heights.comp).
#pragma once

#include "core/made/made_ground.h"
#include "core/terrain/page.h"
#include "core/terrain/post_grid.h"

namespace oro::gpu {

#define ORO_MADE_CONST inline constexpr
#include "shaders/made/page_source.glsl"
#undef ORO_MADE_CONST

}  // namespace oro::gpu

namespace oro {

// Of a page of a grid whose posts are those of `ground`, lifted by N of `undulation`. The grid's posts lie on
// latitudes and longitudes. Any thread; some 20 us.
void set_page_source(const PostGrid& grid, const UndulationField& undulation, const MadeGround& ground,
                     PageIndex page, gpu::MadePageSource& source);

}  // namespace oro
