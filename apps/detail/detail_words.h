// What is told of ground between the posts that is invented (--detail).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "geo/region/region.h"

namespace oro {

// "Ground between posts: invented within 5 km, 1.8 m r.m.s. and up to 14 m off the data's surface; none on
// water and ice, by a rule of height and slope". Of a region that add_detail() has changed; a sentence
// without its stop.
std::string detail_words(const GridDetail& detail);
// The same for programs: all of GridDetail but the part.
nlohmann::ordered_json detail_json(const GridDetail& detail);

}  // namespace oro
