// What a task workgroup tells its mesh workgroups: its clumps in the order of their blades' vertices. As small as that goes: what payloads
// hold is written and read through the device's memory.
const uint starts_count = blade_level_count + 1u;
struct PackedClumps {
    uint first;                  // among those of both lists
    uint starts[starts_count];   // of each number of vertices: its first mesh workgroup, its first clump << 16
    uint order[clumps_per_task / 4u];  // clumps, by their number here, four of 8 bits each
};
uint vertices_of_level(uint level) { return blade_vertices_least + 2u * level; }
uint blades_per_group(uint vertices) { return grass_group_vertices / vertices; }
