// What a task workgroup tells its mesh workgroups: what they draw of a page, meshlets or halves of them (HALVES).
struct TaskPayload {
    uint page_number;
    uint count;                         // of the parts
    uint parts[parts_per_task_max];  // number of the meshlet in the page, edges << 8, which half << 12
};
uint meshlet_of(uint part) { return part & 255u; }
uint edges_of_part(uint part) { return part >> 8 & 15u; }
uint half_of(uint part) { return part >> 12; }  // first_rows, last_rows or first_columns
