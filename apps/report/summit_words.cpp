#include "apps/report/summit_words.h"

#include <cstdio>

#include "apps/report/json_object.h"
#include "apps/report/progress_bar.h"

namespace oro {

std::string summit_words(const std::string& who_stands, const MovedToSummit& moved) {
    if (moved.moved_m == 0.0) return who_stands + " on the place itself: no post nearby is higher";
    char text[200];
    std::snprintf(
        text, sizeof text,
        " on the highest post nearby: %.6f %.6f, H %.1f m, %.0f m from the place that was given and "
        "%.1f m higher",
        moved.to.lat_deg, moved.to.lon_deg, moved.H_m, moved.moved_m, moved.higher_m);
    return who_stands + text;
}

nlohmann::ordered_json summit_json(const MovedToSummit& moved) {
    return json_object("asked_lat_deg", moved.from.lat_deg, "asked_lon_deg", moved.from.lon_deg, "lat_deg",
                       moved.to.lat_deg, "lon_deg", moved.to.lon_deg, "H_m", moved.H_m, "moved_m",
                       moved.moved_m, "higher_m", moved.higher_m);
}

void say_summit(const std::optional<MovedToSummit>& moved, bool quiet) {
    if (moved) say(quiet, summit_words("the eye stands", *moved));
}

}  // namespace oro
