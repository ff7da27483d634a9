// --overwrite is for what the program writes: what a picture is made from is never replaced by it.
#pragma once

#include <string>
#include <vector>

#include "apps/view.h"
#include "geo/region.h"

namespace oro {

// Errors (usage): a file to be written is the style or one of the elevation data of a view.
Result<void> spare_inputs(const std::vector<std::string>& written, const View& view, const Region& region);

}  // namespace oro
