// The rule of a made terrain as the GPU and the CPU take it (shaders/made/made_heights.glsl).
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/made/made_terrain.h"

namespace oro::gpu {

using uint = std::uint32_t;
#define ORO_MADE_CONST inline constexpr
#include "shaders/made/made_rule.glsl"
#undef ORO_MADE_CONST

}  // namespace oro::gpu

namespace oro {

// A place's share of one row of posts: how far it is from the Earth's axis and north of the equator's plane,
// 2^-6 m.
struct MadeRow {
    std::int32_t from_axis{};
    std::int32_t north{};
};
// A column's share: cosine and sine of its longitude, 2^-30.
struct MadeColumn {
    std::int32_t cosine{};
    std::int32_t sine{};
};

// The place of a row or column by whole numbers alone (the same bits everywhere; error: 2^-6 m and 2^-30).
// `post` is its number: the latitude or longitude in degrees times `posts_per_deg` (1 to 72,000). Latitudes
// of -90 to 90.
MadeRow made_row(std::int64_t post, std::int64_t posts_per_deg);
// Longitudes of any whole turn.
MadeColumn made_column(std::int64_t post, std::int64_t posts_per_deg);

// The lattice of octave number `number` of a seed: cells of 2^shift / 192 m, shift 1 to 28. Its amplitude is 0.
gpu::MadeOctave made_octave(std::uint32_t seed, std::uint32_t number, std::uint32_t shift);

// The rule of a terrain. The terrain is one that made_terrain_of() accepts.
gpu::MadeRule made_rule(const MadeTerrain& terrain);

}  // namespace oro
