// What is said of a picture whose eye stands right before a mesh, or in one.
#pragma once

#include <optional>
#include <string>

#include "apps/drawing/picking.h"

namespace oro {

// "Building h1 is 2.1 m before the eye, in the middle of the picture: --stand-on top stands on it, and a
// greater --above looks over it"; "" where there is no mesh within 5 m. middle: what the picture sees there.
std::string near_mesh_note(const std::optional<SeenPlace>& middle);

}  // namespace oro
