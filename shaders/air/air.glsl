// The air between the eye, the ground, the sun and space. Needs frame.glsl. Heights above the sphere that the frame's Earth is drawn
// as, metres; `rise` and `sun_rise`: sine of the angle above the level at a place; light for a sun of illuminance 1.
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer AirTable { vec3 at[]; };
#define AIR FRAME.style.air

const float pi = 3.14159265;
const float air_top_m = 100000.0;
const float sun_radius_rad = 0.00465;
// Share of the sun's disc above a straight edge, `above_rad` from its middle.
float disc_share(float above_rad) {
    float x = clamp(above_rad / sun_radius_rad, -1.0, 1.0);
    return 0.5 + (x * sqrt(max(1.0 - x * x, 0.0)) + asin(x)) / pi;
}

// The plane of `--earth flat` has the sky of a round Earth.
float air_radius_m() { return FRAME.earth_radius_m < 1.0e9 ? FRAME.earth_radius_m : 6371000.0; }

// A line of sight through the shells.
struct AirRay {
    float radius_m;  // of the Earth
    float h_m;       // where it begins
    float rise;
    float sun_rise;
    float to_sun;    // cosine of its angle to the sun
};

// None of these takes a difference of two large numbers.
float radius_along(AirRay ray, float t_m) {
    float r_m = ray.radius_m + ray.h_m;
    return sqrt(max(r_m * r_m + t_m * (2.0 * r_m * ray.rise + t_m), 0.0));
}
float height_along(AirRay ray, float t_m) {
    float r_m = ray.radius_m + ray.h_m;
    return ray.h_m + t_m * (2.0 * r_m * ray.rise + t_m) / (radius_along(ray, t_m) + r_m);
}
// Where it leaves a shell that is above it, or negative where it does not meet it.
float way_out_m(AirRay ray, float shell_m) {
    float r_m = ray.radius_m + ray.h_m, along = r_m * ray.rise;
    float square = along * along + (shell_m - ray.h_m) * (2.0 * ray.radius_m + shell_m + ray.h_m);
    return square < 0.0 ? -1.0 : -along + sqrt(square);
}
// Where it first meets a shell that is below it; negative where it does not.
float way_down_m(AirRay ray, float shell_m) {
    float r_m = ray.radius_m + ray.h_m, along = r_m * ray.rise;
    float below = (ray.h_m - shell_m) * (2.0 * ray.radius_m + shell_m + ray.h_m);
    float square = along * along - below;
    return along >= 0.0 || square < 0.0 ? -1.0 : below / (-along + sqrt(square));
}

// How dense molecules, dust and ozone are, of 1.
vec3 densities(float h_m) {
    float h = max(h_m, 0.0);
    return vec3(exp(-h / AIR.molecules_scale_m), exp(-h / AIR.dust_scale_m), max(0.0, 1.0 - abs(h - 25000.0) / 15000.0));
}
vec3 extinction_per_m(vec3 dense) {
    return AIR.molecules_per_m * dense.x + vec3(AIR.dust_extinction_per_m * dense.y) + AIR.ozone_per_m * dense.z;
}

// Angle of the horizon below the level.
float dip_rad(float radius_m, float h_m) { return atan(sqrt(max(h_m, 0.0) * (2.0 * radius_m + max(h_m, 0.0))) / radius_m); }

// An entry of a table between its neighbours; place: (row, column), in entries.
vec3 entry(uint first, uvec2 size, vec2 place) {
    vec2 at = clamp(place, vec2(0.0), vec2(size - 1u));
    uvec2 low = min(whole_numbers(floor(at)), size - 2u);
    vec2 share = at - vec2(low);
    AirTable table = AirTable(FRAME.air);
    uint i = first + low.x * size.y + low.y;
    return mix(mix(table.at[i], table.at[i + 1u], share.y), mix(table.at[i + size.y], table.at[i + size.y + 1u], share.y), share.x);
}

// Both square roots: fine near the ground and near the horizon.
// Source: E. Bruneton, F. Neyret, Precomputed atmospheric scattering, Computer Graphics Forum 27(4), 2008, section 4.
vec2 column_place(float h_m, float rise) {
    float radius_m = air_radius_m();
    float h = clamp(h_m, 0.0, air_top_m);
    float longest = sqrt(air_top_m * (2.0 * radius_m + air_top_m)), level = sqrt(h * (2.0 * radius_m + h));
    float seen = rise >= 0.0 ? rise : max(rise, -sin(dip_rad(radius_m, h)));
    float way = max(way_out_m(AirRay(radius_m, h, seen, 0.0, 0.0), air_top_m), 0.0);
    float least = air_top_m - h, most = level + longest;
    return vec2(level / longest * float(air_column_heights - 1u), (way - least) / (most - least) * float(air_column_angles - 1u));
}
vec3 to_space(float h_m, float rise) {
    if (h_m >= air_top_m) return vec3(1.0);
    vec3 columns = entry(air_columns_first, uvec2(air_column_heights, air_column_angles), column_place(h_m, rise));
    return exp(-(AIR.molecules_per_m * columns.x + vec3(AIR.dust_extinction_per_m * columns.y) + AIR.ozone_per_m * columns.z));
}

// The share of the sun's disc that is above the horizon.
float sun_shown(float h_m, float sun_rise) {
    if (sun_rise >= sun_radius_rad) return 1.0;  // no horizon is above the level
    float above_rad = asin(clamp(sun_rise, -1.0, 1.0)) + dip_rad(air_radius_m(), h_m);
    return smoothstep(-sun_radius_rad, sun_radius_rad, above_rad);
}
vec3 sunlight(float h_m, float sun_rise) {
    return to_space(h_m, sun_rise) * sun_shown(h_m, sun_rise);
}

// Heights by their square root; suns closest together where they set, and none that is 20 degrees below the level.
const float lowest_sun_rise = -0.342, sun_bend = 0.06;
vec2 light_place_of(float h_m, float sun_rise, vec2 last_entry) {
    float first = asinh(lowest_sun_rise / sun_bend), last = asinh(1.0 / sun_bend);
    return vec2(sqrt(clamp(h_m / air_top_m, 0.0, 1.0)), (asinh(sun_rise / sun_bend) - first) / (last - first)) * last_entry;
}
vec2 light_place(float h_m, float sun_rise) { return light_place_of(h_m, sun_rise, vec2(air_light_heights - 1u, air_light_suns - 1u)); }
// Both tables hold logarithms: at dusk light falls by half with each half degree.
vec3 scattered_often(float h_m, float sun_rise) {
    return exp(entry(air_scattered_first, uvec2(air_light_heights, air_light_suns), light_place(h_m, sun_rise)));
}
vec3 skylight(float h_m, float sun_rise) {
    return exp(entry(air_skylight_first, uvec2(air_light_heights, air_light_suns), light_place(h_m, sun_rise)));
}

// Light that a line gathers: once scattered by molecules and by dust, both without the angle's share, and all that was scattered more
// often; and what it lets through.
struct AirLight {
    vec3 molecules;
    vec3 dust;
    vec3 often;
    vec3 through;
};

// One piece of a line, the light within it as in its middle.
void gather(AirRay ray, float from_m, float to_m, inout AirLight light) {
    float t_m = 0.5 * (from_m + to_m), length_m = to_m - from_m;
    float h_m = height_along(ray, t_m);
    float sun_rise = ((ray.radius_m + ray.h_m) * ray.sun_rise + t_m * ray.to_sun) / radius_along(ray, t_m);
    vec3 dense = densities(h_m);
    vec3 extinction = max(extinction_per_m(dense), vec3(1.0e-12));
    vec3 through = exp(-extinction * length_m);
    // Of light that enters evenly along the piece, so much leaves it.
    vec3 kept = light.through * (1.0 - through) / extinction;
    vec3 sun = sunlight(h_m, sun_rise);
    vec3 by_molecules = AIR.molecules_per_m * dense.x;
    float by_dust = AIR.dust_scattering_per_m * dense.y;
    light.molecules += kept * by_molecules * sun;
    light.dust += kept * by_dust * sun;
    light.often += kept * (by_molecules + by_dust) * scattered_often(h_m, sun_rise);
    light.through *= through;
}

// From one place of a line to another, in pieces that are short where it is lowest.
AirLight gathered(AirRay ray, float from_m, float to_m, int pieces) {
    AirLight light = AirLight(vec3(0.0), vec3(0.0), vec3(0.0), vec3(1.0));
    float lowest_m = clamp(-(ray.radius_m + ray.h_m) * ray.rise, from_m, to_m);
    float before = sqrt(lowest_m - from_m), after = sqrt(to_m - lowest_m);
    if (before + after <= 0.0) return light;
    int first = int(round(float(pieces) * before / (before + after)));
    if (before > 0.0) first = max(first, 1);
    int second = after > 0.0 ? max(pieces - first, 1) : 0;
    for (int i = 0; i < first + second; ++i) {
        bool falls = i < first;
        float low = falls ? float(first - i) / float(first) : float(i - first) / float(second);
        float high = falls ? float(first - i - 1) / float(first) : float(i - first + 1) / float(second);
        float reach_m = falls ? from_m - lowest_m : to_m - lowest_m;
        gather(ray, lowest_m + reach_m * low * low, lowest_m + reach_m * high * high, light);
    }
    return light;
}

// How much of once scattered light goes on at an angle, of all directions. Source: Hillaire 2020, section 4 (Rayleigh; Cornette and
// Shanks).
float molecules_towards(float cosine) { return 3.0 / (16.0 * pi) * (1.0 + cosine * cosine); }
float dust_towards(float cosine) {
    float g = AIR.dust_forward;
    return 3.0 / (8.0 * pi) * (1.0 - g * g) * (1.0 + cosine * cosine) / ((2.0 + g * g) * pow(1.0 + g * g - 2.0 * g * cosine, 1.5));
}
vec3 radiance(AirLight light, float to_sun) {
    return light.molecules * molecules_towards(to_sun) + light.dust * dust_towards(to_sun) + light.often;
}
