// The scene of the dissertation on grass by mesh shaders (docs/notes, grass-as-published): a field of blades
// that an eye looks straight down on.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "shaders/grass/shared_grass.h"

namespace oro {

// Of the dissertation: its picture; the eye's heights, with the blades that it drew from each (its Table 1);
// the distances up to which blades have more than the fewest vertices.
inline constexpr std::uint32_t grass_width_px = 1291;
inline constexpr std::uint32_t grass_height_px = 1026;
inline constexpr std::array<int, 6> grass_eye_heights_m{50, 100, 150, 200, 250, 300};
inline constexpr std::array<std::uint32_t, 6> grass_published_blades{31168,  111736, 240976,
                                                                     418160, 634868, 871264};
inline constexpr std::array<int, 5> grass_switch_distances_m{100, 150, 200, 250, 300};
// Most blades of a field: numbers of workgroups stay below every device's limit.
inline constexpr std::uint32_t grass_blades_max = 16'000'000;

// What a frame of grass is asked for.
struct GrassRequest {
    gpu::GrassView view;
    // Blades nearer than this have more than the fewest vertices, metres. Infinite: all have the most.
    float switch_m{};
    // The time of the wind, seconds; none: no wind.
    std::optional<float> wind_time_s;
    // Clumps are left out by the box around all that they may cover; else by their feet, as published.
    bool by_boxes{false};
    // Blades are nowhere narrower than a pixel: they are fewer and wider there.
    bool thins{false};
};

// A field of so many blades, up to whole clumps, of the size of the dissertation's: one with more is denser.
// blades: 4 to grass_blades_max.
gpu::GrassField grass_field(std::uint32_t blades);

// An eye so high above zero, metres, looking straight down with north at the top: 45 degrees from top to
// bottom. The ground lies around 26 m, as the dissertation's times tell that its own did.
gpu::GrassView grass_view_down(float eye_height_m, std::uint32_t width_px, std::uint32_t height_px);

// How far beyond the planes of the picture's sides a clump's foot may lie, so that it is drawn all the same,
// metres: where clumps are left out by their feet. As large as makes the blades that are drawn as many as in
// Table 1.
inline constexpr float grass_published_margin_m = 13.8F;

}  // namespace oro
