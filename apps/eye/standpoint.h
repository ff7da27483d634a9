// Where somebody stands, or what is looked at: a place and a height, as options say them.
#pragma once

#include <optional>
#include <string>

#include "core/base/result.h"
#include "core/earth/ellipsoid.h"
#include "core/terrain/post_grid.h"
#include "core/terrain/summit.h"
#include "geo/places/place.h"
#include "geo/region/region.h"

namespace oro {

// What options say of one point. The names are those of the options, for errors.
struct Standing {
    const char* place_option;  // "--at"
    std::string place;
    const char* above_option;  // "--above"
    std::optional<double> above_m;
    double usual_above_m;                      // over the ground, where nothing is said
    std::optional<double> altitude_m;          // above sea level instead (--altitude)
    const char* way_out{"--altitude METRES"};  // what to give where there is no ground
    bool on_summit{};                          // on the highest post nearby, and not on the very place
    bool on_top{};                             // on what a plumb line meets first: a roof, say
    const char* summit_option{"--on-summit"};  // what on_summit comes from
};

struct Standpoint {
    Geodetic eye;
    std::optional<MovedToSummit> moved;  // of who asks for the summit
    // Of who does not: the highest post near, where it is a summit, more than least_wall_m higher than the
    // ground of the place, and higher than the eye. A wall is then before the eye.
    std::optional<MovedToSummit> wall;
};
inline constexpr double least_wall_m = 20.0;

// The highest post near a place (core/terrain/summit.h), by heights above sea level, of a surface that is
// exaggerated. Posts are those of the data: ground that is invented between them (--detail) neither has
// summits nor changes what is told. The height of `place` does not count. Posts that cannot be read count as
// void: region.health() tells.
MovedToSummit moved_to_summit(const Geodetic& place, const Region& region, double exaggeration);

// Where an eye stands, moved to the summit where that is asked for. Errors: those of standpoint(); a place
// with a height of its own that is to be moved (usage).
Result<Standpoint> stand(const Standing& standing, const Region& region, double exaggeration = 1.0);

// Lifts a point over the ground by as much as a mesh of the region stands over the ground there; nothing
// happens where none does, and to who is not asked to stand on top. Errors (usage): a region without meshes;
// a height above sea level besides.
Result<void> lift_onto_top(const Standing& standing, const Region& region, double exaggeration,
                           Geodetic& point);

// What one stands on at a place: the ground's height above the ellipsoid; where the ground has none, the
// highest place of a mesh there, as in a pit that is cut out of the terrain; nothing where there is neither.
// field: of the grid that is the ground there.
std::optional<double> standing_h_m(const Region& region, const HeightField& field, double exaggeration,
                                   double lat_deg, double lon_deg);

// Where that is, on the very place. A geo: place with a height has its own, above the ellipsoid. Errors: text
// that is no place, two heights (usage); no ground to stand on (no_data), which names the data's box.
Result<Geodetic> standpoint(const Standing& standing, const Region& region, const HeightField& field,
                            double exaggeration = 1.0);

// The grid that is the ground at a place; the nearest where none has any.
const RegionGrid& grid_at(const Region& region, double lat_deg, double lon_deg);
// The same of grids of data alone: not of ground that is invented between their posts.
const RegionGrid& data_grid_at(const Region& region, double lat_deg, double lon_deg);
// The one of a region's grids that reaches farthest around a place, of those that it is in.
const RegionGrid& widest_at(const Region& region, double lat_deg, double lon_deg);

// A place of an option. Errors (usage) name the option.
Result<Place> place_at(const char* option, const std::string& text);

// "46.670000,8.060000"
std::string place_name(double lat_deg, double lon_deg);
// Whether a grid's box holds a place.
bool holds(const PostGrid& grid, double lat_deg, double lon_deg);
// The data's extent, for who asked for a place without any; and whether the place lies inside when its
// latitude and longitude change places.
std::string where_data_are(const PostGrid& grid, double lat_deg, double lon_deg);

}  // namespace oro
