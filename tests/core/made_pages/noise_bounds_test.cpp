// Must hold: the bounds of the noise of an octave that errors of made levels are proven with. By interval
// arithmetic over all places of a cell and all directions, for the worst slopes at its corners.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "core/made_pages/level_bounds.h"

namespace oro {
namespace {

// Numbers between two ends; ends are moved outwards by more than they are rounded.
struct Interval {
    double low, high;
    Interval(double at) : low(at), high(at) {}  // NOLINT: a number is one
    Interval(double a, double b) : low(a), high(b) {}
};
Interval widened(double low, double high) {
    constexpr double rounding = 1e-13;
    return {low - rounding, high + rounding};
}
Interval operator+(const Interval& a, const Interval& b) {
    return widened(a.low + b.low, a.high + b.high);
}
Interval operator-(const Interval& a, const Interval& b) {
    return widened(a.low - b.high, a.high - b.low);
}
Interval operator*(const Interval& a, const Interval& b) {
    const auto [low, high] = std::minmax({a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high});
    return widened(low, high);
}
double most_of(const Interval& a) {
    return std::max(std::abs(a.low), std::abs(a.high));
}

// The fade, its first and its second derivative over an interval of [0, 1]: by their values at its ends and
// at their turning points.
double fade(int derivative, double t) {
    if (derivative == 0) return t * t * t * (10.0 + t * (-15.0 + 6.0 * t));
    if (derivative == 1) return 30.0 * t * t * (1.0 - t) * (1.0 - t);
    return 60.0 * t * (1.0 - t) * (1.0 - 2.0 * t);
}
Interval fade_over(int derivative, const Interval& t) {
    static const std::array<std::vector<double>, 3> turns{
        std::vector<double>{}, {0.5}, {0.5 - std::sqrt(3.0) / 6.0, 0.5 + std::sqrt(3.0) / 6.0}};
    double low = std::min(fade(derivative, t.low), fade(derivative, t.high));
    double high = std::max(fade(derivative, t.low), fade(derivative, t.high));
    for (const double turn : turns[static_cast<std::size_t>(derivative)])
        if (turn > t.low && turn < t.high) {
            low = std::min(low, fade(derivative, turn));
            high = std::max(high, fade(derivative, turn));
        }
    return widened(low, high);
}

using Box = std::array<Interval, 5>;  // a place of a cell; a direction by two of its parts
using Three = std::array<Interval, 3>;

// What a corner's slope adds at most: it lies along an edge of a cube, so two of its three parts are 1 or -1.
double most_by_a_corner(const Three& of) {
    std::array<double, 3> parts{most_of(of[0]), most_of(of[1]), most_of(of[2])};
    std::ranges::sort(parts);
    return parts[1] + parts[2];
}

// At most what the noise (order 0), its slope along a direction (1) and its bend along it (2) are over a box
// of places. The direction is not of unit length: its largest part is 1, and the answer is for that length.
double most_over(int order, const Three& place, const Three& along) {
    double sum = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        std::array<std::array<Interval, 3>, 3> weight{Three{0.0, 0.0, 0.0}, Three{0.0, 0.0, 0.0},
                                                      Three{0.0, 0.0, 0.0}};
        Three from{0.0, 0.0, 0.0};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const bool far = (corner >> axis & 1) != 0;
            from[axis] = place[axis] - Interval(far ? 1.0 : 0.0);
            for (std::size_t derivative = 0; derivative < 3; ++derivative) {
                const Interval of = fade_over(static_cast<int>(derivative), place[axis]);
                weight[derivative][axis] = far ? of : Interval(derivative == 0 ? 1.0 : 0.0) - of;
            }
        }
        const auto product = [&](std::size_t x, std::size_t y, std::size_t z) {
            return weight[x][0] * weight[y][1] * weight[z][2];
        };
        const Interval whole = product(0, 0, 0);
        const Interval slope =
            product(1, 0, 0) * along[0] + product(0, 1, 0) * along[1] + product(0, 0, 1) * along[2];
        const Interval two(2.0);
        const Interval bend =
            product(2, 0, 0) * along[0] * along[0] + product(0, 2, 0) * along[1] * along[1] +
            product(0, 0, 2) * along[2] * along[2] +
            two * (product(1, 1, 0) * along[0] * along[1] + product(1, 0, 1) * along[0] * along[2] +
                   product(0, 1, 1) * along[1] * along[2]);
        Three of{0.0, 0.0, 0.0};
        for (std::size_t axis = 0; axis < 3; ++axis)
            of[axis] = order == 0   ? whole * from[axis]
                       : order == 1 ? slope * from[axis] + whole * along[axis]
                                    : bend * from[axis] + two * slope * along[axis];
        sum += most_by_a_corner(of);
    }
    return sum;
}

// Whether a bound holds over a box, for directions whose part along an axis is 1 and the others are the box's
// last two. They are at least so long that `length` is theirs.
bool holds_over(int order, double bound, const Box& box, std::size_t largest) {
    Three along{1.0, 1.0, 1.0};
    along[(largest + 1) % 3] = box[3];
    along[(largest + 2) % 3] = box[4];
    const auto least_square = [](const Interval& part) {
        return part.low <= 0.0 && part.high >= 0.0 ? 0.0
                                                   : std::min(part.low * part.low, part.high * part.high);
    };
    const double square = 1.0 + least_square(box[3]) + least_square(box[4]);
    const double length = order == 0 ? 1.0 : (order == 1 ? std::sqrt(square) : square);
    return most_over(order, {box[0], box[1], box[2]}, along) <= bound * length;
}

// Boxes over which it does not hold are halved along their widest side, until all hold, or there are too
// many. By symmetry half a cell along each axis is enough, one direction of each two that are opposite, and
// one axis for the direction's largest part.
bool is_bound(int order, double bound, std::size_t most_boxes, std::size_t& boxes) {
    const Interval half(0.0, 0.5), none(0.0), all(-1.0, 1.0);
    std::vector<Box> open{{half, half, half, order == 0 ? none : all, order == 0 ? none : all}};
    while (!open.empty()) {
        const Box box = open.back();
        open.pop_back();
        if (++boxes > most_boxes) return false;
        if (holds_over(order, bound, box, 0)) continue;
        std::size_t widest = 0;
        for (std::size_t i = 1; i < box.size(); ++i)
            if (box[i].high - box[i].low > (box[widest].high - box[widest].low) * (i > 2 ? 2.0 : 1.0))
                widest = i;
        Box first = box, second = box;
        first[widest].high = second[widest].low = 0.5 * (box[widest].low + box[widest].high);
        open.push_back(first);
        open.push_back(second);
    }
    return true;
}

TEST(NoiseBounds, AreProvenByIntervals) {
    for (const auto& [order, bound] :
         {std::pair{0, noise_most}, {1, noise_slope_most}, {2, noise_bend_most}}) {
        std::size_t boxes = 0;
        EXPECT_TRUE(is_bound(order, bound, 10'000'000, boxes)) << "order " << order;
        std::printf("order %d: at most %g, by %zu boxes\n", order, bound, boxes);
    }
}
// The bounds are not far above what there is: sampling finds 1.036, 3.75 and 14.47.
TEST(NoiseBounds, AreNearWhatThereIs) {
    std::size_t boxes = 0;
    EXPECT_FALSE(is_bound(0, 1.03, 300'000, boxes));
    boxes = 0;
    EXPECT_FALSE(is_bound(1, 3.7, 300'000, boxes));
}

// Terms of `ridged` by the noise of their own octave and of the one before, each anything that it can be:
// what is most is found within a thousandth.
TEST(NoiseBounds, OfRidgedFollowFromThoseOfNoise) {
    double lowest = 0.0, highest = 0.0, steepest = 0.0;
    constexpr int steps = 1000;
    for (int i = 0; i <= steps; ++i)
        for (int j = 0; j <= steps; ++j) {
            const double crest = std::max(0.0, 1.0 - noise_most * i / steps),
                         before = std::max(0.0, 1.0 - noise_most * j / steps);
            const double square = crest * crest, weight = 0.35 + 0.65 * before * before;
            lowest = std::min(lowest, weight * (square - 0.66));
            highest = std::max(highest, weight * (square - 0.66));
            steepest = std::max(steepest,
                                weight * 2.0 * crest * noise_slope_most +
                                    0.65 * 2.0 * before * 0.5 * noise_slope_most * std::abs(square - 0.66));
        }
    EXPECT_LE(std::max(-lowest, highest), ridged_reach_most);
    EXPECT_GT(std::max(-lowest, highest), 0.999 * ridged_reach_most);
    EXPECT_LE(highest - lowest, ridged_spread_most);
    EXPECT_GT(highest - lowest, 0.999 * ridged_spread_most);
    EXPECT_LE(steepest, ridged_slope_most);
    EXPECT_GT(steepest, 0.998 * ridged_slope_most);
}

}  // namespace
}  // namespace oro
