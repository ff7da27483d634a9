// Between linear light and sRGB codes, 0 to 1. Source: IEC 61966-2-1:1999, 5.2.

vec3 srgb_from_linear(vec3 linear) {
    vec3 clamped = clamp(linear, 0.0, 1.0);
    return mix(12.92 * clamped, 1.055 * pow(clamped, vec3(1.0 / 2.4)) - 0.055, greaterThan(clamped, vec3(0.0031308)));
}

vec3 linear_from_srgb(vec3 codes) {
    vec3 clamped = clamp(codes, 0.0, 1.0);
    return mix(clamped / 12.92, pow((clamped + 0.055) / 1.055, vec3(2.4)), greaterThan(clamped, vec3(0.04045)));
}

// Half a step of 8 bits up or down by the place in the picture: gradients of light get no bands.
// Source: J. Jimenez, Next generation post processing in Call of Duty: Advanced Warfare, SIGGRAPH 2014, interleaved gradient noise.
vec3 dithered(vec3 encoded, ivec2 pixel) {
    if (!in_air) return encoded;
    vec2 place = vec2(pixel + ivec2(FRAME.first_x_px, FRAME.first_y_px));
    return encoded + (fract(52.9829189 * fract(dot(place, vec2(0.06711056, 0.00583715)))) - 0.5) / 255.0;
}
