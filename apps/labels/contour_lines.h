// Contour lines of a picture, followed from pixel to pixel.
#pragma once

#include <vector>

#include "apps/labels/seen_heights.h"

namespace oro {

// A line as long as the ground goes on; one that closes ends where it begins.
struct ContourLine {
    double H_m{};
    std::vector<glm::dvec2> points_px;  // where it crosses from node to node, at most two nodes apart
};

// The lines whose H is a whole multiple of `apart_m`, lying as pictures draw them: a centimetre below
// (shaders/shade/ground.glsl, with_contours). Where two or more go between nodes side by side there is none.
// The same for the same heights.
std::vector<ContourLine> contour_lines(const SeenHeights& seen, double apart_m);

}  // namespace oro
