// Which nodes are drawn and how their edges meet their neighbours', from the bits that lod_test.comp has left; the rules of
// core/lod/levels.cpp. Needs frame.glsl, levels.glsl, select.glsl and cull_result.glsl.

bool accepted(uint page_number, uvec2 node) {
    if (page_number == no_page) return false;
    uint i = node.x * meshlets_per_side + node.y;
    return (Words(FRAME.accepted).at[page_number * accepted_words + i / 32u] >> (i % 32u) & 1u) != 0u;
}

// The node of the parent page above a node of this one.
uvec2 parent_node(FramePage page, uvec2 node) { return node / 2u + uvec2(page.quarter / 2u, page.quarter % 2u) * (meshlets_per_side / 2u); }

// What is drawn beyond an edge is coarser when it may be: when the neighbour's parent is accepted.
uint edges_to_coarser(FramePage page, uvec2 node) {
    const uint last = meshlets_per_side - 1u;
    uvec2 above = parent_node(page, node);
    bool north = node.x > 0u ? accepted(page.parent, parent_node(page, node - uvec2(1u, 0u)))
                             : accepted(page.neighbours[0], uvec2(above.x > 0u ? above.x - 1u : last, above.y));
    bool south = node.x < last ? accepted(page.parent, parent_node(page, node + uvec2(1u, 0u)))
                               : accepted(page.neighbours[2], uvec2(above.x < last ? above.x + 1u : 0u, above.y));
    bool west = node.y > 0u ? accepted(page.parent, parent_node(page, node - uvec2(0u, 1u)))
                            : accepted(page.neighbours[3], uvec2(above.x, above.y > 0u ? above.y - 1u : page.west_column));
    // Beyond the last page of a region that goes round the Earth lies its first.
    bool ends = page.first_column + (page_quads << page.level) >= FRAME.last_column;
    bool east = node.y < page.last_column ? accepted(page.parent, parent_node(page, node + uvec2(0u, 1u)))
                                          : accepted(page.neighbours[1], uvec2(above.x, !ends && above.y < last ? above.y + 1u : 0u));
    return (north ? edge_north : 0u) | (east ? edge_east : 0u) | (south ? edge_south : 0u) | (west ? edge_west : 0u);
}

// A node that this frame draws, and its edges.
struct ChosenNode {
    uint cull_result;
    uint edges;
};

ChosenNode choose_node(uint page_number, uint meshlet) {
    FramePage page = frame_pages().at[page_number];
    uvec2 node = uvec2(meshlet / meshlets_per_side, meshlet % meshlets_per_side);
    if (!accepted(page_number, node) || accepted(page.parent, parent_node(page, node))) return ChosenNode(is_not_chosen, 0u);
    atomicAdd(Counts(FRAME.counts).at.nodes_chosen, 1u);
    return ChosenNode(cull_result_of(page, PageBlocks(page.block).at[0].meshlets[meshlet]), edges_to_coarser(page, node));
}
