// The view of all of a region, and the way back to it.
#pragma once

#include <glm/vec2.hpp>
#include <optional>

#include "apps/eye/ground_points.h"
#include "core/earth/camera.h"
#include "geo/places/bounding_box.h"

namespace oro {

// The camera that has all of a region in its picture, as a view that asks for no place
// (apps/view/overview.h): from the south, the steeper the larger the region. Angle of view, roll and size are
// those of `camera`. Nothing where the region has no ground.
std::optional<Camera> framed_home(const Camera& camera, const GroundPoints& ground);

// The ground of a region as far as the arrow asks: its box, and between which heights above the ellipsoid
// (as they are drawn) its ground is.
struct GroundBox {
    BoundingBox box;
    double low_h_m{};
    double high_h_m{};
};

// That of the points of a region; nothing where there are none.
std::optional<GroundBox> ground_box(const GroundPoints& ground);

// Where a region is that a picture does not show.
struct HomeArrow {
    glm::dvec2 point_px{};   // near the picture's border, on the way from its middle to the region's
    double clockwise_deg{};  // of the arrow, 0 .. 360 from the picture's up
    double distance_m{};     // along the ellipsoid from under the eye to the region's middle
    double bearing_deg{};    // true, from under the eye, 0 .. 360
};

// The arrow where no ground of the region can be in the picture; nothing where some may be. Asked are 9 x 9
// places of the box at both heights that the Earth does not hide, and the rays of 33 x 33 points of the
// picture: a region that is smaller than a 32nd of the picture and has none of its places in it may still
// have an arrow. Mountains hide nothing here. inset_px: from the border to point_px.
std::optional<HomeArrow> home_arrow(const Camera& camera, const GroundBox& ground, double inset_px = 32.0);

}  // namespace oro
