// The light of a forest whose single trees are not drawn, beside that of ground of its colour. Compiled as GLSL, and as C++ by tests. Needs
// ORO_FUNCTION, vectors and shared_growth.h. Fitted to trees drawn by brute force on level ground and on slopes of 20 and 35 degrees, seen from 4 to
// 60 degrees over the horizon by suns 15 to 60 degrees up (tests/core/growth/forest_reference.h): docs/notes/2026-11-28-rock-and-far-forests.md.
#ifndef OROGRAPH_SHADERS_SHADE_FOREST_LIGHT
#define OROGRAPH_SHADERS_SHADE_FOREST_LIGHT

// Which way a forest is seen and lit: sines of the sun's and the eye's height, of the angle between the ground and the line to the eye, and
// how far both directions agree along level ground: the sum of the products of their east and north, negative where the sun is before the eye.
struct ForestAngles {
    float sun_up, eye_up, eye_over, agree;
};
ORO_FUNCTION ForestAngles forest_angles(vec3 to_eye, vec3 sun, vec3 normal) {
    float over = to_eye.x * normal.x + to_eye.y * normal.y + to_eye.z * normal.z;
    return ForestAngles(sun.z < 0.0f ? 0.0f : sun.z, to_eye.z, over < 0.0f ? 0.0f : over, to_eye.x * sun.x + to_eye.y * sun.y);
}

// Of the sun's light on level ground; forests of needles and of leaves. Crowns between the eye and the sun show their shaded sides, and crowns
// across from the sun their sunlit ones; the more the ground is seen from above, the more of the dark between them.
ORO_FUNCTION vec2 crowns_lit(ForestAngles at) {
    float s = at.sun_up, h = at.agree, u = at.eye_up, o = at.eye_over, grazing = 1.0f / (o + 0.4f);
    vec2 alone = vec2(0.29f, 0.493f) + u * vec2(-0.052f, 0.034f) + o * vec2(-0.113f, -0.152f) + grazing * vec2(0.356f, -0.085f);
    vec2 by_sun = vec2(-0.101f, -0.041f) + s * vec2(0.509f, 0.181f) + u * vec2(-0.058f, 0.239f) + o * vec2(0.106f, 0.073f) + grazing * vec2(0.148f, 0.233f);
    vec2 by_side = vec2(0.004f, 0.308f) + h * vec2(0.116f, 0.075f) + u * vec2(0.375f, 0.055f) + o * vec2(-0.021f, 0.057f) + s * vec2(0.366f, 0.126f) + grazing * vec2(0.517f, 0.019f);
    return max(alone + s * by_sun + h * by_side, vec2(0.02f));
}
// Of the light of a whole sky.
ORO_FUNCTION vec2 crowns_open(ForestAngles at) { return vec2(1.054f, 0.549f) + at.eye_over * vec2(-0.399f, -0.155f) + at.eye_up * vec2(0.0f, 0.156f); }

// What of the sun's light falls on crowns of a slope, by the cosine of its angle to the sun: that on level ground is 1. Upright crowns are
// lit where their ground is not.
ORO_FUNCTION float sun_on_crowns(float cosine, float sun_up) {
    float share = cosine / (sun_up < 0.15f ? 0.15f : sun_up);
    return share < 0.08f ? 0.08f : share > most_sun ? most_sun : share;
}

// How much crowns differ, in grains of the forest: lit sides stand beside shaded ones, but where the sun is behind the eye.
ORO_FUNCTION float crowns_contrast(float cosine) { return 6.0f - 2.0f * cosine; }
#endif
