// Fields: blocks of long parcels, side by side, each block turned another way. Of absolute place. Needs ground_noise.glsl.

// None is on steeper ground, and of pixels larger than that nothing is left.
const float parcels_to_deg = 14.0, parcels_to_foot_m = 40.0;
const uint blocks_a_cell = 8u;  // along the largest octave's cell: some 1,200 m

uint block_bits(uvec3 cell) { return cell.x * 0x9e3779b1u + cell.y * 0x85ebca77u + cell.z * 0xc2b2ae3du; }

// What a place has of the parcel that it is in: two numbers of that, -1 to 1, and at a border, as wide as a pixel, those between.
struct Parcel {
    vec2 numbers;
    float hedge;  // the share of a pixel that a hedge has, along the borders that have one
    float kept;   // 1 where parcels are larger than pixels, 0 where they are not
};

// Hedges and rows of trees stand on a third of the borders, so wide.
const float hedge_m = 7.0, hedged_borders = 0.35;
const float hedge_mean = 0.031;  // of all ground with parcels

// How much of a pixel is hedge at a place so far from a border, which the bits are of.
float hedge_share(uint bits, float away_m, float foot_m) {
    float least_m = max(foot_m, 1.0);
    float there = clamp((0.5 * (hedge_m + least_m) - away_m) / least_m, 0.0, 1.0) * min(hedge_m / least_m, 1.0);
    return at_lattice_point(bits).y < 1.0 + hedged_borders ? there : 0.0;
}

// place_m: along and across in the block. Parcels of the next row begin elsewhere.
Parcel parcel_in_block(uint block, vec2 place_m, vec2 size_m, float foot_m) {
    float row = place_m.x / size_m.x - 0.5, first = floor(row);
    vec2 of_row[2];
    float beside[2];
    for (int i = 0; i < 2; ++i) {
        uint row_bits = block + uint(int(first) + i) * 0x27d4eb2fu;
        float strip = place_m.y / size_m.y + 8.0 * at_lattice_point(row_bits).x - 0.5, left = floor(strip);
        uint bits = row_bits + uint(int(left)) * 0x165667b1u;
        float on = clamp((strip - left - 0.5) * size_m.y / foot_m + 0.5, 0.0, 1.0);
        of_row[i] = mix(at_lattice_point(bits), at_lattice_point(bits + 0x165667b1u), on);
        beside[i] = hedge_share(bits ^ 0x68bc21ebu, abs(strip - left - 0.5) * size_m.y, foot_m);
    }
    float on = clamp((row - first - 0.5) * size_m.x / foot_m + 0.5, 0.0, 1.0);
    float between = hedge_share((block + uint(int(first)) * 0x27d4eb2fu) ^ 0x02e5be93u, abs(row - first - 0.5) * size_m.x, foot_m);
    return Parcel(2.0 * mix(of_row[0], of_row[1], on) - 3.0, max(mix(beside[0], beside[1], on), between), 1.0);
}

// The parcel at a place in view coordinates. bent: noise that bends the blocks' borders.
Parcel parcel_at(vec3 view, float foot_m, float bent) {
    if (FRAME.refraction_per_m != 0.0) view -= (0.5 * FRAME.refraction_per_m * squared_across(view)) * FRAME.up_view;
    float block_m = FRAME.noise[0].cell_m / float(blocks_a_cell);
    vec3 at = (view * FRAME.view_from_ecef) / block_m + float(blocks_a_cell) * FRAME.noise[0].part;
    vec3 whole = floor(at + 0.05 * bent);
    uvec3 cell = FRAME.noise[0].cell * blocks_a_cell + uvec3(ivec3(whole));
    uint block = block_bits(cell);
    vec2 turn = at_lattice_point(block), size = at_lattice_point(block + 0x27d4eb2fu);
    vec3 up = normalize(vec3(ivec3(cell)) + 0.5), east = normalize(vec3(-up.y, up.x + 1.0e-6, 0.0)), north = cross(up, east);
    vec3 from_middle_m = (at - whole - 0.5) * block_m;
    vec2 place_m = vec2(dot(from_middle_m, east), dot(from_middle_m, north));
    float angle = 3.14159265 * turn.x, width_m = 40.0 * size.x * size.x;
    vec2 along = vec2(cos(angle), sin(angle));
    vec2 size_m = vec2(2.6 * size.y * width_m, width_m);
    float kept = clamp(0.5 * width_m / foot_m - 1.0, 0.0, 1.0);
    // Of larger pixels the mean: a parcel has two borders, one of each kind.
    Parcel parcel = Parcel(vec2(0.0), 0.0, 0.0);
    if (kept > 0.0) parcel = parcel_in_block(mixed_bits(block), vec2(dot(place_m, along), place_m.y * along.x - place_m.x * along.y), size_m, foot_m);
    parcel.hedge = mix(hedge_mean, parcel.hedge, kept);
    parcel.kept = kept;
    return parcel;
}
