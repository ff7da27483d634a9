// Octaves of made terrain at many places at once, by the instructions of one kind of processor: the same bits
// as made_fbm_octave() and made_ridged_octave() of shaders/made/made_heights.glsl, of which each function
// here is that of the same name. Included once for each kind of processor, in a namespace of its own and
// under the options of its kind, with the types Ints and Uints (signed and unsigned whole numbers of 32 bits,
// as many as fit) and made_high() and made_corner() of them.

constexpr std::uint32_t hash_x = 0x9e3779b1U, hash_y = 0x85ebca77U, hash_z = 0xc2b2ae3dU;

inline Uints made_mixed(Uints h) {
    h ^= h >> 16U;
    h *= 0x7feb352dU;
    h ^= h >> 15U;
    h *= 0x846ca68bU;
    return h ^ (h >> 16U);
}

inline Ints made_faded(Uints t) {
    const Uints t2 = made_high(t, t);
    const Uints t3 = made_high(t2, t);
    const Uints inner = 0xa0000000U - 15U * (t >> 4U) + 6U * (t2 >> 4U);
    return (Ints)(made_high(t3, inner) << 3U);
}

inline Ints made_between(Ints a, Ints b, Ints w) {
    return a + (made_high(b - a, w) << 1);
}

// Of the two corners of a cell's edge along x.
inline Ints made_edge(Uints h, Ints dx, Ints dy, Ints dz, Ints wx) {
    constexpr std::int32_t one = 1 << 28;
    return made_between(made_corner(made_mixed(h), dx, dy, dz),
                        made_corner(made_mixed(h + hash_x), dx - one, dy, dz), wx);
}

inline Ints made_noise(Uints cx, Uints cy, Uints cz, Uints fx, Uints fy, Uints fz, std::uint32_t seed) {
    constexpr std::int32_t one = 1 << 28;
    const Uints h = cx * hash_x + cy * hash_y + cz * hash_z + seed;
    const Ints dx = (Ints)(fx >> 4U), dy = (Ints)(fy >> 4U), dz = (Ints)(fz >> 4U);
    const Ints wx = made_faded(fx), wy = made_faded(fy), wz = made_faded(fz);
    const Uints hy = h + hash_y, hz = h + hash_z, hyz = hy + hash_z;
    const Ints low = made_between(made_edge(h, dx, dy, dz, wx), made_edge(hy, dx, dy - one, dz, wx), wy);
    const Ints high =
        made_between(made_edge(hz, dx, dy, dz - one, wx), made_edge(hyz, dx, dy - one, dz - one, wx), wy);
    return made_between(low, high, wz);
}

inline Ints made_octave_noise(const gpu::MadeOctave& o, Ints x, Ints y, Ints z) {
    const Ints mx = x * o.flip_x, my = y * o.flip_y, mz = z * o.flip_z;
    const Uints ux = (Uints)(mx + 2 * my + 2 * mz) + 0x80000000U + o.off_x;
    const Uints uy = (Uints)(2 * mx + my - 2 * mz) + 0x80000000U + o.off_y;
    const Uints uz = (Uints)(2 * mx - 2 * my + mz) + 0x80000000U + o.off_z;
    const std::uint32_t left = 32U - o.shift;
    return made_noise(ux >> o.shift, uy >> o.shift, uz >> o.shift, ux << left, uy << left, uz << left,
                      o.seed);
}

// count: a multiple of 16. sums: what the octave adds is added to them.
inline void add_octave(const gpu::MadeOctave& octave, const std::int32_t* x, const std::int32_t* y,
                       const std::int32_t* z, std::int32_t* sums, std::size_t count) {
    constexpr std::size_t lanes = sizeof(Ints) / sizeof(std::int32_t);
    const Ints amplitude = octave.amplitude - Ints{};
    for (std::size_t i = 0; i < count; i += lanes) {
        Ints at_x, at_y, at_z, sum;
        std::memcpy(&at_x, x + i, sizeof at_x);
        std::memcpy(&at_y, y + i, sizeof at_y);
        std::memcpy(&at_z, z + i, sizeof at_z);
        std::memcpy(&sum, sums + i, sizeof sum);
        sum += made_high(made_octave_noise(octave, at_x, at_y, at_z), amplitude);
        std::memcpy(sums + i, &sum, sizeof sum);
    }
}

// The same of `ridged`. weights: 2^-28, of each place, which becomes that of the next octave.
inline void add_ridged_octave(const gpu::MadeOctave& octave, const std::int32_t* x, const std::int32_t* y,
                              const std::int32_t* z, std::int32_t* sums, std::int32_t* weights,
                              std::size_t count) {
    constexpr std::size_t lanes = sizeof(Ints) / sizeof(std::int32_t);
    const Ints amplitude = octave.amplitude - Ints{}, share = 697932186 - Ints{};
    for (std::size_t i = 0; i < count; i += lanes) {
        Ints at_x, at_y, at_z, sum, weight;
        std::memcpy(&at_x, x + i, sizeof at_x);
        std::memcpy(&at_y, y + i, sizeof at_y);
        std::memcpy(&at_z, z + i, sizeof at_z);
        std::memcpy(&sum, sums + i, sizeof sum);
        std::memcpy(&weight, weights + i, sizeof weight);
        const Ints noise = made_octave_noise(octave, at_x, at_y, at_z), sign = noise >> 31;
        Ints crest = (1 << 28) - ((noise ^ sign) - sign);
        crest &= ~(crest >> 31);
        const Ints square = made_high(crest << 2, crest << 2);
        sum += made_high(made_high(square - 177167401, amplitude), weight) << 4;
        weight = 93952410 + made_high(square << 2, share);
        std::memcpy(sums + i, &sum, sizeof sum);
        std::memcpy(weights + i, &weight, sizeof weight);
    }
}
