#include "apps/bench/meshopt_groups.h"

#include <meshoptimizer.h>

#include <cstddef>
#include <glm/common.hpp>
#include <unordered_map>
#include <utility>
#include <vector>

#include "apps/bench/cover_bound.h"

namespace oro {
namespace {

// A group with vertices of its own, in float from the first of them.
struct FloatGroup {
    std::vector<std::uint32_t> vertices;  // of the mesh
    std::vector<float> positions;
    std::vector<unsigned> corners;

    explicit FloatGroup(const GroupToSimplify& group);
    void add_position(const glm::dvec3& at) {
        for (int axis = 0; axis < 3; ++axis) positions.push_back(static_cast<float>(at[axis]));
    }
    void hold(const GroupToSimplify& group);
    [[nodiscard]] std::size_t position_count() const { return positions.size() / 3; }
    [[nodiscard]] float extent_m() const {
        return meshopt_simplifyScale(positions.data(), position_count(), 3 * sizeof(float));
    }

  private:
    glm::dvec3 first_{};
};

FloatGroup::FloatGroup(const GroupToSimplify& group) : first_(group.vertices[group.triangles[0][0]]) {
    std::unordered_map<std::uint32_t, unsigned> numbers;
    for (const auto& triangle : group.triangles) {
        for (const std::uint32_t corner : triangle) {
            const auto [found, is_new] = numbers.try_emplace(corner, static_cast<unsigned>(vertices.size()));
            if (is_new) vertices.push_back(corner), add_position(group.vertices[corner] - first_);
            corners.push_back(found->second);
        }
    }
}

// Two triangles at each vertex that has to stay.
void FloatGroup::hold(const GroupToSimplify& group) {
    const double width_m = 1.0e-3 * static_cast<double>(extent_m());
    for (unsigned i = 0; i < vertices.size(); ++i) {
        if (!group.stays(vertices[i])) continue;
        const glm::dvec3 at = group.vertices[vertices[i]] - first_;
        for (const double side : {-1.0, 1.0}) {
            const auto next = static_cast<unsigned>(position_count());
            add_position(at + side * width_m * glm::dvec3(1.0, 0.3, 0.0));
            add_position(at + side * width_m * glm::dvec3(0.3, 1.0, 0.1));
            corners.insert(corners.end(), {i, next, next + 1});
        }
    }
}

std::vector<std::array<std::uint32_t, 3>> simplified(const GroupToSimplify& group, MeshoptRims rims,
                                                     MeshoptLimit limit) {
    FloatGroup own(group);
    const auto extent_m = own.extent_m();
    own.hold(group);
    constexpr float no_limit = 1.0e9F;
    const float most = limit == MeshoptLimit::own ? static_cast<float>(group.most_m) / extent_m : no_limit;
    const unsigned options =
        rims == MeshoptRims::stay ? static_cast<unsigned>(meshopt_SimplifyLockBorder) : 0U;
    // Triangles that hold vertices cannot go where borders stay.
    const std::size_t held = own.corners.size() - 3 * group.triangles.size();
    const std::size_t aim = 3 * group.aim + (rims == MeshoptRims::stay ? held : 0);
    std::vector<unsigned> made(own.corners.size());
    made.resize(meshopt_simplify(made.data(), own.corners.data(), own.corners.size(), own.positions.data(),
                                 own.position_count(), 3 * sizeof(float), aim, most, options, nullptr));
    std::vector<std::array<std::uint32_t, 3>> triangles;
    const std::size_t count = own.vertices.size();
    for (std::size_t i = 0; i < made.size(); i += 3)
        if (made[i] < count && made[i + 1] < count && made[i + 2] < count)
            triangles.push_back(
                {own.vertices[made[i]], own.vertices[made[i + 1]], own.vertices[made[i + 2]]});
    return triangles;
}

bool is_within(const GroupToSimplify& group, const std::vector<std::array<std::uint32_t, 3>>& made) {
    if (made.empty()) return false;
    const std::vector<TriangleCorners> before = corners_of(group.vertices, group.triangles),
                                       after = corners_of(group.vertices, made);
    const double accepted_m = 0.97 * group.most_m;
    return cover_bound_m(after, NearestTriangles(before), accepted_m, group.most_m) <= group.most_m &&
           cover_bound_m(before, NearestTriangles(after), accepted_m, group.most_m) <= group.most_m;
}

// None where all tries are farther.
std::vector<std::array<std::uint32_t, 3>> simplified_within(GroupToSimplify group, MeshoptRims rims) {
    std::vector<std::array<std::uint32_t, 3>> best;
    std::size_t least = group.aim, most = group.triangles.size();
    constexpr int tries = 8;
    for (int i = 0; i < tries && least < most; ++i) {
        std::vector<std::array<std::uint32_t, 3>> made = simplified(group, rims, MeshoptLimit::none);
        if (is_within(group, made)) {
            best = std::move(made), most = group.aim;
        } else {
            least = group.aim + 1;
        }
        group.aim = (least + most) / 2;
    }
    return best;
}

}  // namespace

CustomSimplifier simplifier_by_meshopt(MeshoptRims rims, MeshoptLimit limit) {
    return [rims, limit](const GroupToSimplify& group) {
        return limit == MeshoptLimit::measured ? simplified_within(group, rims)
                                               : simplified(group, rims, limit);
    };
}

}  // namespace oro
