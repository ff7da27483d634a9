// What a task workgroup tells its mesh workgroups.
struct TaskPayload {
    uint page_number;
    uint count;                            // of the meshlets
    uint meshlets[meshlets_per_task_max];  // number in the page, edges << 8
};
