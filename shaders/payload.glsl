// What a task workgroup tells its mesh workgroups.
const uint meshlets_per_task_max = 128u;
struct TaskPayload {
    uint page_number;
    uint meshlets[meshlets_per_task_max];
};
