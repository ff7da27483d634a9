// Triangles of meshes (core/seam/mesh_pages.h): what a node holds. A vertex is asked for as a post of its page is, as
// (number in its meshlet, meshlet). Needs frame.glsl.
#include "shaders/shared_mesh_pages.h"

layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer MeshWords {
    uint before[3335];  // packed_words_before
    uint at[];
};

// Whether a frame may have pages of meshes: programs without the code for them take fewer registers.
layout(constant_id = 105) const bool meshes_there = false;  // render/pipelines/pipeline_parts.cpp

bool draws_meshes() { return meshes_there && HAS_NET && FRAME.contents == contents_meshes; }

uint mesh_bits(MeshWords words, uint bit, uint count) {
    if (count == 0u) return 0u;
    uint word = bit >> 5u, first = bit & 31u, value = words.at[word] >> first;
    if (first + count > 32u) value |= words.at[word + 1u] << (32u - first);
    return bitfieldExtract(value, 0, int(count));
}

struct MeshTables {
    uint first;       // the node's first word; 0: it has none
    uint counts;      // its first word itself
    uvec3 widths;
    uvec4 row_bits;   // of vertices, triangles, attributes, looks
    uvec4 first_bit;  // ... where each table begins
};

uint mesh_width(MeshTables tables, uint column) { return tables.widths[column >> 2u] >> ((column & 3u) * 6u) & 63u; }
uint mesh_attribute_bits(MeshTables tables) { return tables.widths.z >> 12u & 63u; }
uint mesh_look_bits(MeshTables tables) { return tables.widths.z >> 18u & 63u; }
uvec2 mesh_vertex_counts(MeshTables tables) { return uvec2(tables.counts & 63u, tables.counts >> 6u & 63u); }
uvec2 mesh_triangle_counts(MeshTables tables) { return uvec2(tables.counts >> 12u & 127u, tables.counts >> 19u & 127u); }
bool is_by_vertex(MeshTables tables) { return (tables.counts >> mesh_by_vertex_bit & 1u) != 0u; }

MeshTables mesh_tables(MeshWords words, uint meshlet) {
    MeshTables tables;
    tables.first = words.at[meshlet];
    tables.counts = tables.first == 0u ? 0u : words.at[tables.first];
    tables.widths = uvec3(0u);
    if (tables.first != 0u) tables.widths = uvec3(words.at[tables.first + 1u], words.at[tables.first + 2u], words.at[tables.first + 3u]);
    tables.row_bits.x = mesh_width(tables, 0u) + mesh_width(tables, 1u) + mesh_width(tables, 2u) + mesh_width(tables, 3u);
    tables.row_bits.y = 3u * (mesh_vertex_bits + mesh_attribute_bits(tables)) + mesh_look_bits(tables);
    tables.row_bits.z = mesh_width(tables, 4u) + mesh_width(tables, 5u) + mesh_width(tables, 6u) + mesh_width(tables, 7u);
    tables.row_bits.w = mesh_width(tables, 8u) + mesh_width(tables, 9u);
    uvec2 vertices = mesh_vertex_counts(tables), triangles = mesh_triangle_counts(tables);
    tables.first_bit.x = 32u * (tables.first + mesh_head_words);
    tables.first_bit.y = tables.first_bit.x + (vertices.x + vertices.y) * tables.row_bits.x;
    tables.first_bit.z = tables.first_bit.y + (triangles.x + triangles.y) * tables.row_bits.y;
    // Looks stand before attributes: there is no count of these.
    tables.first_bit.w = tables.first_bit.z;
    tables.first_bit.z += (1u << mesh_look_bits(tables)) * tables.row_bits.w;
    return tables;
}

// A number of a column, at a bit of its row.
int mesh_number(MeshWords words, MeshTables tables, uint column, uint bit) {
    return int(words.at[tables.first + 1u + mesh_widths + column] + mesh_bits(words, bit, mesh_width(tables, column)));
}

// Which row of its table a vertex (number in the meshlet) has; none beyond the last.
const uint no_mesh_row = 0xffffffffu;
uint mesh_vertex_row(MeshTables tables, uint vertex) {
    uvec2 counts = mesh_vertex_counts(tables);
    if (vertex < mesh_last_vertex) return vertex < counts.x ? vertex : no_mesh_row;
    return vertex - mesh_last_vertex < counts.y ? counts.x + vertex - mesh_last_vertex : no_mesh_row;
}

// The height of a vertex in steps; void_height where there is none.
int mesh_height(MeshWords words, uvec2 post) {
    MeshTables tables = mesh_tables(words, post.y);
    uint row = mesh_vertex_row(tables, post.x);
    if (row == no_mesh_row) return void_height;
    uint bit = tables.first_bit.x + row * tables.row_bits.x + tables.row_bits.x - mesh_width(tables, mesh_column_h);
    return mesh_number(words, tables, mesh_column_h, bit);
}

// Where a vertex lies from the page's origin, steps along the axes of ECEF.
ivec3 mesh_steps(MeshWords words, uvec2 post) {
    MeshTables tables = mesh_tables(words, post.y);
    uint row = mesh_vertex_row(tables, post.x);
    ivec3 steps = ivec3(0);
    if (row == no_mesh_row) return steps;
    uint bit = tables.first_bit.x + row * tables.row_bits.x;
    for (uint axis = 0u; axis < 3u; ++axis) {
        steps[axis] = mesh_number(words, tables, mesh_column_x + axis, bit);
        bit += mesh_width(tables, mesh_column_x + axis);
    }
    return steps;
}

// The bit that a triangle (number in the meshlet) begins at in its table; false where there is none.
bool finds_mesh_triangle(MeshTables tables, uint triangle, out uint bit) {
    uvec2 counts = mesh_triangle_counts(tables);
    uint row = triangle, in_half = triangle;
    if (triangle >= half_triangles) {
        in_half = triangle - half_triangles;
        row = counts.x + in_half;
    }
    bit = tables.first_bit.y + row * tables.row_bits.y;
    return in_half < (triangle < half_triangles ? counts.x : counts.y);
}

// The vertices of a triangle by their numbers in the meshlet; three times the same one where there is none.
uvec3 mesh_triangle_vertices(MeshWords words, uint meshlet, uint triangle) {
    MeshTables tables = mesh_tables(words, meshlet);
    uint bit, first = triangle < half_triangles ? 0u : mesh_last_vertex;
    if (!finds_mesh_triangle(tables, triangle, bit)) return uvec3(first);
    uint all = mesh_bits(words, bit, 3u * mesh_vertex_bits);
    return first + (uvec3(all, all >> mesh_vertex_bits, all >> (2u * mesh_vertex_bits)) & 63u);
}

// What a triangle looks like.
struct MeshSurface {
    uint look;        // mesh_look_...
    float tone;       // of its feature, 0 to 1
    vec3 normals[3];  // of its corners, along the axes of ECEF
    uint codes[3];    // their colours where the look is mesh_look_coloured: three codes of sRGB, the first in the low bits
};
MeshSurface mesh_surface(MeshWords words, uint meshlet, uint triangle) {
    MeshTables tables = mesh_tables(words, meshlet);
    MeshSurface surface;
    uint bit, number_bits = mesh_attribute_bits(tables);
    finds_mesh_triangle(tables, triangle, bit);
    uint numbers = bit + 3u * mesh_vertex_bits, look = mesh_bits(words, numbers + 3u * number_bits, mesh_look_bits(tables));
    uint look_bit = tables.first_bit.w + look * tables.row_bits.w;
    surface.look = uint(mesh_number(words, tables, mesh_column_look, look_bit));
    surface.tone = float(mesh_number(words, tables, mesh_column_tone, look_bit + mesh_width(tables, mesh_column_look))) / seam_unit;
    uvec3 vertices = mesh_triangle_vertices(words, meshlet, triangle);
    for (uint i = 0u; i < 3u; ++i) {
        uint number = is_by_vertex(tables) ? mesh_vertex_row(tables, vertices[i]) : mesh_bits(words, numbers + i * number_bits, number_bits);
        uint at = tables.first_bit.z + number * tables.row_bits.z;
        ivec3 steps;
        for (uint axis = 0u; axis < 3u; ++axis) {
            steps[axis] = mesh_number(words, tables, mesh_column_normal + axis, at);
            at += mesh_width(tables, mesh_column_normal + axis);
        }
        surface.normals[i] = vec3(steps) / seam_unit;
        surface.codes[i] = uint(mesh_number(words, tables, mesh_column_code, at));
    }
    return surface;
}
