#version 460
// One square of one large triangle a workgroup.
#extension GL_GOOGLE_include_directive : require
#include "shaders/place/frame.glsl"
#include "shaders/choose/lists.glsl"
#include "shaders/raster/raster.glsl"

layout(local_size_x = 128) in;

void main() {
    uint number = folded(gl_WorkGroupID);
    if (number >= min(lists().at.tasks, tasks_room)) return;
    LargeTask task = LargeTasks(FRAME.task_list).at[number];
    if (task.triangle == no_triangle) return;
    ScreenTriangle t = large_triangle(task.triangle);
    ivec4 box = in_square(pixel_box(t), ivec2(task.square & 0xffffu, task.square >> 16));
    if (box.z < box.x || box.w < box.y) return;
    if (fits_near(t)) draw_near(t, box, gl_LocalInvocationIndex, 128u);
    else draw_far_square(t, box, gl_LocalInvocationIndex, 128u);
}
