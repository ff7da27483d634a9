#version 460
// Last step of a choice of pages: the frame's pages, all but what plan_terms.comp makes of their places, and the rows and columns of
// pages that they need.
#extension GL_GOOGLE_include_directive : require
#include "shaders/plan/choice.glsl"

layout(local_size_x = 64) in;
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer Pages { FramePage at[]; };

uint number_of(uint page) {
    if (page == no_page) return no_page;
    uint slot = Words(Terms(terms).at.slots).at[page];
    return slot == no_page ? no_page : wanted_pages().at[slot].number;
}

// An address so many bytes before another.
uvec2 before(uvec2 address, uvec2 bytes) {
    uint borrow;
    uint low = usubBorrow(address.x, bytes.x, borrow);
    return uvec2(low, address.y - bytes.y - borrow);
}

void main() {
    uint slot = gl_GlobalInvocationID.x;
    if (slot >= wanted_count()) return;
    uint number = wanted_pages().at[slot].number;
    if (number == no_page) return;
    uint page = wanted_pages().at[slot].page, level = level_of(page);
    uvec2 block = wanted_pages().at[slot].block, means = Terms(terms).at.means_before;
    Pages pages = Pages(Terms(terms).at.pages);
    uint row = records().at[page].row, column = records().at[page].column;
    uint row_source = records().at[page].row_source, column_source = records().at[page].column_source;
    pages.at[number].block = block;
    pages.at[number].means = means == uvec2(0u) ? uvec2(0u) : before(block, means);
    pages.at[number].places = uvec2(0u);
    pages.at[number].from_eye_low = uvec3(0u);
    pages.at[number].from_eye_high = uvec3(0u);
    pages.at[number].cull = Terms(terms).at.cull | ((records().at[page].traits & choice_skirt) != 0u ? is_skirt : 0u);
    pages.at[number].level = level;
    pages.at[number].first_row = row * page_quads << level;
    pages.at[number].first_column = column * page_quads << level;
    pages.at[number].row_terms = row_source * page_posts;
    pages.at[number].column_terms = column_source * page_posts;
    pages.at[number].quarter = quarter_of(page);
    pages.at[number].parent = number_of(records().at[page].parent);
    for (uint i = 0u; i < 4u; ++i) {
        pages.at[number].neighbours[i] = number_of(records().at[page].beside[i]);
        pages.at[number].children[i] = number_of(records().at[page].children[i]);
    }
    pages.at[number].last_column = meshlets_per_side - 1u;
    pages.at[number].west_column = meshlets_per_side - 1u;
    pages.at[number].fallback_quarters = wanted_pages().at[slot].fallback_quarters;
    if (Terms(terms).at.numbers_now != uvec2(0u)) {
        Words(Terms(terms).at.numbers_now).at[page] = number;
        uvec2 known = Terms(terms).at.numbers_before;
        Words(Terms(terms).at.page_before).at[number] = known == uvec2(0u) ? no_page : Words(known).at[page];
    }
    Words numbers = Words(Terms(terms).at.numbers);
    numbers.at[row_source] = row_source;
    numbers.at[Terms(terms).at.row_source_count + column_source] = column_source;
    numbers.at[Terms(terms).at.row_source_count + Terms(terms).at.column_source_count + number] = page;
}
