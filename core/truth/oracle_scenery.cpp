#include "core/truth/oracle_scenery.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <utility>

#include "core/terrain/drawn_heights.h"

namespace oro {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

std::uint64_t next_number() {
    static std::atomic<std::uint64_t> last{0};
    return ++last;
}

}  // namespace

Oracle::Scenery::Scenery(const TrueGround& of, std::size_t number, const Sight& from)
    : ground(of), grid(number), surface(of.surface(number)), sight(from), number_(next_number()) {
    const PostGrid& posts = surface.field().grid;
    // Boxes are tight where the ground lies along the frame's axes.
    const bool flat = sight.earth == Earth::flat;
    const double lat_deg = flat ? sight.place.lat_deg : 0.5 * (posts.north_deg() + posts.south_deg());
    const double lon_deg = flat ? sight.place.lon_deg : 0.5 * (posts.west_deg() + posts.east_deg());
    frame_from_ecef = glm::transpose(ecef_from_enu(lat_deg, lon_deg));
    constexpr int step = TrueSurface::block_cells;
    if (posts.net) return;
    for (int row = 0; row - step < posts.rows() - 1; row += step) {
        const double at_deg = row_lat_deg(posts, std::min(row, posts.rows() - 1));
        const SineCosine angle = sine_cosine_deg(at_deg);
        const double normal_m =
            sight.earth == Earth::sphere ? mean_radius_m : prime_vertical_radius_m(at_deg);
        rows.push_back({normal_m, angle.cosine, angle.sine});
        if (sight.earth == Earth::flat)
            rows_north_m.push_back(meridian_radius_m(sight.place.lat_deg) *
                                   radians_from_deg(at_deg - sight.place.lat_deg).rad);
    }
    for (int column = 0; column - step < posts.columns() - 1; column += step) {
        const double at_deg = posts.lon.at_deg(std::min(column, posts.columns() - 1));
        columns.push_back(sine_cosine_deg(at_deg));
        if (sight.earth == Earth::flat)
            columns_east_m.push_back(
                prime_vertical_radius_m(sight.place.lat_deg) * sine_cosine_deg(sight.place.lat_deg).cosine *
                radians_from_deg(std::remainder(at_deg - sight.place.lon_deg, 360.0)).rad);
    }
}

// Between its corners a patch of a net strays from straight ways by at most an eighth of its angle squared
// times how much it bends; on a parallel these angles are wider. Near a pole it may have any longitude.
Oracle::Scenery::PlaneBox Oracle::Scenery::net_on_plane(const Patch& patch) const {
    const PostGrid& posts = surface.field().grid;
    const TrueSurface::Corners& corners = surface.corners();
    const double cells = TrueSurface::block_cells;
    const double angle = (patch.south - patch.north) * cells * posts.row_step_rad() +
                         (patch.east - patch.west) * cells * posts.column_step_rad();
    double south_deg = 90.0, north_deg = -90.0, first_deg = 0.0, west_deg = 0.0, east_deg = 0.0;
    for (const auto& [row, column] : {std::pair{patch.north, patch.west},
                                      {patch.north, patch.east},
                                      {patch.south, patch.west},
                                      {patch.south, patch.east}}) {
        const PostPlace place =
            place_of_normal(corners.normals[static_cast<std::size_t>(row * corners.columns + column)]);
        if (south_deg > north_deg) first_deg = place.lon_deg;
        const double turned_deg = std::remainder(place.lon_deg - first_deg, 360.0);
        south_deg = std::min(south_deg, place.lat_deg);
        north_deg = std::max(north_deg, place.lat_deg);
        west_deg = std::min(west_deg, turned_deg);
        east_deg = std::max(east_deg, turned_deg);
    }
    const double highest_deg = std::max(north_deg, -south_deg) + deg_from_radians(Radians(angle));
    constexpr double near_pole_deg = 80.0;
    const bool any_meridian = !(highest_deg < near_pole_deg);
    const SineCosine highest = sine_cosine_deg(std::min(highest_deg, near_pole_deg));
    const double stray_deg =
        deg_from_radians(Radians((posts.net->bend() * angle * angle / 8.0 + posts.net->kink() * angle / 4.0) *
                                 1.1 * (1.0 + highest.sine / highest.cosine)));
    const double lat_pad_deg = any_meridian ? deg_from_radians(Radians(angle)) : stray_deg;
    const double lon_pad_deg = stray_deg / highest.cosine;
    const double from_eye_deg = std::remainder(first_deg - sight.place.lon_deg, 360.0);
    west_deg += from_eye_deg - lon_pad_deg;
    east_deg += from_eye_deg + lon_pad_deg;
    if (any_meridian || west_deg < -180.0 || east_deg > 180.0) {
        west_deg = -180.0;
        east_deg = 180.0;
    }
    const double along_m = meridian_radius_m(sight.place.lat_deg);
    const double across_m =
        prime_vertical_radius_m(sight.place.lat_deg) * sine_cosine_deg(sight.place.lat_deg).cosine;
    const auto north_m = [&](double lat_deg) {
        return along_m * radians_from_deg(std::clamp(lat_deg, -90.0, 90.0) - sight.place.lat_deg).rad;
    };
    return {across_m * radians_from_deg(west_deg).rad, north_m(south_deg - lat_pad_deg),
            across_m * radians_from_deg(east_deg).rad, north_m(north_deg + lat_pad_deg)};
}

Oracle::Scenery::PlaneBox Oracle::Scenery::on_plane(const Patch& patch) const {
    if (surface.field().grid.net) return net_on_plane(patch);
    double west_m = columns_east_m[static_cast<std::size_t>(patch.west)];
    double east_m = columns_east_m[static_cast<std::size_t>(patch.east)];
    const double half_turn_m = std::numbers::pi * prime_vertical_radius_m(sight.place.lat_deg) *
                               sine_cosine_deg(sight.place.lat_deg).cosine;
    // Not as wide as its columns: on both sides of the meridian where the plane is cut, and so at both its
    // ends.
    const PostGrid& posts = surface.field().grid;
    const auto at_deg = [&](int column) {
        return posts.lon.at_deg(std::min(column * TrueSurface::block_cells, posts.columns() - 1));
    };
    const double width_deg = at_deg(patch.east) - at_deg(patch.west);
    if (east_m - west_m < (width_deg / 180.0 - 1.0) * half_turn_m) {
        east_m = half_turn_m;
        west_m = -east_m;
    }
    return {west_m, rows_north_m[static_cast<std::size_t>(patch.south)], east_m,
            rows_north_m[static_cast<std::size_t>(patch.north)]};
}

// The frame is the plane's own; sight lines that bend lift it by the square of the distance across it.
void Oracle::Scenery::flat_box(const Patch& patch, const TrueSurface::Layer& layer, glm::dvec3& low,
                               glm::dvec3& high) const {
    const auto [west_m, south_m, east_m, north_m] = on_plane(patch);
    const double near_m = std::hypot(std::max({west_m, -east_m, 0.0}), std::max({south_m, -north_m, 0.0}));
    const double far_m = std::hypot(std::max(-west_m, east_m), std::max(-south_m, north_m));
    const double half_c = 0.5 * sight.refraction.curvature_per_m();
    const auto [least_m, most_m] = std::minmax({half_c * near_m * near_m, half_c * far_m * far_m});
    constexpr double rounded_m = 1.0e-3;
    low = glm::dvec3(west_m, south_m, layer.lowest_h_m - sight.place.h_m + least_m) - rounded_m;
    high = glm::dvec3(east_m, north_m, layer.highest_h_m - sight.place.h_m + most_m) + rounded_m;
}

glm::dvec3 Oracle::Scenery::seen(int row, int column, double h_m) const {
    const TrueSurface::Corners& corners = surface.corners();
    if (!corners.normals.empty()) {
        const glm::dvec3& normal = corners.normals[static_cast<std::size_t>(row * corners.columns + column)];
        if (sight.earth == Earth::sphere)
            return frame_from_ecef *
                   sight.refraction.apparent_m((mean_radius_m + h_m) * normal - sight.eye.m);
        return frame_from_ecef * sight.refraction.apparent_m(ecef_along(normal, h_m).m - sight.eye.m);
    }
    const RowTerms& terms = rows[static_cast<std::size_t>(row)];
    const SineCosine& lon = columns[static_cast<std::size_t>(column)];
    const double e2 = sight.earth == Earth::sphere ? 0.0 : wgs84_e2;
    const double rho_m = (terms.normal_m + h_m) * terms.cosine;
    const glm::dvec3 ecef(rho_m * lon.cosine, rho_m * lon.sine,
                          (terms.normal_m * (1.0 - e2) + h_m) * terms.sine);
    return frame_from_ecef * sight.refraction.apparent_m(ecef - sight.eye.m);
}

bool Oracle::Scenery::box(const TrueSurface::Block& block, glm::dvec3& low, glm::dvec3& high) const {
    const TrueSurface::Layer layer = surface.layer(block);
    if (layer.empty()) return false;
    const int north = block.row << block.level, west = block.column << block.level;
    const bool on_net = surface.field().grid.net != nullptr;
    const int last_row = on_net ? surface.corners().rows - 1 : static_cast<int>(rows.size()) - 1;
    const int last_column = on_net ? surface.corners().columns - 1 : static_cast<int>(columns.size()) - 1;
    const int south = std::min((block.row + 1) << block.level, last_row);
    const int east = std::min((block.column + 1) << block.level, last_column);
    if (sight.earth == Earth::flat) {
        flat_box({north, south, west, east}, layer, low, high);
        return true;
    }
    low = glm::dvec3(infinite);
    high = glm::dvec3(-infinite);
    for (const int row : {north, south}) {
        for (const int column : {west, east}) {
            for (const double h_m : {layer.lowest_h_m, layer.highest_h_m}) {
                const glm::dvec3 corner = seen(row, column, h_m);
                low = glm::min(low, corner);
                high = glm::max(high, corner);
            }
        }
    }
    // Between its corners a patch bulges by at most an eighth of its angles squared times their radii (along
    // the parallel its own, or near a pole every line would meet every patch); refraction, a parabola, by
    // another eighth.
    const PostGrid& posts = surface.field().grid;
    const double cells = TrueSurface::block_cells;
    const double tall = (south - north) * cells * posts.row_step_rad();
    const double wide = (east - west) * cells * posts.column_step_rad();
    const double radius_m = 1.02 * (wgs84_a_m + std::max(0.0, layer.highest_h_m));
    // The cosine of a latitude changes by at most its angle.
    const double cosine = on_net ? 1.0
                                 : std::min(1.0, std::max(rows[static_cast<std::size_t>(north)].cosine,
                                                          rows[static_cast<std::size_t>(south)].cosine) +
                                                     tall);
    const glm::dvec3 across = high - low;
    const double bulge =
        on_net ? posts.net->bend() * (tall + wide) * (tall + wide) + 2.0 * posts.net->kink() * (tall + wide)
               : tall * tall + wide * wide * cosine;
    const double pad_m = bulge / 8.0 * radius_m * 1.1 +
                         std::abs(sight.refraction.curvature_per_m()) * glm::dot(across, across) / 8.0 +
                         1.0e-3;
    low -= pad_m;
    high += pad_m;
    return true;
}

const Oracle::Scenery::Box& Oracle::Scenery::remembered_box(const TrueSurface::Block& block) const {
    constexpr std::size_t kept = 1024;  // 32 x 32 blocks of a level
    static thread_local std::array<Box, kept> boxes;
    Box& one = boxes[static_cast<std::size_t>((block.row % 32) * 32 + block.column % 32) ^
                     static_cast<std::size_t>(block.level * 77 % 1024)];
    const TrueSurface::Block& its = one.block;
    if (one.scenery != number_ || its.level != block.level || its.row != block.row ||
        its.column != block.column) {
        one.scenery = number_;
        one.block = block;
        one.holds_ground = box(block, one.low, one.high);
    }
    return one;
}

}  // namespace oro
