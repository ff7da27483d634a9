// The colours of a frame's parts, sRGB. Compiled as GLSL for the GPU and as C++ for legends (core/frame/frame_colours.cpp).

ORO_FUNCTION vec3 one_of_eight(uint which) {
    if (which == 0u) return vec3(0.16f, 0.38f, 0.78f);
    if (which == 1u) return vec3(0.20f, 0.71f, 0.65f);
    if (which == 2u) return vec3(0.47f, 0.77f, 0.26f);
    if (which == 3u) return vec3(0.95f, 0.82f, 0.22f);
    if (which == 4u) return vec3(0.95f, 0.55f, 0.16f);
    if (which == 5u) return vec3(0.83f, 0.25f, 0.22f);
    if (which == 6u) return vec3(0.66f, 0.33f, 0.68f);
    return vec3(0.60f, 0.60f, 0.62f);
}

ORO_FUNCTION vec3 another_of_eight(uint which) {
    if (which == 0u) return vec3(0.10f, 0.55f, 0.80f);
    if (which == 1u) return vec3(0.16f, 0.66f, 0.38f);
    if (which == 2u) return vec3(0.70f, 0.80f, 0.20f);
    if (which == 3u) return vec3(0.95f, 0.70f, 0.14f);
    if (which == 4u) return vec3(0.92f, 0.38f, 0.12f);
    if (which == 5u) return vec3(0.80f, 0.24f, 0.46f);
    if (which == 6u) return vec3(0.42f, 0.30f, 0.76f);
    return vec3(0.52f, 0.42f, 0.26f);
}

// By level: the finest blue, each next one apart from the one before; after eight the hues between them, then all of these paler. No two
// below 32 look alike, whatever light falls on them: none is another one in up to 0.7 of the light. A cluster graph has some 25.
ORO_FUNCTION vec3 shown_level(uint level) {
    uint turn = level < 24u ? level / 8u : 3u;
    vec3 colour = turn % 2u == 0u ? one_of_eight(level % 8u) : another_of_eight(level % 8u);
    if (turn < 2u) return colour;
    if (turn == 2u && level % 8u == 7u) return vec3(0.30f, 0.30f, 0.32f);
    return 0.6f * colour + 0.4f * vec3(0.92f);
}

// Whether the rounds before the last one had drawn it.
ORO_FUNCTION vec3 shown_round(bool before) { return before ? vec3(0.36f, 0.64f, 0.40f) : vec3(0.96f, 0.57f, 0.18f); }

// By how many triangles cover a pixel: 1, 2, 3 and 4, 5 to 8, 9 to 16, more.
ORO_FUNCTION vec3 shown_overdraw(uint count) {
    if (count <= 1u) return vec3(0.18f, 0.30f, 0.52f);
    if (count == 2u) return vec3(0.20f, 0.56f, 0.60f);
    if (count <= 4u) return vec3(0.45f, 0.73f, 0.42f);
    if (count <= 8u) return vec3(0.93f, 0.82f, 0.33f);
    if (count <= 16u) return vec3(0.93f, 0.52f, 0.20f);
    return vec3(0.78f, 0.18f, 0.22f);
}

// A colour of its own for each number, none of them dark. Source of the mixing: C. Wellons, hash-prospector (public domain), lowbias32.
ORO_FUNCTION vec3 shown_by_hash(uint number) {
    uint x = number;
    x ^= x >> 16u;
    x *= 0x7feb352du;
    x ^= x >> 15u;
    x *= 0x846ca68bu;
    x ^= x >> 16u;
    return vec3(0.3f) + 0.7f * vec3(float(x & 255u), float(x >> 8u & 255u), float(x >> 16u & 255u)) / 255.0f;
}
