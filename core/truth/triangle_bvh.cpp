#include "core/truth/triangle_bvh.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "core/truth/box_walk.h"
#include "core/truth/line_meets.h"

namespace oro {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr std::uint32_t most_in_leaf = 4;

// By what rounding, and turning into the frame, may move a line from 1e9 m away.
constexpr double rounded_m = 1.0e-6;

}  // namespace

TriangleBvh::TriangleBvh(std::vector<std::array<glm::dvec3, 3>> triangles, const glm::dmat3& frame,
                         std::vector<std::uint32_t> owners)
    : frame_from_ecef_(glm::transpose(frame)), triangles_(std::move(triangles)), owners_(std::move(owners)) {
    assert(owners_.size() == triangles_.size());
    if (triangles_.empty()) return;
    std::vector<Bounds> bounds(triangles_.size());
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
        const glm::dvec3 a = frame_from_ecef_ * triangles_[i][0], b = frame_from_ecef_ * triangles_[i][1],
                         c = frame_from_ecef_ * triangles_[i][2];
        bounds[i] = {glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c)), (a + b + c) / 3.0,
                     static_cast<std::uint32_t>(i)};
    }
    nodes_.reserve(triangles_.size());
    nodes_.emplace_back();
    split(0, bounds, 0, static_cast<std::uint32_t>(bounds.size()));
    std::vector<std::array<glm::dvec3, 3>> sorted(triangles_.size());
    std::vector<std::uint32_t> sorted_owners(owners_.size());
    for (std::size_t i = 0; i < sorted.size(); ++i) {
        sorted[i] = triangles_[bounds[i].triangle];
        sorted_owners[i] = owners_[bounds[i].triangle];
    }
    triangles_ = std::move(sorted);
    owners_ = std::move(sorted_owners);
}

// Halves them along the longest side of the box around their middles.
void TriangleBvh::split(std::uint32_t node, std::vector<Bounds>& bounds, std::uint32_t first,
                        std::uint32_t last) {
    glm::dvec3 low(infinite), high(-infinite), least(infinite), most(-infinite);
    for (std::uint32_t i = first; i < last; ++i) {
        low = glm::min(low, bounds[i].low);
        high = glm::max(high, bounds[i].high);
        least = glm::min(least, bounds[i].middle);
        most = glm::max(most, bounds[i].middle);
    }
    nodes_[node].low = low - rounded_m;
    nodes_[node].high = high + rounded_m;
    if (last - first <= most_in_leaf) {
        nodes_[node].first = first;
        nodes_[node].count = last - first;
        return;
    }
    const glm::dvec3 size = most - least;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const std::uint32_t half = first + (last - first) / 2;
    const auto at = [&](std::uint32_t i) { return bounds.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(first), at(half), at(last),
                     [axis](const Bounds& a, const Bounds& b) { return a.middle[axis] < b.middle[axis]; });
    const auto below = static_cast<std::uint32_t>(nodes_.size());
    nodes_[node].first = below;
    nodes_.resize(nodes_.size() + 2);
    split(below, bounds, first, half);
    split(below + 1, bounds, half, last);
}

std::optional<TriangleBvh::Hit> TriangleBvh::first_hit(const glm::dvec3& start_m, const glm::dvec3& direction,
                                                       double reach_m) const {
    if (nodes_.empty()) return std::nullopt;
    const glm::dvec3 start = frame_from_ecef_ * start_m;
    const glm::dvec3 inverse = finite_inverse(frame_from_ecef_ * direction);
    std::optional<Hit> nearest;
    double most_m = reach_m;
    const auto begin_of = [&](std::uint32_t node) {
        return box_begin_m(start, inverse, nodes_[node].low, nodes_[node].high, most_m);
    };
    using Two = std::optional<std::pair<std::uint32_t, std::uint32_t>>;
    const auto below_of = [&](std::uint32_t number) {
        const Node& node = nodes_[number];
        return node.count == 0 ? Two({node.first, node.first + 1}) : Two();
    };
    walk_boxes(most_m, begin_of, below_of, [&](std::uint32_t number) {
        const Node& node = nodes_[number];
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
            const auto at_m = triangle_along_m(triangles_[i], start_m, direction);
            if (!at_m || *at_m < 0.0 || *at_m >= most_m) continue;
            most_m = *at_m;
            nearest = Hit{most_m, owners_[i]};
        }
    });
    return nearest;
}

}  // namespace oro
