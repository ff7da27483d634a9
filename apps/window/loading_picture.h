// What a window shows while no ground is there yet.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/result.h"

namespace oro {

// A plain sheet with the words "loading the ground", as RGBA rows of four bytes a pixel. It looks like
// nothing that a view shows: neither like ground, nor like places without data. Errors: no memory for the
// font.
Result<std::vector<std::uint8_t>> loading_picture(int width_px, int height_px);

}  // namespace oro
