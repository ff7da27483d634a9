// What is told of the canopy: where its heights come from, and how much of it the data hold already.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "geo/canopy/canopy_map.h"
#include "geo/region/region.h"

namespace oro {

// "Canopy: data of trees.tif, up to 29.9 m; 0.5 (SRTM) of it is taken to be in the data already": of a region
// that it raised. names_files: false leaves the files' names out.
std::string canopy_words(const CanopyMap& canopy, const Region& raised, bool names_files = true);
// {"from": "file" or "class", "invented", "files", "table", "highest_m", "held": [{"share", "by"}],
// "raised_posts", "unknown_posts"}; held: of each grid.
nlohmann::ordered_json canopy_json(const CanopyMap& canopy, const Region& raised);
// What a user must know of it, one line each: posts over which nothing is known.
std::vector<std::string> notes_of_canopy(const Region& raised);
// "15.2 m"
std::string metres_words(double metres);

}  // namespace oro
