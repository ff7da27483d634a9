// What `info` prints for people.
#pragma once

#include <string>
#include <vector>

#include "geo/listing/file_listing.h"
#include "geo/region/region.h"

namespace oro {

// The region in some lines; then all that one file says of itself, or one line for each of many, after what
// they have in common.
std::string info_text(const RegionGrid& grid);

// The text about files that make no region together, whose posts were not read.
std::string unread_text(const std::vector<SourceReport>& sources);
// The text about all files that were found, with those that cannot be opened and those to be left out.
std::string listing_text(const FileListing& listing);
// Files without elevation and damaged ones, a line each with the reason; "" where there are none.
std::string unread_files_text(const FileListing& listing);

}  // namespace oro
