// Part of shared.h, which includes it: how a frame is coloured. Not for anybody else.
#ifndef OROGRAPH_SHADERS_SHARED_STYLE_H
#define OROGRAPH_SHADERS_SHARED_STYLE_H

struct TintStop {
    float at;     // H in metres, or degrees: as FrameStyle.colour_by
    vec3 colour;  // linear light; with tints_as_codes sRGB-encoded, 0 to 1
};
ORO_CONST uint tint_stops_max = 256u;

// FrameStyle.colour_by: what of the ground its tints are of.
ORO_CONST uint colour_by_height = 0u;
ORO_CONST uint colour_by_slope = 1u;   // degrees, 0 level
ORO_CONST uint colour_by_aspect = 2u;  // degrees clockwise from true north: where the ground falls to
ORO_CONST uint colour_by_cover = 3u;   // metres above the snow line, see GroundCover
// FrameStyle.light: what lies over the tints.
ORO_CONST uint light_sun = 0u;        // the sun and ambient light
ORO_CONST uint light_none = 1u;       // the tints are what is seen
ORO_CONST uint light_hillshade = 2u;  // the tints times a hillshade's grey
ORO_CONST uint light_relief = 3u;     // warm light and cool shadow, stronger with height

// Light of two colours, as on Swiss relief maps: more of it the higher the ground.
struct ReliefLight {
    vec3 lit;         // what slopes towards the sun turn to; codes, 0 to 1, as those below
    float lit_share;  // ... by so much, 0 to 1
    vec3 shadow;      // what slopes away from the sun are multiplied with
    vec3 veil;        // the air in the valleys
    float low_H_m;
    float high_H_m;      // from here on no veil, and all of the contrast
    float low_contrast;  // at low_H_m and below, of 1
    float low_veil;      // the veil's share there
};
struct ContourLines {
    float interval_m;  // 0: none
    float width_px;    // of a line; every fifth is twice as wide
    vec3 colour;       // linear light
};

// The air, in spherical shells around the Earth: molecules and dust, thinning out by e in each scale height,
// and ozone between 10 and 40 km. Per metre, for red, green and blue; 0 in `on`: no air but FrameStyle's haze
// and sky. Source: S. Hillaire, A scalable and production ready sky and atmosphere rendering technique,
// Computer Graphics Forum 39(4), 2020, table 1.
struct AirModel {
    uint on;
    vec3 molecules_per_m;  // scattered by them, at height 0
    float molecules_scale_m;
    float dust_scattering_per_m;
    float dust_extinction_per_m;  // scattered or taken
    float dust_scale_m;
    float dust_forward;   // mean cosine of the angle that dust scatters by
    vec3 ozone_per_m;     // taken, where it is densest
    float ground_albedo;  // for light that the ground sends back into the air
    float exposure;       // 1: as a camera would choose it for the light at the eye
};
// Its tables, one vec3 an entry: what a line to space meets of molecules, dust and ozone (metres at full
// density); logarithms of light scattered more than once and of light from the whole sky on level ground; and
// the sky as the eye sees it, logarithms, three entries each; last what light is multiplied with to be shown
// (shaders/air/air_tables.comp).
ORO_CONST uint air_column_heights = 64u;
ORO_CONST uint air_column_angles = 128u;
ORO_CONST uint air_light_heights = 32u;
ORO_CONST uint air_light_suns = 64u;
ORO_CONST uint air_sky_rises = 128u;
ORO_CONST uint air_sky_turns = 96u;
ORO_CONST uint air_columns_first = 0u;
ORO_CONST uint air_scattered_first = 8192u;
ORO_CONST uint air_skylight_first = 10240u;
ORO_CONST uint air_sky_first = 12288u;
ORO_CONST uint air_exposure_at = 49152u;
ORO_CONST uint air_entries = 49156u;  // a multiple of 4: what follows are uvec4s, two for each
// ... slice of each line of sight from the eye: what it gathers as far as there (shaders/air/aerial.glsl).
ORO_CONST uint aerial_rises = 64u;  // of lines that meet the ground, and of the others
ORO_CONST uint aerial_turns = 24u;
ORO_CONST uint aerial_slices = 32u;
ORO_CONST uint aerial_first = 36867u;
ORO_CONST uint aerial_end = 233475u;
// ... height and height of the sun: what comes to a place of the sun, wherever the horizon is, and to level
// ground of the sky; one uvec4 each.
ORO_CONST uint lit_heights = 64u;
ORO_CONST uint lit_suns = 128u;
ORO_CONST uint lit_first = 233475u;
ORO_CONST uint lit_end = 241667u;
ORO_CONST float aerial_log_low = -32.0f;  // of the sun's light: nothing is darker
ORO_CONST float aerial_log_high = 1.0f;

// What covers the ground by nature: FrameStyle's tints by metres above the snow line of the latitude, and
// rock where it is steep.
struct SnowLineStop {
    float lat_deg;
    float H_m;
};
ORO_CONST uint snow_line_stops_max = 32u;
struct GroundCover {
    SnowLineStop snow_line[32];  // ascending; linear between
    uint snow_line_count;
    vec3 rock;  // linear light, or codes, as the tints
    float rock_from_deg;
    float rock_to_deg;
    float forest_m;  // above the snow line (so below 0): from here down trees hold on to steeper slopes
    float shade_m;   // so much lower is the snow line on a slope of 30 degrees that faces the pole
    float level_m;   // ... and on level ground, where ice flows down to
};

// What the ground is made of, by these numbers (data/README.md).
ORO_CONST uint material_rock = 0u;
ORO_CONST uint material_scree = 1u;
ORO_CONST uint material_meadow = 2u;
ORO_CONST uint material_shrub = 3u;
ORO_CONST uint material_needle_forest = 4u;
ORO_CONST uint material_broad_forest = 5u;
ORO_CONST uint material_crops = 6u;
ORO_CONST uint material_bare = 7u;
ORO_CONST uint material_snow = 8u;
ORO_CONST uint material_water = 9u;
ORO_CONST uint material_built = 10u;
ORO_CONST uint material_wetland = 11u;
ORO_CONST uint material_count = 12u;
struct Material {
    vec3 colour;   // its mean, linear light
    vec3 patches;  // what its patches add to it, or take
    float grain;   // how much darker or lighter its grain is, root mean square of each octave
};
// 0 in `on`: GroundCover's tints and its rock colour the ground.
struct MaterialTable {
    uint on;
    Material of[12];
    vec2 dry_lat_deg;   // north or south: between these there is no meadow and no forest,
    vec2 dry_H_m;       // ... from between these on
    float snow_to_deg;  // the steepest slope that snow lies on
    float wind;         // over grass, of the usual: 0 where the air is still,
    float wind_time_s;  // ... and when it blows
};
// An octave of the noise that breaks the materials' borders (core/frame/ground_noise.h): a lattice of cubes
// in space, turned, where the eye is.
ORO_CONST uint noise_octaves = 16u;
ORO_CONST float noise_lacunarity = 2.3f;  // so many times smaller are the cells of the next octave
struct NoiseOctave {
    uvec3 cell;     // the eye's cell
    vec3 part;      // where in it the eye is, 0 to 1
    float cell_m;   // its edge
    float border;   // the octave's amplitude in what moves borders; the sum of their variances is 1,
    float patches;  // ... in patches of colour, the same,
    float grain;    // ... and in grain: 0 to what gives the octave a root mean square of 1.5
};

// Water in the ground's heights, in air. 0 in `on`: none is looked for. Level areas are water: see
// shaders/shade/water.glsl.
struct WaterModel {
    uint on;
    uint voids_are_sea;   // 1: what has no height inside the region is the sea
    float sea_low_H_m;    // posts between these two heights are the sea's, level or not; none where the
    float sea_high_H_m;   // ... second is below the first. A first below -1e5: posts tell the sea's depth
    vec3 deep;            // share of light that comes out of deep water again
    float wave_variance;  // mean square of the slopes of its waves
};
// What is drawn where the region has no height and nothing hides it; no ground, for whoever asks what a pixel
// shows. 0 in `on`: all of it is coloured as what lies outside the region.
ORO_CONST uint voids_hatched = 1u;     // quiet lines on the bare ellipsoid
ORO_CONST uint voids_with_skirt = 2u;  // the region's rim stands on walls
struct VoidHatch {
    uint on;      // voids_... together
    vec3 colour;  // linear light
    vec3 lines;
};

// How a frame is coloured. Colours are linear light, Rec. 709 primaries. All zero where nothing is said:
// coloured by height, in sunlight, through air.
struct FrameStyle {
    TintStop tints[256];
    uint tint_count;
    uint colour_by;       // colour_by_...
    uint tints_as_codes;  // 1: tints are mixed as sRGB codes, as GIS programs do; 0: as light
    uint light;           // light_...
    uint is_map;          // 1: there is no air, and no_data_colour wherever there is no ground
    vec3 sun_enu;         // unit vector towards the sun in the local frame of every place (a map's light)
    float sun_hidden;     // share of its light that does not come: 0 by day, 1 when it has set
    float ambient;        // share of the light that has no direction
    float relief;         // slopes are shaded as if they were this much steeper (1: as they are)
    vec3 haze_colour;
    float haze_distance_m;  // distance at which haze has taken 63 % of the colour
    vec3 zenith_colour;
    vec3 no_data_colour;  // the bare ellipsoid
    float sky_scale_height_m;
    vec3 flat_colour;  // of ground that falls nowhere, by aspect
    ReliefLight relief_light;
    ContourLines contours;
    AirModel air;
    GroundCover cover;
    WaterModel water;
    VoidHatch voids;
    uint shadows;       // 1: terrain casts shadows (FrameConstants.casters)
    uint sky_openness;  // 1: the sky's light is that of the part of the sky that a place sees
    uint footprint;     // footprint_...
    uint smooth_edges;  // 1: of pictures of one sample, see shaders/shade/edges.comp
    MaterialTable materials;
};

#endif
