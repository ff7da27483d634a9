// From places to the posts of a grid on a net (FrameConstants.net). Needs frame.glsl and bend.glsl.

// Latitude and longitude of a place near the ellipsoid less the eye's, radians: as region_post_at (outside.glsl) has them.
vec2 angles_from_eye(vec3 view) {
    EyePost eye = FRAME.eye_post;
    vec3 straight = view;
    if (FRAME.refraction_per_m != 0.0) straight -= 0.5 * FRAME.refraction_per_m * squared_across(view) * FRAME.up_view;
    vec3 from_foot = (straight + FRAME.eye_h_m * FRAME.up_view) * FRAME.view_from_eye;
    float cosine = eye.latitude.x, sine = eye.latitude.y, rho_m = eye.normal_m * cosine, out_m = rho_m + from_foot.x;
    float farther_m = (from_foot.x * (rho_m + out_m) + from_foot.y * from_foot.y) / (length(vec2(out_m, from_foot.y)) + rho_m);
    float higher_m = from_foot.z / (1.0 - eye.e2);
    float north_rad = atan(higher_m * cosine - farther_m * sine, eye.normal_m + farther_m * cosine + higher_m * sine);
    return vec2(north_rad, atan(from_foot.y, out_m));
}

// Cosine and sine of an angle that is so much larger than one of which they are known.
vec2 turned_by(vec2 angle, float more) {
    float c = cos(more), s = sin(more);
    return vec2(angle.x * c - angle.y * s, angle.y * c + angle.x * s);
}

// (u, v) of a place by cosines and sines of its latitude and its longitude from the eye's.
vec2 net_uv_at(vec2 latitude, vec2 longitude) {
    vec3 normal = vec3(latitude.x * longitude.x, latitude.x * longitude.y, latitude.y);
    return (vec2(dot(normal, FRAME.net.along_u), dot(normal, FRAME.net.along_v)) - FRAME.net.middle) * FRAME.net.scale;
}
vec2 net_uv(vec2 from_eye_rad) {
    return net_uv_at(turned_by(FRAME.eye_post.latitude, from_eye_rad.x), turned_by(vec2(1.0, 0.0), from_eye_rad.y));
}

// What (u, v) changes by between a place and one so many radians north and east of it: no difference of large numbers.
vec2 net_uv_change(vec2 latitude, vec2 longitude, float north_rad, float east_rad) {
    float half_north = sin(0.5 * north_rad), half_east = sin(0.5 * east_rad);
    vec2 up = turned_by(latitude, 0.5 * north_rad), on = turned_by(longitude, 0.5 * east_rad);
    vec2 latitude_change = 2.0 * half_north * vec2(-up.y, up.x), longitude_change = 2.0 * half_east * vec2(-on.y, on.x);
    vec2 there = longitude + longitude_change;
    vec3 change = vec3(latitude_change.x * there + latitude.x * longitude_change, latitude_change.y);
    return vec2(dot(change, FRAME.net.along_u), dot(change, FRAME.net.along_v)) * FRAME.net.scale;
}

// Row and column, fractional.
vec2 post_on_net(vec2 uv) {
    vec2 held = clamp(uv, vec2(-1.0), vec2(1.0)), sum = vec2(0.0);
    int last = 28;
    for (int i = 6; i >= 0; --i) {
        vec2 row = vec2(0.0);
        for (int j = 6 - i; j >= 0; --j) row = row * held.y + FRAME.net.coefficients[--last];
        sum = sum * held.x + row;
    }
    vec2 out_of = uv - held;
    return sum + FRAME.net.beyond_u * out_of.x + FRAME.net.beyond_v * out_of.y;
}
