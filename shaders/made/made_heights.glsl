// Heights of made terrain: a rule of places in Earth-centred space, in whole numbers alone, so that every processor and every GPU
// gives the same bits. Compiled as GLSL for the GPU and as C++ by core/made/made_heights.cpp.
// Needs: made_rule.glsl, ORO_FUNCTION, ORO_INOUT(type), ORO_RULE (the rule as a function's first parameter, with a comma, or
// nothing where `rule` is known everywhere), ORO_PASS (the same where a function is called), and the two functions
// made_high(int, int) and made_high(uint, uint): the upper 32 bits of a product.

// Source: C. Wellons, hash-prospector, lowbias32 (public domain).
ORO_FUNCTION uint made_mixed(uint h) {
    h ^= h >> 16u;
    h *= 0x7feb352du;
    h ^= h >> 15u;
    h *= 0x846ca68bu;
    return h ^ (h >> 16u);
}
ORO_MADE_CONST uint made_hash_x = 0x9e3779b1u;
ORO_MADE_CONST uint made_hash_y = 0x85ebca77u;
ORO_MADE_CONST uint made_hash_z = 0xc2b2ae3du;

// 6 t^5 - 15 t^4 + 10 t^3 of t in 2^-32, as 2^-31. Source: K. Perlin, Improving Noise, SIGGRAPH 2002.
ORO_FUNCTION int made_faded(uint t) {
    uint t2 = made_high(t, t);
    uint t3 = made_high(t2, t);
    uint inner = 0xa0000000u - 15u * (t >> 4u) + 6u * (t2 >> 4u);  // 2^-28, 1 to 10
    return int(made_high(t3, inner) << 3u);
}
// a + (b - a) w, w in 2^-31.
ORO_FUNCTION int made_between(int a, int b, int w) { return a + (made_high(b - a, w) << 1); }

// What a corner of a cell adds: the slope along one of the twelve edges of a cube, which its hash picks.
ORO_FUNCTION int made_corner(uint h, int dx, int dy, int dz) {
    uint edge = h >> 28u;
    int u = edge < 8u ? dx : dy;
    int v = edge < 4u ? dy : (edge == 12u || edge == 14u ? dx : dz);
    return ((h & 1u) != 0u ? -u : u) + ((h & 2u) != 0u ? -v : v);
}

// Gradient noise of space at a place of a cell: its number and what is left in 2^-32. In 2^-28; 0 at the cells' corners, r.m.s.
// 0.25, at most 1.04.
ORO_FUNCTION int made_noise(uint cx, uint cy, uint cz, uint fx, uint fy, uint fz, uint seed) {
    uint h = cx * made_hash_x + cy * made_hash_y + cz * made_hash_z + seed;
    int dx = int(fx >> 4u);
    int dy = int(fy >> 4u);
    int dz = int(fz >> 4u);
    int one = 1 << 28;
    int wx = made_faded(fx);
    int wy = made_faded(fy);
    int wz = made_faded(fz);
    int a = made_between(made_corner(made_mixed(h), dx, dy, dz), made_corner(made_mixed(h + made_hash_x), dx - one, dy, dz), wx);
    uint hy = h + made_hash_y;
    int b = made_between(made_corner(made_mixed(hy), dx, dy - one, dz), made_corner(made_mixed(hy + made_hash_x), dx - one, dy - one, dz), wx);
    uint hz = h + made_hash_z;
    int c = made_between(made_corner(made_mixed(hz), dx, dy, dz - one), made_corner(made_mixed(hz + made_hash_x), dx - one, dy, dz - one), wx);
    uint hyz = hy + made_hash_z;
    int d = made_between(made_corner(made_mixed(hyz), dx, dy - one, dz - one),
                         made_corner(made_mixed(hyz + made_hash_x), dx - one, dy - one, dz - one), wx);
    return made_between(made_between(a, b, wy), made_between(c, d, wy), wz);
}

// The noise of an octave at a place in 2^-6 m of ECEF (|.| < 4.1e8), in 2^-28. Its lattice is turned against the axes by one of the
// four rotations of whole numbers that are three times a rotation: (1 2 2; 2 1 -2; 2 -2 1) after a mirror of one axis or none.
ORO_FUNCTION int made_octave_noise(MadeOctave o, int x, int y, int z) {
    int mx = x * o.flip_x;
    int my = y * o.flip_y;
    int mz = z * o.flip_z;
    uint ux = uint(mx + 2 * my + 2 * mz) + 0x80000000u + o.off_x;
    uint uy = uint(2 * mx + my - 2 * mz) + 0x80000000u + o.off_y;
    uint uz = uint(2 * mx - 2 * my + mz) + 0x80000000u + o.off_z;
    uint left = 32u - o.shift;
    return made_noise(ux >> o.shift, uy >> o.shift, uz >> o.shift, ux << left, uy << left, uz << left, o.seed);
}
// What an octave of `fbm` adds, 2^-13 m.
ORO_FUNCTION int made_fbm_octave(MadeOctave o, int x, int y, int z) { return made_high(made_octave_noise(o, x, y, z), o.amplitude); }
// What an octave of `ridged` adds, 2^-13 m: the square of 1 - |noise|, which has crests where noise is zero. The weight (2^-28, at
// first 1) keeps hollows smoother than crests; it does not end at zero, which would leave plateaus bare.
ORO_FUNCTION int made_ridged_octave(MadeOctave o, int x, int y, int z, ORO_INOUT(int) weight) {
    int noise = made_octave_noise(o, x, y, z);
    int crest = (1 << 28) - (noise < 0 ? -noise : noise);
    crest = crest < 0 ? 0 : crest;
    int square = made_high(crest << 2, crest << 2);  // 2^-28
    int centred = square - 177167401;                // 0.66
    int added = made_high(made_high(centred, o.amplitude), weight) << 4;
    weight = 93952410 + made_high(square << 2, 697932186);  // 0.35 + 0.65 square
    return added;
}

// A whole number of 64 bits.
struct MadeWide {
    uint high, low;
};
ORO_FUNCTION MadeWide made_wide_product(int a, int b) {
    MadeWide wide;
    wide.high = uint(made_high(a, b));
    wide.low = uint(a) * uint(b);
    return wide;
}
ORO_FUNCTION MadeWide made_wide_square(uint a) {
    MadeWide wide;
    wide.high = made_high(a, a);
    wide.low = a * a;
    return wide;
}
ORO_FUNCTION MadeWide made_wide_sum(MadeWide a, MadeWide b) {
    MadeWide wide;
    wide.low = a.low + b.low;
    wide.high = a.high + b.high + (wide.low < a.low ? 1u : 0u);
    return wide;
}
ORO_FUNCTION bool made_wide_below(MadeWide a, MadeWide b) { return a.high < b.high || (a.high == b.high && a.low < b.low); }
// Of a number with a sign, rounded down; by 0 to 31 bits.
ORO_FUNCTION MadeWide made_wide_right(MadeWide a, uint bits) {
    MadeWide wide;
    wide.high = bits == 0u ? a.high : uint(int(a.high) >> int(bits));
    wide.low = bits == 0u ? a.low : (a.low >> bits) | (a.high << (32u - bits));
    return wide;
}
// The largest whole number whose square is not above it.
ORO_FUNCTION uint made_wide_root(MadeWide a) {
    uint root = 0u;
    for (uint bit = 0x80000000u; bit != 0u; bit >>= 1u) {
        uint tried = root | bit;
        if (!made_wide_below(a, made_wide_square(tried))) root = tried;
    }
    return root;
}

// How far a place is from the box's centre along the rule's direction, times what the rule multiplies it with.
ORO_FUNCTION MadeWide made_along(ORO_RULE int x, int y, int z) {
    MadeWide sum = made_wide_sum(made_wide_product(x - rule.centre_x, rule.along_x), made_wide_product(y - rule.centre_y, rule.along_y));
    sum = made_wide_sum(sum, made_wide_product(z - rule.centre_z, rule.along_z));
    return made_wide_right(made_wide_right(sum, rule.along_shift >> 1u), rule.along_shift - (rule.along_shift >> 1u));
}
ORO_FUNCTION int made_plane_height(ORO_RULE int x, int y, int z) {
    MadeWide along = made_along(ORO_PASS x, y, z);
    int half_range = (rule.high - rule.low) >> 1;
    int rise = int(along.low);
    bool fits = along.high == (rise < 0 ? 0xffffffffu : 0u);
    if (!fits || rise < -half_range || rise > half_range) return int(along.high) < 0 ? rule.low : rule.high;
    return rule.low + half_range + rise;
}
ORO_FUNCTION int made_step_height(ORO_RULE int x, int y, int z) {
    return int(made_along(ORO_PASS x, y, z).high) < 0 ? rule.low : rule.high;
}

// The sine of a share of a turn in 2^-32, in 2^-30: Taylor's series of a quarter of a turn to the eleventh power, within 2^-23.
ORO_FUNCTION int made_sine_of(uint turns) {
    uint quarter = turns << 2u;  // of a quarter of a turn, 2^-32
    bool falls = (turns & 0x40000000u) != 0u;
    uint t = falls ? 0u - quarter : quarter;
    if (falls && t == 0u) return (turns & 0x80000000u) != 0u ? -(1 << 30) : 1 << 30;
    uint t2 = made_high(t, t);
    // Coefficients (pi/2)^n / n! in 2^-31.
    uint s = 344545u - made_high(t2, 7728u);      // n = 9, 11
    s = 10053990u - made_high(t2, s);             // 7
    s = 171138612u - made_high(t2, s);            // 5
    s = 1387197337u - made_high(t2, s);           // 3
    s = 3373259426u - made_high(t2, s);           // 1
    uint size = (made_high(t, s) + 1u) >> 1u;     // 2^-30
    int sine = int(size > 0x40000000u ? 0x40000000u : size);
    return (turns & 0x80000000u) != 0u ? -sine : sine;
}
ORO_FUNCTION int made_sine_height(ORO_RULE int x, int y, int z) {
    int half_range = (rule.high - rule.low) >> 1;
    return rule.low + half_range + ((made_high(half_range << 3, made_sine_of(made_along(ORO_PASS x, y, z).low)) + 1) >> 1);
}

// A cone, or the cap of a sphere, whose top is over the box's centre: what they are lower than it at a straight distance from there.
ORO_FUNCTION int made_round_height(ORO_RULE int x, int y, int z) {
    int dx = x - rule.centre_x;
    int dy = y - rule.centre_y;
    int dz = z - rule.centre_z;
    int reach = int(rule.radius);
    if (dx >= reach || dy >= reach || dz >= reach || -dx >= reach || -dy >= reach || -dz >= reach) return rule.low;
    MadeWide square = made_wide_sum(made_wide_sum(made_wide_product(dx, dx), made_wide_product(dy, dy)), made_wide_product(dz, dz));
    MadeWide most = made_wide_square(rule.radius);
    if (!made_wide_below(square, most)) return rule.low;
    uint drop = 0u;
    if (rule.kind == made_sphere) {
        // Subtracted as most + ~square + 1.
        MadeWide negated;
        negated.high = ~square.high;
        negated.low = ~square.low;
        MadeWide one;
        one.high = 0u;
        one.low = 1u;
        square = made_wide_sum(most, made_wide_sum(negated, one));
    }
    MadeWide fine;  // times 2^10, so that the root is in 2^-11 m
    fine.high = (square.high << 10u) | (square.low >> 22u);
    fine.low = square.low << 10u;
    uint root = made_wide_root(fine);
    if (rule.kind == made_sphere) {
        drop = (rule.radius << 5u) - root;
    } else {
        MadeWide product;
        product.high = made_high(root, rule.slope);
        product.low = root * rule.slope;
        drop = made_wide_right(product, rule.slope_shift).low;
    }
    uint range = uint(rule.high - rule.low);
    return drop >= range ? rule.low : rule.high - int(drop);
}

// Of the sum of the octaves in 2^-13 m.
ORO_FUNCTION int made_octaves_height(ORO_RULE int sum) {
    int height = rule.low + ((rule.high - rule.low) >> 1) + ((sum + 2) >> 2);
    return height < rule.low ? rule.low : (height > rule.high ? rule.high : height);
}

// The height of a place in 2^-6 m of ECEF, in 2^-11 m. `parity`: 0 or 1, the sum of the post's row and column: of `checker` alone.
ORO_FUNCTION int made_height(ORO_RULE int x, int y, int z, uint parity) {
    if (rule.kind == made_fbm || rule.kind == made_ridged) {
        int sum = 0;
        int weight = 1 << 28;
        for (uint i = 0u; i < rule.octaves; ++i)
            sum += rule.kind == made_fbm ? made_fbm_octave(rule.octave[i], x, y, z) : made_ridged_octave(rule.octave[i], x, y, z, weight);
        return made_octaves_height(ORO_PASS sum);
    }
    if (rule.kind == made_plane) return made_plane_height(ORO_PASS x, y, z);
    if (rule.kind == made_sine) return made_sine_height(ORO_PASS x, y, z);
    if (rule.kind == made_step) return made_step_height(ORO_PASS x, y, z);
    if (rule.kind == made_checker) return parity == 0u ? rule.low : rule.high;
    return made_round_height(ORO_PASS x, y, z);
}

// A coordinate of a place: what its row and its column multiply to. The row in 2^-6 m, the column's cosine or sine in 2^-30.
ORO_FUNCTION int made_place(int row, int column) { return made_high(row << 2, column); }
