// The bound of a cover where the question is only whether it is above a number.
#include "core/mesh_graph/distance_cover.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace oro {
namespace {

// Waves of 5 m over a kilometre, and a flat triangle of that size.
constexpr int waves_along = 20;
constexpr double waves_reach_m = 1000.0, high_m = 5.0;

std::vector<std::array<glm::dvec3, 3>> waves() {
    const auto at = [](int i, int k) {
        return glm::dvec3(waves_reach_m * i / waves_along, waves_reach_m * k / waves_along,
                          (i + k) % 2 == 0 ? 0.0 : high_m);
    };
    std::vector<std::array<glm::dvec3, 3>> triangles;
    for (int i = 0; i < waves_along; ++i)
        for (int k = 0; k < waves_along; ++k) {
            triangles.push_back({at(i, k), at(i + 1, k), at(i, k + 1)});
            triangles.push_back({at(i + 1, k), at(i + 1, k + 1), at(i, k + 1)});
        }
    return triangles;
}

OriginalPart flat_triangle() {
    OriginalPart part;
    part.corners[0] = {0.0, 0.0, 2.0};
    part.corners[1] = {waves_reach_m, 0.0, 2.0};
    part.corners[2] = {0.0, waves_reach_m, 2.0};
    part.count = 3;
    return part;
}

// The largest distance is that of a place over a low corner, 2 m at most, or below a high one, 3 m at most.
TEST(DistanceCover, EndsAboveWhatIsAsked) {
    const std::vector<std::array<glm::dvec3, 3>> triangles = waves();
    std::vector<int> users;
    for (std::size_t i = 0; i < triangles.size(); ++i) users.push_back(static_cast<int>(i));
    const NearestTriangles set(triangles);
    DistanceCover whole(set, 0.0, users), asked(set, 0.0, users), never(set, 0.0, users);
    whole.cover(flat_triangle());
    asked.end_above(1.0);
    asked.cover(flat_triangle());
    never.end_above(3.1);
    never.cover(flat_triangle());
    EXPECT_GT(whole.bound_m(), 1.0);
    EXPECT_LE(whole.bound_m(), 3.1);
    EXPECT_GT(asked.bound_m(), 1.0);
    EXPECT_LE(asked.bound_m(), 3.1);
    EXPECT_EQ(never.bound_m(), whole.bound_m()) << "m, where no place is so far";
    EXPECT_GT(whole.taken().size(), 400U) << "pieces";
    EXPECT_LT(asked.taken().size(), 100U) << "pieces";
    EXPECT_EQ(never.taken().size(), whole.taken().size());
}

}  // namespace
}  // namespace oro
