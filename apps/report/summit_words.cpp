#include "apps/report/summit_words.h"

#include <cstdio>

#include "apps/report/json_object.h"
#include "apps/report/progress_bar.h"

namespace oro {

std::string summit_words(const std::string& who_stands, const MovedToSummit& moved) {
    if (moved.moved_m == 0.0) return who_stands + " on the place itself: no post nearby is higher";
    char text[240], higher[80];
    std::snprintf(higher, sizeof higher, " and %.1f m higher", moved.higher_m.value_or(0.0));
    std::snprintf(
        text, sizeof text,
        " on the highest post nearby: %.6f %.6f, H %.1f m, %.0f m from the place that was given%s%s",
        moved.to.lat_deg, moved.to.lon_deg, moved.H_m, moved.moved_m,
        moved.higher_m ? higher : " (the place itself has no height)",
        moved.goes_on_rising ? "; no summit: the ground goes on rising" : "");
    return who_stands + text;
}

std::string wall_words(const MovedToSummit& post) {
    char text[120];
    std::snprintf(text, sizeof text, "a post %.0f m away is %.1f m higher", post.moved_m,
                  post.higher_m.value_or(0.0));
    return text;
}

nlohmann::ordered_json summit_json(const MovedToSummit& moved) {
    return json_object("asked_lat_deg", moved.from.lat_deg, "asked_lon_deg", moved.from.lon_deg, "lat_deg",
                       moved.to.lat_deg, "lon_deg", moved.to.lon_deg, "H_m", moved.H_m, "moved_m",
                       moved.moved_m, "higher_m",
                       moved.higher_m ? nlohmann::ordered_json(*moved.higher_m) : nlohmann::ordered_json(),
                       "goes_on_rising", moved.goes_on_rising);
}

void say_summit(const std::optional<MovedToSummit>& moved, bool quiet) {
    if (moved) say(quiet, summit_words("the eye stands", *moved));
}

void say_wall(const std::optional<MovedToSummit>& wall, bool quiet) {
    if (wall) say(quiet, "note: " + wall_words(*wall) + "; --on-summit stands there");
}

}  // namespace oro
