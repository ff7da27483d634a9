// What covers the ground by nature, without any map of it: FrameStyle.cover. Needs ground.glsl's tints.

// Found once for a pixel (look_for_snow): all of it has one latitude.
float snow_line_m(float lat_deg) {
    uint first = 0u, last = FRAME.style.cover.snow_line_count - 1u;
    while (first < last) {
        uint middle = (first + last) / 2u;
        if (FRAME.style.cover.snow_line[middle].lat_deg < lat_deg) first = middle + 1u;
        else last = middle;
    }
    uint below = max(first, 1u) - 1u;
    float low = FRAME.style.cover.snow_line[below].lat_deg, high = FRAME.style.cover.snow_line[first].lat_deg;
    float share = high > low ? clamp((lat_deg - low) / (high - low), 0.0, 1.0) : 0.0;
    return mix(FRAME.style.cover.snow_line[below].H_m, FRAME.style.cover.snow_line[first].H_m, share);
}

// Trees and snow hold on where grass and scree have slid down.
float held_deg(float above_m) {
    return 9.0 * (1.0 - smoothstep(FRAME.style.cover.forest_m, 0.5 * FRAME.style.cover.forest_m, above_m)
                  + smoothstep(-100.0, 300.0, above_m));
}

// How far a pixel's ground is above the snow line, or taken for so: what tints are by.
float above_snow_line_m(SurfacePoint point) {
    float slope = slope_deg(point), lean = length(point.normal.xy), up = FRAME.exaggeration * point.normal.z;
    float steepness = min(2.0 * lean * inversesqrt(max(lean * lean + up * up, 1.0e-12)), 1.0);
    float to_pole = lean > 0.0 ? point.normal.y / lean * (point.lat_deg < 0.0 ? -1.0 : 1.0) : 0.0;
    float above_m = point.mean_H_m - point.snow_line_m + FRAME.style.cover.shade_m * steepness * to_pole;
    // Level ground high up is most often ice, which snow feeds from above.
    float high = smoothstep(-1.6, -0.8, above_m / max(FRAME.style.cover.level_m, 1.0));
    above_m += FRAME.style.cover.level_m * high * point.wide_level * (1.0 - smoothstep(7.0, 15.0, slope));
    return above_m;
}
float rock_share(SurfacePoint point, float above_m) {
    float held = held_deg(above_m);
    return smoothstep(FRAME.style.cover.rock_from_deg + held, FRAME.style.cover.rock_to_deg + held, slope_deg(point));
}

