// How far a picture's skyline is from the true one.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/earth/camera.h"
#include "core/truth/oracle.h"
#include "core/truth/picture_error.h"
#include "core/truth/true_ground.h"

namespace oro {

// Heights in a pixel at which skylines are looked for: sample i at ((i + 0.5) / 4) of it.
inline constexpr int skyline_samples = 4;

// The true skyline: for each column of pixels, where its highest ground begins, in pixels from the picture's
// top.
struct Skyline {
    std::vector<float> y_px;  // not_measured: no ground. 0: ground at the picture's very top
    // Columns whose highest ground is met from below, through a hole in the data: beneath the ground nothing
    // is modelled, and they are not measured. Empty: none.
    std::vector<std::uint8_t> from_below{};
};
// Along the middles of the columns; by bisection to 1/64 px between the first ray with ground, of those that
// drawn skylines are looked for with (`skyline_samples` a pixel) and the picture's edges, and the ray above
// it. Ground that no such ray meets is not found.
Skyline true_skyline(const TrueGround& ground, const Sight& sight, const Camera& camera, int threads);

// The skyline: how far the drawn one lies from the truth's, in pixels, by the shortest way. The drawn one is
// known to lie between two samples of a column; what is not known is not counted as an error.
struct SkylineError {
    std::vector<float> px;  // of each column; not_measured where it has no skyline in either, or in one only,
                            // or the true one is ground from below,
                            // or ground reaches the picture's top in both
    ErrorSummary summary_px;
    std::uint64_t in_one_only{};  // columns with ground in one of the two only
};
// samples: pictures of the same view, sampled at several heights in the middle of their pixels. oracle: asked
// about columns that are off by more than 0.05 px: how far the truth is to be moved to have what is drawn
// there (to a fifth of that, the farthest to a tenth); a spire or a step between two columns of rays is in
// one picture or the other by chance. Without an oracle such columns count as they look.
SkylineError skyline_error(const Skyline& truth, const Camera& camera, std::span<const DrawnDepths> samples,
                           const Oracle* oracle = nullptr);
SkylineError skyline_error(const TrueGround& ground, const Sight& sight, const Camera& camera,
                           std::span<const DrawnDepths> samples, int threads);

}  // namespace oro
