// Clefts and ledges of rock between the data's posts, as light that they take and give: 0 in the mean. Of absolute place. Needs ground_noise.glsl.

struct RockRelief {
    float to_sun;  // what is added to the cosine of the angle between the sun and the ground
    float to_sky;  // ... and, times the sky's light, to that: crests see more of it than clefts
};

// Noise of -1 to 1 at the corners of a cell, one kind, and how it changes along the cell's axes, a cell.
vec4 lattice_slope(uvec3 cell, vec3 part, uint octave) {
    const uint x = 0x9e3779b1u, y = 0x85ebca77u, z = 0xc2b2ae3du;
    uint h = cell.x * x + cell.y * y + cell.z * z + octave * 0x27d4eb2fu;
    vec3 on = part * part * part * (part * (part * 6.0 - 15.0) + 10.0), change = 30.0 * part * part * (part * (part - 2.0) + 1.0);
    vec4 west = vec4(at_lattice_point(h).x, at_lattice_point(h + y).x, at_lattice_point(h + z).x, at_lattice_point(h + y + z).x);
    vec4 east = vec4(at_lattice_point(h + x).x, at_lattice_point(h + x + y).x, at_lattice_point(h + x + z).x, at_lattice_point(h + x + y + z).x) - west;
    vec4 along_x = west + on.x * east;
    vec2 of_x = mix(east.xz, east.yw, on.y), south = along_x.xz, north = along_x.yw - south, along_y = south + on.y * north;
    return 2.0 * vec4(mix(along_y.x, along_y.y, on.z) - 1.5, change.x * mix(of_x.x, of_x.y, on.z), change.y * mix(north.x, north.y, on.z),
                      change.z * (along_y.y - along_y.x));
}

// Of noise, whose folds are creases: |noise| is what the rock rises by. Walls have clefts along the fall line: the lattice is asked at places
// that are pressed together upwards. Between two pixels and the posts' distance, so it ends where the data's own relief begins. to_sun: view
// coordinates, along the ground.
const float pressed_upwards = 0.72;
RockRelief rock_relief(vec3 view, vec3 up, vec3 to_sun, float H_m, float foot_m, float post_m) {
    RockRelief relief = RockRelief(0.0, 0.0);
    if (0.4 * post_m < foot_m) return relief;
    if (FRAME.refraction_per_m != 0.0) view -= (0.5 * FRAME.refraction_per_m * squared_across(view)) * FRAME.up_view;
    vec3 at = ((view - pressed_upwards * H_m * up) * FRAME.view_from_ecef) / FRAME.noise[0].cell_m;
    vec3 along = (to_sun - pressed_upwards * dot(to_sun, up) * up) * FRAME.view_from_ecef;
    for (uint i = 0u; i < noise_octaves; ++i) {
        float cell_m = FRAME.noise[i].cell_m, kept = min(cell_m / foot_m - 1.6, 1.0) * clamp(2.2 - 1.4 * cell_m / post_m, 0.0, 1.0);
        if (cell_m < 1.6 * foot_m) break;
        if (kept > 0.0) {
            vec3 from_cell = at + FRAME.noise[i].part, whole = floor(from_cell);
            vec4 slope = lattice_slope(FRAME.noise[i].cell + uvec3(ivec3(whole)), from_cell - whole, i + 61u);
            relief.to_sun -= kept * sign(slope.x) * dot(slope.yzw, along);
            relief.to_sky += kept * (abs(slope.x) - 0.32);
        }
        at = noise_lacunarity / 3.0 * vec3(2.0 * at.x - 2.0 * at.y + at.z, at.x + 2.0 * at.y + 2.0 * at.z, 2.0 * at.x + at.y - 2.0 * at.z);
        along = vec3(2.0 * along.x - 2.0 * along.y + along.z, along.x + 2.0 * along.y + 2.0 * along.z, 2.0 * along.x + along.y - 2.0 * along.z) / 3.0;
    }
    return relief;
}

// What rock of this grain sends back more of the sun's light, in shares of it; symmetric about 0, so that no light is made.
float lit_by_relief(RockRelief relief, float cosine) { return clamp(relief.to_sun / max(cosine, 0.25), -0.8, 0.8); }
