// Colours as people write them.
#pragma once

#include <optional>
#include <string>

#include "apps/styles/colours.h"

namespace oro {

// "#e2252b"; nothing of what is none.
std::optional<ColourCodes> colour_from(const std::string& text);
std::string colour_text(const ColourCodes& colour);

}  // namespace oro
