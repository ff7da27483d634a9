// A command line's words, parsed and not run.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "apps/commands/command_line.h"
#include "core/base/result.h"

namespace oro {

// What `words` (the program's name, a command, and its words) ask for. Errors: of usage, in the words of the
// command line; `of_help` where they ask for help or the version.
Result<std::unique_ptr<CommandLine>> parsed_line(const std::vector<std::string>& words, const Error& of_help);

}  // namespace oro
