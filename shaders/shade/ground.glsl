// Style: what colours the ground, and what lights it, all from FrameStyle. Needs surface.glsl, light.glsl and srgb.glsl.

// The number of the first stop above a value; the table is ascending. Reads the table where it is: handed over as a value it was copied
// for every pixel, three quarters of the whole pass's time.
uint tint_above(float value) {
    uint first = 0u, last = FRAME.style.tint_count;
    while (first < last) {
        uint middle = (first + last) / 2u;
        if (value < FRAME.style.tints[middle].at) last = middle;
        else first = middle + 1u;
    }
    return first;
}

// Linear between stops, constant beyond the ends.
vec3 tint(float value) {
    uint above = tint_above(value);
    if (above == 0u) return FRAME.style.tints[0].colour;
    if (above == FRAME.style.tint_count) return FRAME.style.tints[above - 1u].colour;
    float low = FRAME.style.tints[above - 1u].at, high = FRAME.style.tints[above].at;
    return mix(FRAME.style.tints[above - 1u].colour, FRAME.style.tints[above].colour, clamp((value - low) / (high - low), 0.0, 1.0));
}

// Of the ground as it is: not exaggerated.
float slope_deg(SurfacePoint point) {
    return degrees(atan(length(point.normal.xy), FRAME.exaggeration * point.normal.z));
}

// Where the ground falls to, clockwise from true north, 0 to 360.
float aspect_deg(SurfacePoint point) {
    float angle = degrees(atan(point.normal.x, point.normal.y));
    return angle < 0.0 ? angle + 360.0 : angle;
}

#include "shaders/shade/cover.glsl"
#include "shaders/shade/cleared.glsl"
#include "shaders/shade/materials.glsl"
#include "shaders/shade/mesh_looks.glsl"

// In linear light, or as codes.
vec3 ground_tint(SurfacePoint point) {
    bool by_cover = FRAME.style.colour_by == colour_by_cover;
    float value;
#ifdef IN_AIR
    if (of_materials) return colour_of_shares(shares_by_rule(point));
#endif
    if (by_cover) value = above_snow_line_m(point);
    else if (FRAME.style.colour_by == colour_by_slope) value = slope_deg(point);
    else if (FRAME.style.colour_by == colour_by_height) value = point.mean_H_m;
    else if (point.normal.xy == vec2(0.0)) return FRAME.style.flat_colour;
    else value = aspect_deg(point);
    vec3 colour = tint(value);
    return by_cover ? mix(colour, FRAME.style.cover.rock, rock_share(point, value)) : colour;
}

// Cosine of the angle between the sun and the slope, which is drawn `relief` times as steep.
float towards_sun(SurfacePoint point) {
    return dot(steeper(point.normal, FRAME.style.relief), FRAME.style.sun_enu);
}

vec3 sunlit(vec3 colour, SurfacePoint point) {
    vec3 normal = steeper(point.normal, FRAME.style.relief);
    float direct = (1.0 - FRAME.style.sun_hidden) * sun_share() * facing(normal, FRAME.style.sun_enu);
    // The sky's share falls with the slope: a wall sees half of it.
    float diffuse = 0.5 + 0.5 * normal.z;
    float light = FRAME.style.ambient * diffuse * sky_share() + (1.0 - FRAME.style.ambient) * direct;
    return colour * light;
}

// A hillshade's grey, 1 to 255 of 255, as gdaldem computes it.
vec3 hillshaded(vec3 codes, SurfacePoint point) { return codes * ((1.0 + 254.0 * max(towards_sun(point), 0.0)) / 255.0); }

// Slopes towards the sun take its warm colour, those away from it are multiplied with a cool one; level ground keeps its tint. The air in
// the valleys takes contrast away, as it does for one who looks down. Where the sun is hidden no slope is turned to it: all are in shade.
// Source: E. Imhof, Cartographic Relief Presentation, 1982, chapters 9 and 13, by eye.
vec3 in_relief_light(vec3 codes, SurfacePoint point) {
    float level = max(FRAME.style.sun_enu.z, 0.05), cosine = towards_sun(point);
    float hidden = FRAME.style.sun_hidden, lit = (1.0 - hidden) * clamp((cosine - level) / max(1.0 - level, 0.05), 0.0, 1.0);
    float turned_away = mix(clamp((level - cosine) / level, 0.0, 1.0), 1.0, hidden);
    ReliefLight light = FRAME.style.relief_light;
    float up = smoothstep(light.low_H_m, light.high_H_m, point.H_m);
    float contrast = mix(light.low_contrast, 1.0, up);
    vec3 warm = mix(codes, light.lit, light.lit_share * contrast * lit);
    vec3 shaded = warm * mix(vec3(1.0), light.shadow, contrast * turned_away);
    // Steep ground is darker whichever way it faces: relief is seen in the light, too, and where all is in shade by this alone.
    float steep = mix(0.35, 0.7, hidden) * (1.0 - steeper(point.normal, FRAME.style.relief).z);
    return mix(shaded * (1.0 - contrast * steep), light.veil, light.low_veil * (1.0 - up));
}

// Lines where H is a multiple of the interval, as wide as the style says wherever the ground is seen from; thinned out where they would
// stand less than 3.5 px apart. A centimetre is added to H: a lake at a round height is no line.
vec3 with_contours(vec3 colour, SurfacePoint point) {
    float interval = FRAME.style.contours.interval_m;
    if (interval <= 0.0 || point.H_per_px <= 0.0) return colour;
    float in_intervals = (point.mean_H_m + 0.01) / interval, nearest = floor(in_intervals + 0.5);
    float off_px = abs(in_intervals - nearest) * interval / point.H_per_px, apart_px = interval / point.H_per_px;
    bool fifth = mod(nearest, 5.0) == 0.0;
    float half_width_px = FRAME.style.contours.width_px * (fifth ? 1.0 : 0.5);
    float there = clamp(half_width_px + 0.5 - off_px, 0.0, 1.0) * min(2.0 * half_width_px, 1.0);
    float room = smoothstep(1.5, 3.5, fifth ? 5.0 * apart_px : apart_px);
    return mix(colour, FRAME.style.contours.colour, there * room);
}

// What images over the ground do to its colour and its normals: found once for all of a pixel's ground.
struct Images {
    vec3 colour;
    float share;
    float upright;
    vec4 cover;  // land cover below them: its colour, and the share that is known
};
vec4 cover_below(SurfacePoint point, bool as_codes) {
    if (!(as_map || in_air) || !has_cover()) return vec4(0.0);
    vec4 cover = cover_sample(point);
    if (cover.a <= 0.0) return vec4(0.0);
    vec3 light = cover.rgb / cover.a;
    return vec4(as_codes ? srgb_from_linear(light) : light, cover.a);
}
float image_share = 0.0;  // of a pixel's ground: what lies under an image
Images images_over(SurfacePoint point) {
    Images images = Images(vec3(0.0), 0.0, 0.0, vec4(0.0));
    if (!draped) return images;
    bool as_codes = as_map && !in_air && FRAME.style.tints_as_codes == 1u;
    images.cover = cover_below(point, as_codes);
    if (!has_images()) return images;
    vec4 image = drape_sample(point);
    float share = image.a * FRAME.drape.opacity;
    if (share <= 0.0) return images;
    image_share = share;
    vec3 codes = image.rgb / image.a;
    return Images(as_codes ? codes : linear_from_srgb(codes), share, share * (1.0 - FRAME.drape.relief), images.cover);
}
vec3 imaged_tint(Images images, inout SurfacePoint point) {
    vec3 colour = images.cover.rgb;
#ifdef IN_AIR
    rock_colour = sky_colour = vec3(0.0);
#endif
#ifdef IN_AIR
    forest_share = 0.0;
#endif
    if (!draped || images.cover.a < 1.0) {
        vec3 by_rule = as_map || in_air ? ground_tint(point) : tint(point.mean_H_m);
        colour = draped ? mix(by_rule, colour, images.cover.a) : by_rule;
    }
#ifdef IN_AIR
    if (draped) forest_share = mix(forest_share, map_forest.x / max(map_forest.y, 1.0e-4), images.cover.a);
#endif
#ifdef IN_AIR
    if (HAS_NET && of_materials && pixel_look.x > 0.0) {
        forest_share = 0.0;
        colour = mesh_colour(point);
        rock_colour = sky_colour = vec3(0.0);
    }
#endif
    if (!of_materials && has_file_colour()) colour = pixel_file_colour;
#ifdef IN_AIR
    if (draped) {
        float by_rule = (1.0 - images.cover.a) * (1.0 - images.share);
        rock_colour *= by_rule;
        sky_colour *= by_rule;
    }
#endif
    if (images.share <= 0.0) return colour;
    point.normal = normalize(mix(point.normal, vec3(0.0, 0.0, 1.0), images.upright));
    return mix(colour, images.colour, images.share);
}

#ifdef IN_AIR
void add_place(inout GroundLight sum, Images images, SurfacePoint point, vec3 sun, float share) {
    vec3 albedo = share * imaged_tint(images, point), normal = steeper(point.normal, FRAME.style.relief);
    float cosine = facing(normal, sun);
    sum.colour += albedo;
    sum.lit += albedo * cosine;
    sum.open += albedo * (0.5 + 0.5 * normal.z);
    if (of_materials) {
        seen_forest += share * vec2(forest_share, 1.0);
        vec3 rock = share * rock_colour, sky = share * sky_colour;
        sum.colour += sky;
        sum.open += sky * (0.5 + 0.5 * normal.z);
        sum.lit += rock * (cosine * lit_by_relief(pixel_relief, cosine));
        sum.open += rock * clamp(pixel_relief.to_sky, -0.5, 0.5);
    }
}
#else
// In linear light, before any air.
vec3 place_colour(Images images, SurfacePoint point) {
    vec3 colour = imaged_tint(images, point);
    if (as_map) {
        if (FRAME.style.light == light_hillshade) colour = hillshaded(colour, point);
        if (FRAME.style.light == light_relief) colour = in_relief_light(colour, point);
        if (FRAME.style.tints_as_codes == 1u) colour = linear_from_srgb(colour);
    }
    if (!as_map || FRAME.style.light == light_sun) colour = sunlit(colour, point);
    return as_map ? with_contours(colour, point) : colour;
}

void add_place(inout GroundLight sum, Images images, SurfacePoint point, vec3 sun, float share) {
    sum.colour += share * place_colour(images, point);
}
#endif

// Each part of the footprint has ground of several slopes, coloured one by one: places that have the mean and the covariance of its
// normals, as sigma points have. Source: S. Julier, J. Uhlmann, A new extension of the Kalman filter to nonlinear systems, 1997.
float add_part(inout GroundLight sum, Images images, SurfacePoint point, GroundSum part, vec3 sun, float turn) {
    mat2 apart = normals_apart(part);
    float H_m = part.h_m + pixel_ground.origin_m - pixel_ground.undulation_m;
    float H_apart_m = sqrt(max(part.hh_m2 - part.h_m * part.h_m, 0.0));
    // Natural colours differ little enough for two, across each other in parts that are neighbours.
    int places = H_apart_m > 0.5 || apart != mat2(0.0) ? (in_air ? 2 : shows_slopes() ? 8 : 4) : 1;  // posts have one slope
    GroundLight own = GroundLight(vec3(0.0), vec3(0.0), vec3(0.0));
    float shown = 0.0;
    for (int i = 0; i < places; ++i) {
        float one = float(1 - 2 * (i & 1));
        vec2 side = vec2(one, places == 2 ? one * turn : float(1 - (i & 2)));
        if (places == 8) side *= i < 4 ? vec2(1.30656296, 0.54119610) : vec2(0.54119610, 1.30656296);  // evenly on the same circle
        point.normal = normal_of(part.normal.xy + apart * side);
        point.mean_H_m = H_m + H_apart_m * (places == 2 ? one : sign(side.x * side.y));
        if (point.H_per_px > 0.0)
            point.H_per_px = length(point.normal.xy * pixel_ground.to_next) / (point.normal.z * FRAME.exaggeration);
        if (in_air) point.mean_H_m = land_H_m(point.mean_H_m);
        // Places that face the eye show more of themselves.
        float share = max(dot(point.normal, pixel_ground.to_eye) / point.normal.z, 0.02) / float(places);
        add_place(own, images, point, sun, share);
        shown += share;
    }
    // Parts that face it as a whole have been found oftener already (shown_from), nearly by as much as they do: the power is that of the least
    // differences to 64 samples. Those that are turned away more than the mean ground have not.
    float found = part.share * pow(max(shown, 0.5 * pixel_ground.plane.shown), -0.8);
    sum.colour += found * own.colour;
    sum.lit += found * own.lit;
    sum.open += found * own.open;
    return found * shown;
}

GroundLight pixel_light(SurfacePoint point, vec3 sun) {
    GroundLight sum = GroundLight(vec3(0.0), vec3(0.0), vec3(0.0));
    if (in_air) point.mean_H_m = land_H_m(point.mean_H_m);
#ifdef IN_AIR
    if (of_materials) find_pixel_materials(point, sun);
#endif
    Images images = images_over(point);
    float share = 0.0;
    if (by_means && !parts_follow)
        for (int i = 0; i < point.parts; ++i) {
            GroundSum part = part_of_pixel(i);
            if (part.share <= 0.0) continue;
            share += add_part(sum, images, point, part, sun, float(1 - 2 * ((i + i / pixel_ground.rows) & 1)));
        }
    if (share <= 0.0) {
        add_place(sum, images, point, sun, 1.0);
        return sum;
    }
    float scale = 1.0 / share;
    return GroundLight(sum.colour * scale, sum.lit * scale, sum.open * scale);
}

vec3 ground_colour(SurfacePoint point) {
    return pixel_light(point, FRAME.style.sun_enu).colour;
}

// By the light of the sun and of the sky, before the air between. Of slopes, the part that does not see the sky sees other ground.
vec3 sent_by(LitPlace place) {
    PlaceLight light = light_at(place.h_m, place.sun.z);
    vec3 from_sun = light.from_sun, from_sky = light.from_sky;
    vec3 from_ground = AIR.ground_albedo * (from_sun * max(place.sun.z, 0.0) + from_sky);
    vec3 ground = (from_sun * sun_share() * place.ground.lit + from_ground * place.ground.colour
                   + (from_sky - from_ground) * sky_share() * place.ground.open) / pi;
    return !parts_follow && place.water > 0.0 ? mix(ground, water_radiance(place.view, place.sun, from_sun, from_sky), place.water) : ground;
}

LitPlace ground_place(SurfacePoint point) {
    vec3 sun = sun_at(point.view);
    GroundLight light = pixel_light(point, sun);
    // An image has its own water.
    LitPlace place = LitPlace(light, point.view, point.h_m, sun, point.water * (1.0 - image_share));
#ifdef IN_AIR
    if (of_materials) find_canopy(point);
#endif
    return place;
}

// What the sky sends where a line of sight meets nothing; else false, and the place that it meets, unless that is left to the other of two
// programs.
bool sees_sky(vec3 direction, out vec3 sky, out LitPlace place, out bool is_left) {
    float horizon, distance_m = bare_sea_m(direction, horizon);
    bool meets = distance_m >= 0.0;
    is_left = (parts_follow && meets) || (parts_alone && !meets);
    if (is_left) return false;
    if (meets) {
        place = bare_place(direction, distance_m);
        return false;
    }
    float above_rad = asin(clamp(dot(direction, FRAME.up_view), -1.0, 1.0)) - asin(horizon);
    sky = sky_radiance(direction, above_rad) + sun_disc(direction);
    return true;
}

// What covers the ground follows from these; found once for a pixel.
void look_for_snow(inout SurfacePoint point) {
    if (!(as_map || in_air) || FRAME.style.colour_by != colour_by_cover) return;
    point.snow_line_m = snow_line_m(point.lat_deg);
    // Far below it nothing is ice, and far above it everything is.
    float above_m = point.mean_H_m - point.snow_line_m, level_m = FRAME.style.cover.level_m;
#ifdef IN_AIR
    if (of_materials && by_means && above_m < 1000.0) point.hollow_m = hollow_m_at(point, length(point.view) / FRAME.pixels_per_tangent);
#endif
    if (!by_means || level_m <= 0.0 || above_m <= -1.6 * level_m - 1000.0 || above_m >= 2000.0) return;
    // Nor is it on slopes of 15 degrees; where a pixel has one slope and one height that can be told (cover.glsl).
    float lean = length(point.normal.xy), up = FRAME.exaggeration * point.normal.z;
    bool is_one = parts_follow || point.parts == 0;
    if (is_one && (lean > 0.2682 * up || above_m + abs(FRAME.style.cover.shade_m) <= -1.6 * max(level_m, 1.0))) return;
    point.wide_level = wide_level_at(point);
}

// Without air.
vec3 colour_of_surface(SurfacePoint point) {
    vec3 colour = ground_colour(point);
    return as_map && FRAME.style.is_map == 1u ? colour : in_haze(colour, point.h_m, length(point.view));
}
vec3 seen_background(vec3 direction) {
    return as_map && FRAME.style.is_map == 1u ? FRAME.style.no_data_colour : background(direction);
}
