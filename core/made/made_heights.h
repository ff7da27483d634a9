// Heights of made terrain on the CPU: of posts, and of any place between them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/made/made_rule.h"

namespace oro {

// Places of `count` columns, from column number `first` on; columns count from the west.
std::vector<MadeColumn> made_columns(const MadeTerrain& terrain, int first, int count);

// Heights of the posts of one row, one for each of `columns`, which are made_columns from `first_column` on;
// H in 2^-11 m. Rows count from the north. The same bits as made_height of the shaders on any GPU. `steps`
// has as many numbers as `columns`. Any thread.
void made_row_heights(const MadeTerrain& terrain, const gpu::MadeRule& rule, int row, int first_column,
                      std::span<const MadeColumn> columns, std::span<std::int32_t> steps);

// The same of fbm and ridged, and beside each height what its first `coarse_octaves` octaves give alone,
// which is not cut off at the lowest and the highest height. coarse_octaves: at most the rule's.
void made_row_coarse_heights(const MadeTerrain& terrain, const gpu::MadeRule& rule, int row,
                             std::span<const MadeColumn> columns, std::uint32_t coarse_octaves,
                             std::span<std::int32_t> steps, std::span<std::int32_t> coarse_steps);

// The same of the coarse octaves alone.
void made_row_of_octaves(const MadeTerrain& terrain, const gpu::MadeRule& rule, int row,
                         std::span<const MadeColumn> columns, std::uint32_t octaves,
                         std::span<std::int32_t> steps);

// Adds one octave's noise (2^-28, r.m.s. 0.27) times a factor at each of many places in 2^-6 m of ECEF; all
// have the same length.
void add_made_noise(const gpu::MadeOctave& octave, float factor, std::span<const std::int32_t> x,
                    std::span<const std::int32_t> y, std::span<const std::int32_t> z,
                    std::span<float> values);

// H in metres at any place, by the same rule as at posts: the truth between them. The place is rounded to
// 2^-6 m. Latitude -90 to 90. Of `checker`, which is a rule of posts alone, that of the nearest post.
double made_height_m(const MadeTerrain& terrain, const gpu::MadeRule& rule, double lat_deg, double lon_deg);

}  // namespace oro
