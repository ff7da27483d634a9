// A place that has a name, as a search knows it.
#pragma once

#include <optional>
#include <string>

namespace oro {

// What it is, as far as its source tells.
enum class PlaceClass { other, settlement, summit };

struct SearchPlace {
    std::string name;  // one line, UTF-8
    double lat_deg{};  // WGS84
    double lon_deg{};
    std::optional<double> H_m;  // above sea level, as the source states it
    PlaceClass kind{PlaceClass::other};
    double population{};  // of a settlement; 0: not known
};

// How far up a place stands among places whose names match alike: a summit and all else by its height in
// metres, a settlement by a thousand for each power of ten of its people. So a town of ten thousand is as
// high as a summit of 4,000 m. 0 where nothing is known.
double importance_of(const SearchPlace& place);

}  // namespace oro
