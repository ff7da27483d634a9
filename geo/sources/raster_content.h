// What a raster holds, judged by its values and by what lies beside it: heights, or what was made of them.
#pragma once

#include <gdal.h>

#include <string>
#include <string_view>

#include "geo/sources/source.h"

namespace oro {

// What a raster holds instead of heights, as far as it tells itself: "bits: a mask", "classes of land". ""
// where it may be heights.
std::string holds_by_tags(GDALDatasetH dataset);

// What a raster holds instead of heights where a word of its file's name says so (slope, aspect, hillshade,
// roughness and their kin, as one of its parts) and a sample of its values fits the word; the words
// say both. "" where either does not: `north_slope.tif` may be heights of a mountain. Reads 16 rows at most.
std::string holds_by_name_and_values(std::string_view name, GDALDatasetH dataset);

// What a source holds if it was made of another's heights, post by post on the same grid: "slope", "aspect",
// "roughness", "ruggedness" and the like. "" where samples of both do not agree with any of these, or cannot
// be read. Reads 24 rows at most.
std::string made_of_heights(const Source& source, const Source& heights);

// Whether a source differs from another's heights on the same grid by more than elevation data is accurate
// (16 m) at more than half of a sample of posts. Where both do not refer to the same vertical CRS the middle
// of their differences is taken off first. False where samples cannot be read. Reads 32 rows at most.
bool contradicts_heights(const Source& source, const Source& heights);

// Whether two sources have their posts at the same places, all of them.
bool on_same_grid(const Source& one, const Source& other);

}  // namespace oro
