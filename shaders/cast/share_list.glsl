// Where pixels' shares of the sun are kept, and the list of those that the second turn of shares.comp has lines for. Needs casters.glsl.
layout(constant_id = 0) const bool from_compute = false;  // ids come from the compute rasteriser's buffer
layout(binding = 0, r32ui) uniform readonly uimage2D ids;

uint id_at(ivec2 pixel) {
    return from_compute ? id_of(VisibilityWords(FRAME.visibility).at[uint(pixel.y) * FRAME.width_px + uint(pixel.x)]) : imageLoad(ids, pixel).x;
}

// Written by a function: glslang 12.0 does not end on such an assignment in main().
void keep(ivec2 pixel, float share) { CasterShares(CASTERS.sun_shares).at[pixel.y * int(FRAME.width_px) + pixel.x] = share; }

// Behind the shares: how many pixels the second turn lists (none before it), and the workgroups of its dispatch; then the pixels.
const uint list_head = 4u, count_at = 0u, groups_at = 1u;
uint list_at() { return (FRAME.width_px * FRAME.height_px + 3u) / 4u * 4u; }

bool is_in_picture(ivec2 pixel) { return pixel.x < int(FRAME.width_px) && pixel.y < int(FRAME.height_px); }

void put(uint at, uint value) { Words(CASTERS.sun_shares).at[at] = value; }
