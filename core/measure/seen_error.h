// What is truly seen where a picture shows something: other ground, at edges that lie elsewhere.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/earth/camera.h"
#include "core/measure/drawn_point.h"
#include "core/measure/ground_error.h"
#include "core/truth/oracle.h"
#include "core/truth/picture_error.h"

namespace oro {

// The errors of each pixel, at its centre, row by row.
struct SeenErrors {
    // How far away on the picture the truth has what is drawn: ground at that distance, or an edge of ground
    // between nearer and farther ground (sky is farther than all ground). So it counts what moves, what is
    // missing and what should be hidden. `seen_reach_px` where nothing like it lies nearer: at least
    // that.
    std::vector<float> px;
    // How far the ground that is drawn lies from the ground that is truly seen there, along the sight line;
    // not_measured where either is sky.
    std::vector<float> m;
    ErrorSummary summary_px;  // of pixels with ground, drawn or true
    ErrorSummary summary_m;   // of those that show the same slope: not across an edge
    std::uint64_t other{};  // pixels that show other ground than is seen there, or sky for ground, or ground
                            // for sky: across an edge
};
inline constexpr int seen_reach_px = 32;
// To how much of a pixel edges are looked for, here and along the skyline.
inline constexpr double seen_resolution_px = 1.0 / 64.0;

// `truth`: what the oracle sees at the pixels' centres (Oracle::cast_picture); `meter` knows where ground
// points are truly seen: one that is drawn and truly visible is off by its displacement. Hidden ones are
// looked for around the pixel, on circles of 1/64 px to 3/4 px; the largest errors more closely, up to 4 px.
// Error: 1/64 px, or a tenth; of others than the largest too large where what is drawn is truly seen through
// a gap that the rays miss; and where narrow things are moved before ground that is seen grazingly (found: up
// to 1.6 times what they were moved by).
SeenErrors seen_errors(const Oracle& oracle, const GroundMeter& meter,
                       std::span<const std::optional<SightHit>> truth, const Camera& camera,
                       std::span<const DrawnPoint> points, int threads);

}  // namespace oro
