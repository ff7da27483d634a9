// Blades of grass as the rule has them (shaders/growth/blade_rule.glsl), for those who hold what the GPU
// draws against what stands.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace oro {

// A clump by its row and column in the whole lattice, on ground that rises so much a metre east and north;
// wind: what it adds to how far a blade's tip stands beside its foot, over its length. size: 1 is the usual
// one.
struct MeadowStand {
    std::uint32_t row{}, column{};
    double size{1.0};
    glm::dvec2 slope{0.0}, wind{0.0};
};
// A blade: a quadratic Bezier curve of metres east, north and up of the clump's foot, and the unit vector
// across it on level ground.
struct MeadowCurve {
    std::array<glm::dvec3, 3> control;
    glm::dvec2 side;
};
// grown: 0 to 1, from just coming to whole.
MeadowCurve meadow_curve(const MeadowStand& stand, std::uint32_t number, double grown = 1.0);

// What a blade shows, at a place along it of 0 to 1, of the light that the ground at its foot would send
// back: red, green, blue. sun, to_eye: unit vectors towards them, east, north, up. And what the ground
// between blades shows, so far from the eye, which sees it at an angle of that sine. pixel_m: what a pixel
// covers there, which blades are widened to; 0: they are not.
glm::dvec3 meadow_light(const MeadowStand& stand, std::uint32_t number, double along, double pixel_m,
                        const glm::dvec3& sun, const glm::dvec3& to_eye);
double meadow_floor_light(double distance_m, double sine);

// How many of a clump's 32 blades are kept where a pixel covers so much, were they all to stand there.
double meadow_blades_kept(double pixel_m);
// How far a blade has grown, by its number, where so many are kept.
double meadow_grown(double kept, std::uint32_t number);
// The share of a meadow's blades that stands so far from the eye.
double meadow_share_at(double distance_m);
// Metres: a blade's width at its foot; what of it is left along it, 0 to 1.
double meadow_blade_width_m();
double meadow_taper(double along);
// Metres: no blade of a clump of that size reaches farther from the vertical line on its foot, nor higher
// above its foot, on level ground.
double meadow_reach_m(double size);
double meadow_height_m(double size);
// The sizes that clumps have: the largest.
double meadow_size_most();
// What wind of a strength, 1 being the usual and 0 none, adds, as MeadowStand has it, in the middle of a
// clump's tile of grass at a time in seconds.
glm::dvec2 meadow_wind(std::uint32_t row, std::uint32_t column, double strength, double time_s);

}  // namespace oro
