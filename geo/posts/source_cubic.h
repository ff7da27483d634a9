// Heights between a source's posts.
#pragma once

#include "geo/sources/source.h"

namespace oro {

// The height of a post, void_height_m when the block does not hold it. `round`: of `columns` that go round
// the Earth.
float height_or_void(const PostBlock& block, int columns, bool round, int column, int row);

// Cubic convolution (a = -1/2) through a block's posts at fractional post numbers; linear over the four
// nearest where a void is near, and void where one of those is. The cubic stays within limit_m of the linear
// surface, so that a step between two posts (an undeclared no-data collar, a cliff) throws no ring of pits
// around itself. Up to half a cell beyond the outer posts the surface goes on straight, again within limit_m
// of its edge. `round`: after the last column comes the first. Source: R. G. Keys, Cubic convolution
// interpolation for digital image processing, IEEE Trans. ASSP 29(6), 1981, eq. 15.
float cubic_height_m(const PostBlock& block, int rows, int columns, bool round, double column, double row,
                     double limit_m);

}  // namespace oro
