#version 460
// The first round: one workgroup a page that has something to draw, one invocation a node. Those that neither the frustum nor the
// horizon hides are kept; of a frame with occlusion those of the nearest pages, and those that were seen in the last frame, are drawn
// at once, the others wait for cull_second_pass.comp.
#extension GL_GOOGLE_include_directive : require
#include "shaders/place/frame.glsl"
#include "shaders/choose/levels.glsl"
#include "shaders/choose/select.glsl"
#include "shaders/choose/cull_result.glsl"
#include "shaders/choose/choose.glsl"
#include "shaders/choose/feedback.glsl"
#include "shaders/choose/lists.glsl"
#include "shaders/choose/rounds.glsl"

layout(local_size_x = 256) in;

shared uint edges_here[edges_words];

bool was_bit(uint page_number, uvec2 node) {
    if (page_number == no_page) return false;
    uint before = Words(FRAME.page_before).at[page_number];
    return before != no_page && bit_of(FRAME.seen_before, before, node.x * meshlets_per_side + node.y);
}

// Whether the last frame saw a node, or what it had in its place: the next coarser one, or the next finer ones.
bool was_seen(uint page_number, FramePage page, uvec2 node) {
    if (FRAME.seen_before == uvec2(0u)) return false;
    if (was_bit(page_number, node) || was_bit(page.parent, parent_node(page, node))) return true;
    const uint half_side = meshlets_per_side / 2u;
    uint below = page.children[node.x / half_side * 2u + node.y / half_side];
    uvec2 first = node % half_side * 2u;
    return was_bit(below, first) || was_bit(below, first + uvec2(0u, 1u)) || was_bit(below, first + uvec2(1u, 0u)) ||
           was_bit(below, first + 1u);
}

void main() {
    uint lane = gl_LocalInvocationIndex;
    uint number = folded(gl_WorkGroupID), count = Live(FRAME.live_pages).at.count;
    if (number >= count) return;
    uint page_number = Words(FRAME.live).at[FRAME.page_count + number];
    if (lane < edges_words) edges_here[lane] = 0u;
    barrier();
    ChosenNode chosen = choose_node(page_number, lane);
    count_cull_result(chosen.cull_result);
    bool kept = chosen.cull_result == is_kept;
    if (kept) atomicOr(edges_here[lane / 8u], chosen.edges << (lane % 8u * 4u));
    barrier();
    if (lane < edges_words) Words(FRAME.edges).at[page_number * edges_words + lane] = edges_here[lane];
    bool now = kept;
    if (FRAME.occlusion != 0u) {
        FramePage page = frame_pages().at[page_number];
        uvec2 node = uvec2(lane / meshlets_per_side, lane % meshlets_per_side);
        bool waits = (page.cull & cull_by_occlusion) != 0u && !is_looked_at(number, count);
        if (kept && waits) now = was_seen(page_number, page, node);
        write_bits(FRAME.kept, page_number, kept);
        write_bits(FRAME.drawn, page_number, now);
        if (FRAME.feedback != uvec2(0u)) {
            bool asked = kept || (chosen.cull_result != is_not_chosen && stands_for_finer(page, lane) &&
                                  may_be_in_picture(page, PageBlocks(page.block).at[0].meshlets[lane]));
            write_bits_at(FRAME.feedback, page_number * feedback_words, asked);
        }
    }
    draw_nodes(page_number, now, chosen.edges);
}
