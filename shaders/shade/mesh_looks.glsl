// Colours of meshes that are no ground, in the place of its materials: mesh_look_... of shared_mesh_looks.h. But for mesh_look_coloured hues, not
// what a file says. Needs materials.glsl.

// Whether a pixel shows the colour that a mesh's file states: in styles of materials, and in sunlight where all ground has one colour.
bool has_file_colour() {
    if (!HAS_NET || pixel_look.x != float(mesh_look_coloured)) return false;
    bool is_of_one = FRAME.style.colour_by == colour_by_height && FRAME.style.tint_count == 1u;
    return of_materials || (is_of_one && FRAME.style.light == light_sun && FRAME.style.tints_as_codes == 0u);
}
#ifdef IN_AIR
#include "shaders/shade/built_colour.glsl"

vec3 mesh_colour(SurfacePoint point) {
    uint look = uint(pixel_look.x + 0.5);
    float grain = max(1.0 + 0.035 * pixel_noise.grain + 0.02 * clamp(pixel_noise.patches, -2.0, 2.0), 0.5);
    if (look == mesh_look_built) return built_colour(pixel_look.y, pixel_slope_deg) * grain;
    if (look == mesh_look_plain) return plain_colour() * grain;
    if (look == mesh_look_coloured) return pixel_file_colour;
    if (look == mesh_look_water) return pixel_materials[material_water];
    return paved_colour(pixel_materials[material_built]);
}
#endif
