// What a view has in the place of a style's invented trees.
#pragma once

#include <string>

#include "apps/view/style.h"
#include "apps/view/view.h"
#include "core/truth/true_ground.h"

namespace oro {

// What shows the ground's own trees, so that invented ones would stand on top: "the canopy", "the image";
// null where nothing does. Only --trees on draws both.
const char* stands_for_trees(const View& view);

// Why a style of materials draws no trees in a view: "left out (--trees off)", "left out, as the canopy
// stands for them"; "" where the view says nothing of them.
std::string why_without_trees(const View& view);

// Whether the eye may stand among the trees of a style: there are some, and it is lower over the ground than
// they are high.
bool may_stand_among_trees(const View& view, const TrueGround& ground, const Style& style);

}  // namespace oro
