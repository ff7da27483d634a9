// Colours of meshes that are no ground, in the place of its materials: mesh_look_... of shared_mesh_looks.h. Hues, not what a file says.
// Needs materials.glsl.
#ifdef IN_AIR

// Of six colours the one, or between two, that a number of 0 to 1 says; linear light.
vec3 one_of(vec3 colours[6], float number) {
    float at = clamp(number, 0.0, 0.9999) * 5.0;
    int first = int(at);
    return mix(colours[first], colours[first + 1], smoothstep(0.3, 0.7, at - float(first)));
}
// Plaster: white, cream, ochre, grey, rose, sand. Roofs: tiles from orange to brown, slate.
const vec3 plasters[6] = vec3[](vec3(0.62, 0.60, 0.55), vec3(0.60, 0.52, 0.38), vec3(0.50, 0.39, 0.23), vec3(0.42, 0.41, 0.38), vec3(0.54, 0.41, 0.34), vec3(0.58, 0.54, 0.46));
const vec3 roofs[6] = vec3[](vec3(0.27, 0.098, 0.054), vec3(0.22, 0.085, 0.051), vec3(0.17, 0.075, 0.05), vec3(0.13, 0.08, 0.06), vec3(0.10, 0.092, 0.088), vec3(0.24, 0.11, 0.07));

// Walls by how upright they are; of roofs, level ones are gravel.
vec3 built_colour(float tone) {
    float other = fract(tone * 7.31 + 0.17), third = fract(tone * 23.7 + 0.41);
    vec3 wall = one_of(plasters, tone) * (0.82 + 0.36 * other);
    vec3 tiles = one_of(roofs, other) * (0.8 + 0.5 * third);
    vec3 gravel = vec3(0.24, 0.235, 0.22) * (0.75 + 0.6 * third);
    vec3 roof = mix(gravel, tiles, smoothstep(6.0, 11.0, pixel_slope_deg));
    return mix(roof, wall, smoothstep(74.0, 80.0, pixel_slope_deg));
}

vec3 mesh_colour(SurfacePoint point) {
    uint look = uint(pixel_look.x + 0.5);
    float grain = max(1.0 + 0.035 * pixel_noise.grain + 0.02 * clamp(pixel_noise.patches, -2.0, 2.0), 0.5);
    if (look == mesh_look_built) return built_colour(pixel_look.y) * grain;
    if (look == mesh_look_plain) return vec3(0.40, 0.395, 0.385) * grain;
    if (look == mesh_look_water) return pixel_materials[material_water];
    return 0.8 * pixel_materials[material_built];
}
#endif
