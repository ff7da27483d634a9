// How drawn heights lie on the GPU: whole, packed, or in 16 bits with coarser steps.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/base/result.h"
#include "core/terrain/drawn_heights.h"

namespace oro {

class RegionPages;

enum class HeightStorage {
    f32,     // as they are, 4 bytes a post: steps of 2^-11 m, exact in a float near the eye's height
    i16,     // 2 bytes a post, steps as fine as the region's range of heights allows
    packed,  // the same heights as f32 in the fewest bits (packed_heights.h): 0.8 to 1.3 bytes a post of SRTM
};

// The heights of a region in 16 bits: multiples of 2^shift steps around one offset. A post has the same on
// every page and level.
struct HeightQuantization {
    bool sixteen{false};  // false: heights are what they are
    int shift{0};
    std::int32_t offset_steps{0};
    bool packed{false};  // kept as they are, in fewer bits

    static constexpr std::int16_t void_code = -32768;

    // From one height to the next, metres.
    [[nodiscard]] double step_m() const { return std::ldexp(height_step_m, shift); }
    // How far a height may be from what it was, metres.
    [[nodiscard]] double error_m() const { return sixteen ? 0.5 * step_m() : 0.0; }
    // The code nearest to a height, halves upwards. Heights beyond the region's range get the nearest in it.
    [[nodiscard]] std::int16_t code(std::int32_t steps) const {
        if (steps == void_height_steps) return void_code;
        const std::int64_t half = (std::int64_t{1} << shift) / 2;
        return static_cast<std::int16_t>(
            std::clamp<std::int64_t>((std::int64_t{steps} - offset_steps + half) >> shift, -32767, 32767));
    }
    // As post_height of shaders/place/place.glsl.
    [[nodiscard]] std::int32_t steps(std::int16_t code) const {
        if (code == void_code) return void_height_steps;
        return (std::int32_t{code} << shift) + offset_steps;
    }
};

// The finest 16-bit coding that holds heights from lowest to highest (steps).
HeightQuantization sixteen_bits(std::int32_t lowest_steps, std::int32_t highest_steps);
// The coding for a region: of i16 the finest that holds all heights of triangles at full resolution, or all
// that pages may have (known_heights()). Else asks for the record of every page of level 0. Errors: a file
// that cannot be read.
Result<HeightQuantization> height_quantization(const RegionPages& pages, HeightStorage storage);

}  // namespace oro
