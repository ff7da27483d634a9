// The shadows of trees near the eye: from places in view coordinates to the map of what is nearest to the sun. Needs growth_table.glsl and
// what gives sun_in_view().

struct ShadePlace {
    vec2 cell;         // of the map
    float towards_m;   // the sun
};
mat3 shade_axes() {
    vec3 sun = sun_in_view(), across = normalize(cross(sun, abs(sun.x) < 0.8 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0)));
    return mat3(across, cross(sun, across), sun);
}
ShadePlace shade_place(vec3 view, mat3 axes) {
    vec3 at = view * axes;
    return ShadePlace(at.xy / shade_map_cell_m + 0.5 * float(shade_map_side), at.z);
}

// The share of the sun that trees leave to a place: bilinear between cells. Leaves nearer than bias_m take none; far from the eye it is the
// mean of a forest's, and said by colours.
float light_past_trees(vec3 view, float bias_m) {
    uvec2 map = GROWTH.shade_map;
    float distance_m = length(view), fade = clamp((shade_map_reach_m - distance_m) / (0.25 * shade_map_reach_m), 0.0, 1.0);
    if (map == uvec2(0u) || fade <= 0.0) return 1.0;
    ShadePlace place = shade_place(view, shade_axes());
    vec2 at = place.cell - 0.5, low = floor(at), on = at - low;
    if (any(lessThan(low, vec2(0.0))) || any(greaterThan(low, vec2(float(shade_map_side) - 2.0)))) return 1.0;
    float dark = 0.0;
    for (int i = 0; i < 4; ++i) {
        uvec2 cell = uvec2(low) + uvec2(i & 1, i >> 1);
        float nearest_m = uintBitsToFloat(Words(map).at[cell.y * shade_map_side + cell.x]) - shade_map_base_m;
        float weight = ((i & 1) == 1 ? on.x : 1.0 - on.x) * ((i >> 1) == 1 ? on.y : 1.0 - on.y);
        dark += nearest_m > place.towards_m + bias_m ? weight : 0.0;
    }
    return 1.0 - fade * 0.9 * dark;
}
