#include "apps/drawing/near_mesh_words.h"

#include <cstdio>

#include "apps/report/feature_words.h"

namespace oro {

std::string near_mesh_note(const std::optional<SeenPlace>& middle) {
    constexpr double near_m = 5.0;
    if (!middle || !middle->on_mesh || middle->seen_distance_m >= near_m) return {};
    char distance[32];
    std::snprintf(distance, sizeof distance, "%.1f", middle->seen_distance_m);
    const std::string feature = middle->feature ? words_of(*middle->feature) : "";
    return (feature.empty() ? "a mesh" : feature) + " is " + distance +
           " m before the eye, in the middle of the picture: --stand-on top stands on it, and a greater "
           "--above "
           "looks over it";
}

}  // namespace oro
