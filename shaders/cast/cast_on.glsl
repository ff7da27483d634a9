// What a place gets of the sun's light and of the sky's. Needs shown.glsl and what shades with it.

// Ground that is turned away from the sun has none of its light to lose.
bool faces_sun(SurfacePoint surface) {
    vec3 normal = vec3(surface.normal.xy * FRAME.style.relief, surface.normal.z);
    return dot(normal, in_air ? sun_at(surface.view) : FRAME.style.sun_enu) > 0.0;
}

void cast_on(SurfacePoint surface, ivec2 pixel) {
    if (casts && faces_sun(surface)) shown_share = CasterShares(CasterList(FRAME.casters).at.shown_shares).at[pixel.y * int(FRAME.width_px) + pixel.x];
    if (opens) open_share = sky_openness(surface);
}
