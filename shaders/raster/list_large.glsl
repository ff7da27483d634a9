// Hands triangles on that an invocation does not draw alone: smaller ones to a team of invocations each (raster_boxes.comp), larger ones
// square by square to workgroups of their own (raster_large.comp). All invocations of a workgroup list theirs together: a triangle near
// the eye has thousands of squares, and whoever wrote them alone would keep all others waiting; and the frame's counters are asked once a
// workgroup. Needs raster.glsl, draw_alone.glsl, and the workgroup's size.

shared int alone_px;     // pixels of the largest box that an invocation draws by itself
shared uint boxes_here;  // triangles of this workgroup for teams,
shared uint large_here;  // ... larger ones,
shared uint tasks_here;  // ... and their squares
shared uint first_box;   // where theirs begin in the frame's lists
shared uint first_large;
shared uint first_task;
// Triangles with many squares, which all invocations list together: first task, triangle, first square, counts of squares; the last two
// as LargeTask.square.
const uint many_max = 64u;
shared uint many_here;
shared uvec4 many[many_max];

const uint shows_nowhere = 0u;  // or has gone elsewhere
const uint is_small = 1u;       // its invocation draws it
const uint is_box = 2u;
const uint is_large = 3u;

uint kind_of(ScreenTriangle t) {
    ivec4 box = pixel_box(t);
    ivec2 size = box.zw - box.xy + 1;
    if (min(size.x, size.y) <= 0) return shows_nowhere;
    if (!fits_near(t)) return is_large;
    int count = size.x * size.y;
    return count <= alone_px ? is_small : count <= box_max_px ? is_box : is_large;
}

// A triangle that waits to be listed, and its place among those of its workgroup.
struct ToList {
    uint kind;
    uint triangle;
    uint task;
};

// Squares that a box touches, along x and y.
uvec2 squares_across(ivec4 box) { return uvec2(box.zw / int(large_square_px) - box.xy / int(large_square_px) + 1); }

// First, before a barrier. Then each has its kind of triangle noted, and after another barrier all of them are listed.
void begin_listing() {
    if (gl_LocalInvocationIndex != 0u) return;
    boxes_here = large_here = tasks_here = many_here = 0u;
    // The longer the list, the more teams there are already, and the less is gained by more of them.
    uint boxes = atomicLoad(lists().at.boxes, gl_ScopeDevice, gl_StorageSemanticsBuffer, gl_SemanticsRelaxed);
    alone_px = boxes < boxes_room / 8u * 3u ? alone_max_px : max(alone_max_px, alone_of_many_px);
}

ToList note_triangle(uint kind, ScreenTriangle t) {
    ToList noted = ToList(kind, 0u, 0u);
    if (kind == is_box) noted.triangle = atomicAdd(boxes_here, 1u);
    if (kind != is_large) return noted;
    uvec2 across = squares_across(pixel_box(t));
    noted.triangle = atomicAdd(large_here, 1u);
    noted.task = atomicAdd(tasks_here, across.x * across.y);
    return noted;
}

void list_triangle(uint at, ScreenTriangle t) {
    // Member by member: glslang 12.0 crashes on storing a whole struct that holds `precise` values.
    LargeTriangles triangles = LargeTriangles(FRAME.large_list);
    triangles.at[at].ax = t.a.x;
    triangles.at[at].ay = t.a.y;
    triangles.at[at].bx = t.b.x;
    triangles.at[at].by = t.b.y;
    triangles.at[at].cx = t.c.x;
    triangles.at[at].cy = t.c.y;
    triangles.at[at].az = t.depth.x;
    triangles.at[at].bz = t.depth.y;
    triangles.at[at].cz = t.depth.z;
    triangles.at[at].id = t.id;
}

// Square i of a triangle, whose first task it is, as `many` has them.
void list_square(uvec4 one, uint i) {
    if (one.x + i >= tasks_room) return;
    uint across = one.w & 0xffffu;
    LargeTasks list = LargeTasks(FRAME.task_list);
    list.at[one.x + i].triangle = one.y;
    list.at[one.x + i].square = one.z + (i % across | (i / across) << 16);
}
uint squares_of(uvec4 one) { return (one.w & 0xffffu) * (one.w >> 16); }

// Room for all of the workgroup, and as many groups as they need.
void take_room() {
    if (boxes_here > 0u) {
        first_box = atomicAdd(lists().at.boxes, boxes_here);
        uint groups = (min(first_box + boxes_here, boxes_room) + boxes_per_group - 1u) / boxes_per_group;
        atomicMax(lists().at.box_groups[0], min(groups, groups_per_row));
        atomicMax(lists().at.box_groups[1], (groups + groups_per_row - 1u) / groups_per_row);
    }
    if (large_here > 0u) {
        first_large = atomicAdd(lists().at.large, large_here);
        first_task = atomicAdd(lists().at.tasks, tasks_here);
        uint last = min(first_task + tasks_here, tasks_room);
        atomicMax(lists().at.task_groups[0], min(last, groups_per_row));
        atomicMax(lists().at.task_groups[1], (last + groups_per_row - 1u) / groups_per_row);
    }
}

// Lists a larger triangle; its squares alone, or among the `many`: those that have more than two times the workgroup's mean.
void list_large(ToList noted, ScreenTriangle t, bool fits) {
    ivec4 box = pixel_box(t);
    uvec2 across = squares_across(box), first = uvec2(box.xy) / large_square_px;
    uint triangle = fits ? first_large + noted.triangle : no_triangle;
    if (fits) list_triangle(triangle, t);
    uvec4 one = uvec4(first_task + noted.task, triangle, first.x | first.y << 16, across.x | across.y << 16);
    uint count = squares_of(one);
    if (count > max(4u, tasks_here / many_max)) {  // of which there are fewer than many_max
        many[atomicAdd(many_here, 1u)] = one;
        return;
    }
    for (uint i = 0u; i < count; ++i) list_square(one, i);
}

// False for a triangle that found no room: the lists are full. Has barriers of its own where the workgroup has noted any, so all of its
// invocations come here.
bool list_noted(ToList noted, ScreenTriangle t) {
    if (boxes_here + large_here == 0u) return true;
    if (gl_LocalInvocationIndex == 0u) take_room();
    barrier();
    bool box_fits = noted.kind == is_box && first_box + noted.triangle < boxes_room;
    if (box_fits) list_triangle(large_max + first_box + noted.triangle, t);
    if (large_here == 0u) return noted.kind != is_box || box_fits;
    bool large_fits = first_large + large_here <= large_room && first_task + tasks_here <= tasks_room;
    if (noted.kind == is_large) list_large(noted, t, large_fits);
    barrier();
    for (uint each = 0u; each < many_here; ++each) {
        for (uint i = gl_LocalInvocationIndex; i < squares_of(many[each]); i += gl_WorkGroupSize.x) list_square(many[each], i);
    }
    return noted.kind == is_box ? box_fits : noted.kind != is_large || large_fits;
}

// What is left to do when those of the workgroup have been listed: small triangles are drawn, and those that found no room. Where that is
// a large one, raster_clip draws it alone: that code would take registers from all others.
void draw_rest(ToList noted, bool is_listed, ScreenTriangle t) {
    if (noted.kind == is_small || (noted.kind == is_box && !is_listed)) draw_near_alone(t, pixel_box(t));
    else if (!is_listed) list_clip(t.id);
}
