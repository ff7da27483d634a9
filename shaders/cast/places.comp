#version 460
// Where the ground is that a grid shows, pixel by pixel: for the other grids of a frame, whose terrain may take the sun from it.
#extension GL_GOOGLE_include_directive : require
const bool as_map = false;
const bool in_air = false;
const bool draped = false;
const bool by_means = false;
const bool parts_follow = false;
const bool parts_alone = false;
const bool casts = true;
const bool opens = false;
#include "shaders/place/frame.glsl"
#include "shaders/choose/levels.glsl"
#include "shaders/place/place.glsl"
#include "shaders/place/net.glsl"
#include "shaders/shade/surface.glsl"
#include "shaders/air/air.glsl"
#include "shaders/cast/casters.glsl"
#include "shaders/cast/shadow.glsl"
#include "shaders/cast/start.glsl"
#include "shaders/cast/shown.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const bool from_compute = false;  // ids come from the compute rasteriser's buffer
layout(binding = 0, r32ui) uniform readonly uimage2D ids;

// As angles_from_eye, of a place whose height is known: exact. At any height tan(latitude) = z / (rho k), k that of its own height.
vec2 angles_of(vec3 view, float h_m) {
    EyePost eye = FRAME.eye_post;
    vec3 straight = view;
    if (FRAME.refraction_per_m != 0.0) straight -= 0.5 * FRAME.refraction_per_m * squared_across(view) * FRAME.up_view;
    vec3 from_foot = (straight + (FRAME.eye_h_m - h_m) * FRAME.up_view) * FRAME.view_from_eye;
    float radius_m = eye.normal_m + h_m, k = 1.0 - eye.e2 * eye.normal_m / radius_m;
    float cosine = eye.latitude.x, sine = eye.latitude.y, rho_m = radius_m * cosine, out_m = rho_m + from_foot.x;
    float farther_m = (from_foot.x * (rho_m + out_m) + from_foot.y * from_foot.y) / (length(vec2(out_m, from_foot.y)) + rho_m);
    float higher_m = from_foot.z / k;
    float north_rad = small_atan(higher_m * cosine - farther_m * sine, radius_m + farther_m * cosine + higher_m * sine);
    return vec2(north_rad, small_atan(from_foot.y, out_m));
}

// From the numbers of posts, whatever Earth they are drawn on.
vec2 angles_of_post(CastPoint point) {
    EyePost eye = FRAME.eye_post;
    vec2 whole = floor(eye.post), posts = vec2(point.post - ivec2(whole)) + (point.beyond - (eye.post - whole));
    posts.y -= eye.turn * round(posts.y / eye.turn);
    return vec2(-posts.x, posts.y) / eye.per_rad;
}

// Of a seam's triangle: what closes a gap begins where the ground ends, without what it reaches beyond (seam.glsl); where no more of a step
// shows than a line, all of it is the rim of the ground above.
void hold_to_ground(FramePage page, uvec2 posts[3], vec3 view, inout float heights_m[3], inout vec3 at[3]) {
    if ((page.cull & is_skirt) == 0u) return;
    float step_m = abs(posts[0].y == posts[1].y ? heights_m[0] - heights_m[1] : heights_m[1] - heights_m[2]);
    bool is_line = step_m <= 2.0 * FRAME.tau_px / FRAME.pixels_per_tangent * length(view);
    page.cull &= ~is_skirt;
    for (int i = 0; i < 3; ++i) {
        uvec2 post = is_line ? uvec2(quad_of_post(posts[i]).x, posts[i].y) : posts[i];
        int height = post_height(PageBlocks(page.block), post);
        heights_m[i] = float(height) * height_step_m;
        at[i] = place_in_view(page, post, height);
    }
}

// Written by a function: glslang 12.0 does not end on such an assignment in main().
void keep(ivec2 pixel, CastPlace place) { CastPlaces(CasterList(FRAME.casters).at.places).at[pixel.y * int(FRAME.width_px) + pixel.x] = place; }

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (pixel.x >= int(FRAME.width_px) || pixel.y >= int(FRAME.height_px)) return;
    uint id = from_compute ? id_of(VisibilityWords(FRAME.visibility).at[uint(pixel.y) * FRAME.width_px + uint(pixel.x)])
                           : imageLoad(ids, pixel).x;
    if (!is_of_grid(id)) return;
    vec2 clip = (vec2(pixel) + 0.5) * 2.0 / vec2(FRAME.width_px, FRAME.height_px) - 1.0;
    vec3 ray = vec3((clip - FRAME.projection_shift) / FRAME.projection_scale, -1.0);
    uvec2 posts[3];
    vec3 at[3];
    float heights_m[3], scale;
    FramePage page = corners_of(triangle_of_id(id), posts, heights_m, at);
    vec2 shares = met_shares(ray, at, scale);
    vec3 all = vec3(1.0 - shares.x - shares.y, shares);
    SurfacePoint surface;
    surface.view = all.x * at[0] + all.y * at[1] + all.z * at[2];
    surface.post = place_on_page(page, triangle_of_id(id), posts, all);
    if (!has_posts()) {
        hold_to_ground(page, posts, surface.view, heights_m, at);
        surface.view = all.x * at[0] + all.y * at[1] + all.z * at[2];
    }
    CastPlace place;
    place.h_m = all.x * heights_m[0] + all.y * heights_m[1] + all.z * heights_m[2];
    place.distance_m = length(surface.view);
    if (HAS_NET) place.from_eye_rad = angles_of(surface.view, place.h_m);
    // What lies between grids casts nothing, and is drawn at full resolution.
    if (has_posts()) {
        CastPoint point = cast_point(triangle_of_id(id), surface);
        if (!HAS_NET) place.from_eye_rad = angles_of_post(point);
        CastStart start;
        if (starts_on_ground(point, start)) place.h_m = start.at.h_m;
    }
    keep(pixel, place);
}
