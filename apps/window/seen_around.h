// What is seen from a place that a window's user has picked, by the code of the command viewshed.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <stop_token>
#include <string>

#include "apps/commands/sight/sight_ground.h"
#include "apps/commands/sight/viewshed_report.h"
#include "geo/places/geodesic.h"
#include "geo/region/region.h"

namespace oro {

// What its user chooses.
struct SeenAroundChoice {
    LatLon place;
    double above_m{2.0};   // the eye over the ground
    double target_m{0.0};  // what is looked at over the ground
    double radius_km{usual_radius_km};
    bool bends{true};  // light bends as in standard air where the view's goes straight
    // How probable it is that posts are seen, with heights that are off: by so many realisations of the
    // ground.
    bool is_probable{false};
    int realisations{50};
    double le90_m{0.0};  // 90 % of the heights are off by no more; 0: what their sources promise
};
inline constexpr int most_realisations = 10000;

// What came of it: the lines that the command prints, and what its file holds.
struct SeenAround {
    std::string seen, from, light;
    PostRaster raster;
    std::shared_ptr<const PostColours> colours;
    std::string probable;  // the line that the command prints of probabilities; "": they were not asked for
};

// The colour of a post that is seen with such a probability, 0 to 1: sRGB codes and alpha. 0 and 1 have those
// of what is hidden and what is seen.
struct ProbabilityColour {
    std::array<std::uint8_t, 3> rgb;
    double alpha;
};
ProbabilityColour colour_of_probability(double share);

// "46.670000000,8.060000000": the place as --at takes it, and as it is looked from.
std::string at_text(const LatLon& place);
// Through which air it is looked: the view's, or standard air where that bends no light and is to.
Air air_around(const SeenAroundChoice& choice, const Air& of_view);

// Looks around over a region, whatever its exaggeration in the view. Of one that is raised by a canopy, the
// eye and the targets stand on its ground, and the canopy hides; `cover` is what raised it. From any thread;
// the region and its cuts stay as they are meanwhile. Errors: no ground to stand on (no_data); an eye in the
// canopy; probabilities with a canopy, of which there are none; those of viewshed_report().
Result<SeenAround> seen_around(const SeenAroundChoice& choice, const Air& air, const Region& region,
                               const RegionCuts& cuts, const SightCover& cover,
                               const std::function<void(double share)>& tell_share,
                               const std::stop_token& stop);

}  // namespace oro
