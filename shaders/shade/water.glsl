// How water looks. Needs surface.glsl, air.glsl and sky.glsl.

// Land below the sea has no colour of water.
float land_H_m(float H_m) {
    bool has_depths = FRAME.style.water.sea_low_H_m < -1.0e5;
    return FRAME.style.water.on == 1u && !has_depths ? max(H_m, 0.5) : H_m;
}

// Of a pixel's waves those that are larger than it lean its water; the rest is variance. Zero: as water has it in the mean.
vec2 pixel_waves = vec2(0.0);     // their slopes, towards the east and the north
float pixel_wave_variance = 0.0;  // of the rest; 0: the style's

// Sunlight on waves is brighter than a picture has room for: from so much of the light of level white ground on it is pressed together, so that a
// path of light has a core of many tones, and no hard end.
const float waves_pressed = 0.2;

// What water sends to the eye, before the air between: the sky and the sun on its waves, and what comes out of the deep. `view`: where
// it is; sun: towards it in the place's own frame; what comes from there and from the sky.
// Source: C. Schlick, An inexpensive BRDF model for physically-based rendering, Computer Graphics Forum 13(3), 1994 (Fresnel's share;
// 0.02 of a ray straight down); C. Cox, W. Munk, Measurement of the roughness of the sea surface from photographs of the sun's glitter,
// J. Optical Society of America 44(11), 1954 (slopes).
vec3 water_radiance(vec3 view, vec3 sun, vec3 from_sun, vec3 from_sky) {
    WaterModel water = FRAME.style.water;
    vec3 up = normalize(view + (FRAME.earth_radius_m + FRAME.eye_h_m) * FRAME.up_view), to_eye = -normalize(view);
    float variance = pixel_wave_variance > 0.0 ? pixel_wave_variance : water.wave_variance;
    vec3 leaning = axes_at(view) * vec3(pixel_waves, 0.0), facet = normalize(up - 0.5 * leaning);
    // Along the water waves that lean towards the eye are seen.
    float steep = clamp(dot(to_eye, facet), 0.0, 1.0), rise = min(sqrt(steep * steep + sqrt(variance * water.wave_variance)), 1.0);
    float mirrored = 0.02 + 0.98 * pow(1.0 - rise, 5.0);
    // The sky of the water's place: the eye's own where that is low, else its mean.
    vec3 sky = from_sky / pi;
    float high = smoothstep(3000.0, 15000.0, FRAME.eye_h_m);
    if (high < 1.0) {
        vec3 away = reflect(-to_eye, facet), along = away - dot(away, FRAME.up_view) * FRAME.up_view;
        along = dot(along, along) > 1.0e-8 ? normalize(along) : FRAME.view_from_eye * vec3(0.0, 1.0, 0.0);
        vec3 seen = sky_radiance(sqrt(1.0 - rise * rise) * along + rise * FRAME.up_view, asin(rise));
        sky = mix(seen, sky, high);
    }
    vec3 light = mirrored * sky + (1.0 - mirrored) * water.deep * (from_sun * max(sun.z, 0.0) + from_sky) / pi;
    vec3 half_way = sun_in_view() + to_eye;
    if (sun.z <= 0.0 || dot(half_way, up) <= 0.0) return light;
    half_way = normalize(half_way);
    float tilt = dot(half_way, up);
    vec3 leans = half_way / tilt - up + leaning;
    float facets = exp(-dot(leans, leans) / variance) / (pi * variance);
    float by_facet = 0.02 + 0.98 * pow(1.0 - clamp(dot(half_way, to_eye), 0.0, 1.0), 5.0);
    vec3 glitter = from_sun * by_facet * facets / (4.0 * rise * tilt * tilt * tilt * tilt);
    float over = dot(glitter, vec3(pi)) / (waves_pressed * dot(from_sun * sun.z + from_sky, vec3(1.0)));
    return light + glitter * (over > 1.0e-3 ? log(1.0 + over) / over : 1.0);
}
