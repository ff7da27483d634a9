// Light on both sides of where cut ground begins.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <tuple>

#include "core/terrain/drawn_heights.h"
#include "geo/together/cut_regions.h"
#include "tests/support/three_grids.h"

namespace oro {
namespace {

using Key = std::tuple<long long, long long, long long>;
Key key(const glm::dvec3& m) {
    return {std::llround(m.x * 100.0), std::llround(m.y * 100.0), std::llround(m.z * 100.0)};
}

// What a page beside the cut knows: heights of posts that are left, one-sided where no other is.
struct Rest {
    const HeightField& field;
    const GridClip& cut;

    [[nodiscard]] bool has(int row, int column) const {
        if (row < 0 || column < 0 || row >= field.grid.rows() || column >= field.grid.columns()) return false;
        const auto post = static_cast<std::size_t>(row * field.grid.columns() + column);
        return cut.masked_posts[post] == 0 && !is_void(field.H_m[post]);
    }
    // From one post to another where there is one beside, else from or to the post itself.
    [[nodiscard]] glm::dvec3 across(int row, int column, int down, int right) const {
        const auto at = [&](int side) {
            const int r = row + side * down, c = column + side * right;
            return has(r, c) ? post_ecef(field, r, c, 1.0).m : post_ecef(field, row, column, 1.0).m;
        };
        return at(1) - at(-1);
    }
};

TEST(SeamLight, IsThatOfThePagesBeside) {
    const Region region = test::three_grids(120);
    const auto cuts = cut_regions(region);
    ASSERT_TRUE(cuts.ok());
    const Seam seam = seam_between(region, *cuts, 1.0);
    std::map<Key, glm::dvec3> normals;
    for (const SeamPiece& piece : seam.pieces)
        for (const SeamCorner& corner : piece.corners) normals[key(corner.at.m)] = corner.normal;
    int shared = 0;
    double most_deg = 0.0, most_uncut_deg = 0.0;
    const std::vector<RegionGrid>& grids = region.grids;
    for (std::size_t i = 0; i < grids.size(); ++i) {
        const GridClip& cut = cuts->grids[i];
        if (cut.masked_posts.empty()) continue;
        const GridClip uncut{std::vector<char>(cut.masked_posts.size(), 0), {}, {}};
        const Rest rest{grids[i].field, cut}, whole{grids[i].field, uncut};
        for (int row = 0; row < rest.field.grid.rows(); ++row) {
            for (int column = 0; column < rest.field.grid.columns(); ++column) {
                if (!rest.has(row, column)) continue;
                const auto found = normals.find(key(post_ecef(rest.field, row, column, 1.0).m));
                if (found == normals.end()) continue;
                const auto off_deg = [&](const Rest& posts) {
                    const glm::dvec3 normal = glm::normalize(
                        glm::cross(posts.across(row, column, 1, 0), posts.across(row, column, 0, 1)));
                    return glm::length(glm::cross(normal, found->second)) * 180.0 / std::numbers::pi;
                };
                ++shared;
                most_deg = std::max(most_deg, off_deg(rest));
                most_uncut_deg = std::max(most_uncut_deg, off_deg(whole));
            }
        }
    }
    std::printf("%d posts: at most %.4f degrees from what pages beside show, %.1f from what nobody shows\n",
                shared, most_deg, most_uncut_deg);
    EXPECT_GT(shared, 100);
    EXPECT_LT(most_deg, 1.0e-6);
    EXPECT_GT(most_uncut_deg, 1.0);  // what was wrong is noticed
}

}  // namespace
}  // namespace oro
