// What is left of a grid where others lie over it: they are cut out of it along their rims.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "geo/together/coverage_rim.h"

namespace oro {

// A point of a seam, by the posts of one grid: their places, each taken so many times. So it lies on the flat
// triangles that are drawn between them, whatever heights are multiplied by.
struct SeamPoint {
    std::uint32_t grid{};  // 0: the one that is cut; 1 ...: those over it
    std::array<GridPost, 3> posts{};
    std::array<double, 3> shares{};  // 0 .. 1, their sum is 1
};

// A piece of a cut triangle; north-west, south-west, south-east like its whole: anticlockwise, seen from
// above.
struct SeamTriangle {
    std::array<SeamPoint, 3> points;
};

// Upright ground between the two surfaces along a piece of a rim: a step that the data have.
struct SeamWall {
    std::array<SeamPoint, 2> cut;  // along what is left of the grid that is cut, which lies on the right hand
    std::array<SeamPoint, 2> over;  // ... along the other's rim, above or below these
};

struct GridClip {
    // By post of the cut grid, row by row: 1 where it is left out, and with it all its triangles.
    std::vector<char> masked_posts;
    std::vector<SeamTriangle> ground;  // what these leave uncovered
    std::vector<SeamWall> walls;
};

// A piece of the rim of what covers a grid.
struct ClipRim {
    RimEdge edge;  // as SeamWall::over names it
    std::array<PostPlace, 2> at;
};
// What covers a part of a grid: all places where has_ground is true, whose rim is known.
struct ClipCover {
    std::function<bool(double lat_deg, double lon_deg)> has_ground;
    std::vector<ClipRim> rim;
    bool is_narrow{true};  // less than half way round the Earth
};

// Cuts the ground of `over` out of `field`. Every place that `field` has ground for is then on one triangle
// without a post left out, on one of `ground`, or covered. Two rims nearer than seam_slack_posts are one.
// Costs a search in `over` for each post of `field` in their boxes. Errors: a post that could not be read
// (HeightField::health).
inline constexpr double seam_slack_posts = 1.0e-7;
Result<GridClip> clip_by_finer(const HeightField& field, std::span<const HeightField* const> over);

// The same of anything that covers ground.
Result<GridClip> clip_by_covers(const HeightField& field, std::span<const ClipCover> over);

}  // namespace oro
