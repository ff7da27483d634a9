#version 460
// Mirrors in water what stands beyond it, in a picture whose pixels are coloured: from a pixel of water the mirrored line of sight is followed
// over the picture to where it goes behind what that shows. What is not in the picture is not mirrored; water has the sky there (water.glsl).
// A picture of several tiles is followed over those that were drawn before, which are all that a line can meet (core/frame/tile_order.h).
#extension GL_GOOGLE_include_directive : require
#include "shaders/place/frame.glsl"
#include "shaders/growth/growth_table.glsl"
#include "shaders/growth/pixels_kept.glsl"
const bool in_air = true;
#include "shaders/shade/srgb.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 5) const bool edges_follow = false;  // edges.comp mixes what is in `sum`
#include "shaders/growth/kept_colour.glsl"
#include "shaders/growth/picture_kept.glsl"

const int line_steps = 56;
const float first_step = 0.004, longer = 1.12, line_most_m = 40000.0;  // of the water's distance; each of the one before
const float ripple_rad = 0.012;  // by which lakes' waves tilt the line: a light breeze

vec2 place_on_picture(vec3 view) {
    return 0.5 * vec2(FRAME.width_px, FRAME.height_px) * (FRAME.projection_scale * view.xy / -view.z + FRAME.projection_shift + 1.0);
}
bool is_on_picture(vec3 view, out ivec2 pixel) {
    if (-view.z < 1.0) return false;
    pixel = ivec2(floor(clamp(place_on_picture(view), vec2(-1.0e6), vec2(1.0e6))));
    return is_within(pixel + first_of_frame(), size_of_picture());
}
// How far behind what its pixel shows a place is, metres along the view's axis; negative: before it.
float behind_m(vec3 view, ivec2 pixel) {
    float depth = depth_anywhere(pixel);
    return depth == 0.0 ? -1.0 : -view.z - FRAME.near_m / depth;
}

// The colour where a line meets what the picture shows, and how much that counts: 0 where it meets nothing, less towards the picture's edge.
vec4 met_by(vec3 from, vec3 along, float begin_m) {
    float before_m = 0.0, at_m = begin_m, step_m = begin_m;
    for (int i = 0; i < line_steps && at_m < line_most_m; ++i) {
        ivec2 pixel;
        if (!is_on_picture(from + at_m * along, pixel)) return vec4(0.0);
        float behind = behind_m(from + at_m * along, pixel);
        if (behind > 0.0 && behind < 3.0 * step_m) {
            for (int half_step = 0; half_step < 5; ++half_step) {
                float middle_m = 0.5 * (before_m + at_m);
                ivec2 middle;
                if (is_on_picture(from + middle_m * along, middle) && behind_m(from + middle_m * along, middle) > 0.0) {
                    at_m = middle_m;
                    pixel = middle;
                } else before_m = middle_m;
            }
            vec4 there = kept_anywhere(pixel);
            if (there.w == 0.0) return vec4(0.0);
            if (there.w > 0.0) {
                ivec2 on = pixel + first_of_frame(), size = size_of_picture();
                vec2 edge = vec2(min(on, size - on)) / (0.06 * float(size.y));
                return vec4(there.rgb, min(there.w, 1.0) * clamp(min(edge.x, edge.y), 0.0, 1.0));
            }
        }
        before_m = at_m;
        step_m *= longer;
        at_m += step_m;
    }
    return vec4(0.0);
}

void mirror(ivec2 pixel) {
    if (pixel.x >= int(FRAME.width_px) || pixel.y >= int(FRAME.height_px)) return;
    vec4 own = kept_at(pixel);
    float depth = depth_in(pixel);
    if (own.w >= 0.0) return;
    vec3 ray = ray_through(pixel), to_eye = -normalize(ray);
    vec3 view = depth > 0.0 ? ray * (FRAME.near_m / depth) : vec3(0.0);
    if (depth <= 0.0) return;
    vec3 up = normalize(view + (FRAME.earth_radius_m + FRAME.eye_h_m) * FRAME.up_view);
    // As water_radiance() has it.
    float steep = clamp(dot(to_eye, up), 0.0, 1.0), rise = min(sqrt(steep * steep + FRAME.style.water.wave_variance), 1.0);
    float mirrored = 0.02 + 0.98 * pow(1.0 - rise, 5.0);
    if (mirrored < 0.03) return;
    vec3 away = reflect(-to_eye, up);
    float begin_m = max(first_step * length(view), 1.0);
    vec4 met = vec4(0.0);
    for (int i = 0; i < 4; ++i) {
        vec4 one = met_by(view, normalize(away + ripple_rad * (float(i) - 1.0) * up), begin_m);
        met += 0.25 * vec4(one.rgb * one.a, one.a);
    }
    if (met.a <= 0.0) return;
    float share = -own.w * mirrored;
    change_colour(pixel, vec4(own.rgb, 1.0), vec4((1.0 - share * met.a) * own.rgb + share * met.rgb, 1.0));
}

void main() { mirror(ivec2(gl_GlobalInvocationID.xy)); }
