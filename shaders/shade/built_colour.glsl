// Colours of buildings and of meshes that do not say what they are of: hues, not what a file says. Linear light. Compiled as GLSL for
// the GPU and as C++ for exports (core/seam/mesh_colours.cpp).

struct SixColours { vec3 of[6]; };

// Of six colours the one, or between two, that a number of 0 to 1 says.
ORO_FUNCTION vec3 one_of(SixColours colours, float number) {
    float at = clamp(number, 0.0f, 0.9999f) * 5.0f;
    int first = int(at);
    return mix(colours.of[first], colours.of[first + 1], smoothstep(0.3f, 0.7f, at - float(first)));
}
// Plaster: white, cream, ochre, grey, rose, sand. Roofs: tiles from orange to brown, slate.
ORO_CONST SixColours plasters = {{vec3(0.62f, 0.60f, 0.55f), vec3(0.60f, 0.52f, 0.38f), vec3(0.50f, 0.39f, 0.23f), vec3(0.42f, 0.41f, 0.38f), vec3(0.54f, 0.41f, 0.34f), vec3(0.58f, 0.54f, 0.46f)}};
ORO_CONST SixColours roofs = {{vec3(0.27f, 0.098f, 0.054f), vec3(0.22f, 0.085f, 0.051f), vec3(0.17f, 0.075f, 0.05f), vec3(0.13f, 0.08f, 0.06f), vec3(0.10f, 0.092f, 0.088f), vec3(0.24f, 0.11f, 0.07f)}};

// Walls by how upright they are; of roofs, level ones are gravel. tone: 0 to 1, of the building.
ORO_FUNCTION vec3 built_colour(float tone, float slope_deg) {
    float other = fract(tone * 7.31f + 0.17f), third = fract(tone * 23.7f + 0.41f);
    vec3 wall = one_of(plasters, tone) * (0.82f + 0.36f * other);
    vec3 tiles = one_of(roofs, other) * (0.8f + 0.5f * third);
    vec3 gravel = vec3(0.24f, 0.235f, 0.22f) * (0.75f + 0.6f * third);
    vec3 roof = mix(gravel, tiles, smoothstep(6.0f, 11.0f, slope_deg));
    return mix(roof, wall, smoothstep(74.0f, 80.0f, slope_deg));
}

ORO_FUNCTION vec3 plain_colour() { return vec3(0.40f, 0.395f, 0.385f); }

// Roads and squares, of what is built on around them.
ORO_FUNCTION vec3 paved_colour(vec3 built) { return 0.8f * built; }
