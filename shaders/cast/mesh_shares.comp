#version 460
// What each pixel sees of the sun past meshes: eight lines over its disc, followed together through a tree of triangles. Light is parallel
// and straight, and comes from where the sun is seen from the eye, as past terrain. Joined to what the terrain of all grids leaves.
#extension GL_GOOGLE_include_directive : require
#include "shaders/place/frame.glsl"
#include "shaders/choose/levels.glsl"
#include "shaders/place/place.glsl"
#include "shaders/cast/casters.glsl"
#include "shaders/shared_mesh_casters.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const bool from_compute = false;  // ids come from the compute rasteriser's buffer
layout(binding = 0, r32ui) uniform readonly uimage2D ids;
layout(push_constant, scalar) uniform Pushed { uvec2 shadows; };

layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer ShadowTable { MeshShadows at; };
layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer MeshNodes { MeshNode at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer MeshTriangles { MeshTriangle at[]; };

const float disc_rad = 0.00465;  // the sun's radius, as air.glsl has it

// Of an angle below half a radian: its series. A GPU's sin() may be off by 4e-7, which is 2.5 m of an angle at the Earth's middle.
float small_sin(float angle) {
    float square = angle * angle;
    return angle * (1.0 - square * (1.0 / 6.0) * (1.0 - square * (1.0 / 20.0) * (1.0 - square * (1.0 / 42.0))));
}

// From the eye to a place on the ellipsoid's normal, in the eye's meridian frame (out of the axis, east, north along it): differences
// alone, so that no digit of the Earth's radius is lost.
vec3 from_eye_m(CastPlace place) {
    EyePost eye = FRAME.eye_post;
    float c0 = eye.latitude.x, s0 = eye.latitude.y, turn = place.from_eye_rad.x, half_turn = small_sin(0.5 * turn);
    float sine = small_sin(turn), versine = 2.0 * half_turn * half_turn;
    float fall = c0 * versine + s0 * sine;   // of the cosine of latitude
    float rise = c0 * sine - s0 * versine;   // of its sine
    float c = c0 - fall, s = s0 + rise, w0 = sqrt(1.0 - eye.e2 * s0 * s0), w = sqrt(1.0 - eye.e2 * s * s);
    float normal_m = eye.normal_m * w0 / w, more_m = eye.normal_m * eye.e2 * rise * (2.0 * s0 + rise) / (w * (w0 + w));
    float higher_m = place.h_m - FRAME.eye_h_m, half_east = small_sin(0.5 * place.from_eye_rad.y);
    float rho_m = (normal_m + place.h_m) * c;
    float out_m = (more_m + higher_m) * c - (eye.normal_m + FRAME.eye_h_m) * fall - rho_m * 2.0 * half_east * half_east;
    float north_m = (more_m * (1.0 - eye.e2) + higher_m) * s + (eye.normal_m * (1.0 - eye.e2) + FRAME.eye_h_m) * rise;
    return vec3(out_m, rho_m * small_sin(place.from_eye_rad.y), north_m);
}

// Of a vector in the eye's meridian frame.
vec3 ecef_axes(vec3 v, vec2 meridian) { return vec3(meridian.x * v.x - meridian.y * v.y, meridian.y * v.x + meridian.x * v.y, v.z); }

vec3 towards_sun() {
    vec2 latitude = FRAME.eye_post.latitude;
    vec3 sun = FRAME.style.sun_enu;
    return vec3(latitude.x * sun.z - latitude.y * sun.y, sun.x, latitude.y * sun.z + latitude.x * sun.y);
}

// Lines over the disc, each for as much of it, in a spiral. Source: H. Vogel, A better way to construct the sunflower head, Mathematical
// Biosciences 44, 1979.
vec3 sun_line(vec3 sun, vec3 one, vec3 other, uint number) {
    float far = disc_rad * sqrt((float(number) + 0.5) / float(mesh_sun_lines)), angle = 2.39996323 * float(number);
    return normalize(sun + far * (cos(angle) * one + sin(angle) * other));
}

// A line from so far on. Source: T. Moeller, B. Trumbore, Fast, minimum storage ray/triangle intersection, Journal of Graphics Tools 2(1), 1997.
bool is_met(MeshTriangle triangle, vec3 from, vec3 line, float from_m) {
    vec3 p = cross(line, triangle.other);
    float det = dot(triangle.one, p);
    if (det == 0.0) return false;
    vec3 begin = from - triangle.corner, q = cross(begin, triangle.one);
    float u = dot(begin, p) / det, v = dot(line, q) / det;
    return u >= 0.0 && v >= 0.0 && u + v <= 1.0 && dot(triangle.other, q) / det > from_m;
}

// Whether any line of the disc may meet a box: the middle one does, where it is made wider by what the others are off at its far end.
bool is_near(MeshNode node, vec3 from, vec3 sun, vec3 per_m) {
    vec3 middle = 0.5 * (node.low + node.high), half_size = 0.5 * (node.high - node.low);
    float wider_m = 0.01 + 1.01 * disc_rad * (length(middle - from) + length(half_size));
    vec3 one = (node.low - wider_m - from) * per_m, other = (node.high + wider_m - from) * per_m, near = min(one, other), far = max(one, other);
    return min(min(far.x, far.y), far.z) >= max(max(max(near.x, near.y), near.z), 0.0);
}

float share_past_meshes(MeshShadows table, vec3 from, vec3 sun, float from_m) {
    vec3 other = normalize(abs(sun.z) < 0.9 ? cross(sun, vec3(0.0, 0.0, 1.0)) : cross(sun, vec3(1.0, 0.0, 0.0))), one = cross(other, sun);
    vec3 lines[mesh_sun_lines];
    for (uint i = 0u; i < mesh_sun_lines; ++i) lines[i] = sun_line(sun, one, other, i);
    vec3 per_m = 1.0 / mix(sun, vec3(1.0e-9), lessThan(abs(sun), vec3(1.0e-9)));
    const uint all = (1u << mesh_sun_lines) - 1u;
    uint met = 0u, waiting[mesh_tree_depth], count = 1u;
    waiting[0] = 0u;
    while (count > 0u && met != all) {
        MeshNode node = MeshNodes(table.nodes).at[waiting[--count]];
        if (!is_near(node, from, sun, per_m)) continue;
        if (node.count == 0u && count + 2u <= mesh_tree_depth) {
            waiting[count++] = node.first;
            waiting[count++] = node.first + 1u;
        }
        for (uint k = 0u; k < node.count; ++k) {
            MeshTriangle triangle = MeshTriangles(table.triangles).at[node.first + k];
            for (uint i = 0u; i < mesh_sun_lines; ++i)
                if ((met >> i & 1u) == 0u && is_met(triangle, from, lines[i], from_m)) met |= 1u << i;
        }
    }
    return 1.0 - float(bitCount(met)) / float(mesh_sun_lines);
}

uint id_at(ivec2 pixel) {
    return from_compute ? id_of(VisibilityWords(FRAME.visibility).at[uint(pixel.y) * FRAME.width_px + uint(pixel.x)]) : imageLoad(ids, pixel).x;
}

// Written by a function: glslang 12.0 does not end on such an assignment in main().
void keep(uint pixel, float share) {
    CasterShares shown = CasterShares(CasterList(FRAME.casters).at.shown_shares);
    shown.at[pixel] = min(shown.at[pixel], share);
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (pixel.x >= int(FRAME.width_px) || pixel.y >= int(FRAME.height_px) || id_at(pixel) == 0u) return;
    uint number = uint(pixel.y) * FRAME.width_px + uint(pixel.x);
    MeshShadows table = ShadowTable(shadows).at;
    CastPlace place = CastPlaces(CasterList(FRAME.casters).at.places).at[number];
    vec3 from = table.eye_m + ecef_axes(from_eye_m(place), table.meridian);
    // What rounding and the picture's own triangles may be off: a line does not meet the triangle that it begins on.
    float from_m = 0.02 + 2.0e-6 * place.distance_m, share = share_past_meshes(table, from, ecef_axes(towards_sun(), table.meridian), from_m);
    if (share < 1.0) keep(number, share);
}
