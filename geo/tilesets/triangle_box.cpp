#include "geo/tilesets/triangle_box.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "core/earth/ellipsoid.h"

namespace oro {
namespace {

// Let P lie in a triangle with the corners A_i, so that P is the sum of w_i A_i. For any point X the sum of
// w_i |A_i - X|^2 is |P - X|^2 + s, where s is the sum of w_i |A_i - P|^2. With the centre of the smallest
// circle around the triangle for X, s is at most the square of that circle's radius. (Half the longest side
// alone would not do: the middle of an equilateral triangle lies deeper by a third.)

constexpr double margin_m = 0.01;
// Radii of curvature are smallest along the meridian at the equator, and largest at a pole.
constexpr double smallest_radius_m = wgs84_b_m * wgs84_b_m / wgs84_a_m;
constexpr double largest_radius_of_normals_m = wgs84_a_m * wgs84_a_m / wgs84_b_m;

// How far below the lowest of their corners triangles may reach. What lies below that height above the
// ellipsoid is convex, and the radii of curvature of its surface are at least R, smallest_radius_m and that
// height. So a ball of radius R that touches this surface from within, where it is nearest to P, lies below
// it (W. Blaschke, Kreis und Kugel, 1916). No corner is within the ball. With its centre for X, |P - X|^2 is
// at least R^2 - s, and P is R - |P - X| below the surface.
double sag_m(double radius_m, double lowest_h_m) {
    const double of_ball_m = smallest_radius_m + lowest_h_m;
    const double square_m2 = radius_m * radius_m;
    return square_m2 / (of_ball_m + std::sqrt(of_ball_m * of_ball_m - square_m2));
}

// The latitude that no point of triangles lies beyond; lat_deg: that no corner lies beyond. Both are counted
// towards one pole. All normals of one latitude meet in a point Z of the axis, and what lies beyond it is a
// cone with its tip there. Where the latitude is on the far side of the equator, the rest of space is such a
// cone, which is convex: with its corners a triangle is in it. Else let Z be X, and the corners be D from it
// at least. The sines of the angles that lines from Z make with the plane of the equator are then at most
// sin(lat) / sqrt(1 - s / D^2). Normals of the latitude that is sought meet in another point than Z, which
// adds less than 0.9% of the way.
double farthest_lat_deg(double lat_deg, double radius_m, double lowest_h_m) {
    if (lat_deg <= 0.0) return lat_deg;
    constexpr double farthest_from_centre_m = wgs84_e2 * largest_radius_of_normals_m, of_other_point = 1.01;
    const double nearest_m = wgs84_b_m + lowest_h_m - farthest_from_centre_m;
    const SineCosine lat = sine_cosine_deg(lat_deg);
    const double square = lat.cosine * lat.cosine - radius_m * radius_m / (nearest_m * nearest_m);
    if (square <= 0.0) return 90.0;
    const double angle_deg = deg_from_radians(Radians{std::atan2(lat.sine, std::sqrt(square))});
    return std::min(90.0, lat_deg + of_other_point * std::max(0.0, angle_deg - lat_deg));
}

}  // namespace

double enclosing_radius_m(const std::array<glm::dvec3, 3>& corners_m) {
    const glm::dvec3 ab = corners_m[1] - corners_m[0], ac = corners_m[2] - corners_m[0], bc = ac - ab;
    const double sum_m2 = glm::dot(ab, ab) + glm::dot(ac, ac) + glm::dot(bc, bc);
    const double longest_m2 = std::max({glm::dot(ab, ab), glm::dot(ac, ac), glm::dot(bc, bc)});
    if (2.0 * longest_m2 >= sum_m2) return 0.5 * std::sqrt(longest_m2);
    return glm::length(ab) * glm::length(ac) * glm::length(bc) / (2.0 * glm::length(glm::cross(ab, ac)));
}

void TriangleBox::add_corner(const glm::dvec3& at_m) {
    const Geodetic at = geodetic_from_ecef({at_m});
    const double lon_deg = middle_lon_deg_ + std::remainder(at.lon_deg - middle_lon_deg_, 360.0);
    corners_ = {std::min(corners_.west_deg, lon_deg),  std::min(corners_.south_deg, at.lat_deg),
                std::max(corners_.east_deg, lon_deg),  std::max(corners_.north_deg, at.lat_deg),
                std::min(corners_.lowest_h_m, at.h_m), std::max(corners_.highest_h_m, at.h_m)};
    nearest_axis_m_ = std::min(nearest_axis_m_, std::hypot(at_m.x, at_m.y));
}

void TriangleBox::add_triangle(const std::array<glm::dvec3, 3>& corners_m) {
    widest_m_ = std::max(widest_m_, enclosing_radius_m(corners_m));
}

TileBox TriangleBox::box() const {
    TileBox box = corners_;
    // What lies below a height above the ellipsoid is convex.
    box.highest_h_m += margin_m;
    const TileBox earth{-180.0, -90.0, 180.0, 90.0, -wgs84_b_m, box.highest_h_m};
    if (widest_m_ > 0.5 * (smallest_radius_m + corners_.lowest_h_m)) return earth;
    box.lowest_h_m -= sag_m(widest_m_, corners_.lowest_h_m) + margin_m;
    const double margin_deg = deg_from_radians(Radians{margin_m / (0.99 * smallest_radius_m)});
    const auto beyond = [&](double lat_deg) {
        return std::min(90.0, farthest_lat_deg(lat_deg, widest_m_, corners_.lowest_h_m) + margin_deg);
    };
    box.north_deg = beyond(corners_.north_deg);
    box.south_deg = -beyond(-corners_.south_deg);
    // What lies between two meridians less than half a turn apart is convex.
    constexpr double half_turn_deg = 180.0, doubt_deg = 1.0e-6;
    const double margin_lon = margin_m / std::max(nearest_axis_m_, margin_m);
    if (box.east_deg - box.west_deg > half_turn_deg - doubt_deg || margin_lon > 0.5) {
        box.west_deg = earth.west_deg, box.east_deg = earth.east_deg;
        return box;
    }
    box.west_deg -= deg_from_radians(Radians{margin_lon});
    box.east_deg += deg_from_radians(Radians{margin_lon});
    return box;
}

TileBox box_of(const GroundMesh& mesh) {
    std::vector<glm::dvec3> corners_m;
    corners_m.reserve(mesh.positions.size());
    TriangleBox box(geodetic_from_ecef({mesh.centre_m}).lon_deg);
    for (const glm::ivec3& position : mesh.positions) {
        corners_m.push_back(mesh.centre_m + mesh.ecef_from_mesh * (mesh.step_m * glm::dvec3(position)));
        box.add_corner(corners_m.back());
    }
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
        box.add_triangle(
            {corners_m[mesh.indices[i]], corners_m[mesh.indices[i + 1]], corners_m[mesh.indices[i + 2]]});
    return box.box();
}

}  // namespace oro
