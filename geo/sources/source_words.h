// The words for what a source says of itself, as JSON has them and baked regions keep them, and the way back
// from a baked region's words to the facts. Nothing else may decide on these words.
#pragma once

#include <optional>
#include <string>

#include "geo/sources/region_request.h"
#include "geo/sources/source_report.h"

namespace oro {

std::string format_words(const SourceReport& source);  // "SRTM1 .hgt", "GTiff"
std::string posts_words(PostsAre posts);               // "points", "cell centres (area)"
std::string datum_words(const HeightDatum& datum);     // "EGM96 height (assumed: the file states none)"
// "within 10 m of WGS84 by NAD27 to WGS 84 (4); within 5 m with us_noaa_conus.tif, which PROJ lacks"; "" for
// WGS84. There is no way back.
std::string horizontal_words(const HorizontalDatum& datum);
std::string unit_words(const HeightUnit& unit);           // "m", "ft (as told)"
std::string placement_words(const SourceReport& source);  // "posts copied"; "" where it was not laid
std::string void_method_words(VoidMethod method);         // "holes"

// Takes the facts back from words that are theirs. Words of no other kind: a raster's format, a datum's name
// and a unit's name are any text; the others give nothing.
void set_format(SourceReport& source, const std::string& words);
HeightDatum datum_of_words(const std::string& words);
HeightUnit unit_of_words(const std::string& words);
std::optional<PostsAre> posts_of_words(const std::string& words);
std::optional<Placement> placement_of_words(const std::string& words);
std::optional<VoidMethod> void_method_of_words(const std::string& words);

}  // namespace oro
