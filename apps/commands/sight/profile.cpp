// orograph profile: how high the ground is along a line.
#include <cmath>
#include <cstdio>

#include "apps/command_line/refusals.h"
#include "apps/commands/commands.h"
#include "apps/commands/sight/look_along.h"
#include "apps/commands/sight/profile_along.h"
#include "apps/commands/sight/profile_text.h"
#include "apps/commands/sight/sight_ground.h"
#include "apps/options/region_option_table.h"
#include "apps/output/overwrite_guard.h"
#include "apps/report/json_text.h"
#include "apps/report/progress_bar.h"
#include "apps/report/region_json.h"
#include "apps/view/view.h"
#include "geo/files/letter_case.h"
#include "geo/files/whole_file.h"

namespace oro {
namespace {

Result<void> check_words(const ProfileOptions& options) {
    if (options.along.empty())
        return refused(
            "--along", "",
            "is missing: name a file with a line, or places, e.g. --along \"46.57,7.99; 46.62,8.05\"");
    ORO_CHECK(check_steps(options));
    if (options.out.empty()) return {};
    const std::string name = lower_case(options.out);
    if (!name.ends_with(".csv") && !name.ends_with(".svg") && !name.ends_with(".geojson"))
        return refused("--out", options.out, "the file's name must end in .csv, .svg or .geojson");
    return check_may_write(options.out, options.overwrite);
}

Result<void> write(const ProfileOptions& options, const Profile& profile) {
    return write_whole_file(options.out, profile_file_text(profile, lower_case(options.out)),
                            options.overwrite);
}

}  // namespace

Result<void> run_profile(const ProfileOptions& options) {
    ORO_CHECK(check_words(options));
    Profile profile;
    ORO_TRY(profile.line, line_along(options.along, options.line));
    ORO_CHECK(check_length(options, profile.line));
    ProgressBar bar(options.quiet);
    ORO_TRY(const auto ground, open_sight_ground(options.region, bar.progress()));
    if (!options.out.empty())
        ORO_CHECK(spare_inputs({options.out}, {files_of_ground(options.region.paths, ground->region),
                                               {{profile.line.file}, "which the line is read from"}}));
    bar.show(1.0, "following the line");
    ORO_CHECK(follow_line(options, *ground, profile));
    if (lower_case(options.out).ends_with(".geojson"))
        profile.crossings = crossings_of(profile.line, profile.points, ground->ground());
    ORO_CHECK(ground->region.health());
    bar.clear();
    ORO_CHECK(check_has_ground(options, *ground, profile));
    for (const std::string& note : profile.line.notes) say(options.quiet, "note: " + note);
    say_notes(ground->region, options.quiet);
    if (!options.out.empty()) ORO_CHECK(write(options, profile));
    if (options.json) {
        nlohmann::ordered_json json = profile_json(profile);
        json["notes"] = all_notes(ground->region);
        std::printf("%s\n", json_text(json, true).c_str());
    } else {
        std::fputs(profile_text(profile).c_str(), stdout);
    }
    if (!options.out.empty()) say(options.quiet, "wrote " + options.out);
    return {};
}

}  // namespace oro
