// Names of files held against patterns, in which some signs stand for others.
#pragma once

#include <string_view>

namespace oro {

// True when a name is one of the patterns' alternatives, which `|` parts. `#` stands for one digit, `?` for
// any one byte, `*` for any run of bytes, none included; every other byte for itself. "" matches no name.
bool matches_name(std::string_view patterns, std::string_view name);

}  // namespace oro
