// How the quads of a page are split: what its heights alone do not tell.
#pragma once

#include <array>
#include <cstdint>

#include "core/terrain/drawn_heights.h"
#include "core/terrain/page.h"

namespace oro {

// PageBlock::sw_ne of a page, as page_heights() has them of the same heights.
std::array<std::uint32_t, gpu::page_diagonal_words> page_diagonals(const DrawnHeights& heights,
                                                                   PageIndex index);

}  // namespace oro
