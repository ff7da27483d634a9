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

// At most near_px wide and high: then 32 bits hold every product of draw_near, and its depths do not depend on where a box begins.
const int near_px = 64;
bool fits_near(ScreenTriangle t) {
    ivec2 size = max(t.a, max(t.b, t.c)) - min(t.a, min(t.b, t.c));
    return max(size.x, size.y) <= near_px * subpixels;
}

// Edge functions of a triangle that fits_near at a box's first pixel, and their steps from pixel to pixel.
struct NearEdges {
    ivec3 first, by_x, by_y;  // a to b, b to c, c to a
    ivec3 bias;
    float area;
};
NearEdges near_edges(ScreenTriangle t, ivec4 box) {
    ivec2 origin = box.xy * subpixels + ivec2(subpixels / 2);
    ivec2 a = t.a - origin, b = t.b - origin, c = t.c - origin;
    NearEdges e;
    e.first.x = (b.x - a.x) * (0 - a.y) - (b.y - a.y) * (0 - a.x);
    e.first.y = (c.x - b.x) * (0 - b.y) - (c.y - b.y) * (0 - b.x);
    e.first.z = (a.x - c.x) * (0 - c.y) - (a.y - c.y) * (0 - c.x);
    e.by_x = -subpixels * ivec3(b.y - a.y, c.y - b.y, a.y - c.y);
    e.by_y = subpixels * ivec3(b.x - a.x, c.x - b.x, a.x - c.x);
    e.bias = ivec3(edge_bias(t.a, t.b), edge_bias(t.b, t.c), edge_bias(t.c, t.a));
    e.area = float(e.first.x + e.first.y + e.first.z);
    return e;
}

void draw_near_pixel(ScreenTriangle t, NearEdges e, ivec2 pixel, ivec3 edges) {
    ivec3 biased = edges + e.bias;
    if ((biased.x | biased.y | biased.z) < 0) return;
    keep_nearest(pixel, depth_at(t, float(edges.z) / e.area, float(edges.x) / e.area), t.id);
}

// The pixels of `box` that are inside, every `stride`-th from `start` on. The triangle fits_near.
void draw_near(ScreenTriangle t, ivec4 box, uint start, uint stride) {
    NearEdges e = near_edges(t, box);
    int width = box.z - box.x + 1;
    uint count = uint(width * (box.w - box.y + 1));
    for (uint i = start; i < count; i += stride) {
        ivec2 step = ivec2(int(i) % width, int(i) / width);
        draw_near_pixel(t, e, box.xy + step, e.first + e.by_x * step.x + e.by_y * step.y);
    }
}

// All of them, by one invocation: row by row, without a division.
void draw_near_alone(ScreenTriangle t, ivec4 box) {
    NearEdges e = near_edges(t, box);
    ivec3 row = e.first, edges = row;
    ivec2 pixel = box.xy;
    while (pixel.y <= box.w) {
        draw_near_pixel(t, e, pixel, edges);
        ++pixel.x;
        edges += e.by_x;
        if (pixel.x <= box.z) continue;
        pixel = ivec2(box.x, pixel.y + 1);
        row += e.by_y;
        edges = row;
    }
}

// How many steps of `subpixels` a value of an edge function is from being negative. What is beyond all steps within a square is cut off.
int steps_inside(int64_t edge) {
    const int64_t most = int64_t(1 << 30);
    return int(clamp(edge >> 8, -most, most));
}

// The same for any triangle on the grid. `box` is a square of large_square_px at most, all of it or what of it is in the triangle's own
// box: most of them lie wholly within a triangle, or beside it. From pixel to pixel edge functions grow by multiples of `subpixels`: in
// these, rounded down, 32 bits tell what is inside.
void draw_far_square(ScreenTriangle t, ivec4 box, uint start, uint stride) {
    ivec2 origin = box.xy * subpixels + ivec2(subpixels / 2), more = box.zw - box.xy;
    int64_t ab = doubled_area(t.a, t.b, origin), bc = doubled_area(t.b, t.c, origin), ca = doubled_area(t.c, t.a, origin);
    ivec3 by_x = -ivec3(t.b.y - t.a.y, t.c.y - t.b.y, t.a.y - t.c.y), by_y = ivec3(t.b.x - t.a.x, t.c.x - t.b.x, t.a.x - t.c.x);
    ivec3 first = ivec3(steps_inside(ab + edge_bias(t.a, t.b)), steps_inside(bc + edge_bias(t.b, t.c)), steps_inside(ca + edge_bias(t.c, t.a)));
    ivec3 across = by_x * more.x, down = by_y * more.y;
    ivec3 most = first + max(across, ivec3(0)) + max(down, ivec3(0));
    if (min(most.x, min(most.y, most.z)) < 0) return;
    ivec3 least = first + min(across, ivec3(0)) + min(down, ivec3(0));
    bool within = min(least.x, min(least.y, least.z)) >= 0;
    float area = float(doubled_area(t.a, t.b, t.c));
    vec3 share_b = vec3(float(ca), float(by_x.z) * float(subpixels), float(by_y.z) * float(subpixels)) / area;
    vec3 share_c = vec3(float(ab), float(by_x.x) * float(subpixels), float(by_y.x) * float(subpixels)) / area;
    for (uint i = start; i < uint(more.y + 1) * large_square_px; i += stride) {
        ivec2 step = ivec2(i % large_square_px, i / large_square_px);
        if (step.x > more.x) continue;
        ivec3 edges = first + by_x * step.x + by_y * step.y;
        if (!within && (edges.x | edges.y | edges.z) < 0) continue;
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

// All of a triangle, by one invocation, as those to which it is handed on would draw it.
void draw_all(ScreenTriangle t, ivec4 box) {
    if (fits_near(t)) {
        draw_near_alone(t, box);
        return;
    }
    ivec4 squares = box / int(large_square_px);
    for (int y = squares.y; y <= squares.w; ++y) {
        for (int x = squares.x; x <= squares.z; ++x) draw_far_square(t, in_square(box, ivec2(x, y)), 0u, 1u);
    }
}

// One of those that were handed on (list_large.glsl).
ScreenTriangle large_triangle(uint at) {
    LargeTriangle large = LargeTriangles(FRAME.large_list).at[at];
    ScreenTriangle t;
    t.a = ivec2(large.ax, large.ay);
    t.b = ivec2(large.bx, large.by);
    t.c = ivec2(large.cx, large.cy);
    t.depth = vec3(large.az, large.bz, large.cz);
    t.id = large.id;
    return t;
}
