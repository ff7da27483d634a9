#include "core/sight/swept_posts.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/wide.h"

namespace oro {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double least_slope = 1.0e-3;
constexpr int steps_of_newton = 4;

struct Sector {
    double ranges, first, count;
};
struct Directions {
    const double *x, *y, *distance_m;
};

// As azimuth_number(), and which ranges of the sector the edges of a post reach at most.
ORO_WIDE void find_ranges(const Directions& posts, std::size_t size, const Sector& sector,
                          double longest_edge_m, std::int32_t* range, std::int32_t* first_range,
                          std::int32_t* last_range) {
    const double scale = 0.25 * sector.ranges, last = sector.count - 1.0;
    const double elsewhere = 0.5 * (sector.ranges - sector.count);
    for (std::size_t i = 0; i < size; ++i) {
        const double x = posts.x[i], y = posts.y[i];
        const double sum = std::abs(x) + std::abs(y);
        const double share = sum > 0.0 ? y / sum : 0.0;
        const double eastern = share < 0.0 ? 4.0 + share : share;
        const double number = x < 0.0 ? 2.0 - share : eastern;
        range[i] = static_cast<std::int32_t>(number * 0.25 * sector.ranges) -
                   static_cast<std::int32_t>(sector.first);
        const double distance_m = posts.distance_m[i] > 1.0e-9 ? posts.distance_m[i] : 1.0e-9;
        const double sine = longest_edge_m / distance_m;
        const double reach = sine < 0.25 ? 1.05 * sine : 4.0 * sine;
        double place = number * scale - sector.first;
        // Of a neighbouring sector's posts on the other side of east.
        place = place - sector.count > elsewhere ? place - sector.ranges : place;
        place = -place > elsewhere ? place + sector.ranges : place;
        const double before = place - reach * scale, after = place + reach * scale;
        // Rounded down; what lies below 0 is no range of the sector.
        first_range[i] = static_cast<std::int32_t>(before > 0.0 ? before : 0.0);
        const double reached = after < last ? after : last;
        last_range[i] = static_cast<std::int32_t>(reached < 0.0 ? -1.0 : reached);
    }
}

// Between two posts an edge is seen higher by the square of the angle, and by what it bulges. It turns little
// as seen from four times its length.
ORO_WIDE void bound_tangents_of(const EyePlane::TangentBound& bound, const double* distance_m,
                                std::size_t size, double* most_tangent) {
    for (std::size_t i = 0; i < size; ++i) {
        const double nearest_m = distance_m[i] - bound.around_m, most = most_tangent[i];
        const double across = bound.longest_edge_m / nearest_m;
        const double bounded = most + std::abs(most) * across * across + 3.0 * bound.error_m / nearest_m;
        most_tangent[i] = nearest_m > 4.0 * bound.longest_edge_m ? bounded : infinite;
    }
}

ORO_WIDE void turn_normals(const Directions& posts, std::size_t size, const double* up_x, const double* up_y,
                           double* up_s, double* aside) {
    for (std::size_t i = 0; i < size; ++i) {
        up_s[i] = (up_x[i] * posts.x[i] + up_y[i] * posts.y[i]) / posts.distance_m[i];
        aside[i] = std::abs(up_x[i] * posts.y[i] - up_y[i] * posts.x[i]) / posts.distance_m[i];
    }
}

ORO_WIDE void find_heights(const double* ground_z_m, const double* s_m, const double* up_s,
                           const double* up_z, const double* tangent, std::size_t size, double bend,
                           double* needed_m) {
    for (std::size_t i = 0; i < size; ++i) {
        double t_m = 0.0, flattest = infinite;
        for (int step = 0; step < steps_of_newton; ++step) {
            const double there_m = s_m[i] + t_m * up_s[i];
            const double slope = up_z[i] + (2.0 * bend * there_m - tangent[i]) * up_s[i];
            // No number is no slope, either.
            flattest = slope > flattest ? flattest : slope;
            t_m -= (ground_z_m[i] + t_m * up_z[i] + bend * there_m * there_m - tangent[i] * there_m) / slope;
        }
        needed_m[i] = flattest > least_slope ? t_m : infinite;
    }
}

ORO_WIDE int count_not_above(const double* numbers, int count, double tangent) {
    int found = 0;
    for (int i = 0; i < count; ++i) found += tangent < numbers[i] ? 0 : 1;
    return found;
}

}  // namespace

void SweptPosts::add(std::int64_t number, const glm::dvec3& up) {
    if (size_ == x_.size()) {
        const std::size_t more = std::max<std::size_t>(64, 2 * size_);
        for (std::vector<double>* const all :
             {&x_, &y_, &distance_m_, &up_x_, &up_y_, &up_z_, &most_tangent_, &up_s_, &aside_})
            all->resize(more);
        for (std::vector<std::int32_t>* const all : {&range_, &first_range_, &last_range_}) all->resize(more);
    }
    const PlanePost& post = plane_.post(number);
    x_[size_] = post.x;
    y_[size_] = post.y;
    distance_m_[size_] = post.distance_m;
    up_x_[size_] = up.x;
    up_y_[size_] = up.y;
    up_z_[size_] = up.z;
    most_tangent_[size_] = plane_.most_tangent_of_box(number);
    ++size_;
}

void SweptPosts::measure() {
    const Directions posts{x_.data(), y_.data(), distance_m_.data()};
    find_ranges(posts, size_,
                {static_cast<double>(ranges_), static_cast<double>(first_), static_cast<double>(count_)},
                plane_.longest_edge_m(), range_.data(), first_range_.data(), last_range_.data());
    bound_tangents_of(plane_.tangent_bound(), distance_m_.data(), size_, most_tangent_.data());
    turn_normals(posts, size_, up_x_.data(), up_y_.data(), up_s_.data(), aside_.data());
}

void HiddenTargets::write(double bend_per_m, std::vector<float>& deficits_m) {
    const std::size_t size = targets_.size();
    if (numbers_.size() < 6 * size) numbers_.resize(8 * size);
    double* const ground_z_m = numbers_.data();
    double* const s_m = ground_z_m + size;
    double* const up_s = s_m + size;
    double* const up_z = up_s + size;
    double* const tangent = up_z + size;
    double* const needed_m = tangent + size;
    for (std::size_t i = 0; i < size; ++i) {
        const Target& target = targets_[i];
        ground_z_m[i] = target.ground_z_m;
        s_m[i] = target.s_m;
        up_s[i] = target.up_s;
        up_z[i] = target.up_z;
        tangent[i] = target.tangent;
    }
    find_heights(ground_z_m, s_m, up_s, up_z, tangent, size, bend_per_m, needed_m);
    for (std::size_t i = 0; i < size; ++i) {
        const auto missed_m = static_cast<float>(needed_m[i] - targets_[i].target_m);
        deficits_m[targets_[i].cell] =
            targets_[i].further_m > 0.0 ? missed_m + static_cast<float>(targets_[i].further_m) : missed_m;
    }
}

double needed_height_m(double ground_z_m, double s_m, double up_s, double up_z, double bend_per_m,
                       double tangent) {
    double t_m = 0.0;
    for (int step = 0; step < steps_of_newton; ++step) {
        const double there_m = s_m + t_m * up_s;
        const double slope = up_z + (2.0 * bend_per_m * there_m - tangent) * up_s;
        if (!(slope > least_slope)) return infinite;
        t_m -= (ground_z_m + t_m * up_z + bend_per_m * there_m * there_m - tangent * there_m) / slope;
    }
    return t_m;
}

bool are_all_above(const double* numbers, int count, double tangent) {
    constexpr int few = 4, at_once = 32;
    // Most ground that shows fails at once.
    for (int i = 0; i < std::min(few, count); ++i)
        if (!(tangent < numbers[i])) return false;
    for (int i = few; i < count; i += at_once)
        if (count_not_above(numbers + i, std::min(at_once, count - i), tangent) > 0) return false;
    return true;
}

}  // namespace oro
