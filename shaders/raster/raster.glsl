// Exact coverage on a grid of 1/256 px with integer edge functions: triangles that share an edge share no pixel and leave none
// out, in whatever order they come. Needs frame.glsl and lists.glsl.
#extension GL_KHR_memory_scope_semantics : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_shader_atomic_int64 : require

layout(buffer_reference, scalar, buffer_reference_align = 16) buffer Visibility { uint64_t at[]; };

layout(constant_id = 3) const bool counts_overdraw = false;  // into FRAME.overdraw

const int subpixels = 256;
const float farthest_px = 16384.0;  // outside the picture; what reaches farther is clipped first

struct ScreenTriangle {
    ivec2 a, b, c;  // 1/256 px; positive area
    vec3 depth;     // reversed, of a, b, c
    uint id;
};

// A clip position on the pixel grid.
vec2 pixels_of(vec4 clip) {
    precise vec2 half_size = 0.5 * vec2(FRAME.width_px, FRAME.height_px);
    precise vec2 position = clip.xy / clip.w * half_size + half_size;
    return position;
}
ivec2 snapped(vec2 position_px) { return ivec2(roundEven(position_px * float(subpixels))); }

// Inside when not negative: the near plane, then the four sides of a frame of `farthest_px` around the picture.
const int clip_planes = 5;
float side_of(int plane, vec4 p) {
    vec2 reach = 1.0 + 2.0 * farthest_px / vec2(FRAME.width_px, FRAME.height_px);
    if (plane == 0) return p.w - FRAME.near_m;
    if (plane == 1) return reach.x * p.w - p.x;
    if (plane == 2) return reach.x * p.w + p.x;
    if (plane == 3) return reach.y * p.w - p.y;
    return reach.y * p.w + p.y;
}

// True when a triangle can be drawn as it is: in front of the near plane and within the range of the grid.
bool fits_grid(vec4 a, vec4 b, vec4 c) {
    bool fits = true;
    for (int plane = 0; plane < clip_planes; ++plane)
        fits = fits && min(side_of(plane, a), min(side_of(plane, b), side_of(plane, c))) >= 0.0;
    return fits;
}

// Twice the area, in squares of the grid; int64 because triangles may be 32,768 px long.
int64_t doubled_area(ivec2 a, ivec2 b, ivec2 c) {
    return int64_t(b.x - a.x) * int64_t(c.y - a.y) - int64_t(b.y - a.y) * int64_t(c.x - a.x);
}

// False for a triangle without area.
bool screen_triangle(vec4 a, vec4 b, vec4 c, uint id, out ScreenTriangle t) {
    t.a = snapped(pixels_of(a));
    t.b = snapped(pixels_of(b));
    t.c = snapped(pixels_of(c));
    t.depth = vec3(a.z / a.w, b.z / b.w, c.z / c.w);
    t.id = id;
    int64_t area = doubled_area(t.a, t.b, t.c);
    if (area < 0) {
        ivec2 corner = t.b;
        t.b = t.c;
        t.c = corner;
        t.depth = t.depth.xzy;
    }
    return area != 0;
}

// First and last pixel whose centre can be inside, within the picture; an empty box when there is none.
ivec4 pixel_box(ScreenTriangle t) {
    ivec2 low = min(t.a, min(t.b, t.c)), high = max(t.a, max(t.b, t.c));
    ivec2 first = (low + ivec2(subpixels / 2 - 1)) >> 8;  // ceil((low - 128) / 256)
    ivec2 last = (high - ivec2(subpixels / 2)) >> 8;      // floor((high - 128) / 256)
    return ivec4(max(first, ivec2(0)), min(last, ivec2(FRAME.width_px, FRAME.height_px) - 1));
}

// A pixel on an edge belongs to the triangle to whose top or left the edge is (Vulkan 1.3, 28.11.1): edges that go right along a
// row or upwards keep their zero, the others lose it.
int edge_bias(ivec2 from, ivec2 to) {
    ivec2 along = to - from;
    return (along.y < 0 || (along.y == 0 && along.x > 0)) ? 0 : -1;
}

void keep_nearest(ivec2 pixel, float depth, uint id) {
    Visibility visibility = Visibility(FRAME.visibility);
    uint at = uint(pixel.y) * FRAME.width_px + uint(pixel.x);
    if (counts_overdraw) atomicAdd(Words(FRAME.overdraw).at[at], 1u);
    // Where two are as near the lower id wins.
    uint64_t candidate = (uint64_t(floatBitsToUint(depth)) << 32) | uint64_t(~id);
    // Most that is behind costs a load and no exchange. The load is atomic, too: others write while it reads.
    uint64_t nearest = atomicLoad(visibility.at[at], gl_ScopeDevice, gl_StorageSemanticsBuffer, gl_SemanticsRelaxed);
    if (candidate > nearest)
        atomicMax(visibility.at[at], candidate, gl_ScopeDevice, gl_StorageSemanticsBuffer, gl_SemanticsRelaxed);
}

float depth_at(ScreenTriangle t, float share_b, float share_c) {
    precise float depth = t.depth.x + (t.depth.y - t.depth.x) * share_b + (t.depth.z - t.depth.x) * share_c;
    return depth;
}

// At most near_px wide and high: then 32 bits hold every product of draw_near.
const int near_px = 64;
bool fits_near(ScreenTriangle t) {
    ivec2 size = max(t.a, max(t.b, t.c)) - min(t.a, min(t.b, t.c));
    return max(size.x, size.y) <= near_px * subpixels;
}

// The pixels of `box` that are inside, every `stride`-th from `start` on. The triangle fits_near.
void draw_near(ScreenTriangle t, ivec4 box, uint start, uint stride) {
    ivec2 origin = box.xy * subpixels + ivec2(subpixels / 2);
    ivec2 a = t.a - origin, b = t.b - origin, c = t.c - origin;
    // Edge functions at the first pixel's centre, and their steps from pixel to pixel.
    int ab = (b.x - a.x) * (0 - a.y) - (b.y - a.y) * (0 - a.x);
    int bc = (c.x - b.x) * (0 - b.y) - (c.y - b.y) * (0 - b.x);
    int ca = (a.x - c.x) * (0 - c.y) - (a.y - c.y) * (0 - c.x);
    float area = float(ab + bc + ca);
    ivec3 by_x = -subpixels * ivec3(b.y - a.y, c.y - b.y, a.y - c.y);
    ivec3 by_y = subpixels * ivec3(b.x - a.x, c.x - b.x, a.x - c.x);
    ivec3 bias = ivec3(edge_bias(t.a, t.b), edge_bias(t.b, t.c), edge_bias(t.c, t.a));
    int width = box.z - box.x + 1;
    uint count = uint(width * (box.w - box.y + 1));
    for (uint i = start; i < count; i += stride) {
        ivec2 step = ivec2(int(i) % width, int(i) / width);
        ivec3 edges = ivec3(ab, bc, ca) + by_x * step.x + by_y * step.y;
        ivec3 biased = edges + bias;
        if ((biased.x | biased.y | biased.z) < 0) continue;
        keep_nearest(box.xy + step, depth_at(t, float(edges.z) / area, float(edges.x) / area), t.id);
    }
}

// The same in 64 bits, for any triangle on the grid. `box` is a square of large_square_px at most, all of it or what of it is in the
// triangle's own box: most of them lie wholly within a triangle, or beside it.
void draw_far_square(ScreenTriangle t, ivec4 box, uint start, uint stride) {
    ivec2 origin = box.xy * subpixels + ivec2(subpixels / 2), more = box.zw - box.xy;
    // At the first pixel's centre, and from pixel to pixel.
    int64_t ab = doubled_area(t.a, t.b, origin), bc = doubled_area(t.b, t.c, origin), ca = doubled_area(t.c, t.a, origin);
    int64_t ab_x = -int64_t(t.b.y - t.a.y) * subpixels, ab_y = int64_t(t.b.x - t.a.x) * subpixels;
    int64_t bc_x = -int64_t(t.c.y - t.b.y) * subpixels, bc_y = int64_t(t.c.x - t.b.x) * subpixels;
    int64_t ca_x = -int64_t(t.a.y - t.c.y) * subpixels, ca_y = int64_t(t.a.x - t.c.x) * subpixels;
    int64_t ab_in = ab + edge_bias(t.a, t.b), bc_in = bc + edge_bias(t.b, t.c), ca_in = ca + edge_bias(t.c, t.a);
    const int64_t none = int64_t(0);
    int64_t across = int64_t(more.x), down = int64_t(more.y);
    int64_t most = min(ab_in + max(ab_x * across, none) + max(ab_y * down, none),
                       min(bc_in + max(bc_x * across, none) + max(bc_y * down, none), ca_in + max(ca_x * across, none) + max(ca_y * down, none)));
    if (most < 0) return;
    int64_t least = min(ab_in + min(ab_x * across, none) + min(ab_y * down, none),
                        min(bc_in + min(bc_x * across, none) + min(bc_y * down, none), ca_in + min(ca_x * across, none) + min(ca_y * down, none)));
    bool within = least >= 0;
    float area = float(doubled_area(t.a, t.b, t.c));
    vec3 share_b = vec3(float(ca), float(ca_x), float(ca_y)) / area, share_c = vec3(float(ab), float(ab_x), float(ab_y)) / area;
    for (uint i = start; i < uint(more.y + 1) * large_square_px; i += stride) {
        ivec2 step = ivec2(i % large_square_px, i / large_square_px);
        if (step.x > more.x) continue;
        if (!within) {
            int64_t x = int64_t(step.x), y = int64_t(step.y);
            if (((ab_in + ab_x * x + ab_y * y) | (bc_in + bc_x * x + bc_y * y) | (ca_in + ca_x * x + ca_y * y)) < 0) continue;
        }
        precise float b = share_b.x + share_b.y * float(step.x) + share_b.z * float(step.y);
        precise float c = share_c.x + share_c.y * float(step.x) + share_c.z * float(step.y);
        keep_nearest(box.xy + step, depth_at(t, b, c), t.id);
    }
}

// What of a triangle's box is in a square, by its number along x and y.
ivec4 in_square(ivec4 box, ivec2 square) {
    ivec2 first = square * int(large_square_px);
    return ivec4(max(box.xy, first), min(box.zw, first + int(large_square_px) - 1));
}

// All squares of a triangle, by one invocation.
void draw_far(ScreenTriangle t, ivec4 box) {
    ivec4 squares = box / int(large_square_px);
    for (int y = squares.y; y <= squares.w; ++y) {
        for (int x = squares.x; x <= squares.z; ++x) draw_far_square(t, in_square(box, ivec2(x, y)), 0u, 1u);
    }
}

// Hands a triangle on to as many workgroups as it has squares. False when the lists are full.
bool list_large(ScreenTriangle t, ivec4 box) {
    ivec4 squares = box / int(large_square_px);
    uvec2 counts = uvec2(squares.zw - squares.xy + 1);
    uint count = counts.x * counts.y;
    uint triangle = atomicAdd(lists().at.large, 1u);
    uint first = atomicAdd(lists().at.tasks, count);
    bool fits = triangle < large_max && first + count <= tasks_max;
    if (fits) {
        // Member by member: glslang 12.0 crashes on storing a whole struct that holds `precise` values.
        LargeTriangles triangles = LargeTriangles(FRAME.large_list);
        triangles.at[triangle].ax = t.a.x;
        triangles.at[triangle].ay = t.a.y;
        triangles.at[triangle].bx = t.b.x;
        triangles.at[triangle].by = t.b.y;
        triangles.at[triangle].cx = t.c.x;
        triangles.at[triangle].cy = t.c.y;
        triangles.at[triangle].az = t.depth.x;
        triangles.at[triangle].bz = t.depth.y;
        triangles.at[triangle].cz = t.depth.z;
        triangles.at[triangle].id = t.id;
    }
    LargeTasks list = LargeTasks(FRAME.task_list);
    for (uint i = 0u; i < count && first + i < tasks_max; ++i) {
        uvec2 square = uvec2(squares.xy) + uvec2(i % counts.x, i / counts.x);
        list.at[first + i].triangle = fits ? triangle : no_triangle;
        list.at[first + i].square = square.x | (square.y << 16);
    }
    if (!fits) return false;
    uint last = first + count;
    atomicMax(lists().at.task_groups[0], min(last, groups_per_row));
    atomicMax(lists().at.task_groups[1], (last + groups_per_row - 1u) / groups_per_row);
    return true;
}
