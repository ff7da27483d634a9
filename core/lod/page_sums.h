// What is known of a page's nodes together, which the choice of pages asks for.
#pragma once

#include "core/lod/pyramid.h"

namespace oro {

// From a level to the next, errors and radii grow by this much beyond what they must hold: more than rounding
// in float takes from a page's place, a sphere's distance and the formulas of shaders/choose/levels.glsl.
inline constexpr double error_growth = 1.0 + 1.0e-5;
inline constexpr double radius_growth = 1.0 + 1.0e-4;

// The nearest float that is not less.
float rounded_up(double value);

// Fills the page's quarters, and largest_error_m and lod_radius_m of its summary, from its nodes with their
// errors and lod spheres.
void sum_up_nodes(PyramidPage& page);

}  // namespace oro
