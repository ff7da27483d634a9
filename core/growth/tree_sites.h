// The sites of trees: a lattice over the whole Earth whose sites say by their own numbers which tree stands
// there (shaders/growth/tree_rule.glsl).
#pragma once

#include <cstdint>

#include "shaders/shared_growth.h"

namespace oro {

// The lattice's tiles of 64 x 64 sites: how many there are round the Earth in a row of tiles, counted from
// the south pole.
std::uint32_t site_tile_columns(std::uint32_t tile_row);

// Latitude of the southern edge of a row of tiles, degrees.
double site_tile_south_deg(std::uint32_t tile_row);
// The row of tiles that a latitude lies in; below 0 or beyond the last one past a pole.
std::int64_t site_tile_row_at(double lat_deg);
// Longitude of the western edge of a tile, degrees from -180.
double site_tile_west_deg(std::uint32_t tile_row, std::uint32_t tile_column);

// Metres from a row of sites to the next, on the mean meridian.
double site_spacing_m();

// A tree as the rule has it.
struct SiteTree {
    double column{}, row{};  // of the place in the lattice, sites from the south-west corner of site (0, 0)
    bool stands{};           // there is a tree in closed forest
    double height_m{}, crown_m{}, radius_m{};
};
// The tree of a site by its row and column in the whole lattice. is_needle: else a broad-leaved tree.
SiteTree tree_of_site(std::uint32_t row, std::uint32_t column, bool is_needle);

}  // namespace oro
