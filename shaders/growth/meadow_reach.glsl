// How far from the eye grass is drawn, and how dark the ground between its blades is. Needs shared_meadow.h. Compiled as GLSL and as C++ by
// core/growth/meadow_rule.cpp.
#ifndef OROGRAPH_SHADERS_GROWTH_MEADOW_REACH
#define OROGRAPH_SHADERS_GROWTH_MEADOW_REACH

// The share of a meadow's blades that stands at a distance: all near, none beyond the reach.
ORO_CONST float meadow_fades_from = 0.6f;  // of the reach
ORO_FUNCTION float meadow_at(float distance_m) {
    float x = (meadow_reach_m - distance_m) / ((1.0f - meadow_fades_from) * meadow_reach_m);
    x = x < 0.0f ? 0.0f : x > 1.0f ? 1.0f : x;
    return x * x * (3.0f - 2.0f * x);
}
// What blades leave of the light on the ground between them, where all of them stand.
ORO_CONST float meadow_floor_light = 0.6f;
// How light a meadow is in the mean, seen at an angle to its ground whose sine is given, where the ground between blades has the share above and
// blades have their own (light_of_blade.glsl): what both are divided by, so that it is as light as without grass. At a grazing angle tips are seen, from
// above the ground between. Fitted to a field on level ground, within 0.02.
ORO_FUNCTION float meadow_seen(float sine) {
    float s = sine < 0.0f ? 0.0f : sine > 1.0f ? 1.0f : sine;
    return 1.36f - 1.385f * s + 0.715f * s * s;
}
ORO_FUNCTION float meadow_floor_at(float distance_m, float sine) {
    float all = meadow_at(distance_m);
    return 1.0f + all * all * (meadow_floor_light / meadow_seen(sine) - 1.0f);
}
#endif
