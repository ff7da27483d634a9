#include "core/truth/piece_tree.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

namespace oro {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr std::uint32_t most_in_leaf = 4;

glm::dvec3 middle_of(const std::array<glm::dvec3, 3>& triangle) {
    return (triangle[0] + triangle[1] + triangle[2]) / 3.0;
}

// Whether a line meets a box nearer than reach_m. Widened by what rounding takes from it.
bool meets(const glm::dvec3& start, const glm::dvec3& inverse, const glm::dvec3& low, const glm::dvec3& high,
           double reach_m) {
    constexpr double rounded_m = 1.0e-6;
    double begin_m = 0.0, end_m = reach_m;
    for (int axis = 0; axis < 3; ++axis) {
        const double from = low[axis] - rounded_m - start[axis], to = high[axis] + rounded_m - start[axis];
        if (std::isinf(inverse[axis])) {
            if (from > 0.0 || to < 0.0) return false;
            continue;
        }
        const auto [one_m, other_m] = std::minmax(from * inverse[axis], to * inverse[axis]);
        begin_m = std::max(begin_m, one_m);
        end_m = std::min(end_m, other_m);
    }
    return begin_m <= end_m;
}

// Source: T. Möller, B. Trumbore, Fast, Minimum Storage Ray/Triangle Intersection, 1997, eq. 6; a share may
// be below 0 by rounding.
std::optional<double> along_m(const std::array<glm::dvec3, 3>& triangle, const glm::dvec3& start,
                              const glm::dvec3& direction) {
    const glm::dvec3 one = triangle[1] - triangle[0], other = triangle[2] - triangle[0];
    const glm::dvec3 across = glm::cross(direction, other);
    const double determinant = glm::dot(one, across);
    if (determinant == 0.0) return std::nullopt;
    constexpr double rounded = 1.0e-9;
    const glm::dvec3 to_start = start - triangle[0];
    const double share_1 = glm::dot(to_start, across) / determinant;
    const glm::dvec3 around = glm::cross(to_start, one);
    const double share_2 = glm::dot(direction, around) / determinant;
    if (share_1 < -rounded || share_2 < -rounded || share_1 + share_2 > 1.0 + rounded) return std::nullopt;
    return glm::dot(other, around) / determinant;
}

}  // namespace

PieceTree::PieceTree(std::vector<std::array<glm::dvec3, 3>> triangles) : triangles_(std::move(triangles)) {
    if (triangles_.empty()) return;
    nodes_.emplace_back();
    split(0, 0, static_cast<std::uint32_t>(triangles_.size()));
}

// Halves them along the longest side of the box around their middles.
void PieceTree::split(std::uint32_t node, std::uint32_t first, std::uint32_t last) {
    glm::dvec3 low(infinite), high(-infinite), least(infinite), most(-infinite);
    for (std::uint32_t i = first; i < last; ++i) {
        for (const glm::dvec3& corner : triangles_[i]) {
            low = glm::min(low, corner);
            high = glm::max(high, corner);
        }
        least = glm::min(least, middle_of(triangles_[i]));
        most = glm::max(most, middle_of(triangles_[i]));
    }
    nodes_[node].low = low;
    nodes_[node].high = high;
    if (last - first <= most_in_leaf) {
        nodes_[node].first = first;
        nodes_[node].count = last - first;
        return;
    }
    const glm::dvec3 size = most - least;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const std::uint32_t half = first + (last - first) / 2;
    const auto at = [&](std::uint32_t i) { return triangles_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(first), at(half), at(last), [axis](const auto& a, const auto& b) {
        return middle_of(a)[axis] < middle_of(b)[axis];
    });
    const auto below = static_cast<std::uint32_t>(nodes_.size());
    nodes_[node].first = below;
    nodes_.resize(nodes_.size() + 2);
    split(below, first, half);
    split(below + 1, half, last);
}

std::optional<double> PieceTree::first_hit(const glm::dvec3& start_m, const glm::dvec3& direction,
                                           double reach_m) const {
    std::optional<double> nearest_m;
    if (nodes_.empty()) return nearest_m;
    const glm::dvec3 inverse = 1.0 / direction;
    std::array<std::uint32_t, 64> waiting{};  // 2^32 triangles are 32 levels
    std::size_t count = 0;
    waiting[count++] = 0;
    while (count > 0) {
        const Node& node = nodes_[waiting[--count]];
        if (!meets(start_m, inverse, node.low, node.high, nearest_m.value_or(reach_m))) continue;
        if (node.count == 0) {
            waiting[count++] = node.first;
            waiting[count++] = node.first + 1;
            continue;
        }
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
            const auto at_m = along_m(triangles_[i], start_m, direction);
            if (at_m && *at_m >= 0.0 && *at_m < nearest_m.value_or(reach_m)) nearest_m = at_m;
        }
    }
    return nearest_m;
}

}  // namespace oro
