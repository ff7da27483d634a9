#include "apps/view/trees_of_view.h"

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

}  // namespace oro
