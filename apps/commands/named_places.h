// Places of a command line that are names in its files.
#pragma once

#include "apps/commands/command_line.h"
#include "core/base/result.h"

namespace oro {

// Turns names in the places of a command line (--at, --look-at, --from, --to, --along) into degrees, by the
// files of --names, and --gazetteer of a window. What reads as a place stays one, but for geohashes without
// `geohash:` that are the whole name of a place. Files are read only where a text may be a name. A note tells
// of a name that was not given whole. After take_coordinates(). Errors: those of read_named_places() and of
// place_by_name(); a name where no file is given that could hold it (usage), with what gives one.
Result<void> take_named_places(CommandLine& line);

}  // namespace oro
