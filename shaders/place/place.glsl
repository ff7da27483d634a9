// Exact placement of posts in float32, relative to the eye. Needs frame.glsl and levels.glsl.
// Every expression is `precise`: the same post gives the same bits in every workgroup and shader that asks for it, and from every
// page and level that has it.
#include "shaders/place/bend.glsl"
#include "shaders/place/seam.glsl"

#include "shaders/place/heights.glsl"

// The sum of a 64-bit and a 32-bit whole number of steps, rounded once if it fits 32 bits, and by its value alone otherwise. Metres.
float lattice_m(uint low, uint high, int more) {
    uint carry, sum = uaddCarry(low, uint(more), carry);
    int top = int(high) + (more >> 31) + int(carry);
    precise float whole = float(int(sum));
    if (top != (int(sum) >> 31)) whole = float(top) * 4294967296.0 + float(sum);
    return whole * height_step_m;
}

// Adds a product of two whole numbers to one of 64 bits.
void add_product(inout uint low, inout uint high, int one, int other) {
    int product_high, product_low;
    imulExtended(one, other, product_high, product_low);
    uint carry;
    low = uaddCarry(low, uint(product_low), carry);
    high += uint(product_high) + carry;
}

// From the eye's lattice point to what the steps of a post are counted from, along an axis: 64 bits.
uvec2 places_begin(FramePage page, PlacesOfPages places, uvec2 post, uint axis) {
    uint low = page.from_eye_low[axis], high = page.from_eye_high[axis];
    if ((page.cull & places_from_plane) != 0u) {
        add_product(low, high, int(post.x) - places.at[0].middle_row, places.at[0].row_step[axis]);
        add_product(low, high, int(post.y) - places.at[0].middle_column, places.at[0].column_step[axis]);
        add_product(low, high, 1, places.at[0].middle[axis]);
    }
    return uvec2(low, high);
}

// The same for a grid whose posts lie on a net (PagePlaces): along the axes of ECEF. The difference of post and eye is exact until it is
// rounded to a float.
vec3 place_on_net(FramePage page, uvec2 post) {
    precise vec3 position;
    if (draws_meshes()) {
        ivec3 steps = mesh_steps(MeshWords(page.block), post);
        for (uint axis = 0u; axis < 3u; ++axis)
            position[axis] = lattice_m(page.from_eye_low[axis], page.from_eye_high[axis], steps[axis]) - FRAME.eye_remainder[axis];
        return position;
    }
    PlacesOfPages places = PlacesOfPages(page.places);
    uint first = 3u * (post.x * page_posts + post.y);
    for (uint axis = 0u; axis < 3u; ++axis) {
        uvec2 begin = places_begin(page, places, post, axis);
        position[axis] = lattice_m(begin.x, begin.y, places.at[0].steps[first + axis]) - FRAME.eye_remainder[axis];
    }
    if ((page.cull & is_skirt) != 0u) position += gap_reach_m(page, post, position);
    return position;
}

// Position in the eye's meridian frame; within 1 mm up to 4 km away, and 1 mm and 3.2e-7 of the distance beyond (0.0005 px).
vec3 place_from_eye(FramePage page, uvec2 post, int height) {
    if (HAS_NET) {
        vec2 meridian = FRAME.eye_meridian;
        precise vec3 ecef = place_on_net(page, post);
        precise vec3 turned = vec3(meridian.x * ecef.x + meridian.y * ecef.y, meridian.x * ecef.y - meridian.y * ecef.x, ecef.z);
        return turned;
    }
    RowTerms t = RowTable(FRAME.row_terms).at[page.row_terms + post.x];
    ColumnTerms u = ColumnTable(FRAME.column_terms).at[page.column_terms + post.y];
    precise float dh = float(height - FRAME.reference_steps) * height_step_m;
    precise float r = t.P + dh * t.Q;
    precise vec3 position;
    position.x = (t.R + dh * t.C) - r * u.V;
    position.y = r * u.W;
    position.z = t.Z + dh * t.S;
    return position;
}

vec3 ecef_rounded(vec3 from_eye) {
    vec2 meridian = FRAME.eye_meridian;
    precise vec3 turned;
    turned.x = meridian.x * from_eye.x - meridian.y * from_eye.y;
    turned.y = meridian.y * from_eye.x + meridian.x * from_eye.y;
    turned.z = from_eye.z;
    precise vec3 ecef = FRAME.eye_high + (turned + FRAME.eye_low);
    return ecef;
}

// What float32 ECEF makes of a position: rounded to float in ECEF, then relative to the eye without further loss, or as a view matrix
// in float32 does it.
vec3 view_by_ecef(vec3 from_eye) {
    precise vec3 ecef = ecef_rounded(from_eye);
    precise vec3 view;
    if (FRAME.placing == placing_naive) view = FRAME.view_from_ecef * ecef + FRAME.view_translation;
    else view = FRAME.view_from_ecef * ((ecef - FRAME.eye_high) - FRAME.eye_low);
    return view;
}

// Position in view coordinates, as it is seen. post: (row, column) within the page.
vec3 place_in_view(FramePage page, uvec2 post, int height) {
    precise vec3 position;
    if (HAS_NET) {
        position = FRAME.view_from_ecef * place_on_net(page, post);
    } else {
        vec3 from_eye = place_from_eye(page, post, height);
        position = FRAME.view_from_eye * from_eye;
        if (FRAME.placing != placing_relative) position = view_by_ecef(from_eye);
    }
    if (FRAME.refraction_per_m != 0.0) position = bent(position);
    return position;
}

// Reversed depth without a far plane: near is 1, infinity 0.
vec4 project(vec3 view) {
    precise vec4 clip;
    clip.w = -view.z;
    clip.x = FRAME.projection_scale.x * view.x + FRAME.projection_shift.x * clip.w;
    clip.y = FRAME.projection_scale.y * view.y + FRAME.projection_shift.y * clip.w;
    clip.z = FRAME.near_m;
    return clip;
}

// Quads of a meshlet: 8, or fewer where the region ends.
uvec2 quads_of(FramePage page, uint meshlet) {
    uvec2 last = uvec2(FRAME.last_row, FRAME.last_column) + (1u << page.level) - 1u;
    return min((last >> page.level) - (uvec2(page.first_row, page.first_column) >> page.level) - first_post(meshlet), uvec2(meshlet_quads));
}

// The post of a meshlet's vertex (row, column within the meshlet) in its page, after stitching.
uvec2 vertex_post(FramePage page, uint meshlet, uvec2 vertex, uint edges) {
    if (draws_meshes()) return uvec2(vertex.x * meshlet_posts + vertex.y, meshlet);
    uvec2 corner = first_post(meshlet);
    if (edges == 0u) return corner + vertex;
    return corner + stitched_post(vertex, quads_of(page, meshlet), edges);
}

// The three posts of a drawn meshlet's triangle as (row, column) within the meshlet, before stitching.
void triangle_posts(FramePage page, uint meshlet, uint triangle, uint edges, out uvec2 a, out uvec2 b, out uvec2 c) {
    if (draws_meshes()) {
        uvec3 at = mesh_triangle_vertices(MeshWords(page.block), meshlet, triangle);
        a = uvec2(at.x / meshlet_posts, at.x % meshlet_posts);
        b = uvec2(at.y / meshlet_posts, at.y % meshlet_posts);
        c = uvec2(at.z / meshlet_posts, at.z % meshlet_posts);
        return;
    }
    uint cell = triangle >> 1u;
    uvec2 nw = uvec2(cell / meshlet_quads, cell % meshlet_quads);
    bool sw_ne = sw_ne_in_meshlet(PageBlocks(page.block), meshlet, cell);
    if (sw_ne && edges != 0u) sw_ne = drawn_sw_ne(sw_ne, nw, quads_of(page, meshlet), edges);
    quad_posts(nw, sw_ne, triangle & 1u, a, b, c);
}

// Posts as row << 8 | column: do they span a triangle? Stitching lets posts fall together or into one line.
bool has_area(uint a, uint b, uint c) {
    if (draws_meshes()) return a != b && b != c && c != a;
    ivec2 to_b = ivec2(int(b >> 8) - int(a >> 8), int(b & 255u) - int(a & 255u));
    ivec2 to_c = ivec2(int(c >> 8) - int(a >> 8), int(c & 255u) - int(a & 255u));
    return to_b.x * to_c.y != to_b.y * to_c.x;
}
