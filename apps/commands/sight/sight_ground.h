// The ground that sight, profile and viewshed look over.
#pragma once

#include <functional>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "apps/eye/standpoint.h"
#include "apps/options/options.h"
#include "core/base/progress.h"
#include "core/truth/true_ground.h"
#include "geo/together/region_ground.h"

namespace oro {

// A region and its full resolution. Stays where it is: the ground holds on to the region.
struct SightGround {
    Region region;
    std::unique_ptr<const RegionGround> grids;
    [[nodiscard]] const TrueGround& ground() const { return grids->ground(); }
    // H of a point: above the geoid (of the region, as everywhere).
    [[nodiscard]] double H_m(const Geodetic& point) const;
    // Height of a point over the ground below it; nothing where there is none.
    [[nodiscard]] std::optional<double> above_m(const Geodetic& point) const;
};
Result<std::unique_ptr<const SightGround>> open_sight_ground(const RegionOptions& options,
                                                             const Progress& progress);

// Refuses a height over the ground below 0: `option` is how it was given.
Result<void> check_above(const char* option, const std::optional<double>& above_m);
// Where somebody stands, or what is looked at. On the ground means least_above_m over it. Errors: those of
// stand(), and a point under the ground (usage).
Result<Standpoint> stand_over_ground(const Standing& standing, const SightGround& ground);
// The same over a region whose full resolution `ground` is.
Result<Standpoint> stand_over_ground(const Standing& standing, const Region& region,
                                     const TrueGround& ground);
// The point of stand_over_ground() alone, without how it came there.
Result<Geodetic> point_over_ground(const Standing& standing, const SightGround& ground);

// {"lat_deg", "lon_deg", "h_m", "H_m"}
nlohmann::ordered_json point_json(const SightGround& ground, const Geodetic& point);

}  // namespace oro
