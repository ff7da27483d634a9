// What a region is made of, as JSON and as lines for people.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

#include "geo/measures/region_resampling.h"
#include "geo/region/region.h"

namespace oro {

nlohmann::ordered_json sources_json(const std::vector<SourceReport>& sources);
// Null for nothing.
nlohmann::ordered_json resampling_json(const std::optional<RegionResampling>& found);
nlohmann::ordered_json region_json(const Region& region);
// How far apart the posts of a file in a projected CRS are as the CRS counts it, the mean of both ways;
// nothing of one in degrees, nor of a baked region's, of which it is not known.
std::optional<double> projected_spacing_m(const SourceReport& source);
// The size of all of the file that a baked grid is in, with other grids and clusters.
std::uint64_t bytes_of_file(const RegionFile& file);
// The file of a baked region that is one whole; null for all others.
nlohmann::ordered_json file_json(const Region& region);

// A line about the region's posts without a height, by why, if it has any.
std::string note_of_voids(const Region& region);
// A line about files whose vertical datum is assumed, because neither they nor their names nor the request
// say it; "" for none. Of this grid alone.
std::string note_of_assumed_heights(const Region& region);
// The region's notes and that one; of this grid alone.
std::vector<std::string> own_notes(const Region& region);
// All of these, of all its grids.
std::vector<std::string> all_notes(const Region& region);
// Prints all_notes() on standard error, unless quiet.
void say_notes(const Region& region, bool quiet);

// All attributions of a region, each once, joined by "; ".
std::string attribution_of(const Region& region);

}  // namespace oro
