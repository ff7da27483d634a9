#include "core/measure/shown_place.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "core/measure/drawn_point.h"

namespace oro {

PostPlace place_of(const DrawnPoint& point, const TrueGround& ground, const Sight& sight,
                   const Camera& camera, glm::dvec2 point_px) {
    if (point.grid < ground.grids()) {
        const PostPlace at = ground.surface(point.grid).field().grid.place_at(point.row, point.column);
        return {at.lat_deg, normalised_lon_deg(at.lon_deg)};
    }
    const glm::dvec2 tangent = camera.half_fov_tangent();
    const glm::dvec3 ray((2.0 * point_px.x / camera.width_px - 1.0) * tangent.x,
                         (1.0 - 2.0 * point_px.y / camera.height_px) * tangent.y, -1.0);
    const glm::dvec3 offset_m =
        sight.refraction.true_m(glm::transpose(camera.view_from_ecef()) * (point.z_m * ray));
    const Geodetic there = sight.earth == Earth::ellipsoid
                               ? geodetic_from_ecef({sight.eye.m + offset_m})
                               : model_point(sight.earth, sight.place, offset_m).value_or(Geodetic{});
    return {there.lat_deg, there.lon_deg};
}

// A triangle's heights, linear in rows and columns: as the true surface has them.
struct ShownPlaces::Plane {
    std::size_t grid;
    std::array<double, 3> row, column;
    double h_m, down_m, right_m;  // at its first corner, and the change for a row and for a column
    double twice_area;

    [[nodiscard]] double h_at_m(double at_row, double at_column) const {
        return h_m + down_m * (at_row - row[0]) + right_m * (at_column - column[0]);
    }
    // The least of a place's three shares of the corners: below 0 outside.
    [[nodiscard]] double least_share(double at_row, double at_column) const {
        double least = 1.0;
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
            const double across =
                (row[k] - row[j]) * (at_column - column[j]) - (column[k] - column[j]) * (at_row - row[j]);
            least = std::min(least, across / twice_area);
        }
        return least;
    }
};

ShownPlaces::ShownPlaces(const TrueGround& ground, const Camera& camera, const WorldModel& model,
                         bool full_resolution)
    : ground_(ground),
      camera_(camera),
      sight_(sight_of(model, camera.eye)),
      ecef_from_view_(glm::transpose(camera.view_from_ecef())),
      tangent_(camera.half_fov_tangent()) {
    if (full_resolution) oracle_.emplace(ground_, sight_);
}

ShownPlaces::Plane ShownPlaces::plane_of(const ShownTriangle& shown) const {
    const gpu::DrawnTriangle& triangle = shown.triangle;
    const TrueSurface& surface = ground_.surface(shown.grid);
    Plane plane{};
    plane.grid = shown.grid;
    std::array<double, 3> h_m{};
    for (std::size_t i = 0; i < 3; ++i) {
        plane.row[i] = triangle.rows[i];
        plane.column[i] = triangle.columns[i];
        // Without the steps that heights are drawn in.
        h_m[i] = surface.post_h_m(static_cast<int>(triangle.rows[i]), static_cast<int>(triangle.columns[i]))
                     .value_or(static_cast<double>(triangle.h_m[i]));
    }
    const double row_1 = plane.row[1] - plane.row[0], row_2 = plane.row[2] - plane.row[0];
    const double column_1 = plane.column[1] - plane.column[0], column_2 = plane.column[2] - plane.column[0];
    plane.twice_area = row_1 * column_2 - row_2 * column_1;
    plane.h_m = h_m[0];
    if (plane.twice_area == 0.0) return plane;
    const double rise_1 = h_m[1] - h_m[0], rise_2 = h_m[2] - h_m[0];
    plane.down_m = (rise_1 * column_2 - rise_2 * column_1) / plane.twice_area;
    plane.right_m = (row_1 * rise_2 - row_2 * rise_1) / plane.twice_area;
    return plane;
}

Geodetic ShownPlaces::point_at(const glm::dvec3& direction, double distance_m) const {
    const glm::dvec3 offset_m = sight_.refraction.true_m(distance_m * direction);
    return sight_.earth == Earth::ellipsoid
               ? geodetic_from_ecef({sight_.eye.m + offset_m})
               : model_point(sight_.earth, sight_.place, offset_m).value_or(Geodetic{});
}

ShownPlace ShownPlaces::place_at(const glm::dvec3& direction, double distance_m, std::size_t grid,
                                 double near_column) const {
    const Geodetic point = point_at(direction, distance_m);
    const PostGrid& posts = ground_.surface(grid).field().grid;
    if (posts.net) {
        const PostNumber post = posts.net->post_at(point.lat_deg, point.lon_deg);
        return {point, post.row, post.column, distance_m, grid};
    }
    const GridAxis& lon = posts.lon;
    const double turn = 360.0 * lon.posts_per_deg;
    double column = lon.index_at(point.lon_deg);
    column -= turn * std::round((column - near_column) / turn);
    return {point, posts.lat.index_at(point.lat_deg), column, distance_m, grid};
}

// Of no grid's posts: its place alone tells where it is.
ShownPlace ShownPlaces::between_grids(const glm::dvec3& direction, double distance_m) const {
    ShownPlace place;
    place.point = point_at(direction, distance_m);
    place.grid = ground_.grid_at(place.point.lat_deg, place.point.lon_deg).value_or(0);
    const PostNumber post =
        ground_.surface(place.grid).field().grid.post_at(place.point.lat_deg, place.point.lon_deg);
    place.row = post.row;
    place.column = post.column;
    place.distance_m = distance_m;
    return place;
}

// By secants from where float32 has it; nothing where the ray and the triangle are all but parallel.
std::optional<ShownPlace> ShownPlaces::met(const Plane& plane, const glm::dvec3& direction,
                                           double about_m) const {
    if (plane.twice_area == 0.0) return std::nullopt;
    const auto above_m = [&](const ShownPlace& place) {
        return place.point.h_m - plane.h_at_m(place.row, place.column);
    };
    ShownPlace last = place_at(direction, about_m, plane.grid, plane.column[0]);
    double last_m = above_m(last);
    ShownPlace here =
        place_at(direction, about_m + std::max(0.01, 1.0e-6 * about_m), plane.grid, plane.column[0]);
    double here_m = above_m(here);
    const double exact_m = 2.0e-9 + 4.0e-16 * about_m;
    for (int step = 0; step < 12 && std::abs(here_m) > exact_m; ++step) {
        if (here_m == last_m) return std::nullopt;
        const double next_at_m =
            here.distance_m - here_m * (here.distance_m - last.distance_m) / (here_m - last_m);
        if (!(next_at_m > 0.0 && next_at_m < 4.0 * about_m)) return std::nullopt;
        last = here;
        last_m = here_m;
        here = place_at(direction, next_at_m, plane.grid, plane.column[0]);
        here_m = above_m(here);
    }
    constexpr double residual_m = 1.0e-6;
    return std::abs(here_m) <= residual_m ? std::optional(here) : std::nullopt;
}

std::optional<ShownPlace> ShownPlaces::met_truly(const glm::dvec3& direction) const {
    if (!oracle_) return std::nullopt;
    const auto hit = oracle_->first_hit(direction, sight_reach_m(camera_.eye.h_m));
    if (!hit) return std::nullopt;
    if (hit->between_grids) return between_grids(direction, hit->distance_m);
    return place_at(direction, hit->distance_m, hit->grid, hit->column);
}

ShownPlace ShownPlaces::on_rim(const DrawnPoint& drawn) const {
    ShownPlace place;
    const PostPlace at = ground_.surface(drawn.grid).field().grid.place_at(drawn.row, drawn.column);
    place.point = {at.lat_deg, normalised_lon_deg(at.lon_deg), drawn.h_m};
    place.row = drawn.row;
    place.column = drawn.column;
    place.grid = drawn.grid;
    const glm::dvec3 offset_m = model_offset_m(sight_.earth, camera_.eye, place.point);
    place.distance_m = glm::length(sight_.refraction.apparent_m(offset_m));
    return place;
}

std::optional<ShownPlace> ShownPlaces::at(const ShownTriangle& shown, glm::dvec2 point_px) const {
    const glm::dvec3 ray((2.0 * point_px.x / camera_.width_px - 1.0) * tangent_.x,
                         (1.0 - 2.0 * point_px.y / camera_.height_px) * tangent_.y, -1.0);
    const DrawnPoint drawn = drawn_point(shown, ray);
    if (drawn.background()) return std::nullopt;
    const double longer = glm::length(ray);
    const glm::dvec3 direction = ecef_from_view_ * (ray / longer);
    if (shown.grid >= ground_.grids()) {
        const double about_m = drawn.z_m * longer;
        const auto truly = met_truly(direction);
        // What float32 leaves, and twice that: else the ray passes beside the step.
        constexpr double near_m = 0.01, near_share = 1.0e-6;
        if (truly && std::abs(truly->distance_m - about_m) < near_m + near_share * about_m) return truly;
        ++missed_;
        return truly ? truly : between_grids(direction, about_m);
    }
    const Plane plane = plane_of(shown);
    const auto on_plane = met(plane, direction, drawn.z_m * longer);
    // What rounding of rows and columns leaves; a little outside, no place of the neighbour is nearer.
    constexpr double rounded = -1.0e-9, too_far = -0.05;
    const double least = on_plane ? plane.least_share(on_plane->row, on_plane->column) : -1.0;
    if (least >= rounded) return on_plane;
    ++missed_;
    if (const auto truly = met_truly(direction)) return truly;
    if (least >= too_far) return on_plane;
    return on_rim(drawn);
}

}  // namespace oro
