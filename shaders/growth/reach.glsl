// How far from the eye single trees are drawn. Compiled as GLSL and as C++ by core/growth/growth_plan.cpp.
#ifndef OROGRAPH_SHADERS_GROWTH_REACH
#define OROGRAPH_SHADERS_GROWTH_REACH

// Metres: while what a crown rises above a smooth canopy, 12 m, is at least so many pixels, and no farther than 12 km.
ORO_CONST float tree_above_canopy_m = 12.0f;
ORO_CONST float tree_least_px = 2.0f;
ORO_CONST float tree_reach_most_m = 12000.0f;
ORO_FUNCTION float tree_reach_m(float pixels_per_tangent, float tau_px) {
    float least_px = tau_px > 1.0f ? tree_least_px * tau_px : tree_least_px;
    float reach_m = pixels_per_tangent * tree_above_canopy_m / least_px;
    return reach_m < tree_reach_most_m ? reach_m : tree_reach_most_m;
}

// The share of a forest's trees that stand at a distance: all of them near, none beyond the reach.
ORO_FUNCTION float trees_at(float distance_m, float reach_m) {
    float x = (reach_m - distance_m) / (0.65f * reach_m);
    x = x < 0.0f ? 0.0f : x > 1.0f ? 1.0f : x;
    return x * x * (3.0f - 2.0f * x);
}
// What a forest that is not drawn as trees rises above its ground, metres: its mean top as it is seen along the ground, how much that differs
// by the noise of its crowns, and the most.
ORO_CONST float canopy_top_m = 20.0f;
ORO_CONST float canopy_varies_m = 8.0f;
ORO_CONST float canopy_most_m = 26.0f;
// How many pixels that is at most, where a metre at a distance of one is so many. Needs shared_growth.h.
ORO_FUNCTION uint canopy_most_px(float pixels_per_m, float reach_m) {
    // 1.05: towards the reach, trees being fewer, it rises faster than it draws away.
    float most_px = 1.05f * canopy_most_m * pixels_per_m / reach_m;
    return most_px < float(canopy_search_px) ? uint(most_px) + 1u : canopy_search_px;
}
// Ranks (tree_rule.glsl) over which a tree goes from nothing to its height: the more, the less changes at once.
ORO_CONST float trees_grow_in = 0.32f;
#endif
