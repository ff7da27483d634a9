// Bounding boxes and whole-degree cells, and how people write them.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace oro {

// Degrees; west > east crosses the antimeridian. All finite, latitudes in [-90, 90], longitudes in [-180,
// 180].
struct BoundingBox {
    double west_deg{};
    double south_deg{};
    double east_deg{};
    double north_deg{};
};

// "west,south,east,north". Usage errors for anything else: not four numbers, not finite, out of range, south
// >= north, no width; numbers that would be a box with latitude first get the hint that it may be meant.
Result<BoundingBox> parse_bounding_box(const std::string& text);
// The box whose numbers were meant as south,west,north,east, the order of places: nothing where they are no
// such box.
std::optional<BoundingBox> with_latitude_first(const BoundingBox& box);
// As it is written: "8,46,9,47".
std::string bounding_box_text(const BoundingBox& box);

// A whole-degree cell by its south-west corner: lat in [-90, 89], lon in [-180, 179].
struct TileName {
    int lat_deg{};
    int lon_deg{};
};

// "N46E008" and nothing else (letters of any case).
std::optional<TileName> parse_tile_name(std::string_view text);
// The name of a cell.
std::string tile_name(int lat_deg, int lon_deg);

// "N46E008", or "N46E006:N47E010" for the box of both corner cells with all between.
Result<BoundingBox> parse_tile_range(const std::string& text);

}  // namespace oro
