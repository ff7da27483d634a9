// What a mesh workgroup draws at a time: a meshlet, or half of one (HALVES). Vertices and triangles of such a part by number, row by
// row, so that the ids of its triangles ascend. Needs payload.glsl.
#ifdef HALVES
const uint part_vertices = half_vertices, part_triangles = half_triangles;

// The vertex of its meshlet (row, column) that is number i of a part.
uvec2 vertex_of_part(uint part, uint i) {
    const uint half_posts = half_quads + 1u;
    if (half_of(part) == first_columns) return uvec2(i / half_posts, i % half_posts);
    return uvec2(i / meshlet_posts + (half_of(part) == last_rows ? half_quads : 0u), i % meshlet_posts);
}

// The inverse, of three: their rows, their columns.
uvec3 vertices_in_part(uint part, uvec3 rows, uvec3 columns) {
    if (half_of(part) == first_columns) return rows * (half_quads + 1u) + columns;
    return (rows - (half_of(part) == last_rows ? half_quads : 0u)) * meshlet_posts + columns;
}

// The triangle of its meshlet that is number i of a part.
uint triangle_of_part(uint part, uint i) {
    if (half_of(part) == first_columns) return i / (2u * half_quads) * (2u * meshlet_quads) + i % (2u * half_quads);
    return i + (half_of(part) == last_rows ? half_triangles : 0u);
}
#else
const uint part_vertices = meshlet_vertices, part_triangles = meshlet_triangles;

uvec2 vertex_of_part(uint part, uint i) { return uvec2(i / meshlet_posts, i % meshlet_posts); }
uvec3 vertices_in_part(uint part, uvec3 rows, uvec3 columns) { return rows * meshlet_posts + columns; }
uint triangle_of_part(uint part, uint i) { return i; }
#endif
