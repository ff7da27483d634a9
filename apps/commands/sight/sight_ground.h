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
#include "geo/canopy/canopy_map.h"
#include "geo/together/region_ground.h"

namespace oro {

// The canopy over a ground, as a surface that hides. Stays where it is: its ground holds on to the region.
struct SightCanopy {
    std::shared_ptr<const CanopyMap> map;
    Region region;  // raised (geo/canopy/raised_region.h)
    std::unique_ptr<const RegionGround> grids;
};

// A region and its full resolution. Stays where it is: the ground holds on to the region.
struct SightGround {
    Region region;
    std::unique_ptr<const RegionGround> grids;
    std::unique_ptr<const SightCanopy> canopy;  // null: nothing grows
    // What people stand on, and heights are counted from.
    [[nodiscard]] const TrueGround& ground() const { return grids->ground(); }
    // What lines of sight are held against: the canopy where there is one.
    [[nodiscard]] const TrueGround& hiding() const { return canopy ? canopy->grids->ground() : ground(); }
    // How high the canopy is over the ground at a place, 0 or more; nothing where no post around has any.
    [[nodiscard]] std::optional<double> canopy_m(const Geodetic& place) const;
    // How far below the top of the canopy a point is; nothing where it is not in one.
    [[nodiscard]] std::optional<double> in_canopy_m(const Geodetic& point) const;
    // H of a point: above the geoid (of the region, as everywhere).
    [[nodiscard]] double H_m(const Geodetic& point) const;
    // Height of a point over the ground below it; nothing where there is none.
    [[nodiscard]] std::optional<double> above_m(const Geodetic& point) const;
};
// What --landcover, --canopy and --canopy-held name.
struct SightCover {
    std::shared_ptr<const CoverMap> cover;    // null: none
    std::shared_ptr<const CanopyMap> canopy;  // null: none
    std::optional<double> held;               // share of the canopy that the data hold
};
// Errors: those of cover_choice_from(), canopy_choice_from(), open_cover() and open_canopy().
Result<SightCover> open_sight_cover(const ViewOptions& view);
// The files that these are made of.
std::vector<std::string> files_of_cover(const SightCover& cover);

// Errors: those of open_region(), of RegionGround::of() and of raise_by_canopy().
Result<std::unique_ptr<const SightGround>> open_sight_ground(const RegionOptions& options,
                                                             const Progress& progress,
                                                             const SightCover& cover = {});
// The same of a region that was opened already. Errors: those of RegionGround::of() and of raise_by_canopy().
Result<std::unique_ptr<const SightGround>> sight_ground_of(Region region, const SightCover& cover);

// Refuses a height over the ground below 0: `option` is how it was given.
Result<void> check_above(const char* option, const std::optional<double>& above_m);
// Where somebody stands, or what is looked at: over the ground, whatever grows on it. On the ground means
// least_above_m over it. Errors: those of stand(), and a point under the ground (usage).
Result<Standpoint> stand_over_ground(const Standing& standing, const SightGround& ground);
// The same over a region whose full resolution `ground` is.
Result<Standpoint> stand_over_ground(const Standing& standing, const Region& region,
                                     const TrueGround& ground);
// The point of stand_over_ground() alone, without how it came there.
Result<Geodetic> point_over_ground(const Standing& standing, const SightGround& ground);

// {"lat_deg", "lon_deg", "h_m", "H_m"}
nlohmann::ordered_json point_json(const SightGround& ground, const Geodetic& point);

}  // namespace oro
