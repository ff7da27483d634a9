#version 460
// A further round: of the nodes that were kept and not drawn yet, those that the ground drawn so far does not hide. The last round asks
// of all, so that the next frame knows which of them are seen.
#extension GL_GOOGLE_include_directive : require
#include "shaders/place/frame.glsl"
#include "shaders/choose/lists.glsl"
#include "shaders/choose/rounds.glsl"
#include "shaders/choose/levels.glsl"
#include "shaders/place/bend.glsl"
#include "shaders/choose/occlusion.glsl"
#include "shaders/choose/select.glsl"
#include "shaders/choose/feedback.glsl"

layout(local_size_x = 256) in;

shared uint tested_here;
shared uint hidden_here;
shared uint later_here;

// Whether anything finer may show that a node stands for: that is within its error of the full resolution, as it is itself.
bool finer_may_show(uint page_number, uint node, bool shows) {
    if (!bit_at(FRAME.feedback, page_number * feedback_words, node)) return false;
    FramePage page = frame_pages().at[page_number];
    if (!stands_for_finer(page, node)) return false;
    if (shows || (page.cull & cull_by_occlusion) == 0u) return true;
    float error_m = PageBlocks(page.block).at[0].meshlets[node].error_m;
    return error_m >= unfit_error_m || !is_hidden(page, node, 2.0 * error_m);
}

void main() {
    uint lane = gl_LocalInvocationIndex;
    uint number = folded(gl_WorkGroupID), count = Live(FRAME.live_pages).at.count;
    if (number >= count) return;
    uint page_number = Words(FRAME.live).at[FRAME.page_count + number];
    bool is_last = round.is_last != 0u;
    if (lane == 0u) tested_here = hidden_here = later_here = 0u;
    barrier();
    bool kept = bit_of(FRAME.kept, page_number, lane), drawn = bit_of(FRAME.drawn, page_number, lane);
    bool asks = kept && (is_last || (!drawn && is_looked_at(number, count)));
    bool hidden = false;
    if (asks) {
        FramePage page = frame_pages().at[page_number];
        hidden = (page.cull & cull_by_occlusion) != 0u && is_hidden(page, lane, 0.0);
        if (is_last) atomicAdd(tested_here, 1u);
        if (is_last && hidden && !drawn) atomicAdd(hidden_here, 1u);
    }
    bool now = asks && !drawn && !hidden;
    if (now) atomicAdd(later_here, 1u);
    if (is_last) write_bits(FRAME.seen, page_number, kept && !hidden);
    else write_bits(FRAME.drawn, page_number, drawn || now);
    if (is_last && FRAME.feedback != uvec2(0u)) {
        bool shows = kept && !hidden;
        write_bits_at(FRAME.feedback, page_number * feedback_words + accepted_words, shows);
        write_bits_at(FRAME.feedback, page_number * feedback_words + 2u * accepted_words, finer_may_show(page_number, lane, shows));
    }
    draw_nodes(page_number, now, now ? edges_of(page_number * meshlets_per_page + lane) & 15u : 0u);
    barrier();
    if (lane != 0u) return;
    Counts counts = Counts(FRAME.counts);
    if (tested_here > 0u) atomicAdd(counts.at.meshlets_tested, tested_here);
    if (hidden_here > 0u) atomicAdd(counts.at.meshlets_hidden, hidden_here);
    if (later_here > 0u) atomicAdd(counts.at.meshlets_drawn_later, later_here);
}
