// What the ground is made of.
#pragma once

#include <array>
#include <cstdint>

#include "shaders/shared.h"

namespace oro {

// The numbers are those of gpu::material_rock and so on, and those of material_names.
enum class Material : std::uint8_t {
    rock,
    scree,
    meadow,
    shrub,
    needle_forest,
    broad_forest,
    crops,
    bare,
    snow,
    water,
    built,
    wetland
};
inline constexpr std::array<const char*, gpu::material_count> material_names{
    "rock",  "scree", "meadow", "shrub", "needle forest", "broad forest",
    "crops", "bare",  "snow",   "water", "built",         "wetland"};
static_assert(static_cast<gpu::uint>(Material::needle_forest) == gpu::material_needle_forest &&
              static_cast<gpu::uint>(Material::snow) == gpu::material_snow &&
              static_cast<gpu::uint>(Material::wetland) + 1 == gpu::material_count);

}  // namespace oro
