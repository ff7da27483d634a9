// Crowns that cover many pixels, in the lists of a frame. Needs crown_pixels.glsl.

LargeCrown as_large(Crown crown, CrownPixels of) {
    vec3 axes[3] = vec3[3](crown.axes[0], crown.axes[1], crown.axes[2]);
    return LargeCrown(crown.foot, axes, crown.low_m, crown.high_m, crown.radius_m, crown.shell, crown.kind, crown.hash, of.id,
                      uint(of.box.x) | uint(of.box.y) << 16, uint(of.box.z) | uint(of.box.w) << 16, of.begins_m);
}
Crown crown_of(LargeCrown large) {
    return Crown(large.foot, mat3(large.axes[0], large.axes[1], large.axes[2]), large.low_m, large.high_m, large.radius_m, large.shell, 0.0,
                 large.kind, large.hash);
}
CrownPixels pixels_of(LargeCrown large) {
    ivec4 box = ivec4(large.first_px & 0xffffu, large.first_px >> 16, large.last_px & 0xffffu, large.last_px >> 16);
    return CrownPixels(box, pixel_m_at(large.foot), large.begins_m, large.id);
}

// The pixels of a piece of a box.
ivec4 piece_of(ivec4 box, uint number) {
    int side = int(crown_piece_px), across = (box.z - box.x) / side + 1;
    ivec2 first = box.xy + ivec2(int(number) % across, int(number) / across) * side;
    return ivec4(first, min(first + side - 1, box.zw));
}
uint piece_count_of(ivec4 box) {
    ivec2 count = (box.zw - box.xy) / int(crown_piece_px) + 1;
    return uint(count.x * count.y);
}
