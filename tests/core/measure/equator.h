// A surface whose errors are known by hand: the ellipsoid itself along the equator.
#pragma once

#include <gtest/gtest.h>

#include "core/earth/camera.h"
#include "core/truth/true_surface.h"
#include "tests/support/made_terrain.h"

namespace oro::test {

// The ellipsoid itself along the equator, 0.5 W to 1.5 E: the section of the Earth there is a circle of
// radius a = 6,378,137 m.
inline HeightField equator() {
    return made_field(0.1, -0.5, 60.0, 13, 121, [](double, double) { return 0.0F; });
}

// At 0 N 0 E, as high as asked, looking east; up is ECEF x and ahead is y. 1 x 1001 px and 90 degrees: 500.5
// px for a tangent of 1, the horizontal in the middle of row 500.
inline Camera eastward(double h_m) {
    Camera camera;
    camera.eye = {0.0, 0.0, h_m};
    camera.attitude = {90.0, 0.0, 0.0};
    camera.vertical_fov_deg = 90.0;
    camera.width_px = 1;
    camera.height_px = 1001;
    return camera;
}

class Equator : public ::testing::Test {
  protected:
    const HeightField field = equator();
    const TrueSurface surface{field, 1.0, 2};
};

}  // namespace oro::test
