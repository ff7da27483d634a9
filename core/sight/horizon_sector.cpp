#include "core/sight/horizon_sector.h"

#include <algorithm>
#include <cmath>

namespace oro {
namespace {

// The direction of an azimuth's number, of length 1.
PlanePost direction_of(double number) {
    number = std::fmod(number, 4.0);
    const double x = number < 2.0 ? 1.0 - number : number - 3.0;
    const double y = number < 1.0 ? number : number < 3.0 ? 2.0 - number : number - 4.0;
    const double length = std::hypot(x, y);
    return {x / length, y / length, 0.0, 1.0, 0.0};
}

}  // namespace

HorizonSector::HorizonSector(const EyePlane& plane, int ranges, int first, int count)
    : plane_(plane),
      ranges_(ranges),
      first_(first),
      own_(static_cast<std::size_t>(count)),
      lowest_(static_cast<std::size_t>(count), Horizon::none) {
    for (int i = 0; i <= count; ++i) borders_.push_back(direction_of(4.0 * (first + i) / ranges));
}

// Where an edge crosses a direction, as a tangent.
double HorizonSector::tangent_at(const PlanePost& right, const PlanePost& left, const PlanePost& towards,
                                 double& distance_m) const {
    const double of_left = -turn(towards, right), of_right = turn(towards, left), sum = of_left + of_right;
    distance_m = (along(right, towards) * of_right + along(left, towards) * of_left) / sum;
    return (right.z * of_right + left.z * of_left) / (sum * distance_m);
}

// No place of an edge is seen higher.
double HorizonSector::most_tangent(const PlanePost& right, const PlanePost& left, double turned) const {
    const double nearest_m = std::min(right.distance_m, left.distance_m);
    const double across = turned / (right.distance_m * left.distance_m);
    // Of a short one alone: of its angle's sine, and an eye that is farther from it than it is long.
    constexpr double most_across = 0.2;
    if (!(across < most_across && along(right, left) > 0.0)) return std::numeric_limits<double>::infinity();
    const double highest = std::max(right.tangent, left.tangent);
    return highest + std::abs(highest) * across * across + 2.0 * plane_.error_m() / nearest_m;
}

void HorizonSector::add_edge(std::int64_t one, std::int64_t other, bool is_rim) {
    const double turned = turn(plane_.post(one), plane_.post(other));
    // An edge along a line of sight is as high as its ends, which other edges have, too. (No number: no
    // edge.)
    if (!(turned != 0.0)) return;
    const Edge edge{static_cast<std::uint32_t>(turned > 0.0 ? one : other),
                    static_cast<std::uint32_t>(turned > 0.0 ? other : one), 0.0};
    const PlanePost &right = plane_.post(edge.right), &left = plane_.post(edge.left);
    if (std::isnan(right.z + left.z)) return;
    const double most = most_tangent(right, left, turned);
    const double scale = 0.25 * ranges_;
    const double right_place = azimuth_number(right) * scale, left_place = azimuth_number(left) * scale;
    const auto wrapped = [&](int number) { return number < 0 ? number + ranges_ : number % ranges_; };
    const int from = wrapped(static_cast<int>(right_place));
    int length = wrapped(static_cast<int>(left_place)) - from;
    if (length < 0) length += ranges_;
    const int count = static_cast<int>(own_.size());
    const int into = wrapped(from - first_);
    // Its first range in this sector, counted from `from`.
    int step = into < count ? 0 : ranges_ - into;
    Crossing border{0.0, 0.0, false};
    for (; step <= length; ++step) {
        const int number = wrapped(from + step - first_);
        if (number >= count) break;
        if (is_rim) own_[static_cast<std::size_t>(number)].has_rim = true;
        if (most < lowest_[static_cast<std::size_t>(number)])
            border.is_known = false;
        else
            add_to(number, edge, step == 0, step == length, border);
    }
}

// begins, ends: the edge does so within the range. border: that with the range before, then with the next.
void HorizonSector::add_to(int number, const Edge& edge, bool begins, bool ends, Crossing& border) {
    Range& range = own_[static_cast<std::size_t>(number)];
    double& lowest_of_range = lowest_[static_cast<std::size_t>(number)];
    const PlanePost &right = plane_.post(edge.right), &left = plane_.post(edge.left);
    const PlanePost &low = borders_[static_cast<std::size_t>(number)],
                    &high = borders_[static_cast<std::size_t>(number) + 1];
    double near_m = right.distance_m, far_m = left.distance_m;
    double at_right = right.tangent, at_left = left.tangent;
    if (border.is_known) {
        at_right = border.tangent;
        near_m = border.distance_m;
    } else if (!begins) {
        at_right = tangent_at(right, left, low, near_m);
    }
    if (!ends) at_left = tangent_at(right, left, high, far_m);
    border = {at_left, far_m, true};
    const double nearest_m = std::min(near_m, far_m);
    // Close by an edge may turn far in a range: over level it is never left out, and it stands in for
    // nothing.
    constexpr double too_near_m = 1.0e-3;
    const bool is_near = !(nearest_m > too_near_m);
    // Between two directions a straight edge's tangent is a cosine of the azimuth.
    const double angle = turn(low, high), size = std::max(std::abs(at_right), std::abs(at_left));
    const double slack = size * angle * angle + plane_.error_m() / nearest_m;
    const double most_right = at_right + plane_.error_m() / near_m,
                 most_left = at_left + plane_.error_m() / far_m;
    double highest = std::max(at_right, at_left) + slack;
    // Below level such a cosine is highest at an end.
    if (most_right < 0.0 && most_left < 0.0)
        highest = std::max(most_right, most_left);
    else if (is_near)
        highest = std::numeric_limits<double>::infinity();
    if (!(highest >= lowest_of_range)) return;
    if (!begins && !ends && !is_near) {
        const double lowest = std::min(at_right, at_left) - slack;
        if (lowest > lowest_of_range) {
            lowest_of_range = lowest;
            int kept = 0;
            for (int i = 0; i < range.count; ++i) {
                const Edge& its = range.edges[static_cast<std::size_t>(i)];
                if (its.highest >= lowest) range.edges[static_cast<std::size_t>(kept++)] = its;
            }
            range.count = kept;
        }
    }
    if (range.count == Range::most) {
        // The lowest goes: what is left out matters no more as soon as it is below the horizon.
        const auto lowest = std::min_element(
            range.edges.begin(), range.edges.end(),
            [](const Edge& first, const Edge& second) { return first.highest < second.highest; });
        range.left_out = std::max(range.left_out, std::min(highest, lowest->highest));
        if (highest > lowest->highest) *lowest = {edge.right, edge.left, highest};
        return;
    }
    range.edges[static_cast<std::size_t>(range.count++)] = {edge.right, edge.left, highest};
}

bool HorizonSector::is_above(const PlanePost& post, double reach, double tangent) const {
    const double scale = 0.25 * ranges_, count = static_cast<double>(own_.size());
    double place = azimuth_number(post) * scale - first_;
    // Of a neighbouring sector's posts on the other side of east.
    const double elsewhere = 0.5 * (ranges_ - count);
    if (place - count > elsewhere) place -= ranges_;
    if (-place > elsewhere) place += ranges_;
    const double before = std::floor(place - reach * scale), after = std::floor(place + reach * scale);
    const int to = static_cast<int>(std::min(after, count - 1.0));
    bool above = true;
    for (int number = static_cast<int>(std::max(before, 0.0)); number <= to; ++number)
        above = above && tangent < lowest_[static_cast<std::size_t>(number)];
    return above;
}

bool HorizonSector::horizon(const PlanePost& target, int number, Horizon& horizon) const {
    const int count = static_cast<int>(own_.size());
    const auto own = static_cast<std::size_t>(std::clamp(number, 0, count - 1));
    const Range& range = own_[own];
    horizon.has_rim |= range.has_rim;
    const double length_m = target.distance_m;
    for (int i = 0; i < range.count; ++i) {
        const Edge& edge = range.edges[static_cast<std::size_t>(i)];
        const PlanePost &right = plane_.post(edge.right), &left = plane_.post(edge.left);
        const double of_right = turn(target, left), of_left = -turn(target, right);
        if (of_right < 0.0 || of_left < 0.0) continue;
        const double sum = of_right + of_left;
        const double distance_m =
            (along(right, target) * of_right + along(left, target) * of_left) / (sum * length_m);
        if (!(distance_m > 0.0)) continue;
        const double height_m = (right.z * of_right + left.z * of_left) / sum;
        horizon.add(height_m + plane_.bulge_m(right, left, of_left / sum), distance_m, plane_.error_m());
    }
    return range.left_out == Horizon::none || range.left_out < std::max(lowest_[own], horizon.lowest);
}

}  // namespace oro
