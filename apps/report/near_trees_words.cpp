#include "apps/report/near_trees_words.h"

#include <cstdio>

#include "apps/report/json_object.h"
#include "core/growth/near_trees.h"

namespace oro {

double near_trees_share(const PictureReport& report, const Camera& camera) {
    return static_cast<double>(report.near_tree_px) /
           (static_cast<double>(camera.width_px) * static_cast<double>(camera.height_px));
}

std::string near_trees_note(double share) {
    if (share < 0.5) return {};
    char text[160];
    std::snprintf(
        text, sizeof text,
        "trees within %.0f m of the eye hide %.0f %% of the picture; --trees off shows the ground, and "
        "so does a greater --above",
        near_trees_m, 100.0 * share);
    return text;
}

nlohmann::ordered_json near_trees_json(double share) {
    nlohmann::ordered_json json = json_object("within_m", near_trees_m, "share", share);
    if (const std::string note = near_trees_note(share); !note.empty()) json["note"] = note;
    return json;
}

}  // namespace oro
