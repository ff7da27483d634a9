// What a region is made of, as JSON and as lines for people.
#pragma once

#include <nlohmann/json.hpp>

#include "geo/measures/region_resampling.h"
#include "geo/region/region.h"

namespace oro {

nlohmann::ordered_json sources_json(const std::vector<SourceReport>& sources);
// Null for nothing.
nlohmann::ordered_json resampling_json(const std::optional<RegionResampling>& found);
nlohmann::ordered_json region_json(const Region& region);
// The file of a baked region that is one whole; null for all others.
nlohmann::ordered_json file_json(const Region& region);

// A line about the region's posts without a height, by why, if it has any.
std::string note_of_voids(const Region& region);
// Its notes and that one on standard error, unless quiet.
void say_notes(const Region& region, bool quiet);

// All attributions of a region, each once, joined by "; ".
std::string attribution_of(const Region& region);

}  // namespace oro
