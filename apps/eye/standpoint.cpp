#include "apps/eye/standpoint.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <limits>

#include "apps/command_line/refusals.h"
#include "core/terrain/ground.h"
#include "geo/places/geodesic.h"
#include "geo/together/mesh_roofs.h"

namespace oro {

std::string place_name(double lat_deg, double lon_deg) {
    char text[64];
    std::snprintf(text, sizeof text, "%.6f,%.6f", lat_deg, lon_deg);
    return text;
}

bool holds(const PostGrid& grid, double lat_deg, double lon_deg) {
    const auto [row, column] = grid.post_at(lat_deg, lon_deg);
    return row >= 0.0 && row <= grid.rows() - 1 && column >= 0.0 && column <= grid.columns() - 1;
}

std::string where_data_are(const PostGrid& grid, double lat_deg, double lon_deg) {
    if (holds(grid, lat_deg, lon_deg)) return " (a hole in the data)";
    char text[200];
    std::snprintf(text, sizeof text, " (the data's box is %.6g,%.6g,%.6g,%.6g: west,south,east,north)",
                  grid.west_deg(), grid.south_deg(), grid.east_deg(), grid.north_deg());
    if (std::abs(lon_deg) > 90.0 || !holds(grid, lon_deg, lat_deg)) return text;
    return text + (". " + place_name(lon_deg, lat_deg)) + " lies inside: latitude comes first";
}

// How far a place is from a grid's posts, about: 0 inside.
double rad_from(const PostGrid& grid, double lat_deg, double lon_deg) {
    if (holds(grid, lat_deg, lon_deg)) return 0.0;
    const auto [row, column] = grid.post_at(lat_deg, lon_deg);
    const PostPlace near =
        grid.place_at(std::clamp(row, 0.0, grid.rows() - 1.0), std::clamp(column, 0.0, grid.columns() - 1.0));
    const glm::dvec3 there = ecef_from_enu(near.lat_deg, near.lon_deg)[2],
                     here = ecef_from_enu(lat_deg, lon_deg)[2];
    return std::acos(std::clamp(glm::dot(there, here), -1.0, 1.0));
}

namespace {

const RegionGrid& grid_among(const Region& region, double lat_deg, double lon_deg, bool data_alone) {
    const RegionGrid* there = nullptr;
    for (const RegionGrid& grid : region.grids)
        if (!(data_alone && grid.detail) && (there == nullptr || grid.rank < there->rank) &&
            grid.field.surface_H_m(lat_deg, lon_deg))
            there = &grid;
    if (there != nullptr) return *there;
    return *std::ranges::min_element(region.grids, {}, [&](const RegionGrid& grid) {
        return grid.detail ? std::numeric_limits<double>::max() : rad_from(grid.field.grid, lat_deg, lon_deg);
    });
}

}  // namespace

const RegionGrid& grid_at(const Region& region, double lat_deg, double lon_deg) {
    return grid_among(region, lat_deg, lon_deg, false);
}

const RegionGrid& data_grid_at(const Region& region, double lat_deg, double lon_deg) {
    return grid_among(region, lat_deg, lon_deg, true);
}

const RegionGrid& widest_at(const Region& region, double lat_deg, double lon_deg) {
    const auto area = [](const RegionGrid& one) {
        const PostGrid& grid = one.field.grid;
        return (grid.rows() - 1.0) * grid.row_step_rad() * (grid.columns() - 1.0) * grid.column_step_rad();
    };
    const RegionGrid* widest = &grid_at(region, lat_deg, lon_deg);
    for (const RegionGrid& grid : region.grids)
        if (holds(grid.field.grid, lat_deg, lon_deg) && area(grid) > area(*widest)) widest = &grid;
    return *widest;
}

Result<Place> place_at(const char* option, const std::string& text) {
    Result<Place> place = parse_place(text);
    if (!place.ok()) return refused(option, text, place.error().what);
    return place;
}

std::optional<double> standing_h_m(const Region& region, const HeightField& field, double exaggeration,
                                   double lat_deg, double lon_deg) {
    const std::optional<double> ground_m = ground_h_m(field, lat_deg, lon_deg, exaggeration);
    if (ground_m || !region.meshes) return ground_m;
    const auto top = MeshRoofs(region, exaggeration).at(lat_deg, lon_deg);
    return top ? std::optional(top->h_m) : std::nullopt;
}

Result<Geodetic> standpoint(const Standing& standing, const Region& region, const HeightField& field,
                            double exaggeration) {
    const std::string option = standing.place_option;
    ORO_TRY(const Place place, place_at(standing.place_option, standing.place));
    if (place.height_m) {
        if (standing.altitude_m || standing.above_m)
            return refused(option, standing.place,
                           std::string("gives a height of its own: leave ") + standing.above_option +
                               " and --altitude out");
        // Of WGS84, as geo: places are: above the ellipsoid.
        return Geodetic{place.lat_deg, place.lon_deg, *place.height_m};
    }
    if (standing.altitude_m)
        return Geodetic{place.lat_deg, place.lon_deg,
                        *standing.altitude_m + field.undulation.at_m(place.lat_deg, place.lon_deg)};
    const std::optional<double> ground =
        standing_h_m(region, field, exaggeration, place.lat_deg, place.lon_deg);
    // Ground that could not be read is no ground to stand on, but that is not why there is none.
    if (!ground) ORO_CHECK(field.health());
    if (!ground)
        return Error{ErrorKind::no_data, option + " " + place_name(place.lat_deg, place.lon_deg),
                     std::string("no elevation data there to stand on; give ") + standing.way_out +
                         " or another place" + where_data_are(field.grid, place.lat_deg, place.lon_deg)};
    return Geodetic{place.lat_deg, place.lon_deg,
                    *ground + standing.above_m.value_or(standing.usual_above_m)};
}

Result<void> lift_onto_top(const Standing& standing, const Region& region, double exaggeration,
                           Geodetic& point) {
    if (!standing.on_top) return {};
    if (!region.meshes) return refused("--stand-on", "top", "needs a mesh: --mesh-file FILE");
    if (standing.altitude_m)
        return refused("--stand-on", "top", either_words("--stand-on top", "--altitude"));
    const auto top = MeshRoofs(region, exaggeration).at(point.lat_deg, point.lon_deg);
    const auto ground_m = ground_h_m(grid_at(region, point.lat_deg, point.lon_deg).field, point.lat_deg,
                                     point.lon_deg, exaggeration);
    if (top && ground_m && top->h_m > *ground_m) point.h_m += top->h_m - *ground_m;
    return {};
}

MovedToSummit moved_to_summit(const Geodetic& place, const Region& region, double exaggeration) {
    // Posts between those of the data are so near to each other that none of few is a summit.
    const HeightField& field = data_grid_at(region, place.lat_deg, place.lon_deg).field;
    const auto ground_m = ground_h_m(field, place.lat_deg, place.lon_deg, exaggeration);
    const auto H_over = [&](const Geodetic& at) {
        return (at.h_m - field.undulation.at_m(at.lat_deg, at.lon_deg)) / exaggeration;
    };
    const auto post_H_m = [&](int row, int column) -> std::optional<double> {
        const float H_m = field.H_at_post_m(row, column);
        return is_void(H_m) ? std::nullopt : std::optional<double>(H_m);
    };
    constexpr double below_all_m = -1.0e9;
    MovedToSummit moved;
    moved.from = {place.lat_deg, place.lon_deg, ground_m.value_or(0.0)};
    moved.to = moved.from;
    // Which of two posts is higher is a question of heights above sea level: the geoid leans.
    Geodetic from_H = moved.from;
    from_H.h_m = ground_m ? H_over(moved.from) : below_all_m;
    moved.H_m = ground_m ? from_H.h_m : 0.0;
    if (ground_m) moved.higher_m = 0.0;
    const auto highest = highest_post_near(field.grid, from_H, post_H_m);
    if (!highest || highest->h_m - from_H.h_m < least_higher_m) return moved;
    moved.to = *highest;
    moved.to.h_m = highest->h_m * exaggeration + field.undulation.at_m(highest->lat_deg, highest->lon_deg);
    // As the ground there has it, to the last bit.
    if (const auto there_m = ground_h_m(field, highest->lat_deg, highest->lon_deg, exaggeration))
        moved.to.h_m = *there_m;
    moved.H_m = H_over(moved.to);
    if (ground_m) moved.higher_m = moved.H_m - from_H.h_m;
    moved.goes_on_rising = rises_beyond(field.grid, from_H, *highest, post_H_m);
    moved.moved_m =
        geodesic_between(moved.from.lat_deg, moved.from.lon_deg, moved.to.lat_deg, moved.to.lon_deg)
            .distance_m;
    return moved;
}

namespace {

// The summit near a place that is so much higher than its ground that who stands there sees a wall. On a
// slope that goes on rising there is none: that people stand there is no mistake.
Result<std::optional<MovedToSummit>> wall_before(const Geodetic& eye, const Region& region,
                                                 double exaggeration) {
    const MovedToSummit post = moved_to_summit(eye, region, exaggeration);
    ORO_CHECK(region.health());
    const double higher_m = post.higher_m.value_or(0.0);
    const bool hides =
        !post.goes_on_rising && higher_m > least_wall_m && eye.h_m - post.from.h_m < higher_m * exaggeration;
    return hides ? std::optional(post) : std::nullopt;
}

}  // namespace

Result<Standpoint> stand(const Standing& standing, const Region& region, double exaggeration) {
    ORO_TRY(const Place place, place_at(standing.place_option, standing.place));
    const HeightField& field = grid_at(region, place.lat_deg, place.lon_deg).field;
    if (!standing.on_summit) {
        ORO_TRY(const Geodetic eye, standpoint(standing, region, field, exaggeration));
        if (place.height_m) return Standpoint{eye, {}, {}};
        ORO_TRY(const auto wall, wall_before(eye, region, exaggeration));
        return Standpoint{eye, {}, wall};
    }
    if (place.height_m)
        return refused(standing.place_option, standing.place,
                       std::string("gives a height of its own: leave ") + standing.summit_option + " out");
    const MovedToSummit moved = moved_to_summit({place.lat_deg, place.lon_deg, 0.0}, region, exaggeration);
    ORO_CHECK(region.health());
    if (moved.moved_m == 0.0) {
        ORO_TRY(const Geodetic eye, standpoint(standing, region, field, exaggeration));
        return Standpoint{eye, moved, {}};
    }
    Geodetic eye = moved.to;
    if (standing.altitude_m)
        eye.h_m = *standing.altitude_m + field.undulation.at_m(eye.lat_deg, eye.lon_deg);
    else
        eye.h_m += standing.above_m.value_or(standing.usual_above_m);
    return Standpoint{eye, moved, {}};
}

}  // namespace oro
