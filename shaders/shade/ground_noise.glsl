// Noise of absolute place, from the octaves that are at least two pixels long: FrameConstants.noise.

struct GroundNoise {
    float border;         // of variance 1, with what is left out
    float border_sharp;   // 1 over the root mean square of what is left out
    float patches;        // the same
    float patches_sharp;
    float grain;
    float crowns;         // of a forest: most of it of the size of crowns
    float tops;           // likewise, which has nothing in common with it: how high they are is not how light
};

#include "shaders/shade/lattice_noise.glsl"

// Crowns stand some 5 m apart; of larger areas, with their gaps and their ages, the mean differs less.
const float crown_m = 6.0;

// Of a place in view coordinates, as it is seen; foot_m: the side of a pixel on the ground; least: variance that borders have anyhow;
// has_crowns: whether noise of crowns goes on below their size.
GroundNoise ground_noise(vec3 view, float foot_m, float least, bool has_crowns) {
    if (FRAME.refraction_per_m != 0.0) view -= (0.5 * FRAME.refraction_per_m * squared_across(view)) * FRAME.up_view;
    vec3 at = (view * FRAME.view_from_ecef) / FRAME.noise[0].cell_m;
    GroundNoise noise = GroundNoise(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    vec2 left = vec2(1.0);  // variance
    for (uint i = 0u; i < noise_octaves; ++i) {
        // From two to three pixels long it fades in.
        float kept = min(FRAME.noise[i].cell_m / foot_m - 2.0, 1.0);
        if (kept <= 0.0) break;
        vec3 from_cell = at + FRAME.noise[i].part, whole = floor(from_cell);
        uvec3 cell = FRAME.noise[i].cell + uvec3(ivec3(whole));
        vec2 both = kept * (i == 0u ? two_lattices_noise(cell, from_cell - whole, i) : lattice_noise(cell, from_cell - whole, i));
        float border = FRAME.noise[i].border, patches = FRAME.noise[i].patches;
        noise.border += border * both.x;
        noise.patches += patches * both.y;
        left -= 0.1603 * kept * kept * vec2(border * border, patches * patches);
        // Of the one kind where it moves no border much, so that grain and borders have nothing in common.
        noise.grain += FRAME.noise[i].grain * both.y;
        float crowns_wide = FRAME.noise[i].cell_m / crown_m;
        // Where no trees are drawn a forest is a smooth canopy, also from near: what is smaller than crowns fades out.
        vec2 crowns = both * (crowns_wide > 1.0 ? inversesqrt(crowns_wide) : has_crowns ? 1.0 : crowns_wide);
        noise.crowns += crowns.y;
        noise.tops += crowns.x;
        at = noise_lacunarity / 3.0 * vec3(2.0 * at.x - 2.0 * at.y + at.z, at.x + 2.0 * at.y + 2.0 * at.z, 2.0 * at.x + at.y - 2.0 * at.z);
    }
    vec2 sharp = inversesqrt(max(left, 0.0) + least);
    noise.border_sharp = sharp.x;
    noise.patches_sharp = sharp.y;
    return noise;
}

// The same kind of noise for whole regions: of variance 1, cells of 304 km to 38 km.
float wide_noise(vec3 view) {
    if (FRAME.refraction_per_m != 0.0) view -= (0.5 * FRAME.refraction_per_m * squared_across(view)) * FRAME.up_view;
    vec3 at = (view * FRAME.view_from_ecef) / FRAME.noise[0].cell_m + FRAME.noise[0].part;
    ivec3 eye_cell = ivec3(FRAME.noise[0].cell);
    float sum = 0.0, amplitude = 1.837;
    for (int larger = 5; larger > 1; --larger) {
        ivec3 cell = eye_cell >> larger;
        vec3 from_cell = (vec3(eye_cell - (cell << larger)) + at) / float(1 << larger), whole = floor(from_cell);
        sum += amplitude * lattice_noise(uvec3(cell + ivec3(whole)), from_cell - whole, noise_octaves + uint(larger)).x;
        amplitude *= 0.7;
    }
    return sum;
}
