// A line of sight by brute force: marched in small steps with GeographicLib's places, heights from the posts
// themselves. Shares no code with the oracle.
#pragma once

#include <GeographicLib/Geocentric.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "core/terrain/post_grid.h"
#include "tests/support/cell_rule.h"

namespace oro::test {

struct Point3 {
    double x, y, z;
};

class MarchedLine {
  public:
    // Of degrees and metres above the ellipsoid.
    struct Place {
        double lat_deg, lon_deg, h_m;
    };
    // k: of refraction at this eye, with the Gaussian radius of curvature there.
    MarchedLine(const HeightField& field, const Place& eye, const Place& target, double k)
        : field_(field), eye_(ecef(eye)) {
        constexpr double degree = 3.14159265358979323846 / 180.0, a_m = 6378137.0;
        constexpr double e2 = 0.0066943799901413165;
        const double lat = eye.lat_deg * degree, lon = eye.lon_deg * degree;
        up_ = {std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon), std::sin(lat)};
        const double w2 = 1.0 - e2 * std::sin(lat) * std::sin(lat);
        // sqrt(M N) = a sqrt(1 - e2) / w2
        bend_per_m_ = 0.5 * k * w2 / (a_m * std::sqrt(1.0 - e2));
        const Point3 to = ecef(target);
        seen_ = {to.x - eye_.x, to.y - eye_.y, to.z - eye_.z};
        const double lift_m = bend_per_m_ * across2(seen_);
        seen_ = {seen_.x + lift_m * up_.x, seen_.y + lift_m * up_.y, seen_.z + lift_m * up_.z};
        length_m_ = std::sqrt(seen_.x * seen_.x + seen_.y * seen_.y + seen_.z * seen_.z);
    }

    // Least height of the line over the ground at all the edges of triangles that it crosses, and along the
    // way in between; infinite over no ground. Steps: of a cell.
    [[nodiscard]] double least_clearance_m(double steps_per_cell) const {
        // The narrowest cells that there are.
        const PostGrid& grid = field_.grid;
        const double pole_deg = std::max(std::abs(grid.north_deg()), std::abs(grid.south_deg()));
        const double cosine = std::cos(std::min(pole_deg, 89.9) * 3.14159265358979323846 / 180.0);
        const double cell_m =
            111000.0 * std::min(1.0 / grid.lat.posts_per_deg, cosine / grid.lon.posts_per_deg);
        const int steps = 1 + static_cast<int>(std::ceil(length_m_ / cell_m * steps_per_cell));
        double least_m = std::numeric_limits<double>::infinity();
        Numbers before = numbers(0.0);
        for (int i = 1; i <= steps; ++i) {
            const double from = static_cast<double>(i - 1) / steps, share = static_cast<double>(i) / steps;
            const Place place = at(share);
            const Numbers here = numbers(place);
            if (i < steps) least_m = std::min(least_m, clearance_m(place));
            for (std::size_t axis = 0; axis < 4; ++axis) {
                if (std::floor(before[axis]) != std::floor(here[axis]))
                    least_m = std::min(
                        least_m, clearance_m(crossing(axis, {from, before[axis]}, {share, here[axis]})));
            }
            before = here;
        }
        return least_m;
    }

  private:
    using Numbers = std::array<double, 4>;  // row, column, their difference and sum

    static const GeographicLib::Geocentric& earth() { return GeographicLib::Geocentric::WGS84(); }
    static Point3 ecef(const Place& place) {
        Point3 at{};
        earth().Forward(place.lat_deg, place.lon_deg, place.h_m, at.x, at.y, at.z);
        return at;
    }
    [[nodiscard]] double across2(const Point3& p) const {
        const double along = p.x * up_.x + p.y * up_.y + p.z * up_.z;
        return p.x * p.x + p.y * p.y + p.z * p.z - along * along;
    }
    [[nodiscard]] Place at(double share) const {
        const Point3 p{share * seen_.x, share * seen_.y, share * seen_.z};
        const double lift_m = bend_per_m_ * across2(p);
        Place place{};
        earth().Reverse(eye_.x + p.x - lift_m * up_.x, eye_.y + p.y - lift_m * up_.y,
                        eye_.z + p.z - lift_m * up_.z, place.lat_deg, place.lon_deg, place.h_m);
        return place;
    }
    [[nodiscard]] Numbers numbers(const Place& place) const {
        const PostGrid& grid = field_.grid;
        const double row = (grid.lat.at_deg(0) - place.lat_deg) * grid.lat.posts_per_deg;
        // East of the first column, by less than a turn where the place is in the grid.
        double east_deg = std::remainder(place.lon_deg - grid.lon.at_deg(0), 360.0);
        const double width_deg = (grid.columns() - 1) / grid.lon.posts_per_deg;
        if (east_deg < -1e-9 && width_deg > 180.0) east_deg += 360.0;
        const double column = east_deg * grid.lon.posts_per_deg;
        return {row, column, row - column, row + column};
    }
    [[nodiscard]] Numbers numbers(double share) const { return numbers(at(share)); }
    // A share of the way, and one of the numbers there.
    struct Mark {
        double share, number;
    };
    // Where one of the numbers passes a whole one: on its far side by less than 1e-12 of the way. Between two
    // marks a number all but runs along a straight line, so where that passes is asked, and a little to
    // either side; halving needs 40 places.
    [[nodiscard]] double crossing(std::size_t axis, Mark low, Mark high) const {
        constexpr double exact = 1.0e-12, offset = 4.0e-13;
        const double first = std::floor(low.number);
        const double whole = high.number > low.number ? first + 1.0 : first;
        for (int i = 0; i < 60 && high.share - low.share > exact; ++i) {
            const double straight =
                low.share + (high.share - low.share) * (whole - low.number) / (high.number - low.number);
            double next = 0.5 * (low.share + high.share);
            if (i % 4 == 0) next = straight;
            if (i % 4 == 1) next = straight - offset;
            if (i % 4 == 2) next = straight + offset;
            if (!(next > low.share && next < high.share)) next = 0.5 * (low.share + high.share);
            const Mark middle{next, numbers(next)[axis]};
            (std::floor(middle.number) == first ? low : high) = middle;
        }
        return high.share;
    }

  public:
    // Height of the line over the ground at a share of its length; infinite over none.
    [[nodiscard]] double clearance_m(double share) const { return clearance_m(at(share)); }
    [[nodiscard]] double clearance_m(const Place& place) const {
        const auto ground_m = ground_h_m(place);
        return ground_m ? place.h_m - *ground_m : std::numeric_limits<double>::infinity();
    }
    // The surface's definition, once more: two triangles a cell.
    [[nodiscard]] std::optional<double> ground_h_m(const Place& place) const {
        const PostGrid& grid = field_.grid;
        const Numbers number = numbers(place);
        constexpr double slack = 1.0e-6;
        if (number[0] < -slack || number[0] > grid.rows() - 1 + slack) return std::nullopt;
        if (number[1] < -slack || number[1] > grid.columns() - 1 + slack) return std::nullopt;
        const int row = std::clamp(static_cast<int>(std::floor(number[0])), 0, grid.rows() - 2);
        const int column = std::clamp(static_cast<int>(std::floor(number[1])), 0, grid.columns() - 2);
        const double down = number[0] - row, right = number[1] - column;
        const auto post = [&](int r, int c) -> std::optional<double> {
            if (is_void(field_.H_at_post_m(r, c))) return std::nullopt;
            return field_.h_at_post_m(r, c);
        };
        const auto a = post(row, column), d = post(row + 1, column + 1);
        if (sw_ne_by_rule(field_, row, column)) {
            const auto b = post(row, column + 1), c = post(row + 1, column);
            return down + right <= 1.0 ? *a + down * (*c - *a) + right * (*b - *a)
                                       : *d + (1.0 - down) * (*b - *d) + (1.0 - right) * (*c - *d);
        }
        const auto other = down >= right ? post(row + 1, column) : post(row, column + 1);
        if (!a || !d || !other) return std::nullopt;
        return down >= right ? *a + down * (*other - *a) + right * (*d - *other)
                             : *a + right * (*other - *a) + down * (*d - *other);
    }

  private:
    const HeightField& field_;
    Point3 eye_;
    Point3 up_{};
    Point3 seen_{};
    double bend_per_m_{};
    double length_m_{};
};

}  // namespace oro::test
