#include "apps/window/seen_around.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "apps/commands/sight/seen_probability.h"
#include "apps/commands/sight/sight_ground.h"
#include "apps/view/model_names.h"

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

Result<SeenAround> seen_around(const SeenAroundChoice& choice, const Air& air, const Region& region,
                               const RegionCuts& cuts, const std::function<void(double share)>& tell_share,
                               const std::stop_token& stop) {
    // Heights count as they are, however they are drawn.
    ORO_TRY(const auto ground, RegionGround::of(region, cuts, 1.0));
    ViewshedQuestion question;
    question.at = at_text(choice.place);
    question.air = air;
    question.target_m = choice.target_m;
    question.radius_km = choice.radius_km;
    const Standing standing{"--at", question.at, "--above", choice.above_m, 2.0, std::nullopt};
    ORO_TRY(const Standpoint stood, stand_over_ground(standing, region, ground->ground()));
    question.eyes = {stood.eye};
    const auto tell_first = [&](double share) {
        if (tell_share) tell_share(choice.is_probable ? share / (1.0 + choice.realisations) : share);
    };
    ORO_TRY(ViewshedReport report, viewshed_report(question, *ground, tell_first, stop));
    SeenAround around;
    std::optional<SeenProbability> probability;
    if (choice.is_probable) {
        RealisationOptions options;
        options.count = choice.realisations;
        if (choice.le90_m > 0.0) options.le90_m = choice.le90_m;
        ORO_CHECK(check_realisations(options));
        // Looking once takes as long as one realisation.
        const auto tell_second = [&](double share) {
            if (tell_share) tell_share((1.0 + share * choice.realisations) / (1.0 + choice.realisations));
        };
        const double above_m =
            ground->ground().h_m(stood.eye.lat_deg, stood.eye.lon_deg).value_or(stood.eye.h_m);
        ORO_TRY(probability, seen_probability(options, report, region, *ground, {stood.eye.h_m - above_m},
                                              tell_second, stop));
        around.probable = probable_words(*probability, report.cells);
    }
    around.seen = seen_words(report);
    around.from = eye_text(stood.eye, ground->ground());
    around.light = light_words(air, stood.eye.h_m);
    PostColours colours = colours_of(report, *ground);
    if (probability) tint_by(probability->share, colours);
    around.colours = std::make_shared<PostColours>(std::move(colours));
    around.raster = raster_of(report, *ground);
    if (probability) add_probability(*probability, around.raster);
    return around;
}

}  // namespace oro
