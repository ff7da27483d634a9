#include "apps/detail/detail_words.h"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "apps/report/json_object.h"

namespace oro {

std::string detail_words(const GridDetail& detail) {
    const auto metres = [](double m) {
        char text[40];
        std::snprintf(text, sizeof text, "%.*f m", m < 9.95 ? 1 : 0, m);
        return std::string(text);
    };
    char radius[40];
    std::snprintf(radius, sizeof radius, "%.3g km", detail.radius_km);
    return std::string("Ground between posts: invented within ") + radius + ", " + metres(detail.rms_m) +
           " r.m.s. and up to " + metres(detail.largest_m) +
           " off the data's surface; none on water and ice" +
           (detail.by_cover ? " nor on built land, by the land cover" : ", by a rule of height and slope");
}

nlohmann::ordered_json detail_json(const GridDetail& detail) {
    nlohmann::ordered_json json = json_object("halvings", detail.halvings, "radius_km", detail.radius_km,
                                              "lat_deg", detail.lat_deg, "lon_deg", detail.lon_deg);
    json["invented"] = true;
    json["rms_m"] = detail.rms_m;
    json["largest_m"] = detail.largest_m;
    json["posts"] = detail.posts;
    json["posts_on_data"] = detail.still;
    json["none_on"] = detail.by_cover ? "landcover" : "rule";
    return json;
}

}  // namespace oro
