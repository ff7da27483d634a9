// Air: haze and sky, from FrameStyle.

// Metres of air at sea-level density along a straight path between two heights: density falls by e each scale height.
float air_path_m(float from_h_m, float to_h_m, float distance_m, float scale_height_m) {
    float from_density = exp(-max(from_h_m, 0.0) / scale_height_m);
    float to_density = exp(-max(to_h_m, 0.0) / scale_height_m);
    float rise = (max(to_h_m, 0.0) - max(from_h_m, 0.0)) / scale_height_m;
    float mean = abs(rise) < 1.0e-3 ? 0.5 * (from_density + to_density) : (from_density - to_density) / rise;
    return distance_m * mean;
}

vec3 in_haze(vec3 colour, float to_h_m, float distance_m) {
    float air_m = air_path_m(FRAME.eye_h_m, to_h_m, distance_m, FRAME.style.sky_scale_height_m);
    return mix(FRAME.style.haze_colour, colour, exp(-air_m / FRAME.style.haze_distance_m));
}

vec3 sky(float sine_above_horizon) {
    float density = exp(-max(FRAME.eye_h_m, 0.0) / (2.0 * FRAME.style.sky_scale_height_m));
    float rise = 1.0 - exp(-5.0 * max(sine_above_horizon, 0.0));
    return mix(FRAME.style.haze_colour, FRAME.style.zenith_colour, rise) * density;
}

// Where a direction meets the bare ellipsoid, metres; -1 where it does not, and `horizon` the sine of the angle down to that.
float bare_earth_m(vec3 direction, out float horizon) {
    float rise = dot(direction, FRAME.up_view);
    float h = max(FRAME.eye_h_m, 1.0);
    float b = (FRAME.earth_radius_m + h) * rise;
    float c = h * (2.0 * FRAME.earth_radius_m + h);
    float discriminant = b * b - c;
    horizon = -sqrt(c) / (FRAME.earth_radius_m + h);
    return b < 0.0 && discriminant > 0.0 ? c / (-b + sqrt(discriminant)) : -1.0;
}

// Where no terrain is: the bare ellipsoid below the horizon, the sky above it.
vec3 background(vec3 direction) {
    float horizon, distance_m = bare_earth_m(direction, horizon);
    if (distance_m >= 0.0) return in_haze(FRAME.style.no_data_colour, 0.0, distance_m);
    return sky(dot(direction, FRAME.up_view) - horizon);
}
