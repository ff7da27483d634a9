// What a grid lost by resampling, of all its sources together.
#pragma once

#include <cstdint>
#include <optional>

#include "geo/region/region.h"

namespace oro {

struct RegionResampling {
    std::uint64_t files{};              // that were resampled or interpolated
    std::uint64_t unknown{};            // of these, such as nobody measured: 0 of what this program opens
    std::uint64_t posts{}, compared{};  // as in Resampling, summed
    double worst_m{};                   // the largest, without its sign
    double rms_m{};
    bool operator==(const RegionResampling&) const = default;
};

// Nothing where the grid's posts are its sources' own.
[[nodiscard]] std::optional<RegionResampling> region_resampling(const RegionGrid& grid);

// The source with the post that is farthest off; null where none was compared. Points into the grid.
[[nodiscard]] const SourceReport* worst_resampled(const RegionGrid& grid);

}  // namespace oro
