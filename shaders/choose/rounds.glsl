// What a frame's rounds hand on: bits for each node of a page, and what the rasterisers draw. Needs frame.glsl and lists.glsl.
// The compute rasteriser takes lists of meshlets, the mesh path bits of pages.
layout(constant_id = 0) const bool for_compute = true;

shared uint bits_here[accepted_words];
shared uint count_here;
shared uint first_here;

bool bit_at(uvec2 words, uint first, uint node) { return (Words(words).at[first + node / 32u] >> (node % 32u) & 1u) != 0u; }
bool bit_of(uvec2 words, uint page_number, uint node) { return bit_at(words, page_number * accepted_words, node); }

// Writes words of bits, one from each invocation of the workgroup.
void write_bits_at(uvec2 words, uint first, bool bit) {
    uint lane = gl_LocalInvocationIndex;
    barrier();
    if (lane < accepted_words) bits_here[lane] = 0u;
    barrier();
    if (bit) atomicOr(bits_here[lane / 32u], 1u << (lane % 32u));
    barrier();
    if (lane < accepted_words) Words(words).at[first + lane] = bits_here[lane];
}

// ... those of a page.
void write_bits(uvec2 words, uint page_number, bool bit) { write_bits_at(words, page_number * accepted_words, bit); }

// Whether a round looks at the page with that number among those that have something to draw.
bool is_looked_at(uint number, uint count) {
    uint share = number * round_shares / count;
    return share >= round.first_share && share < round.last_share;
}

// Draws those nodes of a page in this round whose invocations say so.
void draw_nodes(uint page_number, bool now, uint edges) {
    uint lane = gl_LocalInvocationIndex;
    if (lane == 0u) count_here = 0u;
    barrier();
    uint place = now ? atomicAdd(count_here, 1u) : 0u;
    barrier();
    if (lane == 0u && count_here > 0u) {
        atomicAdd(Counts(FRAME.counts).at.meshlets_drawn, count_here);
        if (for_compute) {
            first_here = atomicAdd(lists().at.meshlets, count_here);
            uint last = first_here + count_here;
            atomicMax(lists().at.meshlet_groups[0], min(last, groups_per_row));
            atomicMax(lists().at.meshlet_groups[1], (last + groups_per_row - 1u) / groups_per_row);
        }
    }
    barrier();
    if (for_compute) {
        if (now) Words(FRAME.meshlet_list).at[first_here + place] = page_number * meshlets_per_page + lane | edges << 28;
    } else {
        if (lane == 0u) Words(FRAME.round_live).at[page_number] = count_here > 0u ? 1u : 0u;
        write_bits(FRAME.drawn_now, page_number, now);
    }
}
