// Which meshlets are worth drawing. Conservative: may keep what is hidden, never drops what can be seen. Compiled as GLSL for
// the GPU and as C++ by core/earth/culling.cpp, so that what is tested against brute force is what runs.

// A sphere in the page frame that lies wholly outside one of the planes. Slack: above the float rounding of every term.
ORO_FUNCTION bool sphere_beyond_plane(vec3 centre, float radius, vec4 plane) {
    float distance_m = dot(vec3(plane), centre) + plane.w;
    float size_m = abs(centre.x) + abs(centre.y) + abs(centre.z) + abs(plane.w) + radius;
    return distance_m < -(radius + 1.0e-2f + 4.0e-7f * size_m);
}

// A meshlet whose every post the occluding ellipsoid hides. eye_offset: the eye's direction minus the meshlet's, unit
// vectors in scaled space; the angles as in MeshletBounds. Chords instead of angles: exact for near neighbours.
// Slack: 4e-6 rad and a millionth of the sum, above the rounding of every term (some 25 m of ground: kept, not lost).
ORO_FUNCTION bool beyond_horizon(vec3 eye_offset, float eye_angle_rad, float horizon_angle_rad) {
    float reach_rad = (eye_angle_rad + horizon_angle_rad) * 1.000001f + 4.0e-6f;
    if (reach_rad >= 3.14159f) return false;
    // The sine's series up to x^5 is never below the sine and has, unlike a GPU's sin(), the same bits everywhere; 4e-5 above it
    // at a quarter turn, 5e-3 at half a turn.
    float x = 0.5f * reach_rad;
    float xx = x * x;
    float chord = 2.0f * x * (1.0f - xx * (1.0f / 6.0f - xx * (1.0f / 120.0f)));
    return dot(eye_offset, eye_offset) > chord * chord * 1.000001f;
}
