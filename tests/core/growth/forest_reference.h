// A forest on a slope as the rule of trees has it, drawn by brute force: every tree an analytic cone or
// ellipsoid, in double, many samples a pixel. What it has in common with the pictures' shaders is the rule
// (shaders/growth/tree_rule.glsl) and what leaves send back (shaders/growth/shade_growth.comp).
#pragma once

#include <glm/vec3.hpp>
#include <vector>

namespace oro::test {

struct ForestView {
    double distance_m{};  // of the window's middle
    glm::dvec3 to_eye;    // from there: east, north, up
    glm::dvec3 sun;       // likewise
    glm::dvec3 ground;    // the slope's normal
    bool is_needle{true};
    int side_px{32};  // of the window
    int samples_a_side{16};
    double pixels_per_tangent{1304.0};  // 1080 px over 45 degrees
    // As pictures leave out trees far away: 1 is all of them.
    double kept{1.0};
};

// What a pixel sends back over what ground of the forest's colour does: of the sun's light that falls on
// level ground, and of the light of a whole sky.
struct ForestPicture {
    int side_px{};
    std::vector<double> lit, open, trees;  // trees: the share of the pixel that shows them
};

ForestPicture draw_forest(const ForestView& view);

}  // namespace oro::test
