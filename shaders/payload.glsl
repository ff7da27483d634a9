// What a task workgroup tells its mesh workgroups.
struct TaskPayload {
    uint page_number;
    uint meshlets[meshlets_per_task_max];
};
