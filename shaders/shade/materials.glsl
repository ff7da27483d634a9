// Ground of materials, whose borders are broken by noise: FrameStyle.materials. Needs cover.glsl. Which materials a place has is said by their
// shares: here by a rule of height, slope, hollows and latitude. What says it otherwise (a map of land cover) gives such shares, too.
#ifdef IN_AIR
#include "shaders/shared_growth.h"
#include "shaders/shade/ground_noise.glsl"
#include "shaders/shade/parcels.glsl"
#include "shaders/shade/rock_relief.glsl"
#include "shaders/shared_meadow.h"
#include "shaders/growth/reach.glsl"
#include "shaders/shade/forest_light.glsl"
#include "shaders/growth/meadow_reach.glsl"

// By number (material_rock and so on); together 1.
struct MaterialShares { float of[12]; };

// Found once for a pixel, for all the parts of its footprint.
GroundNoise pixel_noise;
vec3 pixel_materials[12];  // the materials' colours there
float pixel_second;        // the share of the second of two materials that a map does not tell apart
float pixel_rock;          // the share of bare ground that is rock
float pixel_slope_deg;
float pixel_H_m;
RockRelief pixel_relief;
Parcel pixel_parcel;
vec3 pixel_forest_sky[2];  // what forests send back of the sky's light more than of the sun's: needles, leaves
vec3 sky_colour;           // ... of the place that was coloured last
vec3 rock_colour;  // of the place that was coloured last: what its rock has of the colour
vec2 seen_forest;   // of the places of a pixel: the sum of their forest's shares, and of theirs
float pixel_canopy_m = 0.0;  // what the pixel's forest rises above its ground where no trees are drawn

// The share of ground on the one side of a border: x from it, in units in which noise moves the border by `spread` (root mean square). Of noise
// that a pixel is too large for the mean: shares of large areas are those of small ones.
float broken(float x, float spread, float noise, float sharp) {
    return smoothstep(-1.88, 1.88, (x / spread + noise) * sharp);  // nearly a normal distribution's
}
float broken(float x, float spread) { return broken(x, spread, pixel_noise.border, pixel_noise.border_sharp); }
float patched(float x, float spread) { return broken(x, spread, pixel_noise.patches, pixel_noise.patches_sharp); }

// Layers of rock, by height, bent by noise: of mean 0. How light each is, and how far its edge stands out.
vec2 strata(float H_m, float foot_m) {
    float bent_m = H_m + 22.0 * pixel_noise.border + 14.0 * pixel_noise.patches;
    vec2 sum = vec2(0.0);
    float thick_m = 170.0;
    for (int i = 0; i < 3; ++i) {
        thick_m *= 0.35;
        float kept = clamp(0.5 * thick_m / foot_m - 1.0, 0.0, 1.0);
        float layers = bent_m / thick_m, whole = floor(layers), on = smoothstep(0.25, 0.75, layers - whole);
        uint layer = uint(int(whole)) * 0x9e3779b1u + uint(i);
        sum += kept * (2.0 * mix(at_lattice_point(layer), at_lattice_point(layer + 0x9e3779b1u), on) - 3.0);
    }
    return sum;
}

// Ground this steep is rock in half of all places.
float half_rock_deg() { return 0.5 * (FRAME.style.cover.rock_from_deg + FRAME.style.cover.rock_to_deg); }

// How much lighter drawn trees are, where they end, than those of the reference (forest_reference.h), which have neither relief nor shadows:
// needles, leaves. Fitted to the light of forest alone, all other ground being black, in 196 pairs of pictures of slopes of 22 to 39 degrees, to the
// eye and across, by 13 suns, where forest has its height: docs/notes/2026-11-30-light-of-forests-alone.md.
vec2 as_drawn(ForestAngles at) {
    float h = at.agree;
    return vec2(0.826 + h * (0.314 * h - 0.244) - 0.122 * at.eye_over + 0.162 * at.eye_up + 0.22 * at.sun_up, 0.92 - 0.049 * h + 0.041 * at.eye_over);
}

// What a pixel's far forest has of the sun's light and of the sky's, over ground of its colour; by kinds.
struct ForestLight { vec2 lit, open; };  // needles, leaves
ForestLight forest_light(vec3 to_eye, vec3 sun, vec3 normal) {
    ForestAngles at = forest_angles(to_eye, sun, normal);
    vec3 steep = steeper(normal, FRAME.style.relief);
    float cosine = facing(steep, sun), on_crowns = sun_on_crowns(cosine, sun.z) / max(cosine, 0.02);
    vec2 drawn = as_drawn(at);
    return ForestLight(drawn * on_crowns * crowns_lit(at), drawn * crowns_open(at) / (0.5 + 0.5 * steep.z));
}

bool is_forest(uint material) { return material == material_needle_forest || material == material_broad_forest; }

// How much rock rises and falls, for what its colour does.
const float relief_of_grain = 2.7;

void find_pixel_parcel(SurfacePoint point, float steep_deg, float foot_m) {
    pixel_parcel = Parcel(vec2(0.0), hedge_mean, 0.0);
    if (steep_deg < parcels_to_deg && foot_m < parcels_to_foot_m) pixel_parcel = parcel_at(point.view, foot_m, pixel_noise.border);
}

void colour_parcel() {
    vec2 numbers = pixel_parcel.kept * pixel_parcel.numbers;
    vec3 hue = FRAME.style.materials.of[material_crops].patches;
    pixel_materials[material_crops] = max(pixel_materials[material_crops] * (1.0 + 0.4 * numbers.x) + 1.6 * numbers.y * hue, vec3(0.0));
    pixel_materials[material_meadow] *= 1.0 + 0.16 * numbers.x * (1.0 - smoothstep(0.7 * parcels_to_deg, parcels_to_deg, pixel_slope_deg));
}

// Forest that is not drawn as trees, and the floor of what is.
void light_far_forest(SurfacePoint point, vec3 sun, vec3 to_eye) {
    pixel_forest_sky[0] = pixel_forest_sky[1] = vec3(0.0);
    if ((FRAME.style.materials.on & materials_with_trees) == 0u) return;
    // Where trees stand their floor is seen, in their shade; the mean of both is the forest's colour.
    float trees = trees_at(length(point.view), tree_reach_m(FRAME.pixels_per_tangent, FRAME.tau_px));
    ForestLight light = forest_light(to_eye, sun, point.normal);
    vec2 lit = mix(light.lit, vec2(0.65), trees), open = mix(light.open, vec2(0.65), trees);
    // A map's colours have one light for the sun and the sky.
    if (draped && has_cover()) lit = open = mix(open, 0.7 * lit + 0.3 * open, sun_share());
    pixel_forest_sky[0] = (open.x - lit.x) * pixel_materials[material_needle_forest];
    pixel_forest_sky[1] = (open.y - lit.y) * pixel_materials[material_broad_forest];
    pixel_materials[material_needle_forest] *= lit.x;
    pixel_materials[material_broad_forest] *= lit.y;
}

// Trees are lower towards where forests end.
float size_of_trees(SurfacePoint point) { return mix(0.35, 1.0, smoothstep(-200.0, 350.0, FRAME.style.cover.forest_m - above_snow_line_m(point))); }

void find_canopy(SurfacePoint point) {
    float forest = seen_forest.x / max(seen_forest.y, 1.0e-4);
    if ((FRAME.style.materials.on & materials_with_trees) == 0u || forest < 0.02) return;
    float away = 1.0 - trees_at(length(point.view), tree_reach_m(FRAME.pixels_per_tangent, FRAME.tau_px));
    float top_m = min(canopy_top_m + canopy_varies_m * max(pixel_noise.tops, -1.0), canopy_most_m);
    pixel_canopy_m = forest * away * (1.0 - point.water) * size_of_trees(point) * top_m;
}

// Wind has ruffled some water more than other, and waves of more than two pixels lean: both by the noise that the ground has, which is there
// already. An octave of waves has a tenth of all variance; five are finer than crown_m.
const float ruffled = 0.7, octave_of_waves = 0.1;
void find_pixel_waves(SurfacePoint point, float facing_eye, float finest_m) {
    float variance = FRAME.style.water.wave_variance * exp(ruffled * clamp(pixel_noise.border + 0.2 * pixel_noise.grain, -2.5, 2.5));
    // Seen along the water waves are shorter than pixels.
    float kept = smoothstep(0.03, 0.2, facing_eye), octaves = clamp(log2(crown_m / (2.5 * finest_m)) / 1.2, -2.0, 5.0);
    float seen = kept * kept * octave_of_waves * (octaves > 0.0 ? 0.9 + octaves : 0.9 * exp2(octaves));
    pixel_waves = kept * sqrt(octave_of_waves * variance / 0.32) * vec2(pixel_noise.crowns, pixel_noise.tops);
    pixel_wave_variance = variance * (1.0 - seen);
}

void find_pixel_materials(SurfacePoint point, vec3 sun) {
    map_forest = seen_forest = vec2(0.0);
    vec3 to_eye = normalize(-point.view) * axes_at(point.view);
    // A square of as much ground as the pixel's: where that is seen at a grazing angle its longer side alone would leave nothing.
    float facing_eye = max(dot(point.normal, to_eye), 0.15);
    float foot_m = length(point.view) * inversesqrt(facing_eye) / FRAME.pixels_per_tangent;
    // The waves of an octave are two of its cells long. Where the longer side of a pixel is little longer cells may be a pixel and a half; else
    // its waves along that side would be shorter than the pixel. Of a pixel of several posts the noise is one for all their slopes.
    float sharper = by_means ? mix(0.42, 0.1, smoothstep(0.4, 1.6, foot_m / point.post_m)) : 0.42;
    float finest_m = foot_m * (1.0 - sharper * smoothstep(0.15, 0.6, facing_eye));
    // A part of a footprint has a few places for all the slopes and heights that are in it: sharp borders between these would be chance.
    // Waves are as smooth as a canopy without drawn trees, whether or not there are any.
    bool has_crowns = (FRAME.style.materials.on & materials_with_trees) != 0u && point.water == 0.0;
    pixel_noise = ground_noise(point.view, finest_m, point.parts > 0 ? 0.04 : 0.0005, has_crowns);
    if (point.water > 0.0) find_pixel_waves(point, max(dot(point.normal, to_eye), 0.0), finest_m);
    pixel_slope_deg = slope_deg(point);
    float patches = clamp(pixel_noise.patches, -2.0, 2.0);
    // Beside the sun crowns show their lit and their shaded sides, and with the sun behind the eye lit ones alone.
    float crowns = pixel_noise.crowns * crowns_contrast(dot(to_eye, sun));
    // From near a meadow would be blotched by octaves that are seen one by one.
    float meadow_grain = pixel_noise.grain * mix(0.65, 1.0, smoothstep(1.0, 12.0, finest_m));
    for (uint i = 0u; i < material_count; ++i) {
        vec3 colour = FRAME.style.materials.of[i].colour + patches * FRAME.style.materials.of[i].patches;
        pixel_materials[i] = colour * max(1.0 + FRAME.style.materials.of[i].grain * (is_forest(i) ? crowns : i == material_meadow ? meadow_grain : pixel_noise.grain), 0.1);
    }
    // Where it is dry grass is straw, and where it is wet it is green.
    pixel_materials[material_meadow] *= max(1.0 + 0.7 * FRAME.style.materials.of[material_meadow].grain * meadow_grain * vec3(1.0, 0.2, -0.4), vec3(0.1));
    light_far_forest(point, sun, to_eye);
#ifndef GROWS_GRASS
    // What is seen between blades stands in their shade; the mean of both is the meadow's colour.
    if ((FRAME.style.materials.on & materials_with_grass) != 0u) pixel_materials[material_meadow] *= meadow_floor_at(length(point.view), dot(point.normal, to_eye));
#endif
    find_pixel_parcel(point, pixel_slope_deg, foot_m);
    if (pixel_parcel.kept > 0.0) colour_parcel();
    vec2 layers = strata(point.mean_H_m, foot_m);
    pixel_materials[material_rock] *= 1.0 + 0.3 * layers.x;
    pixel_relief = RockRelief(0.0, 0.0);
    if (pixel_slope_deg > 18.0 || point.mean_H_m - point.snow_line_m > FRAME.style.cover.forest_m) {
        vec3 along = sun - dot(sun, point.normal) * point.normal;
        mat3 axes = axes_at(point.view);
        pixel_relief = rock_relief(point.view, axes[2], axes * along, point.mean_H_m, finest_m, by_means ? point.post_m : 30.0);
        // Ledges look up.
        pixel_relief.to_sun += layers.y * along.z;
        float much = relief_of_grain * FRAME.style.materials.of[material_rock].grain;
        pixel_relief.to_sun *= much;
        pixel_relief.to_sky *= much;
    }
    pixel_second = patched(0.0, 1.0);
    pixel_H_m = point.mean_H_m;
    pixel_rock = broken(pixel_slope_deg - half_rock_deg(), 7.0);
}

// The share of ground that is neither steeper nor lower nor higher than a map's class of it can be (DrapeStore).
float share_within(uint limits) {
    float steepest_deg = float(limits & 127u);
    vec2 H_m = 50.0 * vec2((limits >> 7u) & 511u, (limits >> 16u) & 511u) - 12000.0;
    return broken(steepest_deg - pixel_slope_deg, 4.0) * broken(pixel_H_m - H_m.x, 100.0) * broken(H_m.y - pixel_H_m, 100.0);
}

// The materials' noise on a map's own colour, whose mean it stays. Bare ground that is steep is rock, whatever a map's colour of it; rock or
// scree is other ground beyond its limits.
vec3 textured(vec3 colour, uint materials, uint limits) {
    uint first = materials & 255u, second = (materials >> 8u) & 255u;
    forest_share = mix(is_forest(first) ? 1.0 : 0.0, is_forest(second) ? 1.0 : 0.0, pixel_second);
    vec3 mean = 0.5 * (FRAME.style.materials.of[first].colour + FRAME.style.materials.of[second].colour);
    vec3 own = colour * mix(pixel_materials[first], pixel_materials[second], pixel_second) / max(mean, vec3(0.001));
    vec3 rock = pixel_materials[material_rock];
    if (first == material_bare) return mix(own, rock, pixel_rock);
    float within = share_within(limits);
    forest_share *= within;
    return mix(mix(pixel_materials[material_scree], rock, pixel_rock), own, within);
}

vec3 colour_of_shares(MaterialShares shares) {
    vec3 colour = vec3(0.0);
    for (uint i = 0u; i < material_count; ++i) colour += shares.of[i] * pixel_materials[i];
    forest_share = shares.of[material_needle_forest] + shares.of[material_broad_forest];
    sky_colour = shares.of[material_needle_forest] * pixel_forest_sky[0] + shares.of[material_broad_forest] * pixel_forest_sky[1];
    rock_colour = shares.of[material_rock] * pixel_materials[material_rock] + 0.5 * shares.of[material_scree] * pixel_materials[material_scree];
    return colour;
}

// Deserts beyond mountains that take the rain; nothing else is known of rain here. They have no border along a parallel: that winds by half a
// degree, and reaches farther over high ground.
float dry_share(SurfacePoint point) {
    vec2 lat = FRAME.style.materials.dry_lat_deg, H = FRAME.style.materials.dry_H_m;
    float within_deg = min(abs(point.lat_deg) - lat.x, lat.y - abs(point.lat_deg));
    float up = 4.0 * (point.mean_H_m - H.x) / max(H.y - H.x, 1.0) - 2.0;
    if (within_deg < -2.5 || up < -4.0) return 0.0;
    if (within_deg < 2.5) within_deg += 0.42 * wide_noise(point.view) + 0.15 * clamp((point.mean_H_m - H.y) / 1500.0, -1.0, 1.0);
    return broken(min(within_deg / 0.3, up), 1.0);
}

// Near meshes no forest grows, and beside buildings nothing is tilled: meadows and gardens, and much is paved.
void make_open(inout MaterialShares shares, vec2 distance_m) {
    // No circles: noise of all sizes moves the edge of a wood.
    float ragged = pixel_noise.border + clamp(0.4 * pixel_noise.grain, -1.6, 1.6);
    float woods = 1.0 - broken(38.0 - distance_m.x, 9.0, ragged, pixel_noise.border_sharp), fields = 1.0 - broken(22.0 - distance_m.y, 6.0);
    float before = shares.of[material_needle_forest] + shares.of[material_broad_forest] + shares.of[material_shrub] + shares.of[material_crops];
    shares.of[material_needle_forest] *= woods;
    shares.of[material_broad_forest] *= woods;
    shares.of[material_shrub] *= woods;
    shares.of[material_crops] *= fields;
    shares.of[material_meadow] += before - shares.of[material_needle_forest] - shares.of[material_broad_forest] - shares.of[material_shrub] - shares.of[material_crops];
    float paved = shares.of[material_meadow] * patched(7.0 - distance_m.y, 4.0);
    shares.of[material_meadow] -= paved;
    shares.of[material_built] += paved;
}

MaterialShares shares_by_rule(SurfacePoint point) {
    float above_m = above_snow_line_m(point), slope = slope_deg(point), forest_m = FRAME.style.cover.forest_m;
    // Snow lies longest in hollows, and slides from walls; where trees grow it has gone.
    float snow = smoothstep(0.8 * forest_m, 0.5 * forest_m, above_m) * broken(above_m + 4.0 * point.hollow_m, 210.0) * broken(FRAME.style.materials.snow_to_deg - slope, 8.0);
    float left = 1.0 - snow;
    float high = smoothstep(0.75 * forest_m, 0.3 * forest_m, above_m);
    float rock = left * broken(slope - half_rock_deg() - held_deg(above_m) + 6.0 * high, 7.0, -pixel_noise.border, pixel_noise.border_sharp);
    left -= rock;
    float dry = dry_share(point);
    // On slopes more than on level ground, which is tilled or grazed.
    float wooded = min((forest_m - above_m) / 160.0, clamp(0.04 * (slope - 10.0) + 0.025 * point.hollow_m, -0.7, 0.9));
    float forest = left * (1.0 - dry) * broken(wooded, 1.0);
    left -= forest;
    float broad = patched((1.9 * forest_m - above_m) / 220.0, 1.0);
    float green = broken((0.5 * forest_m - above_m) / 150.0 - max(slope - 30.0, 0.0) / 6.0 + clamp(0.04 * point.hollow_m, -1.0, 1.0), 1.0);
    float grown = left * green * (1.0 - dry);
    float shrub = grown * patched(0.2 - abs(above_m - 0.85 * forest_m) / 120.0, 1.0);
    float crops = (grown - shrub) * patched(min(0.2 - 0.3 * (slope - 3.0), (2.0 * forest_m - above_m) / 300.0), 1.0);
    // A parcel is of the one or of the other, and hedges are trees.
    float meadow = grown - shrub - crops, tilled = crops / max(crops + meadow, 1.0e-4);
    float in_parcel = smoothstep(-0.15, 0.15, 1.18 * tilled - 0.09 - (0.5 + 0.5 * pixel_parcel.numbers.y));
    float parcels = (1.0 - smoothstep(0.5 * parcels_to_deg, parcels_to_deg, slope)) * (1.0 - smoothstep(1.25 * forest_m, 0.95 * forest_m, above_m));
    crops = mix(crops, (crops + meadow) * in_parcel, pixel_parcel.kept * parcels);
    float hedge = parcels * pixel_parcel.hedge * (grown - shrub);
    crops *= 1.0 - parcels * pixel_parcel.hedge;
    float bare = left * green * dry;
    MaterialShares shares;
    shares.of[material_rock] = rock;
    shares.of[material_scree] = left - grown - bare;
    shares.of[material_meadow] = grown - shrub - crops - hedge;
    shares.of[material_shrub] = shrub;
    shares.of[material_needle_forest] = forest * (1.0 - broad);
    shares.of[material_broad_forest] = forest * broad + hedge;
    shares.of[material_crops] = crops;
    shares.of[material_bare] = bare;
    shares.of[material_snow] = snow;
    shares.of[material_water] = shares.of[material_built] = shares.of[material_wetland] = 0.0;
    if (FRAME.cleared.cells != uvec2(0u)) make_open(shares, mesh_distance_m(point.view));
    return shares;
}

// How much lower a place is than the ground of some 200 m around it. Pixels that are larger show hollows and crests at once.
float hollow_m_at(SurfacePoint point, float pixel_m) {
    float seen = clamp(2.0 - pixel_m / 60.0, 0.0, 1.0);
    if (seen == 0.0) return 0.0;
    MeansPage page = page_over(means_page(point.page), uint(max(log2(250.0 / point.post_m), 0.0)), point.region);
    GroundSum around = no_ground();
    add_squares(around, means_of(page), among_squares(page, point.region), point.h_m / FRAME.exaggeration, false);
    return around.share > 0.0 ? seen * clamp(around.h_m / around.share, -40.0, 40.0) : 0.0;
}
#endif
