// What a view has in the place of a style's invented trees.
#pragma once

#include <string>

#include "apps/view/view.h"

namespace oro {

// What shows the ground's own trees, so that invented ones would stand on top: "the canopy", "the image";
// null where nothing does. Only --trees on draws both.
const char* stands_for_trees(const View& view);

// Why a style of materials draws no trees in a view: "left out (--trees off)", "left out, as the canopy
// stands for them"; "" where the view says nothing of them.
std::string why_without_trees(const View& view);

}  // namespace oro
