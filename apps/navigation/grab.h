// The eye moves so that what the cursor took hold of stays under it.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <optional>

#include "core/earth/camera.h"
#include "core/earth/place_framing.h"
#include "core/earth/world_model.h"

namespace oro {

// Where in the picture of a camera a point is seen, pixels from the top left corner, whether the picture
// reaches there or not; nothing where the point is not before the eye. Ground that hides it does not count.
std::optional<glm::dvec2> pixel_of(const Camera& camera, const Ecef& point, const Air& air = {});

// The unit ECEF direction, at the camera's eye, in which a point is seen through the air.
glm::dvec3 seen_direction(const Camera& camera, const Ecef& point, const Air& air = {});

// The camera at another place, level as before: it looks to the same side in space, but for a rotation of the
// whole camera (ECEF axes), whatever north is there.
Camera carried_to(const Camera& camera, const Geodetic& eye, const glm::dmat3& rotation = glm::dmat3(1.0));

// A camera turned to have a direction at a pixel; exact: it has (to rounding, some 1e-5 pixels).
struct Holding {
    Camera camera;
    bool exact{};
};
// The camera, its roll kept and its pitch within lowest_deg and highest_deg, turned by the least to have a
// unit ECEF direction at a pixel. Where no such pitch allows that, its pitch is at the nearest limit, and the
// direction is on that side of the pixel; the camera never turns over to the opposite side.
Holding turned_to_hold(const Camera& camera, const glm::dvec3& ecef_direction, glm::dvec2 point_px,
                       double lowest_deg = -90.0, double highest_deg = 90.0);

// The camera moved over the ellipsoid, its height, pitch and roll kept, to have `place` at a pixel: exact
// (below 0.001 pixels; where the steps do not come so near, the camera is turned for the rest). Where the
// pixel shows what is farther than the place may ever be (sky, or ground that the line of sight would meet at
// less than 1 degree), the pixel that counts is the nearest one straight below it, and the camera is not
// exact. `place` is lower than the eye.
Holding moved_to_hold(const Camera& camera, const Ecef& place, glm::dvec2 point_px, const Air& air = {});

// What a drag began with.
struct GrabStart {
    Camera camera;              // as the button went down
    glm::dvec2 pressed_px{};    // and where
    std::optional<Ecef> place;  // what the picture has there, as it is drawn; nothing for the sky
};
// Whether the eye is moved by dragging that, and not only turned: the line of sight meets the level of the
// place at 2 degrees or more. Flatter ones would fling the eye far for a few pixels.
bool grab_moves_eye(const GrabStart& start);

// The camera of a drag whose cursor is at a pixel; it depends on nothing else, so a cursor that comes back
// brings the first camera back, to the bit. The place is under the cursor: the eye is moved by
// moved_to_hold(), lifted where it would be lower than eye_clearance_m over the ground, and then turned to
// hold the place. Where grab_moves_eye() is false, the eye stays and turns, and what was in the direction of
// the cursor stays there. Past the farthest reach the picture stops following; it follows continuously up to
// there and never turns over. Source of the first guess: the shortest turn of a sphere between two of its
// points, on the sphere of the Gaussian radius at the eye; Newton's steps on the ellipsoid then.
Camera grabbed(const GrabStart& start, glm::dvec2 cursor_px, const GroundHeightAt& ground_h_m,
               const Air& air = {});

}  // namespace oro
