// Ground behind the edges of a picture: hidden, or in gaps between pixels. Within core/truth.
#pragma once

#include <span>
#include <vector>

#include "core/truth/view_samples.h"

namespace oro {

// Between two neighbouring pixels: the nearer ground, and how far beyond it the other one sees.
struct PictureEdge {
    ViewSample near;
    double until_m;  // infinite: the sky
};

// Goes along the nearer pixel's sight line, in steps of a fiftieth of the distance, from its ground to the
// other's: of the ground above or below it what is seen, or would be, within `behind_edges_px` of the pixel.
// Of a great many edges some.
std::vector<ViewSample> samples_behind(const TrueGround& ground, const Sight& sight, const Camera& camera,
                                       std::span<const PictureEdge> edges, int threads);

// Farther than any sight line of a picture of these data: over a plane ground has no horizon. Of more than a
// hemisphere on a plane no more than some 8,500 km.
double picture_reach_m(const TrueGround& ground, const Sight& sight, double eye_h_m);

}  // namespace oro
