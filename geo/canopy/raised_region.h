// The canopy as a surface: the posts of a region raised to the top of what grows on them.
#pragma once

#include <optional>
#include <string>

#include "core/base/result.h"
#include "geo/canopy/canopy_map.h"
#include "geo/region/region.h"

namespace oro {

// The share of a canopy's height that the heights of SRTM hold: its radar saw 0.5 of it in pine and in mixed
// forest, 0.53 and 0.6 in others. Source: L. W. Kenyi, R. Dubayah, M. Hofton, M. Schardt, Comparative
// analysis of SRTM-NED vegetation canopy height to LIDAR-derived vegetation canopy metrics, International
// Journal of Remote Sensing, 2009.
inline constexpr double srtm_held_share = 0.5;

// Which share of a canopy the data of a grid hold already, and by whose heights: SRTM's as above, others
// none.
struct HeldCanopy {
    double share{};
    std::string by;  // "SRTM"; "" where the share is 0
};
HeldCanopy held_by_sources(const RegionGrid& grid);

// Raises every post of the region that has a height: H + (1 - held) * canopy, in float. What is told of the
// grids and of their posts' fingerprints stays that of the ground; posts of a baked grid come into memory,
// and its levels and clusters are not used any more. `held`: the share of the canopy that the data hold;
// nothing: held_by_sources(). Not for a region that is raised already. Errors: those of
// CanopyMap::heights_around(); a canopy that is known of no post (no_data); damage in a baked region.
Result<void> raise_by_canopy(Region& region, const CanopyMap& canopy, const std::optional<double>& held);

// The region as it was before it was raised: its ground, to the bit. Costs a copy of its posts.
Region ground_of_raised(const Region& raised);

// How high the raised surface of a grid is over the ground at a place, by the posts around it: metres, 0 or
// more, linear between posts. Nothing where no post around is raised.
std::optional<double> canopy_over_ground_m(const RegionGrid& grid, double lat_deg, double lon_deg);

}  // namespace oro
