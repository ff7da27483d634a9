// For surface.glsl where clusters are drawn: the corners of a triangle, and the page that its places are shaded from.
#include "shaders/clusters/cluster.glsl"

uint page_number(uint id) { return drawn_cluster(id / cluster_triangles).page; }

// As of a page's triangle: but posts are the region's, and so is the page.
FramePage corners_of(uint id, out uvec2 posts[3], out float heights_m[3], out vec3 at[3]) {
    DrawnCluster drawn = drawn_cluster(id / cluster_triangles);
    ClusterBlocks block = ClusterBlocks(drawn.block);
    uvec3 corners = corners_in_cluster(block, id % cluster_triangles);
    for (int i = 0; i < 3; ++i) {
        ClusterVertex vertex = block.at.vertices[corners[i]];
        posts[i] = uvec2(vertex.row, vertex.column);
        heights_m[i] = float(vertex.steps) * height_step_m;
        at[i] = vertex_in_view(vertex);
    }
    return page_of_vertices(drawn.page);
}

// A place on a triangle in the page that covers its cluster, which takes the place of `page`.
vec2 place_on_page(inout FramePage page, uint id, uvec2 posts[3], vec3 shares) {
    page = frame_pages().at[page_number(id)];
    ivec2 first = ivec2(posts[0]);
    vec2 from_first = shares.y * vec2(ivec2(posts[1]) - first) + shares.z * vec2(ivec2(posts[2]) - first);
    // From the page's own first post: numbers in a large region would be rounded.
    vec2 post = vec2(first - ivec2(page.first_row, page.first_column)) + from_first;
    vec2 last = vec2(ivec2(FRAME.last_row, FRAME.last_column) - ivec2(page.first_row, page.first_column));
    float spacing = float(1u << page.level);
    vec2 whole = floor(post / spacing);
    vec2 from = whole * spacing, to = min(from + spacing, last);
    return clamp(whole + (post - from) / max(to - from, vec2(1.0e-3)), vec2(0.0), vec2(float(page_quads)));
}
