#include "apps/commands/sight/viewshed_question.h"

#include <cmath>

#include "apps/command_line/refusals.h"
#include "apps/cover/canopy_words.h"
#include "apps/report/figures.h"
#include "apps/view/mesh_request.h"
#include "apps/view/view.h"

namespace oro {
namespace {

// An observer in a canopy sees nothing: a viewshed of that is a mistake.
Result<void> check_eyes(const std::vector<Standing>& eyes, const ViewshedQuestion& question,
                        const SightGround& ground) {
    for (std::size_t i = 0; i < question.eyes.size(); ++i) {
        const std::optional<double> below_m = ground.in_canopy_m(question.eyes[i]);
        if (!below_m) continue;
        const double above_m = ground.above_m(question.eyes[i]).value_or(0.0);
        return refused(eyes[i].place_option, eyes[i].place,
                       "the observer stands in the canopy, " + metres_words(*below_m) +
                           " below its top, and sees nothing: " + eyes[i].above_option + " " +
                           figure(std::ceil(10.0 * (above_m + *below_m) + 0.01) / 10.0) + " looks over it");
    }
    return {};
}

}  // namespace

Result<void> check_viewshed(const ViewshedOptions& options) {
    for (const std::string& at : options.at) {
        if (const auto place = place_at("--at", at); !place.ok()) return place.error();
    }
    if (options.radius_km && !(*options.radius_km >= least_radius_km && *options.radius_km <= most_radius_km))
        return refused("--radius", all_digits(*options.radius_km),
                       between_words(least_radius_km, most_radius_km));
    ORO_CHECK(check_above("--target", options.target_m));
    return {};
}

Result<void> check_target_on(const ViewshedOptions& options) {
    if (options.target_on == "top") {
        // Whether there is any is known once the region is open: a baked one may have meshes.
        ORO_CHECK(mesh_request(options.region));
        return {};
    }
    if (options.target_on && options.view.canopy.empty())
        return refused("--target-on", *options.target_on, "needs --canopy");
    return {};
}

Result<void> begin_question(const ViewshedOptions& options, ViewshedQuestion& question) {
    if (!options.at.empty()) question.at = options.at.front();
    question.target_m = options.target_m.value_or(0.0);
    question.radius_km = options.radius_km.value_or(usual_radius_km);
    ORO_TRY(question.air, air_asked_for(options.view.refraction_k, options.view.air, standard_air));
    return {};
}

std::vector<Standing> asked_eyes(const ViewshedOptions& options) {
    std::vector<Standing> eyes;
    for (const std::string& at : options.at) {
        Standing standing{"--at", at, "--above", options.above_m, 2.0, options.altitude_m};
        standing.on_summit = options.on_summit;
        standing.on_top = options.view.stand_on.value_or("ground") == "top";
        eyes.push_back(std::move(standing));
    }
    return eyes;
}

Result<void> place_eyes(const std::vector<Standing>& eyes, bool targets_on_canopy, const SightGround& ground,
                        ViewshedQuestion& question, Standpoints& standpoints) {
    for (const Standing& standing : eyes) {
        ORO_TRY(const Standpoint stood, stand_over_ground(standing, ground));
        question.eyes.push_back(stood.eye);
        if (stood.moved) standpoints.moved.push_back(*stood.moved);
        if (stood.wall) standpoints.walls.emplace_back(standing.place, *stood.wall);
    }
    ORO_CHECK(check_eyes(eyes, question, ground));
    if (ground.canopy && !targets_on_canopy) question.footing = &ground.ground();
    return {};
}

void add_canopy_tags(const SightGround& ground, const std::string& targets_stand_on, PostRaster& raster) {
    if (!ground.canopy) return;
    raster.tags.emplace_back("CANOPY", canopy_words(*ground.canopy->map, ground.canopy->region));
    raster.tags.emplace_back("TARGETS_STAND_ON", targets_stand_on);
}

}  // namespace oro
