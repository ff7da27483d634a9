#include "apps/window/seen_around.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "apps/commands/sight/seen_probability.h"
#include "apps/commands/sight/viewshed_question.h"
#include "apps/view/model_names.h"
#include "geo/canopy/raised_region.h"

namespace oro {
namespace {

void tint_by(const std::vector<float>& share, PostColours& colours) {
    for (std::size_t post = 0; post < share.size(); ++post) {
        if (share[post] == Viewshed::unknown) continue;
        const ProbabilityColour one = colour_of_probability(double{share[post]});
        colours.rgba[post] = texel_of(one.rgb[0], one.rgb[1], one.rgb[2], one.alpha);
    }
}

}  // namespace

ProbabilityColour colour_of_probability(double share) {
    // From what is hidden (colours_of) through violet and red to what is seen.
    constexpr std::array<std::array<double, 4>, 5> stops{{{16.0, 22.0, 44.0, 0.4},
                                                          {84.0, 40.0, 118.0, 0.5},
                                                          {190.0, 48.0, 84.0, 0.55},
                                                          {240.0, 104.0, 40.0, 0.55},
                                                          {255.0, 176.0, 32.0, 0.55}}};
    const double along = 4.0 * std::clamp(share, 0.0, 1.0);
    const std::size_t first = std::min<std::size_t>(3, static_cast<std::size_t>(along));
    const double rest = along - static_cast<double>(first);
    const auto mixed = [&](std::size_t part) {
        return std::lerp(stops[first][part], stops[first + 1][part], rest);
    };
    const auto code = [&](std::size_t part) { return static_cast<std::uint8_t>(std::lround(mixed(part))); };
    return {{code(0), code(1), code(2)}, mixed(3)};
}

std::string at_text(const LatLon& place) {
    char text[60];
    std::snprintf(text, sizeof text, "%.9f,%.9f", place.lat_deg, place.lon_deg);
    return text;
}

Air air_around(const SeenAroundChoice& choice, const Air& of_view) {
    return choice.bends && of_view.k == 0.0 ? standard_air : of_view;
}

namespace {

// How probable it is that posts are seen. `canopied`: the ground with its canopy, null without one.
Result<SeenProbability> probability_of(const SeenAroundChoice& choice, const ViewshedReport& report,
                                       const Region& region, const RegionGround& ground,
                                       const SightGround* canopied,
                                       const std::function<void(double share)>& tell_share,
                                       const std::stop_token& stop) {
    RealisationOptions options;
    options.count = choice.realisations;
    if (choice.le90_m > 0.0) options.le90_m = choice.le90_m;
    ORO_CHECK(check_realisations(options));
    // Looking once takes as long as one realisation.
    const auto tell_second = [&](double share) {
        if (tell_share) tell_share((1.0 + share * choice.realisations) / (1.0 + choice.realisations));
    };
    const Geodetic& eye = report.question.eyes.front();
    if (canopied != nullptr) {
        const Standing standing{"--at", report.question.at, "--above", choice.above_m, 2.0, std::nullopt};
        return seen_probability(options, report, *canopied, {standing}, tell_second);
    }
    const double above_m = ground.ground().h_m(eye.lat_deg, eye.lon_deg).value_or(eye.h_m);
    return seen_probability(options, report, region, ground, {eye.h_m - above_m}, tell_second, stop);
}

}  // namespace

Result<SeenAround> seen_around(const SeenAroundChoice& choice, const Air& air, const Region& region,
                               const RegionCuts& cuts, const SightCover& cover,
                               const std::function<void(double share)>& tell_share,
                               const std::stop_token& stop) {
    ViewshedQuestion question;
    question.at = at_text(choice.place);
    question.air = air;
    question.target_m = choice.target_m;
    question.radius_km = choice.radius_km;
    const Standing standing{"--at", question.at, "--above", choice.above_m, 2.0, std::nullopt};
    // Heights count as they are, however they are drawn.
    std::unique_ptr<const SightGround> canopied;
    std::unique_ptr<const RegionGround> own;
    if (cover.canopy) {
        ORO_TRY(canopied, sight_ground_of(ground_of_raised(region), cover));
        Standpoints standpoints;
        ORO_CHECK(place_eyes({standing}, false, *canopied, question, standpoints));
    } else {
        ORO_TRY(own, RegionGround::of(region, cuts, 1.0));
        ORO_TRY(const Standpoint stood, stand_over_ground(standing, region, own->ground()));
        question.eyes = {stood.eye};
    }
    const RegionGround& ground = canopied ? *canopied->grids : *own;
    const RegionGround& hiding = canopied ? *canopied->canopy->grids : *own;
    const auto tell_first = [&](double share) {
        if (tell_share) tell_share(choice.is_probable ? share / (1.0 + choice.realisations) : share);
    };
    ORO_TRY(ViewshedReport report, viewshed_report(question, hiding, tell_first, stop));
    SeenAround around;
    std::optional<SeenProbability> probability;
    if (choice.is_probable) {
        ORO_TRY(probability,
                probability_of(choice, report, region, ground, canopied.get(), tell_share, stop));
        around.probable = probable_words(*probability, report.cells);
    }
    around.seen = seen_words(report);
    around.from = eye_text(question.eyes.front(), ground.ground());
    around.light = light_words(air, question.eyes.front().h_m);
    PostColours colours = colours_of(report, hiding);
    if (probability) tint_by(probability->share, colours);
    around.colours = std::make_shared<PostColours>(std::move(colours));
    around.raster = raster_of(report, ground);
    if (canopied) add_canopy_tags(*canopied, "ground", around.raster);
    if (probability) add_probability(*probability, around.raster);
    return around;
}

}  // namespace oro
