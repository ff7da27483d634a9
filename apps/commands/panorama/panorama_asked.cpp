#include "apps/commands/panorama/panorama_asked.h"

#include <string>
#include <string_view>
#include <utility>

#include "apps/command_line/refusals.h"
#include "apps/command_line/whole_text.h"
#include "apps/options/view_limits.h"
#include "apps/view/view_option_table.h"

namespace oro {
namespace {

// Options of views that say nothing of a panorama, or something that it says in another way.
Result<void> refuse_others(const ViewOptions& view) {
    if (const char* const option = first_given_of(view_option_table(), view,
                                                  {"--heading", "--pitch", "--roll", "--look-at", "--fov"}))
        return refused(option, "",
                       "a panorama looks around at level height: give --sector FROM,TO and --elevation");
    if (view.size) return refused("--size", "", "give --width PX: the height follows from the elevations");
    if (view.labels) return refused("--labels", "", "a panorama has none");
    if (view.tolerance)
        return refused("--tolerance", "", "is for shot: give --accuracy or --tau to a panorama");
    return {};
}

// "90,200"
Result<std::pair<double, double>> two_numbers(const char* option, const std::string& text, const char* must,
                                              const Limits& limits) {
    const std::size_t comma = text.find(',');
    const std::string_view all(text);
    std::pair<double, double> numbers;
    if (comma == std::string::npos || !read_whole(all.substr(0, comma), numbers.first) ||
        !read_whole(all.substr(comma + 1), numbers.second))
        return refused(option, text, must);
    if (!limits.hold(numbers.first) || !limits.hold(numbers.second))
        return refused(option, text, "each of the two " + between_words(limits.low, limits.high));
    return numbers;
}

}  // namespace

Result<void> check_panorama_view(const PanoramaOptions& options) {
    ORO_CHECK(refuse_others(options.view));
    if (!options.view.at && options.view_file.empty())
        return refused("--at", "", "is missing: name the place, e.g. --at 46.67,8.06");
    return {};
}

Result<AskedFrame> asked_frame(const PanoramaOptions& options) {
    AskedFrame asked;
    if (!options.sector.empty()) {
        ORO_TRY(const auto between,
                two_numbers("--sector", options.sector,
                            "must be FROM,TO in degrees clockwise from north, e.g. 90,200",
                            view_limits::azimuth_deg));
        const double turn_deg = between.second - between.first,
                     sweep_deg = turn_deg == 360.0 ? 360.0 : turned_deg(turn_deg);
        if (!view_limits::sweep_deg.hold(sweep_deg))
            return refused("--sector", options.sector, "is empty: it must be 0.1 degree wide or more");
        asked.sector = {turned_deg(between.first), sweep_deg};
    }
    if (!options.elevation.empty()) {
        ORO_TRY(asked.elevation, two_numbers("--elevation", options.elevation,
                                             "must be LOW,HIGH in degrees above level, e.g. -12,6",
                                             view_limits::elevation_deg));
        if (!(asked.elevation->second - asked.elevation->first >= view_limits::least_elevations_deg))
            return refused("--elevation", options.elevation,
                           "is empty: the second must be higher than the first");
    }
    if (options.ridges) asked.ridges = *options.ridges == "on";
    asked.width_px = options.width_px;
    if (options.view_file.empty()) return asked;
    if (asked.sector)
        return refused("--sector", "", "not together with --view, which has a sector of its own");
    if (asked.elevation)
        return refused("--elevation", "", "not together with --view, which has elevations of its own");
    return asked;
}

ViewOptions view_options_of(const PanoramaOptions& options) {
    ViewOptions view = options.view;
    view.stands_at_place = true;
    if (options.view_file.empty() && !view.air && !view.refraction_k && !view.accuracy) view.air = "standard";
    return view;
}

}  // namespace oro
