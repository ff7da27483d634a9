// The lines of a view's --overlay files while its eye moves.
#pragma once

#include <memory>
#include <vector>

#include "apps/overlay/overlay_in_view.h"

namespace oro {

// A part of a line that is seen, from pixel to pixel.
struct StrokedLine {
    std::vector<glm::dvec2> places_px;
    Stroke stroke{};
};

// Follows lines over the ground once, and asks which parts of them are seen at places some pixels apart: so
// many as a frame of an eye that moves has time for. Where even few take long it gives none until the eye has
// rested.
class LinesInMotion {
  public:
    // `ground`: of the view's region and exaggeration, the same one until forget() is called.
    // longest_s: what it may take of a frame; it keeps to that from the next frame on.
    std::vector<StrokedLine> find(const View& view, const TrueGround& ground, double longest_s);
    // The eye rests: the next frame of one that moves may try again.
    void rest() {
        if (is_slow_) apart_px_ = first_apart_px;
        is_slow_ = false;
    }
    void forget() { *this = {}; }

  private:
    static constexpr double first_apart_px = 12.0;
    std::shared_ptr<const VectorsRead> of_;  // whose lines they are
    std::vector<GroundLine> lines_;
    std::vector<Stroke> strokes_;  // by the shapes of these
    double apart_px_{first_apart_px};
    bool is_slow_{};
};

}  // namespace oro
