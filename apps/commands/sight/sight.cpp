// orograph sight: whether one place is seen from another, by how much, and what stands in the way.
#include <cstdio>
#include <utility>

#include "apps/command_line/refusals.h"
#include "apps/commands/commands.h"
#include "apps/commands/sight/seen_probability.h"
#include "apps/commands/sight/sight_between.h"
#include "apps/cover/canopy_words.h"
#include "apps/report/json_text.h"
#include "apps/report/progress_bar.h"
#include "apps/report/region_json.h"
#include "apps/report/summit_words.h"
#include "apps/view/view.h"

namespace oro {
namespace {

// What stands before the eye, or is the summit that the target is not.
void say_walls(const Standpoint& from, const Standpoint& target, bool quiet) {
    say_wall(from.wall, quiet);
    if (target.wall)
        say(quiet, "note: the target: " + wall_words(*target.wall) + "; --target-on-summit stands there");
}

// Names the land cover at the places that are told of.
Result<void> name_cover(const CoverMap& cover, SightReport& report) {
    const auto name = [&](const Geodetic& place, std::string& words) -> Result<void> {
        ORO_TRY(const int code, cover.code_at(place.lat_deg, place.lon_deg));
        words = cover.name_of(code);
        return {};
    };
    ORO_CHECK(name(report.from, report.from_cover));
    ORO_CHECK(name(report.to, report.to_cover));
    return report.obstacle ? name(report.obstacle->point, report.obstacle_cover) : Result<void>();
}

bool stands_on_top(const SightOptions& options) {
    return options.view.stand_on.value_or("ground") == "top";
}

Standing asked_eye(const SightOptions& options) {
    Standing eye{"--from", options.from, "--above", options.above_m, 2.0, options.altitude_m};
    eye.on_summit = options.on_summit;
    eye.on_top = stands_on_top(options);
    return eye;
}

Standing asked_target(const SightOptions& options) {
    Standing target{"--to", options.to,   "--target",          options.target_m,
                    0.0,    std::nullopt, "geo:LAT,LON,HEIGHT"};
    target.on_summit = options.target_on_summit;
    target.summit_option = "--target-on-summit";
    target.on_top = stands_on_top(options);
    return target;
}

void say_canopy(const SightGround& ground, const SightReport& report, bool quiet) {
    if (!ground.canopy) return;
    for (const std::string& note : ground.canopy->map->notes()) say(quiet, "note: " + note);
    for (const std::string& note : notes_of_canopy(ground.canopy->region)) say(quiet, "note: " + note);
    if (const auto below_m = ground.in_canopy_m(report.from))
        say(quiet, "note: the eye stands in the canopy, " + metres_words(*below_m) +
                       " below its top, and sees nothing: a larger --above looks over it");
}

}  // namespace

Result<void> run_sight(const SightOptions& options, const RealisationOptions& realisations) {
    if (options.from.empty())
        return refused("--from", "", "is missing: name the place, e.g. --from 46.67,8.06");
    if (options.to.empty()) return refused("--to", "", "is missing: name the place, e.g. --to 46.54,7.96");
    // What is wrong with the words is said before anything is read.
    for (const auto& [option, text] : {std::pair{"--from", options.from}, std::pair{"--to", options.to}}) {
        if (const auto place = place_at(option, text); !place.ok()) return place.error();
    }
    ORO_CHECK(check_realisations(realisations));
    ORO_TRY(const Air air, air_asked_for(options.view.refraction_k, options.view.air, standard_air));
    ORO_TRY(const SightCover asked, open_sight_cover(options.view));
    const std::shared_ptr<const CoverMap>& cover = asked.cover;
    ProgressBar bar(options.quiet);
    ORO_TRY(const auto ground, open_sight_ground(options.region, bar.progress(), asked));
    const Standing standing = asked_eye(options), looked_at = asked_target(options);
    ORO_TRY(const Standpoint from, stand_over_ground(standing, *ground));
    ORO_TRY(const Standpoint target, stand_over_ground(looked_at, *ground));
    const Geodetic& to = target.eye;
    bar.show(1.0, "looking");
    SightReport report = sight_between(from.eye, to, air, *ground);
    report.moved = from.moved;
    report.target_moved = target.moved;
    std::optional<SightProbability> probability;
    if (realisations.count && report.slant_m > least_above_m) {
        ORO_TRY(probability,
                sight_probability(
                    realisations, {from.eye, to, keeps_height(standing), keeps_height(looked_at)}, air,
                    *ground, [&](double share) { bar.show(share, "looking in realisations"); }));
    }
    ORO_CHECK(ground->region.health());
    if (cover) ORO_CHECK(name_cover(*cover, report));
    bar.clear();
    if (report.slant_m <= least_above_m)
        return refused("--to", options.to, "is where --from is: there is no line between them");
    say_notes(ground->region, options.quiet);
    if (cover)
        for (const std::string& note : cover->notes()) say(options.quiet, "note: " + note);
    say_canopy(*ground, report, options.quiet);
    say_walls(from, target, options.quiet);
    if (report.line.without_data_m > 0.5) {
        char note[160];
        std::snprintf(
            note, sizeof note,
            "note: %.2f km of the line lie over no data; ground that is there could hide the target",
            report.line.without_data_m / 1000.0);
        say(options.quiet, note);
    }
    if (!options.json) {
        std::fputs(sight_text(report, *ground).c_str(), stdout);
        if (probability) std::printf("%s\n", probable_words(*probability).c_str());
        return {};
    }
    nlohmann::ordered_json json = sight_json(report, *ground);
    if (probability) json["realisations"] = probability_json(*probability);
    json["notes"] = all_notes(ground->region);
    std::printf("%s\n", json_text(json, true).c_str());
    return {};
}

}  // namespace oro
