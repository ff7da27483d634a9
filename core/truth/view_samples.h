// Ground points that a view sees, for predictions: many where the ground is rugged, few where it is even.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "core/earth/camera.h"
#include "core/truth/oracle.h"
#include "core/truth/true_ground.h"

namespace oro {

// A point that is seen, or would be if the ground before it were a little lower.
struct ViewSample {
    Geodetic point;
    glm::dvec3 apparent_m;  // offset from the eye at which it is seen, ECEF axes
    double distance_m;
    double slope;  // of its triangle, metres a metre
    int row;       // of its cell
    int column;
    bool west;  // of the cell's triangles
    bool even;  // one of those spread evenly over the picture: medians are taken of these alone
    double from_seen_px{0.0};   // 0: seen at a pixel's centre; else how far it lies from one that is, on the
                                // picture: behind an edge, or in a gap that no centre looks through
    std::size_t grid{0};        // of the ground's: whose cell it is
    bool between_grids{false};  // on a step between two grids, which belongs to none
};
// What lies behind edges is given up to this far from them.
inline constexpr double behind_edges_px = 5.0;

// Casts sight lines through centres of pixels: up to 160 x 640 all over the picture (14,400 for 16:9; those
// of its rim included), then wherever four of them see ground whose distances differ by more than a fifth, or
// ground and sky, more between them, down to single pixels: what is seen through gaps between hills is seen
// here, too. Of several grids that is seen which is the ground there. Behind edges between two pixels, or
// between a pixel and the picture's rim, the ground is followed along the sight line to what lies beyond:
// what is within `behind_edges_px` of the edge is given, too, seen or not. So is what shows through gaps
// between pixels, and what comes out when ground moves.
std::vector<ViewSample> view_samples(const TrueGround& ground, const Sight& sight, const Camera& camera,
                                     int threads);

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
