#include "apps/view/trees_of_view.h"

#include <algorithm>

#include "core/growth/near_trees.h"
#include "shaders/shared_growth.h"

namespace oro {

const char* stands_for_trees(const View& view) {
    if (view.canopy_choice.asked()) return "the canopy";
    return view.drape.empty() ? nullptr : "the image";
}

std::string why_without_trees(const View& view) {
    if (view.trees) return "left out (--trees off)";
    const char* const others = stands_for_trees(view);
    return others == nullptr ? "" : std::string("left out, as ") + others + " stands for them";
}

bool may_stand_among_trees(const View& view, const TrueGround& ground, const Style& style) {
    if ((style.frame.materials.on & gpu::materials_with_trees) == 0 || view.show) return false;
    const Geodetic& eye = view.camera.eye;
    const auto ground_h_m = ground.h_m(eye.lat_deg, eye.lon_deg);
    return ground_h_m && eye.h_m - *ground_h_m < highest_tree_m * std::max(view.exaggeration, 1.0);
}

}  // namespace oro
