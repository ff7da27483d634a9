// Which tree stands on a site of the lattice, and how large it is: by the site's own numbers alone, so that nothing is
// stored. Compiled as GLSL for the GPU and as C++ by core/growth/tree_sites.cpp. Needs shared_growth.h.
//
// Heights, stems per hectare and crowns are those of a mountain forest of beech, spruce and fir. Source: J.-M. Monnet, field
// inventory and airborne laser scan of Chablais, plot 3 (R package lidaRtRee): 402 stems a hectare, heights with 10, 50, 90 and
// 99 % quantiles of 7.3, 14.3, 21.7 and 25.9 m, 0.76 of the ground under crowns above 3 m.
#ifndef OROGRAPH_SHADERS_GROWTH_TREE_RULE
#define OROGRAPH_SHADERS_GROWTH_TREE_RULE

// Source: C. Wellons, hash-prospector, lowbias32 (public domain).
ORO_FUNCTION uint site_mixed(uint h) {
    h ^= h >> 16u;
    h *= 0x7feb352du;
    h ^= h >> 15u;
    h *= 0x846ca68bu;
    return h ^ (h >> 16u);
}
// Of a site by its row and column in the whole lattice.
ORO_FUNCTION uint site_hash(uint row, uint column) { return site_mixed(row * 0x9e3779b1u ^ site_mixed(column + 0x7f4a7c15u)); }
// Numbers of 0 to below 1 that follow from a hash, each by its own number.
ORO_FUNCTION float site_number(uint hash, uint number) { return float(site_mixed(hash + number * 0x9e3779b9u) >> 8u) * (1.0f / 16777216.0f); }

// Where in its cell a site is, from the south-west: columns, rows.
ORO_CONST float site_jitter = 1.5f;
ORO_FUNCTION vec2 site_place(uint hash) {
    return vec2(0.5f + site_jitter * (site_number(hash, 1u) - 0.5f), 0.5f + site_jitter * (site_number(hash, 2u) - 0.5f));
}

// The share of sites that hold a tree in closed forest: 402 stems a hectare of 625 sites.
ORO_CONST float stocked_sites = 0.643f;

// Which of the sites holds one, by a number from 0 to 1 that is less than the share of them that do. Taller trees come first, so
// that what is left out where a forest thins out, or far away, is what is smallest.
ORO_FUNCTION float site_rank(uint hash) { return site_number(hash, 3u); }

// Height of a grown tree, metres: by its rank among those of closed forest, which is evenly spread. A piecewise linear inverse
// of the distribution function of the inventory.
ORO_FUNCTION float tree_height_m(uint hash) {
    float below = 1.0f - site_rank(hash) * (1.0f / stocked_sites);  // share of trees that are lower
    below = below < 0.0f ? 0.0f : below;
    if (below < 0.1f) return 3.5f + (7.3f - 3.5f) * (below * 10.0f);
    if (below < 0.5f) return 7.3f + (14.3f - 7.3f) * ((below - 0.1f) * 2.5f);
    if (below < 0.9f) return 14.3f + (21.7f - 14.3f) * ((below - 0.5f) * 2.5f);
    if (below < 0.99f) return 21.7f + (25.9f - 21.7f) * ((below - 0.9f) * (1.0f / 0.09f));
    return 25.9f + 3.5f * ((below - 0.99f) * 100.0f);
}

// A tree, metres and unit vectors of east and north; kind: site_needle, site_broad.
struct Tree {
    float height_m;
    float crown_m;   // from the foot to where the crown begins
    float radius_m;  // of the crown at its widest
    vec2 lean;       // what a metre upwards moves east and north
    float colour;    // -1 to 1: darker to lighter, greener to yellower
};
ORO_FUNCTION Tree tree_of_site(uint hash, uint kind, float size) {
    Tree tree;
    tree.height_m = size * tree_height_m(hash);
    float wide = 0.8f + 0.4f * site_number(hash, 4u), low = site_number(hash, 5u);
    bool is_needle = kind == site_needle;
    tree.crown_m = tree.height_m * (is_needle ? 0.08f + 0.17f * low : 0.2f + 0.18f * low);
    // Of a small tree no more than its height allows: it is no cushion.
    float radius_m = is_needle ? 0.85f + 0.105f * tree.height_m : 0.9f + 0.165f * tree.height_m, most_m = (is_needle ? 0.26f : 0.43f) * tree.height_m;
    tree.radius_m = wide * (radius_m < most_m ? radius_m : most_m);
    float leans = is_needle ? 0.025f : 0.07f;
    tree.lean = vec2(leans * (2.0f * site_number(hash, 6u) - 1.0f), leans * (2.0f * site_number(hash, 7u) - 1.0f));
    tree.colour = site_number(hash, 8u) + site_number(hash, 9u) - 1.0f;
    return tree;
}
#endif
