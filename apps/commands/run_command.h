// From a command line that was parsed to its command.
#pragma once

#include <string>
#include <vector>

#include "apps/commands/command_line.h"
#include "core/base/result.h"

namespace oro {

// Runs the one command that `app` has parsed into `line`, by `words`, the whole command line. Errors: the
// command's, and those of take_coordinates(); of commands that only print, a file that was changed meanwhile.
Result<void> run_command(CLI::App& app, CommandLine& line, const std::vector<std::string>& words);

}  // namespace oro
