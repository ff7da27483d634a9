// How probable it is that posts are seen, when the heights have errors: by simulation.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "apps/commands/sight/sight_ground.h"
#include "apps/commands/sight/viewshed_report.h"
#include "apps/options/realisation_options.h"
#include "core/realised/realised_heights.h"

namespace oro {

// What simulations were made of.
struct Simulations {
    int realisations{};
    int seed{};
    double le90_m{};
    HeightErrors errors;
    GroundRoughness roughness;
    int finer{1};  // posts of realisations in place of one of the data, each way
    double looking_s{};
};

struct SeenProbability {
    Simulations made;
    std::vector<float> share;  // for each post of the report's window: of realisations in which it is seen by
                               // any observer; Viewshed::unknown where the report has no answer
    double expected{};         // posts that are seen: the sum of the shares
    std::size_t uncertain{};   // posts with a share of 0.1 to 0.9
};

struct SightProbability {
    Simulations made;
    double share{};  // of realisations in which the target is seen
    // Of the share, as the number of realisations leaves it: sqrt(p (1 - p) / N) of p = (seen + 1) / (N + 2),
    // so that it is not 0 where all are seen, or none. Source: P.-S. de Laplace, rule of succession, 1774.
    double standard_error{};
};

// Refuses words that mean nothing, and --accuracy and its like without --realisations (usage).
Result<void> check_realisations(const RealisationOptions& options);

// For the posts of a report. Observers stand as high over the ground of each realisation as they do over the
// data's, or, where their Standing gives a height above the sea or the ellipsoid, at that. `eyes` are those
// of the report. The same seed gives the same bytes. Errors (usage): several grids, meshes or a canopy, which
// have no realisations; data of which no accuracy is known and none is given; too many posts. Else those of
// RealisedHeights.
Result<SeenProbability> seen_probability(const RealisationOptions& options, const ViewshedReport& report,
                                         const SightGround& ground, const std::vector<Standing>& eyes,
                                         const ViewshedProgress& progress);

// The same over a region whose full resolution `ground` is. above_m: of each of the report's eyes how high
// over the ground of each realisation it stands; nothing: it stays where it is. Asked to stop, it ends soon,
// with an error that nobody need be told.
Result<SeenProbability> seen_probability(const RealisationOptions& options, const ViewshedReport& report,
                                         const Region& region, const RegionGround& ground,
                                         const std::vector<std::optional<double>>& above_m,
                                         const ViewshedProgress& progress, const std::stop_token& stop);
// How far off 90 % of the heights of a grid are at most, as its sources are known to promise; nothing where
// they say nothing.
std::optional<double> stated_le90_m(std::span<const SourceReport> sources);

// The ends of a line of sight, and how they were said.
struct SightEnds {
    Geodetic from, to;
    bool from_keeps_height{}, to_keeps_height{};  // and are not as high over each ground
};
// Whether a place is at a height above the sea or the ellipsoid, and not over the ground.
bool keeps_height(const Standing& standing);

// For a line of sight, whose ends stand as above; of the ground in the box around the line. Errors as above.
Result<SightProbability> sight_probability(const RealisationOptions& options, const SightEnds& ends,
                                           const Air& air, const SightGround& ground,
                                           const ViewshedProgress& progress);

// "Probable: 1,234 posts expected to be seen, 21.7 %; ..."
std::string probable_words(const SeenProbability& probability, std::size_t cells);
// "Probability of being seen: 0.74, standard error 0.04 (...)"
std::string probable_words(const SightProbability& probability);
nlohmann::ordered_json probability_json(const SeenProbability& probability);
nlohmann::ordered_json probability_json(const SightProbability& probability);
// Adds the band and what a file says of it.
void add_probability(const SeenProbability& probability, PostRaster& raster);

}  // namespace oro
