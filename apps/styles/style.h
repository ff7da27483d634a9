// A style ready for the GPU, and the sun it is lit by.
#pragma once

#include "apps/light/sun.h"
#include "shaders/shared.h"

namespace oro {

struct Style {
    gpu::FrameStyle frame;
    SunDirection sun;
    bool sun_by_place{false};  // views that ask for no sun have the usual one of their place, and not this
    bool contours_by_view{false};  // their interval follows from the view (apps/styles/contour_interval.h)
    double labels_px{};            // size of the figures on every fifth contour line; 0: none
};

}  // namespace oro
