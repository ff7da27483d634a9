// What `info` prints for people.
#pragma once

#include <string>
#include <vector>

#include "geo/region/region.h"

namespace oro {

// The region in some lines; then all that one file says of itself, or one line for each of many, after what
// they have in common.
std::string info_text(const Region& region);

// The same of files that make no region together, whose posts were not read.
std::string unread_text(const std::vector<SourceReport>& sources);

}  // namespace oro
