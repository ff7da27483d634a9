// A page's heights in fewer bits, without any loss: as the GPU keeps them (shaders/shared_heights.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "shaders/shared_heights.h"

namespace oro {

// The heights of a page in steps, row by row from post (-1, -1), void_height_steps where there is none.
using HeightsOfPage = std::span<const std::int32_t, gpu::page_heights>;

// The most words that a page can take.
inline constexpr std::size_t packed_words_max = 1 + 4 * gpu::packed_blocks + gpu::page_heights + 1;

// Words of a page's packed heights: the unit, the blocks, their codes, and one more, because a code is read
// from two words. Any heights pack to what they were. Those of a source in whole metres or feet,
// `exaggeration` times as high, take few bits: what is left of them between N and a plane is a number of such
// units.
std::vector<std::uint32_t> packed_heights(HeightsOfPage steps, double exaggeration);

// One of them, by row and column of the page's 131 x 131; as stored_height of shaders/place/place.glsl.
std::int32_t unpacked_height(std::span<const std::uint32_t> packed, std::size_t row, std::size_t column);

}  // namespace oro
