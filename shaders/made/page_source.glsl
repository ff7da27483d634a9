// What the heights of a page of made terrain are made from, as the CPU writes it and the GPU reads it: in scalar block layout the structs
// are those of C++. Compiled as GLSL, and as C++ by core/made_pages/page_source.h. Needs uint, ORO_MADE_CONST.

// Rows and columns of a page's heights: PageBlock.heights has so many of each, from post -1 on.
ORO_MADE_CONST uint made_page_stride = 131u;
// What a row or a column is: bits.
ORO_MADE_CONST uint made_post_there = 1u;  // the region has it
ORO_MADE_CONST uint made_post_odd = 2u;    // its number is odd
ORO_MADE_CONST uint made_post_pole = 4u;   // a row: all its posts are one pole

// A row's and a column's share of places, and where they lie among the nodes of N: the first of two, and the share of the second.
struct MadePageRow {
    int from_axis, north;  // 2^-6 m
    uint is;
    int N_first;
    double N_share;
};
struct MadePageColumn {
    int cosine, sine;  // 2^-30
    uint is;
    int N_first;
    double N_share;
};
struct MadePageSource {
    MadePageRow rows[131];
    MadePageColumn columns[131];
    MadePageColumn of_poles;  // where N is asked for all posts of a pole
};
