// What --fetch and --network do to a command line.
#pragma once

#include "apps/commands/command_line.h"
#include "core/base/result.h"

namespace CLI {
class App;
}

namespace oro {

// Adds both to the commands that take them.
void add_fetching(CLI::App& app, FetchingOptions& options);

// With --network lets paths lie on a network. With --fetch adds to the paths of the command that `app` was
// called with the tiles that they lack (apps/fetch/missing_tiles.h). After take_coordinates(). Does nothing
// without the options. Errors: those of fetch_missing_tiles(); a distance that is none (usage).
Result<void> take_fetching(CLI::App& app, CommandLine& line);

}  // namespace oro
