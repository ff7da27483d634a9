// Pages of the manual, as man(1) shows them, made of what the commands take.
#pragma once

#include <string>
#include <vector>

#include "apps/command_line/described_command.h"

namespace oro {

// The page of one command, orograph-shot(1), as roff with the macros of man(7).
std::string manual_page(const DescribedCommand& command);
// The page of the program, orograph(1). about: a sentence that says what it is.
std::string program_manual_page(const std::string& about, const std::vector<DescribedCommand>& commands);

}  // namespace oro
