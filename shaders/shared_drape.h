// Part of shared.h, which includes it: images over the ground. Not for anybody else.
#ifndef OROGRAPH_SHADERS_SHARED_DRAPE_H
#define OROGRAPH_SHADERS_SHARED_DRAPE_H

// Images over the ground, as tiles of a pyramid. A tile of level k covers 128 2^k of the region's posts a
// side, k also below 0 where an image is finer than the posts; its texels are RGBA8, sRGB codes times alpha,
// and one more on each side, so that any place within it is found by bilinear mixing. Those that are on the
// GPU stand in a hash table: the first free place from drape_hash() on.
ORO_CONST uint drape_texels = 256u;  // along a side of a tile
ORO_CONST uint drape_stride = 258u;
ORO_CONST uint drape_words = 66564u;       // drape_stride squared
ORO_CONST int drape_finest = -16;          // no level is below it
ORO_CONST uint texture_tile_requests_max = 16384u;  // places of the table of what a frame wants; a power of two
ORO_CONST uint drape_probes = 64u;         // of it that are tried
struct DrapeTile {
    uint name;  // level - drape_finest + 1; 0: nothing stands here
    uint row;
    uint column;
    uvec2 texels;  // device address; 0: there is nothing of an image in it
};
struct TextureTileRequest {
    uint hash;  // 0: nothing stands here
    uint name;
    uint row;
    uint column;
};
struct DrapeTable {
    uvec2 tiles;   // device address of DrapeTile[tile_mask + 1]
    uvec2 requests;  // device address of TextureTileRequest[texture_tile_requests_max] and one more: its name is 1 where a tile
                   // is missing
    uint tile_mask;
    uint request_seed;  // another for each try: two tiles of one hash have others then
    int finest;        // levels that there are
    int coarsest;
    float opacity;
    float relief;  // share of a slope's own light on the image, which has been lit already; the rest is that
                   // of level ground
};
#ifdef __cplusplus
#define ORO_INLINE constexpr
#else
#define ORO_INLINE
#endif
// Where a tile is looked for first.
ORO_INLINE uint drape_hash(uint name, uint row, uint column, uint seed) {
    uint h = (name * 0x9e3779b1u) ^ (row * 0x85ebca77u) ^ (column * 0xc2b2ae3du) ^ (seed * 0x27d4eb2fu);
    h = (h ^ (h >> 15u)) * 0x2c1b3c6du;
    h = (h ^ (h >> 12u)) * 0x297a2d39u;
    return h ^ (h >> 15u);
}

#endif
