// Colours of meshes that are no ground, in the place of its materials: mesh_look_... of shared_mesh_looks.h. Hues, not what a file says.
// Needs materials.glsl.
#ifdef IN_AIR
#include "shaders/shade/built_colour.glsl"

vec3 mesh_colour(SurfacePoint point) {
    uint look = uint(pixel_look.x + 0.5);
    float grain = max(1.0 + 0.035 * pixel_noise.grain + 0.02 * clamp(pixel_noise.patches, -2.0, 2.0), 0.5);
    if (look == mesh_look_built) return built_colour(pixel_look.y, pixel_slope_deg) * grain;
    if (look == mesh_look_plain) return plain_colour() * grain;
    if (look == mesh_look_water) return pixel_materials[material_water];
    return paved_colour(pixel_materials[material_built]);
}
#endif
