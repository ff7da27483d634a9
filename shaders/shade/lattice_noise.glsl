// Noise between random numbers at the points of a lattice. Compiled as GLSL, and as C++ by tests with the types of glm. Needs ORO_FUNCTION.

// Of a sum of products, whose upper bits are mixed already. Source: C. Wellons, hash-prospector, lowbias32 (public domain), its second half.
ORO_FUNCTION uint mixed_bits(uint h) {
    h ^= h >> 15u;
    h *= 0x846ca68bu;
    return h ^ (h >> 16u);
}
// Two numbers, 1 to 2.
ORO_FUNCTION vec2 at_lattice_point(uint h) {
    uint bits = mixed_bits(h);
    return vec2(uintBitsToFloat(0x3f800000u | (bits >> 9u)), uintBitsToFloat(0x3f800000u | ((bits << 8u) & 0x7fffffu)));
}
// Two kinds of noise, -1 to 1, in a cell. Source: K. Perlin, Improving noise, 2002 (the fade).
ORO_FUNCTION vec2 lattice_noise(uvec3 cell, vec3 part, uint octave) {
    const uint x = 0x9e3779b1u, y = 0x85ebca77u, z = 0xc2b2ae3du;
    uint h = cell.x * x + cell.y * y + cell.z * z + octave * 0x27d4eb2fu;
    vec3 on = part * part * part * (part * (part * 6.0f - 15.0f) + 10.0f);
    vec2 low = mix(mix(at_lattice_point(h), at_lattice_point(h + x), on.x), mix(at_lattice_point(h + y), at_lattice_point(h + x + y), on.x), on.y);
    h += z;
    vec2 high = mix(mix(at_lattice_point(h), at_lattice_point(h + x), on.x), mix(at_lattice_point(h + y), at_lattice_point(h + x + y), on.x), on.y);
    return 2.0f * mix(low, high, on.z) - 3.0f;
}
// Of the largest octave, whose grid shows from space where no other is beside it: a third more power along the cells' diagonals. Half of it is
// of a lattice that is turned by rows of a third of (2 1 2), (-2 2 1), (1 2 -2), to the bit: a cell's numbers are whole.
ORO_FUNCTION vec2 two_lattices_noise(uvec3 cell, vec3 part, uint octave) {
    ivec3 at = ivec3(cell);
    ivec3 thirds = ivec3(2 * at.x + at.y + 2 * at.z, -2 * at.x + 2 * at.y + at.z, at.x + 2 * at.y - 2 * at.z);
    vec3 turned = vec3(2.0f * part.x + part.y + 2.0f * part.z, -2.0f * part.x + 2.0f * part.y + part.z, part.x + 2.0f * part.y - 2.0f * part.z) / 3.0f;
    ivec3 whole = ivec3(floor(vec3(thirds) / 3.0f));
    turned += vec3(thirds - 3 * whole) / 3.0f;
    vec3 more = floor(turned);
    return 0.70710678f * (lattice_noise(cell, part, octave) + lattice_noise(uvec3(whole + ivec3(more)), turned - more, octave + 31u));
}
