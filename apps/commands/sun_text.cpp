#include "apps/commands/sun_text.h"

#include <cmath>
#include <cstdio>

#include "apps/report/json_object.h"
#include "apps/report/json_text.h"
#include "apps/report/summit_words.h"
#include "apps/view/model_names.h"

namespace oro {
namespace {

using nlohmann::ordered_json;

std::string time_there(const SunReport& report, std::int64_t time_utc_s) {
    std::string text = time_text(time_utc_s + report.east_s);
    text.pop_back();
    return text + report.zone;
}

// The first of the disc, or the last: nothing where the day has none.
const SunReport::Crossing* first_light(const SunReport::Light& light) {
    for (const SunReport::Crossing& crossing : light.crossings) {
        if (crossing.rising) return &crossing;
    }
    return nullptr;
}
const SunReport::Crossing* last_light(const SunReport::Light& light) {
    for (std::size_t i = light.crossings.size(); i-- > 0;) {
        if (!light.crossings[i].rising) return &light.crossings[i];
    }
    return nullptr;
}

std::string crossing_text(const SunReport& report, const SunReport::Crossing* crossing) {
    if (!crossing) return "none this day";
    char where[80];
    std::snprintf(where, sizeof where, ", at %.1f degrees", crossing->azimuth_deg);
    const std::string text = time_there(report, crossing->time_utc_s) + where;
    if (!crossing->data_reach_m) return text;
    std::snprintf(where, sizeof where, " (data reach %.0f km)", *crossing->data_reach_m / 1000.0);
    return text + where;
}

std::string duration_text(double seconds) {
    char text[60];
    const auto minutes = static_cast<int>(std::lround(seconds / 60.0));
    std::snprintf(text, sizeof text, "%d h %02d min of sun", minutes / 60, minutes % 60);
    return text;
}

// The lines of one horizon.
std::string light_text(const SunReport& report, const SunReport::Light& light, const std::string& over,
                       const char* all_day, const char* never) {
    std::string text = over + ":\n";
    if (light.day == SunDay::up_all_day) return text + "    " + all_day + "\n";
    if (light.day == SunDay::down_all_day) return text + "    " + never + "\n";
    text += "    first light  " + crossing_text(report, first_light(light)) + "\n";
    text += "    last light   " + crossing_text(report, last_light(light)) + "\n";
    for (std::size_t i = 0; i + 1 < light.crossings.size(); ++i) {
        const SunReport::Crossing &from = light.crossings[i], &to = light.crossings[i + 1];
        if (!from.rising && to.rising)
            text += "    hidden       " + time_there(report, from.time_utc_s) + " to " +
                    time_there(report, to.time_utc_s) + "\n";
    }
    return text + "    " + duration_text(light.sunlight_s) + "\n";
}

std::string place_text(const SunReport& report) {
    char text[160];
    std::snprintf(text, sizeof text, "Place: %.6f %.6f", report.place.lat_deg, report.place.lon_deg);
    std::string line = text;
    if (report.H_m) {
        std::snprintf(text, sizeof text, ", H %.0f m", *report.H_m);
        line += text;
    }
    if (report.above_ground_m) {
        std::snprintf(text, sizeof text, ", %.0f m above the ground", *report.above_ground_m);
        line += text;
    }
    if (report.moved) line += "\nSummit: " + summit_words("the eye stands", *report.moved);
    return line + "\n";
}

const char* key_of(SunDay day) {
    switch (day) {
        case SunDay::rises_or_sets:
            return "rises_or_sets";
        case SunDay::up_all_day:
            return "up_all_day";
        case SunDay::down_all_day:
            return "down_all_day";
    }
    return "";
}

ordered_json crossing_json(const SunReport& report, const SunReport::Crossing* crossing) {
    if (!crossing) return nullptr;
    ordered_json json =
        json_object("time", time_there(report, crossing->time_utc_s), "time_utc_s", crossing->time_utc_s,
                    "rising", crossing->rising, "azimuth_deg", crossing->azimuth_deg);
    if (crossing->data_reach_m) json["data_reach_m"] = *crossing->data_reach_m;
    return json;
}

ordered_json light_json_of(const SunReport& report, const SunReport::Light& light) {
    ordered_json json = json_object("day", key_of(light.day), "sunlight_s", light.sunlight_s);
    json["first_light"] = crossing_json(report, first_light(light));
    json["last_light"] = crossing_json(report, last_light(light));
    json["crossings"] = ordered_json::array();
    for (const SunReport::Crossing& crossing : light.crossings)
        json["crossings"].push_back(crossing_json(report, &crossing));
    return json;
}

}  // namespace

std::string sun_text(const SunReport& report) {
    std::string text = place_text(report);
    text += "Day: " + report.date + ", 24 hours around solar noon, from " +
            time_there(report, report.light_from_utc_s) + "\n";
    if (report.terrain)
        text += light_text(report, *report.terrain, "Over the terrain (where the data end, over the sea)",
                           "the sun shows all day", "the sun does not show");
    text += light_text(report, report.plain, "Over a plain horizon", "polar day: the sun does not set",
                       "polar night: the sun does not rise");
    if (report.night)
        text += "    night        " + time_there(report, report.night->from_utc_s) + " to " +
                time_there(report, report.night->to_utc_s) + "\n";
    char noon[80];
    std::snprintf(noon, sizeof noon, ", %.1f degrees high", report.noon.elevation_deg);
    return text + "Solar noon: " + time_there(report, report.noon_utc_s) + noon + "\n";
}

ordered_json sun_json(const SunReport& report) {
    ordered_json json = ordered_json::object();
    ordered_json& place = json["place"] =
        json_object("lat_deg", report.place.lat_deg, "lon_deg", report.place.lon_deg);
    for (const char* name : {"h_m", "H_m", "above_ground_m"}) place[name] = nullptr;
    if (report.H_m) place["h_m"] = report.place.h_m;
    if (report.H_m) place["H_m"] = *report.H_m;
    if (report.above_ground_m) place["above_ground_m"] = *report.above_ground_m;
    json["date"] = report.date;
    if (report.moved) json["on_summit"] = summit_json(*report.moved);
    json["from"] = time_there(report, report.from_utc_s);
    json["from_utc_s"] = report.from_utc_s;
    json["light_from"] = time_there(report, report.light_from_utc_s);
    json["light_from_utc_s"] = report.light_from_utc_s;
    json["terrain"] = nullptr;
    if (report.terrain) json["terrain"] = light_json_of(report, *report.terrain);
    json["plain"] = light_json_of(report, report.plain);
    json["night"] = nullptr;
    if (report.night)
        json["night"] = json_object(
            "from", time_there(report, report.night->from_utc_s), "from_utc_s", report.night->from_utc_s,
            "to", time_there(report, report.night->to_utc_s), "to_utc_s", report.night->to_utc_s);
    json["noon"] =
        json_object("time", time_there(report, report.noon_utc_s), "time_utc_s", report.noon_utc_s,
                    "azimuth_deg", report.noon.azimuth_deg, "elevation_deg", report.noon.elevation_deg);
    json["light"] = nullptr;
    if (report.air) json["light"] = light_json(*report.air, report.place.h_m);
    json["notes"] = report.notes;
    return json;
}

}  // namespace oro
