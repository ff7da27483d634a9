// Noise of absolute place that breaks the borders of what covers the ground: octaves of lattices in the space
// that turns with the Earth, each turned against the one before, so that there is no grain, no pole and no
// seam.
#pragma once

#include "core/earth/ellipsoid.h"
#include "shaders/shared.h"

namespace oro {

// Sets FrameConstants.noise for an eye: the cell of each octave's lattice that the eye is in, as whole
// numbers, and where in it. The shader goes on from there by differences to the eye, in float: a place has
// the same noise from every eye, in every page and grid. The eye must be within 2^31 cells (7e7 m) of the
// Earth's centre.
void set_ground_noise(const Ecef& eye, gpu::FrameConstants& constants);

}  // namespace oro
