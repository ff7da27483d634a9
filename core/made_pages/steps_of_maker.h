// Posts of a made region from its maker.
#pragma once

#include <optional>
#include <span>

#include "core/made_pages/measured_block.h"

namespace oro {

// Of all these rows of the region and of columns at such places; nothing where the region has no maker, or
// that makes none (MadePostMaker::make()).
std::optional<MadeSteps> steps_of_maker(const MadeRegion& region, std::span<const int> rows,
                                        std::span<const MadeColumn> columns, std::uint32_t coarse_octaves);

}  // namespace oro
