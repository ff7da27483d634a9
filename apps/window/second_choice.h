// What a window's second view has otherwise than its first, and where the two stand: pure, tested without a
// window.
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/view/view.h"

namespace oro {

// What its user chooses; nothing: as the first view has it.
struct SecondChoice {
    std::optional<double> tau_px{};
    std::optional<double> exaggeration{};
    std::optional<Air> air{};
    std::optional<Earth> earth{};
    bool leaves_geoid_out{};
    std::string style{};               // ""
    std::string sun_time{};            // "2026-06-21T05:30+02:00"; "": the first view's light
    std::vector<std::string> paths{};  // of another source
    bool operator==(const SecondChoice&) const = default;
};

// The second view over the data of the first, or of its own source: `view` is the first one, or as the other
// source's was opened with what its user chose for the first (keep_choices()). Its camera is that of `view`.
// What draws it is chosen anew. Errors: usage, a time that is none.
Result<View> differing_view(View view, const SecondChoice& choice);
// Where it sees from: the first view's eye, in a picture of another width. N_m: of the geoid there, where the
// second view alone leaves it out, so that its eye is as high over the ground; else 0.
Camera second_camera(const Camera& first, int width_px, double N_m);

// What differs, in words for each: "tau 0.50 px, ellipsoid" and "tau 4.00 px, sphere". sources: the names of
// both views' data. Of views in which nothing differs: "first view" and "second view".
struct DifferenceWords {
    std::string first, second;
};
DifferenceWords difference_words(const View& first, const SecondChoice& choice,
                                 const DifferenceWords& sources);

enum class TwoViewsLayout { side_by_side, swipe };
// Columns of a window: where the second view begins, and how wide the two pictures are; at least one pixel.
struct TwoHalves {
    int begins_px{};
    int first_px{1}, second_px{1};
};
// line: the share of the window left of a swipe's line, 0 to 1.
TwoHalves two_halves(TwoViewsLayout layout, double line, int window_px);

// A point of the window as one of the first view's picture. A drag that begins in one half goes on as if that
// went on beyond its border; otherwise each half has its own points. Points left of or above the window stay.
class PointerOverHalves {
  public:
    // begins_px: of the second view's picture; 0: there are no halves.
    [[nodiscard]] glm::dvec2 point_of_first(glm::dvec2 at_px, int begins_px) const;
    // Told of each button that goes down or up.
    void button(bool down, glm::dvec2 at_px, int begins_px);

  private:
    int buttons_down_{};
    bool drags_second_{};
};

}  // namespace oro
