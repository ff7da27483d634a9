// Clusters of triangles (core/clusters) as a frame has them on the GPU. A part of shaders/shared.h.

ORO_CONST uint cluster_triangles = 128u;  // at most, as meshlet_triangles: ids number them alike
ORO_CONST uint cluster_vertices = 128u;   // at most
// A vertex is one of the region's posts (of level 0).
struct ClusterVertex {
    uint row;
    uint column;
    int steps;  // drawn height
};
struct ClusterBlock {
    uint corners[128];  // of each triangle: its vertices, 8 bits each; counter-clockwise seen from above
    ClusterVertex vertices[128];
};
// One that a frame draws. Its number among them stands in triangle ids, in the place of page and meshlet.
struct DrawnCluster {
    uvec2 block;  // device address of its ClusterBlock
    uint page;    // number in the frame of the finest page that covers all of it: shading begins there
    uint counts;  // triangles, vertices << 8, level of the graph << 16
    uint number;  // in the graph
    uint group;   // in the graph: that which made it; of one of the original's, that which uses it
};
// The clusters of a frame.
struct ClusterTable {
    uvec2 drawn;  // device address of DrawnCluster[count]
    uint on;      // 1: clusters are drawn, not nodes of pages
    uint count;
    uint rows;     // place of the terms of the region's first row in the frame's table; all follow
    uint columns;  // likewise
};
