// The rule of a made terrain, as the CPU and the GPU know it: in scalar block layout the structs are those of C++. Compiled as GLSL,
// and as C++ by core/made/made_rule.h. Needs uint, ORO_MADE_CONST.

// Kinds of terrain.
ORO_MADE_CONST uint made_fbm = 0u;
ORO_MADE_CONST uint made_ridged = 1u;
ORO_MADE_CONST uint made_plane = 2u;
ORO_MADE_CONST uint made_cone = 3u;
ORO_MADE_CONST uint made_sine = 4u;
ORO_MADE_CONST uint made_step = 5u;
ORO_MADE_CONST uint made_sphere = 6u;
ORO_MADE_CONST uint made_checker = 7u;
ORO_MADE_CONST uint made_octaves_most = 24u;

struct MadeOctave {
    uint shift;                // a cell is 2^shift units wide; a unit is 2^-6 m / 3
    int amplitude;             // 2^-17 m
    uint seed;
    uint off_x, off_y, off_z;  // below 2^29: lattices of octaves do not share their nodes
    int flip_x, flip_y, flip_z;  // 1 or -1: which of four turned lattices it is
};
struct MadeRule {
    uint kind;
    uint octaves;
    int low, high;                     // 2^-11 m
    int centre_x, centre_y, centre_z;  // of the box, 2^-6 m
    int along_x, along_y, along_z;     // plane: what a unit of 2^-6 m raises, 2^-11 m; sine: turns of 2^-32; step: a direction;
    uint along_shift;                  // each times 2^along_shift
    uint radius;                       // cone, sphere: 2^-6 m, below 2^26
    uint slope;                        // cone: what 2^-11 m of distance lowers, in 2^-(slope_shift + 11) m
    uint slope_shift;                  // 0 to 31
    MadeOctave octave[made_octaves_most];
};
