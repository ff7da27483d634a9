// How light bends on its way to the eye: what is seen is the scene with each point lifted along the eye's vertical by c a^2 / 2, a its
// distance across that vertical (core/earth/world_model.h, Refraction). Needs frame.glsl. View coordinates, metres.

float squared_across(vec3 view) {
    vec3 up = FRAME.up_view;
    precise float along = view.x * up.x + view.y * up.y + view.z * up.z;
    precise vec3 across = view - along * up;
    precise float squared = across.x * across.x + across.y * across.y + across.z * across.z;
    return squared;
}

vec3 bent(vec3 view) {
    precise vec3 seen = view + (0.5 * FRAME.refraction_per_m * squared_across(view)) * FRAME.up_view;
    return seen;
}

// A node's sphere and error as they are seen: the lift of two points whose a differ by r differs by at most c r (a + r / 2).
void bend_node(inout MeshletBounds bounds, inout vec3 centre_view) {
    float c = abs(FRAME.refraction_per_m), a = sqrt(squared_across(centre_view)), r = bounds.lod_radius;
    bounds.error_m *= 1.0 + c * (a + r);
    bounds.lod_radius = r + c * r * (a + 0.5 * r);
    centre_view = bent(centre_view);
}
