// What --coordinates does to a command line.
#pragma once

#include "apps/commands/command_line.h"
#include "core/base/result.h"

namespace oro {

// Turns what the command line gives in coordinates of a CRS (--coordinates) into degrees, in which everything
// else reads it: places of two plain numbers, and --bbox. The option then counts as not given; a window keeps
// its CRS (WindowOptions::coordinates). Does nothing without the option. Errors: a CRS that is none,
// coordinates without a place in it, no place and no box to read by it (usage); with `source` those of
// one_source_crs().
Result<void> take_coordinates(CommandLine& line);

}  // namespace oro
