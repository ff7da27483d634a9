// What a blade of grass shows of the light that the ground under it sends back, of all colours: 1 in the mean over a meadow. Needs
// blade_rule.glsl. Compiled as C++, too, where vectors have GLSL's functions.

// Straw among green blades; both together are as the ground.
ORO_FUNCTION vec3 colour_of_blade(MeadowBlade blade) {
    float c = blade.colour;
    vec3 hue = vec3(1.0f + 0.1f * c, 1.0f, 1.0f - 0.14f * c) * (1.0f + 0.26f * c);
    return hue * (blade.dry > 0.5f ? vec3(1.55f, 1.34f, 1.12f) : vec3(0.91f, 0.945f, 0.98f));
}

// Lit from the side that is seen, or from the other, through the blade: yellower.
ORO_FUNCTION vec3 sun_on_blade(vec3 normal, vec3 sun, vec3 to_eye) {
    float faces_sun = dot(normal, sun), lit = abs(faces_sun);
    if (faces_sun * dot(normal, to_eye) > 0.0f) return vec3(0.72f + 0.7f * lit);
    return vec3(0.8f, 0.81f, 0.76f) + vec3(0.62f, 0.64f, 0.56f) * lit;
}

ORO_FUNCTION vec3 light_of_blade(MeadowBlade blade, float t, vec3 sun, vec3 to_eye) {
    vec3 along = mix(blade.middle - blade.foot, blade.tip - blade.middle, t);
    vec3 normal = normalize(cross(along, vec3(blade.side, 0.0f)));
    // Neighbours take light from what is low among them.
    float up = t * (2.0f - t), open = mix(0.42f, 1.28f, up * up * (3.0f - 2.0f * up));
    vec3 by_sun = mix(vec3(1.0f), sun_on_blade(normal, sun, to_eye), clamp(4.0f * sun.z, 0.0f, 1.0f));
    return colour_of_blade(blade) * by_sun * open;
}
