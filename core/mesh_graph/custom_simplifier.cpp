#include "core/mesh_graph/custom_simplifier.h"

#include <algorithm>
#include <map>
#include <unordered_map>
#include <utility>

#include "core/mesh_graph/space_simplifier.h"

namespace oro {
namespace {

std::array<std::uint32_t, 3> sorted_corners(std::array<std::uint32_t, 3> corners) {
    std::sort(corners.begin(), corners.end());
    return corners;
}

}  // namespace

std::vector<LevelTriangle> simplified_by(const CustomSimplifier& simplifier, GroupToSimplify group,
                                         std::vector<LevelTriangle> triangles) {
    std::vector<std::array<std::uint32_t, 3>> before;
    std::map<std::array<std::uint32_t, 3>, std::size_t> same;
    std::unordered_map<std::uint32_t, std::uint32_t> original_at;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        before.push_back(triangles[i].corners);
        same.try_emplace(sorted_corners(triangles[i].corners), i);
        for (const std::uint32_t corner : triangles[i].corners)
            original_at.try_emplace(corner, triangles[i].original);
    }
    group.triangles = before;
    const std::vector<std::array<std::uint32_t, 3>> after = simplifier(group);
    if (after.empty()) return triangles;
    std::vector<LevelTriangle> made;
    made.reserve(after.size());
    for (const std::array<std::uint32_t, 3>& corners : after) {
        const auto kept = same.find(sorted_corners(corners));
        if (kept != same.end()) {
            made.push_back(triangles[kept->second]);
        } else {
            LevelTriangle triangle;
            triangle.original = original_at.at(corners[0]);
            made.push_back(std::move(triangle));
        }
        made.back().corners = corners;
    }
    return made;
}

}  // namespace oro
