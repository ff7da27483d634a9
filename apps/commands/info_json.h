// What `info --json` prints.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "geo/listing/file_listing.h"
#include "geo/region/region.h"

namespace oro {

// Takes the notes out of a region that name files which were passed over: info lists all of these.
void leave_listed_notes_out(Region& region);
// All that is known of a region and its grids. `passed_over` is an empty list: it is files_json() of a
// listing. checked: the files of baked grids were read whole and are well.
nlohmann::ordered_json info_json(const Region& region, bool checked);
// The files of a listing that hold no elevation, or those that are damaged, with the reason for each.
nlohmann::ordered_json files_json(const std::vector<ListedFile>& files, bool damaged);

}  // namespace oro
