#include "apps/window/seen_around.h"

#include <cstdio>
#include <utility>

#include "apps/commands/sight/sight_ground.h"
#include "apps/view/model_names.h"

namespace oro {

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
    ORO_TRY(ViewshedReport report, viewshed_report(question, *ground, tell_share, stop));
    SeenAround around;
    around.seen = seen_words(report);
    around.from = eye_text(stood.eye, ground->ground());
    around.light = light_words(air, stood.eye.h_m);
    around.colours = std::make_shared<PostColours>(colours_of(report, *ground));
    around.raster = raster_of(report, *ground);
    return around;
}

}  // namespace oro
