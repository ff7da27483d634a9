// Heights written on contour lines: which, where, and at what angle.
#pragma once

#include <functional>
#include <string>
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

struct LineLabel {
    std::string text;  // H in whole metres
    double H_m{};
    glm::dvec2 middle_px;  // on the line; from the picture's top left corner
    double angle_deg{};    // of its base line: clockwise, 0 to the right, -90 to 90
    double length_px{};
    bool top_is_uphill{};
};

// How far a line may be from a straight one below its label, in sizes.
inline constexpr double most_line_off_share = 0.2;

// Length of a text in pixels.
using TextLength = std::function<Result<double>(const std::string& text)>;

// Labels of every fifth line, of figures `size_px` high (their em). A label stands where its line is nearly
// straight, the ground goes on without an edge, and no other line passes below it; 20 times its size from
// others of the same H, 8 times its size or two lengths from all others, and its size from the border. Its
// top is uphill. A place where that would turn it more than 90 degrees is left for another one on the same
// line; on a line that has no other it is turned round, 40 times its size from others of the same H. Lines
// between whole metres have none. The same for the same heights. Errors: those of `length`.
Result<std::vector<LineLabel>> line_labels(const SeenHeights& seen, double interval_m, double size_px,
                                           const TextLength& length);

}  // namespace oro
