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
    uint seen;  // the last frame (FrameConstants.clusters_turn) that saw it; 0: none, since it is here
    uint unused[3];
};
// One that a frame draws. Its number among them stands in triangle ids, in the place of page and meshlet.
struct DrawnCluster {
    uvec2 block;  // device address of its ClusterBlock
    uint page;    // number in the frame of the finest page that covers all of it: shading begins there
    uint counts;  // triangles, vertices << 8, level of the graph << 16
    uint number;  // in the graph
    uint group;   // in the graph: that which made it; of one of the original's, that which uses it
    // It is of the cut where the group that made it stands, and that which uses it does not. Numbers among the
    // frame's AskedGroup; no_asked_group: there is none, or its answer is the one that draws the cluster,
    // for not all is there that the other would draw.
    uint made_by;
    uint used_by;
};
ORO_CONST uint no_asked_group = 0xffffffffu;
// A group that a frame asks whether it stands (shaders/clusters/group_rule.glsl), as its eye sees it. Lengths
// are over a power of two of metres, so that no square of one is too large or too small.
struct AskedGroup {
    float distance;  // of its sphere's centre from the eye,
    float along;     // ... along the view,
    float across;    // ... and across it
    float radius;
    float error;
    uint level;  // in the graph
};
// What a cut asks of groups.
struct CutRule {
    float pixels_per_tangent;  // core/lod/levels.h
    float corner_tangent;
    float stretch;  // sqrt(1 + corner_tangent^2)
    float tau_px;
    uint level;  // groups up to it stand, and none above; no_cut_level: those do whose error is at most tau_px
};
ORO_CONST uint no_cut_level = 0xffffffffu;
// The cut that a frame makes of its clusters.
struct ClusterCut {
    uvec2 asked;   // device address of the frame's AskedGroup
    uvec2 groups;  // ... of three numbers of mesh workgroups: up to the last cluster of the cut, one each
    CutRule rule;
    uint in_cut;  // those of the processor's cut, which come first among the frame's clusters
};
// What a drawn cluster lies in: a box around a point of view coordinates, where light would be straight. Its
// half axes are along ECEF.
struct ClusterBox {
    vec3 centre;
    mat3 half_axes;
};
// FrameConstants.cluster_states, bits of each.
ORO_CONST uint cluster_kept = 1u;       // of the cut, and neither frustum nor horizon hides it
ORO_CONST uint cluster_drawn = 2u;      // by the rounds so far; from the last one on: by those before it
ORO_CONST uint cluster_drawn_now = 4u;  // by this round
ORO_CONST uint cluster_shows = 8u;      // by the last round: no ground that is drawn hides it
ORO_CONST uint clusters_per_choice = 64u;  // of a workgroup that chooses
// The clusters of a frame.
struct ClusterTable {
    uvec2 drawn;  // device address of DrawnCluster[count]
    uint on;      // 1: clusters are drawn, not nodes of pages
    uint count;
    uint rows;     // place of the terms of the region's first row in the frame's table; all follow
    uint columns;  // likewise
};
