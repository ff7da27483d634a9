// The grass of a grid: clumps and blades in view coordinates. Needs growth.glsl.
#include "shaders/shared_meadow.h"
#include "shaders/growth/meadow_reach.glsl"
#include "shaders/growth/blade_rule.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer MeadowTables { MeadowTable at; };
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer Clumps { MeadowClump at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer Pieces {
    MeadowPieces head;
    uint at[];
};
#define MEADOW MeadowTables(growth_table).at

uint hash_of_clump(GrowthTile tile, uint clump) {
    return site_hash(tile.row * clumps_per_side + clump / clumps_per_side, tile.column * clumps_per_side + clump % clumps_per_side);
}
// Where in its tile a clump is, columns and rows.
vec2 place_of_clump(uint clump, uint hash) {
    vec2 jitter = 0.6 * vec2(site_number(hash, 1u), site_number(hash, 2u)) - 0.3;
    return (vec2(clump % clumps_per_side, clump / clumps_per_side) + 0.5 + jitter) / float(clumps_per_side);
}
vec2 wind_on(GrowthTile tile, uint clump, uint hash) {
    return wind_on_clump(hash, tile.row, tile.column, place_of_clump(clump, hash), FRAME.style.materials.wind,
                         FRAME.style.materials.wind_time_s);
}

// East, north and up there, as columns.
mat3 axes_of_foot(vec3 view) {
    vec3 up = normalize(view + (FRAME.earth_radius_m + FRAME.eye_h_m) * FRAME.up_view);
    vec3 east = normalize(cross(FRAME.view_from_eye * vec3(0.0, 0.0, 1.0), up));
    return mat3(east, cross(up, east), up);
}

float kept_of(MeadowClump clump) { return float(clump.blue_kept >> 16u) * (1.0 / 1024.0); }
vec3 light_of(MeadowClump clump) { return vec3(unpackHalf2x16(clump.red_green), unpackHalf2x16(clump.blue_kept).x); }

MeadowBlade blade_numbered(MeadowClump clump, uint hash, uint number, vec2 wind) {
    float grown = blade_grown(kept_of(clump), float(number));
    return blade_of_clump(hash, number, clump.size, unpackHalf2x16(clump.slope), wind, grown);
}

uint id_of_blade(uint tile, uint clump, uint number) {
    return (GROWTH.first_page + tile) * (meshlets_per_page * meshlet_triangles) + clump * blades_per_clump + number + 1u;
}
