// The sky from the eye. Needs air.glsl.

float eye_in_air_m() { return max(FRAME.eye_h_m, 1.0); }

// At the air's very top there is nothing to take a logarithm of: from above the table ends just below it.
const float last_share = 0.998;

bool eye_above_air() { return FRAME.eye_h_m > air_top_m; }

// From the horizon to the zenith.
float sky_span_rad() { return 0.5 * pi + dip_rad(air_radius_m(), eye_in_air_m()); }

// The row of a direction, of 1: its angle above the horizon by the square root. From above the air, where a tenth of a second of arc
// is a metre: by the height at which it passes the Earth.
float sky_row(float rise, float above_rad) {
    if (!eye_above_air()) return sqrt(max(above_rad, 0.0) / sky_span_rad());
    if (rise > 0.0) return 2.0;
    float r_m = air_radius_m() + FRAME.eye_h_m;
    float passes_m = FRAME.eye_h_m - r_m * rise * rise / (1.0 + sqrt(max(1.0 - rise * rise, 0.0)));
    return sqrt(max(passes_m, 0.0) / air_top_m);
}

// The line of a row and a column (turns from the sun) of the sky's table, and the part of it that is in the air.
void sky_line(uint row, uint column, out AirRay ray, out float from_m, out float to_m) {
    float share = min(float(row) / float(air_sky_rises - 1u), eye_above_air() ? last_share : 1.0), turn = pi * float(column) / float(air_sky_turns - 1u);
    float radius_m = air_radius_m(), h_m = eye_in_air_m(), rise, level;
    if (eye_above_air()) {
        float passes_m = share * share * air_top_m, r_m = radius_m + h_m;
        level = (radius_m + passes_m) / r_m;
        rise = -sqrt((h_m - passes_m) * (2.0 * radius_m + h_m + passes_m)) / r_m;
    } else {
        float angle = share * share * sky_span_rad() - dip_rad(radius_m, h_m);
        rise = sin(angle);
        level = cos(angle);
    }
    float sun_rise = FRAME.style.sun_enu.z, sun_level = sqrt(max(1.0 - sun_rise * sun_rise, 0.0));
    ray = AirRay(radius_m, h_m, rise, sun_rise, rise * sun_rise + level * sun_level * cos(turn));
    to_m = way_out_m(ray, air_top_m);
    from_m = eye_above_air() ? max(way_down_m(ray, air_top_m), 0.0) : 0.0;
}

// View coordinates: the sun over the eye's place.
vec3 sun_in_view() {
    vec3 east = FRAME.view_from_eye * vec3(0.0, 1.0, 0.0), up = FRAME.up_view;
    return FRAME.style.sun_enu.x * east + FRAME.style.sun_enu.y * cross(up, east) + FRAME.style.sun_enu.z * up;
}

// What comes from a direction of the sky, `above_rad` over the horizon.
vec3 sky_radiance(vec3 direction, float above_rad) {
    vec3 up = FRAME.up_view, sun = sun_in_view();
    vec3 level = direction - dot(direction, up) * up, sun_level = sun - dot(sun, up) * up;
    float lengths = length(level) * length(sun_level);
    float turn = lengths > 1.0e-6 ? acos(clamp(dot(level, sun_level) / lengths, -1.0, 1.0)) : 0.0;
    float share = sky_row(dot(direction, up), above_rad);
    if (share > 1.0) return vec3(0.0);
    vec2 place = vec2(share * float(air_sky_rises - 1u), turn / pi * float(air_sky_turns - 1u));
    uvec2 low = min(whole_numbers(floor(place)), uvec2(air_sky_rises, air_sky_turns) - 2u);
    vec2 part = clamp(place - vec2(low), 0.0, 1.0);
    AirTable sky = AirTable(FRAME.air);
    AirLight light = AirLight(vec3(0.0), vec3(0.0), vec3(0.0), vec3(1.0));
    for (uint k = 0u; k < 4u; ++k) {
        uint at = air_sky_first + 3u * ((low.x + k / 2u) * air_sky_turns + low.y + k % 2u);
        float weight = (k / 2u == 1u ? part.x : 1.0 - part.x) * (k % 2u == 1u ? part.y : 1.0 - part.y);
        light.molecules += weight * sky.at[at];
        light.dust += weight * sky.at[at + 1u];
        light.often += weight * sky.at[at + 2u];
    }
    float last = eye_above_air() ? clamp((1.0 - share) / (1.0 - last_share), 0.0, 1.0) : 1.0;
    return last * radiance(AirLight(exp(light.molecules), exp(light.dust), exp(light.often), vec3(1.0)), dot(direction, sun));
}

// White ground in the light at the eye's place is a little below white; when the sun is low less light is let in than a camera would,
// so that dusk is dark. From space by day, wherever the sun is.
float exposure() {
    float h_m = min(eye_in_air_m(), 10000.0), rise = FRAME.style.sun_enu.z;
    vec3 light = skylight(h_m, rise) + sunlight(h_m, rise) * max(rise, 0.0);
    float seen = dot(light, vec3(0.2126, 0.7152, 0.0722));  // of Rec. 709
    seen = mix(seen, 0.8, smoothstep(2.0e4, 2.0e5, FRAME.eye_h_m));
    return AIR.exposure * pi * 1.45 * pow(max(seen, 2.0e-4), -0.8);
}
