// Ground and sky by the light of the sun in the air: FrameStyle.air. Needs surface.glsl and aerial.glsl.

// Towards the sun from a place: east, north, up there. Its light is parallel.
vec3 sun_at(vec3 view) {
    vec3 up = normalize(view + (FRAME.earth_radius_m + FRAME.eye_h_m) * FRAME.up_view);
    vec3 east = cross(FRAME.view_from_eye * vec3(0.0, 0.0, 1.0), up), sun = sun_in_view();
    if (dot(east, east) < 1.0e-12) east = FRAME.view_from_eye * vec3(0.0, 1.0, 0.0);
    east = normalize(east);
    return vec3(dot(sun, east), dot(sun, cross(up, east)), dot(sun, up));
}

// A pixel's ground: its colour; in air what it sends back of any light, of light from the sun, and of light from an open sky.
struct GroundLight {
    vec3 colour;
    vec3 lit;
    vec3 open;
};
// ... and where it is. One place in the code reckons with light and air for all that is no sky: copies of that fill the processors' memory
// for code, and take a driver long to compile.
struct LitPlace {
    GroundLight ground;
    vec3 view;
    float h_m;
    vec3 sun;     // towards it: east, north, up there
    float water;  // share of water
};

// As a place is seen through the air from the eye.
vec3 through_air(vec3 colour, vec3 view) {
    float distance_m = length(view);
    vec3 direction = view / distance_m, sun = sun_in_view();
    AirRay ray = AirRay(FRAME.earth_radius_m, eye_in_air_m(), dot(direction, FRAME.up_view), FRAME.style.sun_enu.z, dot(direction, sun));
    SeenAir seen = aerial_light(ray, distance_m);
    return colour * seen.through + seen.light;
}

vec3 sun_disc(vec3 direction) {
    float angle = acos(clamp(dot(direction, sun_in_view()), -1.0, 1.0));
    float rise = dot(direction, FRAME.up_view);
    float disc = 1.0 - smoothstep(0.95 * sun_radius_rad, 1.05 * sun_radius_rad, angle);
    return disc <= 0.0 ? vec3(0.0) : disc * to_space(min(eye_in_air_m(), air_top_m), rise) / (pi * sun_radius_rad * sun_radius_rad);
}

// As a camera develops it: with a little more contrast than there is around what is exposed as a middle grey, and bright light pressed
// together instead of cut off.
vec3 shown(vec3 radiance) {
    vec3 light = radiance * AirTable(FRAME.air).at[air_exposure_at].x;
    light = 0.22 * pow(max(light, vec3(0.0)) / 0.22, vec3(1.15));
    return mix(light, 0.35 + 0.65 * (1.0 - exp(-(light - 0.35) / 0.65)), greaterThan(light, vec3(0.35)));
}
