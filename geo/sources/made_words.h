// Made terrain as people write it: made:fbm?seed=7&octaves=9&H=-200:4000&spacing=1s&box=8,46,9,47
#pragma once

#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/made/made_terrain.h"

namespace oro {

// True for a text that stands where a path may and means made terrain: one that begins with "made:".
bool is_made(std::string_view path);

// The terrain that such a text describes. Usage errors, with the text as their place: a kind or a key that is
// not known, or given twice, or that the kind does not have; a value that is no number or out of its range; a
// box that is none, or so small that it holds fewer than 2 x 2 posts; more posts than a grid can have.
Result<MadeTerrain> made_terrain_of(const std::string& text);

}  // namespace oro
