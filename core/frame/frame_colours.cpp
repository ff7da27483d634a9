#include "core/frame/frame_colours.h"

namespace oro {
namespace gpu {
namespace {
#define ORO_FUNCTION inline
#include "shaders/shade/show_colours.glsl"
#undef ORO_FUNCTION
}  // namespace
}  // namespace gpu

gpu::vec3 colour_of_level(gpu::uint level) {
    return gpu::shown_level(level);
}

gpu::vec3 colour_of_round(bool before_last) {
    return gpu::shown_round(before_last);
}

gpu::vec3 colour_of_overdraw(gpu::uint triangles) {
    return gpu::shown_overdraw(triangles);
}

gpu::vec3 colour_of_number(gpu::uint number) {
    return gpu::shown_by_hash(number);
}

}  // namespace oro
