// What a frame tells of the clusters that it draws. Needs frame.glsl.

layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer DrawnClusters { DrawnCluster at[]; };

DrawnCluster drawn_cluster(uint number) { return DrawnClusters(FRAME.clusters.drawn).at[number]; }
uint triangles_of_cluster(DrawnCluster drawn) { return drawn.counts & 255u; }
uint vertices_of_cluster(DrawnCluster drawn) { return drawn.counts >> 8 & 255u; }
uint level_of_cluster(DrawnCluster drawn) { return drawn.counts >> 16; }
uint state_of_cluster(uint number) { return Words(FRAME.cluster_states).at[number]; }
