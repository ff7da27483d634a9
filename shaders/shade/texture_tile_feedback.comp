#version 460
// Tells which tiles of images a frame's pixels are coloured from: each is put once into the table FrameConstants.drape.requests.
#extension GL_GOOGLE_include_directive : require
const bool as_map = false;
const bool in_air = false;
const bool draped = true;
const bool by_means = false;
const bool parts_follow = false;
const bool parts_alone = false;
#include "shaders/place/frame.glsl"
#include "shaders/choose/levels.glsl"
#include "shaders/place/place.glsl"
#include "shaders/place/net.glsl"
#include "shaders/shade/surface.glsl"
#include "shaders/shade/drape.glsl"
#include "shaders/shade/cover_tiles.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const bool from_compute = false;  // ids come from the compute rasteriser's buffer
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer TextureTileFeedback { TextureTileRequest at[]; };
layout(binding = 0, r32ui) uniform readonly uimage2D ids;

// Two tiles of one hash: the one that comes second is left out. Where it is missing, the next try has another seed.
void request(DrapeSpot spot) {
    TextureTileFeedback requests = TextureTileFeedback(FRAME.drape.requests);
    uvec2 texels;
    if (!drape_find(spot, texels)) requests.at[texture_tile_requests_max].name = 1u;
    uint hash = max(drape_hash(spot.name, spot.tile.x, spot.tile.y, FRAME.drape.request_seed), 1u);
    uint place = hash & (texture_tile_requests_max - 1u);
    for (uint i = 0u; i < drape_probes; ++i) {
        uint there = requests.at[place].hash;
        if (there == 0u) there = atomicCompSwap(requests.at[place].hash, 0u, hash);
        if (there == 0u) {
            requests.at[place].name = spot.name;
            requests.at[place].row = spot.tile.x;
            requests.at[place].column = spot.tile.y;
            return;
        }
        if (there == hash) return;
        place = (place + 1u) & (texture_tile_requests_max - 1u);
    }
}

void request_for_pixel(SurfacePoint point, ivec2 levels, bool of_cover) {
    DrapeFootprint footprint = drape_footprint(drape_per_px(point), levels);
    DrapeSpot before[2];
    before[0].name = before[1].name = 0u;
    for (int tap = 0; tap < footprint.taps; ++tap) {
        ivec2 whole;
        vec2 part;
        if (of_cover) cover_tap(point, footprint, tap, levels, whole, part);
        else drape_tap(point, footprint, tap, whole, part);
        for (int i = 0; i < (footprint.share > 0.0 ? 2 : 1); ++i) {
            DrapeSpot spot = of_cover ? cover_spot(whole, part, footprint.level + i) : drape_spot(whole, part, footprint.level + i);
            if (spot.name == before[i].name && spot.tile == before[i].tile) continue;
            request(spot);
            before[i] = spot;
        }
    }
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (pixel.x >= int(FRAME.width_px) || pixel.y >= int(FRAME.height_px)) return;
    vec2 clip = (vec2(pixel) + 0.5) * 2.0 / vec2(FRAME.width_px, FRAME.height_px) - 1.0;
    vec3 ray = vec3((clip - FRAME.projection_shift) / FRAME.projection_scale, -1.0);
    uint id = from_compute ? id_of(VisibilityWords(FRAME.visibility).at[uint(pixel.y) * FRAME.width_px + uint(pixel.x)])
                           : imageLoad(ids, pixel).x;
    if (!is_of_grid(id)) return;
    SurfacePoint point = surface_at(triangle_of_id(id), ray);
    if (has_images()) request_for_pixel(point, ivec2(FRAME.drape.finest, FRAME.drape.coarsest), false);
    if (has_cover()) request_for_pixel(point, cover_levels(), true);
}
