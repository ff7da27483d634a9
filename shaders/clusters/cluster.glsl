// The clusters that a frame draws, and where their vertices are. Needs frame.glsl and place.glsl.
#include "shaders/clusters/drawn.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer ClusterBlocks { ClusterBlock at; };

// The vertices of a triangle.
uvec3 corners_in_cluster(ClusterBlocks block, uint triangle) {
    uint corners = block.at.corners[triangle];
    return uvec3(corners & 255u, corners >> 8 & 255u, corners >> 16 & 255u);
}

// A page as large as the region, whose posts are the region's: vertices are posts of it. This is the one place where shaders know that
// a vertex is a post.
FramePage page_of_vertices(uint covering_page) {
    FramePage page = frame_pages().at[covering_page];
    page.level = page.first_row = page.first_column = 0u;
    page.row_terms = FRAME.clusters.rows;
    page.column_terms = FRAME.clusters.columns;
    return page;
}

vec3 vertex_in_view(ClusterVertex vertex) {
    FramePage page;
    page.row_terms = FRAME.clusters.rows;
    page.column_terms = FRAME.clusters.columns;
    return place_in_view(page, uvec2(vertex.row, vertex.column), vertex.steps);
}
