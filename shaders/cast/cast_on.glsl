// What a place gets of the sun's light and of the sky's. Needs shown.glsl and what shades with it.

// Ground that is turned away from the sun has none of its light to lose.
bool faces_sun(SurfacePoint surface) {
    vec3 normal = vec3(surface.normal.xy * FRAME.style.relief, surface.normal.z);
    return dot(normal, in_air ? sun_at(surface.view) : FRAME.style.sun_enu) > 0.0;
}

// As shares.comp keeps them.
float share_in(ivec2 pixel) { return CasterShares(CasterList(FRAME.casters).at.shown_shares).at[pixel.y * int(FRAME.width_px) + pixel.x]; }

// Of a pixel with several posts in it, of which a line begins at one: the mean with the pixels around it that show ground about as far away.
float mean_share(uint id, ivec2 pixel) {
    uint level = frame_pages().at[page_number(triangle_of_id(id))].level;
    float sum = 0.0, count = 0.0;
    for (int i = 0; i < 9; ++i) {
        ivec2 at = pixel + ivec2(i % 3, i / 3) - 1;
        if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, ivec2(FRAME.width_px, FRAME.height_px)))) continue;
        float share = share_in(at);
        uint neighbour = id_in(at);
        if (share < 0.0 || !is_of_grid(neighbour)) continue;
        uint there = frame_pages().at[page_number(triangle_of_id(neighbour))].level;
        if (max(there, level) - min(there, level) > 1u) continue;
        float light = floor(share / share_step), weight = float((1 + (i % 3 & 1)) * (1 + (i / 3 & 1))) * (light + 1.0);
        sum += weight * (share - light * share_step);
        count += weight;
    }
    return count > 0.0 ? sum / count : 0.0;
}

void cast_on(SurfacePoint surface, uint id, ivec2 pixel) {
    if (casts && faces_sun(surface)) shown_share = surface.parts > 0 && FRAME.sample_count == 1u ? mean_share(id, pixel) : max(without_light(vec4(share_in(pixel))).x, 0.0);
    if (opens) open_share = sky_openness(surface);
}
