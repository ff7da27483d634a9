#version 460
// Fills one of the tables of shared.h's AirModel, an invocation an entry: each needs those before it.
#extension GL_GOOGLE_include_directive : require
#include "shaders/place/frame.glsl"
#include "shaders/air/air.glsl"
#include "shaders/air/sky.glsl"
#include "shaders/air/aerial.glsl"

layout(local_size_x = 64) in;
// TABLE: 0 columns, 1 scattered, 2 skylight, 3 lit, 4 sky, 5 aerial; each has a program.

const vec3 least_light = vec3(1.0e-20);  // of the sun's

void put(uint at, vec3 value) { AirTable(FRAME.air).at[at] = value; }

// The inverse of column_place().
void fill_columns(uint i) {
    float radius_m = air_radius_m();
    float longest = sqrt(air_top_m * (2.0 * radius_m + air_top_m));
    float level = longest * float(i / air_column_angles) / float(air_column_heights - 1u);
    float h_m = level * level / (sqrt(level * level + radius_m * radius_m) + radius_m);
    float least = air_top_m - h_m, most = level + longest;
    float way = least + (most - least) * float(i % air_column_angles) / float(air_column_angles - 1u);
    float rise = way <= 0.0 ? 1.0 : (longest * longest - level * level - way * way) / (2.0 * (radius_m + h_m) * way);
    AirRay ray = AirRay(radius_m, h_m, clamp(rise, -1.0, 1.0), 0.0, 0.0);
    const int pieces = 96;
    vec3 columns = vec3(0.0);
    for (int k = 0; k < pieces; ++k) {
        float low = float(k) / float(pieces), high = float(k + 1) / float(pieces);
        float from_m = way * low * low, to_m = way * high * high;
        columns += densities(height_along(ray, 0.5 * (from_m + to_m))) * (to_m - from_m);
    }
    put(air_columns_first + i, columns);
}

// The inverse of light_place_of().
void light_of(uint i, uint heights, uint suns, out float h_m, out float sun_rise) {
    float root = float(i / suns) / float(heights - 1u);
    h_m = air_top_m * root * root;
    float first = asinh(lowest_sun_rise / sun_bend), last = asinh(1.0 / sun_bend);
    sun_rise = clamp(sun_bend * sinh(mix(first, last, float(i % suns) / float(suns - 1u))), lowest_sun_rise, 1.0);
}

// Number k of as many directions, over the sphere or (below 0) its upper half: closest together at the horizon, where at dusk all light
// comes from. `weight`: the share of the sphere that it stands for.
AirRay direction(uint k, uint below, uint above, uint turns, float h_m, float sun_rise, out float weight) {
    uint row = k / turns;
    float horizon = below > 0u ? -dip_rad(air_radius_m(), h_m) : 0.0;
    float span = row < below ? -0.5 * pi - horizon : 0.5 * pi - horizon;
    float count = float(row < below ? below : above), place = float(row < below ? row : row - below);
    float low = place / count, high = (place + 1.0) / count, middle = 0.5 * (low + high);
    float angle = horizon + span * middle * middle;
    weight = abs(span) * middle / (count * float(turns)) * cos(angle);
    float rise = sin(angle), turn = pi * (float(k % turns) + 0.5) / float(turns);  // the other half of the turn is the same
    float to_sun = rise * sun_rise + cos(angle) * sqrt(1.0 - sun_rise * sun_rise) * cos(turn);
    return AirRay(air_radius_m(), h_m, rise, sun_rise, to_sun);
}

// Light scattered twice, and by that more and more often, as if evenly into all directions.
// Source: Hillaire 2020, equations 5 to 10.
void fill_scattered(uint i) {
    float h_m, sun_rise;
    light_of(i, air_light_heights, air_light_suns, h_m, sun_rise);
    const uint half_of_rises = 14u, turns = 4u;
    vec3 twice = vec3(0.0), share = vec3(0.0);
    float all = 0.0;
    for (uint k = 0u; k < 2u * half_of_rises * turns; ++k) {
        float weight;
        AirRay ray = direction(k, half_of_rises, half_of_rises, turns, h_m, sun_rise, weight);
        all += weight;
        float ground_m = way_down_m(ray, 0.0);
        float to_m = ground_m >= 0.0 ? ground_m : max(way_out_m(ray, air_top_m), 0.0);
        vec3 through = vec3(1.0);
        const int pieces = 24;
        for (int j = 0; j < pieces; ++j) {
            float low = float(j) / float(pieces), high = float(j + 1) / float(pieces);
            float from_m = to_m * low * low, until_m = to_m * high * high, t_m = 0.5 * (from_m + until_m);
            float at_m = height_along(ray, t_m);
            float sun_at = ((ray.radius_m + h_m) * sun_rise + t_m * ray.to_sun) / radius_along(ray, t_m);
            vec3 dense = densities(at_m);
            vec3 extinction = max(extinction_per_m(dense), vec3(1.0e-12));
            vec3 of_piece = exp(-extinction * (until_m - from_m));
            vec3 scattering = AIR.molecules_per_m * dense.x + AIR.dust_scattering_per_m * dense.y;
            vec3 kept = through * (1.0 - of_piece) / extinction * scattering;
            twice += weight * kept * sunlight(at_m, sun_at) / (4.0 * pi);
            share += weight * kept;
            through *= of_piece;
        }
        if (ground_m >= 0.0) {
            float sun_at = ((ray.radius_m + h_m) * sun_rise + ground_m * ray.to_sun) / ray.radius_m;
            twice += weight * through * AIR.ground_albedo / pi * max(sun_at, 0.0) * sunlight(0.0, sun_at);
        }
    }
    put(air_scattered_first + i, log(max(twice / all / (1.0 - share / all), least_light)));
}

void fill_skylight(uint i) {
    float h_m, sun_rise;
    light_of(i, air_light_heights, air_light_suns, h_m, sun_rise);
    const uint rises = 12u, turns = 6u;
    vec3 sum = vec3(0.0);
    for (uint k = 0u; k < rises * turns; ++k) {
        float weight;
        AirRay ray = direction(k, 0u, rises, turns, h_m, sun_rise, weight);
        AirLight light = gathered(ray, 0.0, max(way_out_m(ray, air_top_m), 0.0), 24);
        sum += weight * ray.rise * radiance(light, ray.to_sun);
    }
    put(air_skylight_first + i, log(max(4.0 * pi * sum, least_light)));
}

void fill_sky(uint i) {
    AirRay ray;
    float from_m, to_m;
    sky_line(i / air_sky_turns, i % air_sky_turns, ray, from_m, to_m);
    AirLight light = AirLight(vec3(0.0), vec3(0.0), vec3(0.0), vec3(1.0));
    if (to_m > from_m) light = gathered(ray, from_m, to_m, 64);
    if (i == 0u) put(air_exposure_at, vec3(exposure()));
    put(air_sky_first + 3u * i, log(max(light.molecules, least_light)));
    put(air_sky_first + 3u * i + 1u, log(max(light.dust, least_light)));
    put(air_sky_first + 3u * i + 2u, log(max(light.often, least_light)));
}

void put_aerial(uint at, AirLight seen, float to_sun) {
    vec3 light = seen.molecules * molecules_towards(to_sun) + seen.often, dust = seen.dust, through = seen.through;
    uint codes[9];
    for (int i = 0; i < 3; ++i) {
        codes[i] = aerial_code(light[i]);
        codes[i + 3] = aerial_code(dust[i]);
        codes[i + 6] = uint(clamp(through[i], 0.0, 1.0) * 65535.0 + 0.5);
    }
    AerialTable table = AerialTable(FRAME.air);
    table.at[at] = uvec4(codes[0] | codes[1] << 16, codes[2] | codes[3] << 16, codes[4] | codes[5] << 16, codes[6] | codes[7] << 16);
    table.at[at + 1u] = uvec4(codes[8], 0u, 0u, 0u);
}

// A line with all its slices.
void fill_aerial(uint i) {
    uint row = i / aerial_turns, column = i % aerial_turns;
    AirRay ray = aerial_ray(row, column);
    float from_m, length_m;
    aerial_reach(ray, row < aerial_rises, from_m, length_m);
    AirLight light = AirLight(vec3(0.0), vec3(0.0), vec3(0.0), vec3(1.0));
    put_aerial(aerial_at(row, column, 0u), light, ray.to_sun);
    for (uint slice = 1u; slice < aerial_slices; ++slice) {
        float near_m = from_m + length_m * way_of_slice(float(slice - 1u) / float(aerial_slices - 1u));
        float far_m = from_m + length_m * way_of_slice(float(slice) / float(aerial_slices - 1u)), middle_m = 0.5 * (near_m + far_m);
        [[unroll]] for (int half_of = 0; half_of < 2; ++half_of) gather(ray, half_of == 0 ? near_m : middle_m, half_of == 0 ? middle_m : far_m, light);
        put_aerial(aerial_at(row, column, slice), light, ray.to_sun);
    }
}

void fill_lit(uint i) {
    float h_m, sun_rise;
    light_of(i, lit_heights, lit_suns, h_m, sun_rise);
    vec3 sun = to_space(h_m, sun_rise), sky = skylight(h_m, sun_rise);
    AerialTable(FRAME.air).at[lit_first + i] = uvec4(aerial_code(sun.x) | aerial_code(sun.y) << 16, aerial_code(sun.z) | aerial_code(sky.x) << 16,
                                                     aerial_code(sky.y) | aerial_code(sky.z) << 16, 0u);
}

void main() {
    uint i = gl_GlobalInvocationID.x;
#if TABLE == 0
    if (i < air_column_heights * air_column_angles) fill_columns(i);
#elif TABLE == 1
    if (i < air_light_heights * air_light_suns) fill_scattered(i);
#elif TABLE == 2
    if (i < air_light_heights * air_light_suns) fill_skylight(i);
#elif TABLE == 3
    if (i < lit_heights * lit_suns) fill_lit(i);
#elif TABLE == 4
    if (i < air_sky_rises * air_sky_turns) fill_sky(i);
#else
    if (i < 2u * aerial_rises * aerial_turns) fill_aerial(i);
#endif
}
