// The trees of a grid, and where their sites are on its ground. Needs frame.glsl, levels.glsl and place.glsl.
#include "shaders/growth/growth_table.glsl"
#include "shaders/growth/tree_rule.glsl"
#include "shaders/growth/reach.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer GrowthTiles { GrowthTile at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer ListsOfCrowns { CrownLists at; };

// Of a site in a tile.
uint hash_of_site(GrowthTile tile, uint site) {
    return site_hash(tile.row * sites_per_side + site / sites_per_side, tile.column * sites_per_side + site % sites_per_side);
}

// Of a tile's site that an invocation of one of its workgroups takes: a workgroup has 16 x 8 sites, which lie near each other.
uint site_of_group(uint group, uint invocation) {
    const uint across = 16u, down = site_group / across, groups_across = sites_per_side / across;
    uint row = group / groups_across * down + invocation / across, column = group % groups_across * across + invocation % across;
    return row * sites_per_side + column;
}

// A site on the ground, as the finest page of the frame has that.
struct SitePlace {
    uint page;    // number in the frame
    vec2 post;    // (row, column) in it, fractional
    ivec2 whole;  // ... in the region: whole posts,
    vec2 part;    // ... and the rest
    vec3 view;    // metres
    float h_m;    // above the ellipsoid, as drawn
    vec3 corners[3];  // of the triangle, view coordinates
};

// Down to the finest page over a post of the region.
uint finest_page(uint number, ivec2 whole) {
    for (int i = 0; i < 24; ++i) {
        int quarter = int(page_quads / 2u) << frame_pages().at[number].level;
        bvec2 on = greaterThanEqual(whole, ivec2(frame_pages().at[number].first_row, frame_pages().at[number].first_column) + quarter);
        uint child = frame_pages().at[number].children[(on.x ? 2u : 0u) + (on.y ? 1u : 0u)];
        if (child == no_page) break;
        number = child;
    }
    return number;
}

// Of a place in a tile, 0 to 1 from the west and the south. False where there is no ground.
bool place_in_tile(GrowthTile tile, vec2 at, out SitePlace place) {
    vec2 off = mix(mix(tile.corners[0], tile.corners[1], at.x), mix(tile.corners[2], tile.corners[3], at.x), at.y), posts = floor(off);
    place.whole = ivec2(tile.post[0], tile.post[1]) + ivec2(posts);
    place.part = off - posts;
    if (any(lessThan(place.whole, ivec2(0))) || any(greaterThanEqual(place.whole, ivec2(FRAME.last_row, FRAME.last_column)))) return false;
    place.page = finest_page(tile.page, place.whole);
    FramePage page = frame_pages().at[place.page];
    PageBlocks block = PageBlocks(page.block);
    ivec2 first = ivec2(page.first_row, page.first_column), last = ivec2(FRAME.last_row, FRAME.last_column);
    ivec2 quad = clamp((place.whole - first) >> int(page.level), ivec2(0), ivec2(int(page_quads) - 1));
    ivec2 from = first + (quad << int(page.level)), span = max(min(from + (1 << int(page.level)), last) - from, ivec2(1));
    vec2 share = clamp((vec2(place.whole - from) + place.part) / vec2(span), 0.0, 1.0);
    place.post = vec2(quad) + share;
    bool sw_ne = sw_ne_at(block, uvec2(quad));
    bool east = sw_ne ? share.x + share.y > 1.0 : share.y > share.x;
    uvec2 corners[3];
    quad_posts(uvec2(quad), sw_ne, east ? 1u : 0u, corners[0], corners[1], corners[2]);
    vec3 shares = sw_ne ? (east ? vec3(1.0 - share.y, share.x + share.y - 1.0, 1.0 - share.x) : vec3(1.0 - share.x - share.y, share.x, share.y))
                        : (east ? vec3(1.0 - share.y, share.x, share.y - share.x) : vec3(1.0 - share.x, share.x - share.y, share.y));
    place.view = vec3(0.0);
    place.h_m = 0.0;
    for (int i = 0; i < 3; ++i) {
        int height = post_height(block, corners[i]);
        if (height == void_height) return false;
        place.corners[i] = place_in_view(page, corners[i], height);
        place.view += shares[i] * place.corners[i];
        place.h_m += shares[i] * float(height) * height_step_m;
    }
    return true;
}
bool place_of_site(GrowthTile tile, uint site, uint hash, out SitePlace place) {
    vec2 at = (vec2(site % sites_per_side, site / sites_per_side) + site_place(hash)) / float(sites_per_side);
    return place_in_tile(tile, at, place);
}

// Which site an invocation takes of those that are asked for: its number in its tile and 4096 times that of the tile. False beyond
// the last.
bool asked_site(out uint tile, out uint site) {
    uint at = folded(gl_WorkGroupID) * site_group + gl_LocalInvocationIndex;
    if (at >= ListsOfCrowns(GROWTH.lists).at.asked_count) return false;
    uint asked = Words(GROWTH.asked).at[at];
    tile = asked / sites_per_tile;
    site = asked % sites_per_tile;
    return true;
}

// A crown and its stem, in a frame at the foot: east, north and along the stem, as columns in view coordinates.
struct Crown {
    vec3 foot;
    mat3 axes;
    float low_m;   // where the crown begins
    float high_m;  // its top
    float radius_m;
    float shell;  // how far out leaves may reach, over the mean: low_m, high_m and radius_m hold them
    float colour;
    uint kind;
    uint hash;
};
float pixel_m_at(vec3 view) { return -view.z / FRAME.pixels_per_tangent; }
const float shell_of_leaves = 1.25;
Crown crown_at(vec3 view, uint hash, uint stands) {
    Tree tree = tree_of_site(hash, stands & 3u, float((stands >> site_size_bit) & 255u) / 255.0);
    vec3 up = normalize(view + (FRAME.earth_radius_m + FRAME.eye_h_m) * FRAME.up_view);
    vec3 east = normalize(cross(FRAME.view_from_eye * vec3(0.0, 0.0, 1.0), up)), north = cross(up, east);
    vec3 along = normalize(up + tree.lean.x * east + tree.lean.y * north);
    east = normalize(east - dot(east, along) * along);
    Crown crown;
    crown.foot = view;
    crown.axes = mat3(east, cross(along, east), along);
    // Where it stands alone its crown is wider and begins lower.
    bool alone = (stands & site_in_forest) == 0u;
    crown.low_m = (alone ? 0.4 : 1.0) * tree.crown_m * FRAME.exaggeration;
    crown.high_m = tree.height_m * FRAME.exaggeration;
    // Leaves reach out of a smooth crown here and there. Near the eye alone: it costs rays that meet nothing.
    crown.shell = 1.0 + (shell_of_leaves - 1.0) * clamp(1.6 - 11.0 * pixel_m_at(view), 0.0, 1.0);
    crown.radius_m = (alone ? 1.25 : 1.0) * tree.radius_m * crown.shell;
    if ((stands & 3u) != site_needle) {
        float beyond_m = 0.5 * (crown.shell - 1.0) * (crown.high_m - crown.low_m);
        crown.high_m += beyond_m;
        crown.low_m = max(crown.low_m - beyond_m, 0.0);
    }
    crown.colour = tree.colour;
    crown.kind = stands & 3u;
    crown.hash = hash;
    return crown;
}

// Stems end among leaves. They are drawn where a pixel covers less than this.
const float stem_least_px_m = 0.25;
float stem_m(Crown crown) { return crown.low_m + 0.3 * (crown.high_m - crown.low_m); }
float stem_radius_m(Crown crown) { return 0.011 * crown.high_m; }
// Rays through pixels begin so many metres before the eye.
const float ray_begin_m = 0.3;

// What stands on a site of the frame; false for nothing.
bool crown_of_site(uint tile_number, uint site, out Crown crown) {
    uint stands = Words(GROWTH.sites).at[tile_number * sites_per_tile + site];
    if (stands == 0u) return false;
    GrowthTile tile = GrowthTiles(GROWTH.tiles).at[tile_number];
    uint hash = hash_of_site(tile, site);
    SitePlace place;
    if (!place_of_site(tile, site, hash, place)) return false;
    crown = crown_at(place.view, hash, stands);
    return true;
}

// Whether all within a radius of the line between two places lies behind the eye or beyond one side of the picture.
bool is_beside_picture(vec3 foot, vec3 top, float radius_m) {
    if (max(-foot.z, -top.z) + radius_m < 0.3) return true;
    vec2 scale = abs(FRAME.projection_scale), reach = radius_m * sqrt(scale * scale + (1.0 + abs(FRAME.projection_shift)) * (1.0 + abs(FRAME.projection_shift)));
    vec2 one = FRAME.projection_scale * foot.xy - FRAME.projection_shift * foot.z, other = FRAME.projection_scale * top.xy - FRAME.projection_shift * top.z;
    // w is -z: beyond a side where the coordinate across is larger than it.
    return any(greaterThan(min(one + foot.z, other + top.z), reach)) || any(greaterThan(min(foot.z - one, top.z - other), reach));
}

// The pixels of the picture that may show what is within a radius of the line between two places: an empty box where there are none.
// From the balls around both.
ivec4 pixels_around(vec3 foot, vec3 top, float radius_m) {
    vec2 low = vec2(1.0e30), high = vec2(-1.0e30), half_size = 0.5 * vec2(FRAME.width_px, FRAME.height_px);
    for (int i = 0; i < 2; ++i) {
        vec3 at = i == 0 ? foot : top;
        float w = -at.z, near_m = w - radius_m;
        if (near_m < 0.5) return is_beside_picture(foot, top, radius_m) ? ivec4(0, 0, -1, -1) : ivec4(0, 0, FRAME.width_px - 1u, FRAME.height_px - 1u);
        vec2 middle = at.xy / w, reach = radius_m * (1.0 + abs(middle)) / near_m;
        low = min(low, (middle - reach) * FRAME.projection_scale);
        high = max(high, (middle + reach) * FRAME.projection_scale);
        low = min(low, (middle + reach) * FRAME.projection_scale);
        high = max(high, (middle - reach) * FRAME.projection_scale);
    }
    vec2 first = (low + FRAME.projection_shift + 1.0) * half_size, last = (high + FRAME.projection_shift + 1.0) * half_size, end = vec2(FRAME.width_px, FRAME.height_px);
    ivec4 box = ivec4(ivec2(clamp(floor(first), vec2(-1.0), end)), ivec2(clamp(floor(last), vec2(-1.0), end)));
    return ivec4(max(box.xy, ivec2(0)), min(box.zw, ivec2(end) - 1));
}
bool is_empty(ivec4 box) { return box.x > box.z || box.y > box.w; }
// No part of a crown has a larger depth than this, of the frame's: near_m over metres.
float nearest_depth(vec3 foot, vec3 top, float radius_m) { return FRAME.near_m / max(min(-foot.z, -top.z) - radius_m, 0.01) * 1.0001; }

// Whether nearer ground is in all pixels of a box.
bool is_behind_ground(ivec4 box, float depth) {
    if (GROWTH.farthest == uvec2(0u)) return false;
    ivec2 first = box.xy / int(depth_block_px), last = box.zw / int(depth_block_px);
    if (any(greaterThan(last - first, ivec2(7)))) return false;
    int across = int((FRAME.width_px + depth_block_px - 1u) / depth_block_px);
    for (int row = first.y; row <= last.y; ++row)
        for (int column = first.x; column <= last.x; ++column)
            if (Floats(GROWTH.farthest).at[row * across + column] <= depth) return false;
    return true;
}

// Through a pixel, of depth 1.
vec3 ray_of_pixel(ivec2 pixel) {
    vec2 clip = (vec2(pixel) + 0.5) * 2.0 / vec2(FRAME.width_px, FRAME.height_px) - 1.0;
    return vec3((clip - FRAME.projection_shift) / FRAME.projection_scale, -1.0);
}
