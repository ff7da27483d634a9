// How water looks. Needs surface.glsl, air.glsl and sky.glsl.

// Land below the sea has no colour of water.
float land_H_m(float H_m) {
    bool has_depths = FRAME.style.water.sea_low_H_m < -1.0e5;
    return FRAME.style.water.on == 1u && !has_depths ? max(H_m, 0.5) : H_m;
}

// What water sends to the eye, before the air between: the sky and the sun on its waves, and what comes out of the deep. `view`: where
// it is; sun: towards it in the place's own frame; what comes from there and from the sky.
// Source: C. Schlick, An inexpensive BRDF model for physically-based rendering, Computer Graphics Forum 13(3), 1994 (Fresnel's share;
// 0.02 of a ray straight down); C. Cox, W. Munk, Measurement of the roughness of the sea surface from photographs of the sun's glitter,
// J. Optical Society of America 44(11), 1954 (slopes).
vec3 water_radiance(vec3 view, vec3 sun, vec3 from_sun, vec3 from_sky) {
    WaterModel water = FRAME.style.water;
    vec3 up = normalize(view + (FRAME.earth_radius_m + FRAME.eye_h_m) * FRAME.up_view), to_eye = -normalize(view);
    // Along the water waves that lean towards the eye are seen.
    float steep = clamp(dot(to_eye, up), 0.0, 1.0), rise = min(sqrt(steep * steep + water.wave_variance), 1.0);
    float mirrored = 0.02 + 0.98 * pow(1.0 - rise, 5.0);
    // The sky of the water's place: the eye's own where that is low, else its mean.
    vec3 sky = from_sky / pi;
    float high = smoothstep(3000.0, 15000.0, FRAME.eye_h_m);
    if (high < 1.0) {
        vec3 away = reflect(-to_eye, up), along = away - dot(away, FRAME.up_view) * FRAME.up_view;
        along = dot(along, along) > 1.0e-8 ? normalize(along) : FRAME.view_from_eye * vec3(0.0, 1.0, 0.0);
        vec3 seen = sky_radiance(sqrt(1.0 - rise * rise) * along + rise * FRAME.up_view, asin(rise));
        sky = mix(seen, sky, high);
    }
    vec3 light = mirrored * sky + (1.0 - mirrored) * water.deep * (from_sun * max(sun.z, 0.0) + from_sky) / pi;
    vec3 half_way = sun_in_view() + to_eye;
    if (sun.z <= 0.0 || dot(half_way, up) <= 0.0) return light;
    half_way = normalize(half_way);
    float tilt = dot(half_way, up), slope_squared = (1.0 - tilt * tilt) / (tilt * tilt);
    float facets = exp(-slope_squared / water.wave_variance) / (pi * water.wave_variance);
    float by_facet = 0.02 + 0.98 * pow(1.0 - clamp(dot(half_way, to_eye), 0.0, 1.0), 5.0);
    return light + from_sun * by_facet * facets / (4.0 * rise * tilt * tilt * tilt * tilt);
}
