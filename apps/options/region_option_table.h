// The tables of the options of elevation data and of memory.
#pragma once

#include <vector>

#include "apps/options/option_table.h"
#include "apps/options/options.h"
#include "core/base/result.h"

namespace oro {

// The rows of the options that say which terrain, in the order of help.
const std::vector<OptionRow<RegionOptions>>& region_option_table();
// The rows of the options that say how much memory it may take.
const std::vector<OptionRow<MemoryOptions>>& memory_option_table();

// The name of the first option that was given which says how data are read or which part of them is taken;
// nothing where there is none. The paths of the data are not among these.
const char* first_given_of_region(const RegionOptions& options);

// Whether a mesh is named, by --mesh-file or as a PATH.
bool names_any_mesh(const RegionOptions& options);
// A usage error where meshes are given to what asks the terrain alone. what: that it does, "viewsheds are of
// terrain alone".
Result<void> check_without_meshes(const RegionOptions& options, const char* what);

}  // namespace oro
