#include "core/seam/mesh_colours.h"

#include <glm/common.hpp>

namespace oro {
namespace gpu {
namespace {
using glm::clamp;
using glm::fract;
using glm::mix;
using glm::smoothstep;
#define ORO_FUNCTION inline
#include "shaders/shade/built_colour.glsl"
#undef ORO_FUNCTION
}  // namespace
}  // namespace gpu

gpu::vec3 colour_of_building(float tone, float slope_deg) {
    return gpu::built_colour(tone, slope_deg);
}

gpu::vec3 colour_of_plain_mesh() {
    return gpu::plain_colour();
}

gpu::vec3 colour_of_paving(const gpu::vec3& built) {
    return gpu::paved_colour(built);
}

}  // namespace oro
