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
// One of a region's grids.
nlohmann::ordered_json region_json(const RegionGrid& grid);
// How far apart the posts of a file in a projected CRS are as the CRS counts it, the mean of both ways;
// nothing of one in degrees, nor of a baked region's, of which it is not known.
std::optional<double> projected_spacing_m(const SourceReport& source);
// The file of a baked grid that is one whole; null for all others.
nlohmann::ordered_json file_json(const RegionGrid& grid);

// A line about a grid's posts without a height, by why, if it has any.
std::string note_of_voids(const RegionGrid& grid);
// A line about files whose vertical datum is assumed, because neither they nor their names nor the request
// say it; "" for none.
std::string note_of_assumed_heights(const RegionGrid& grid);
// The grid's notes and that one.
std::vector<std::string> own_notes(const RegionGrid& grid);
// All of these, of all grids of a region, each once.
std::vector<std::string> all_notes(const Region& region);
// Prints all_notes() on standard error, unless quiet.
void say_notes(const Region& region, bool quiet);

// All attributions of a region, each once, joined by "; ".
std::string attribution_of(const Region& region);

}  // namespace oro
