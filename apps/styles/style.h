// A style ready for the GPU, and the sun it is lit by.
#pragma once

#include "apps/light/sun.h"
#include "shaders/shared.h"

namespace oro {

struct Style {
    gpu::FrameStyle frame;
    SunDirection sun;
    bool contours_by_view{false};  // their interval follows from the view (apps/styles/contour_interval.h)
    double labels_px{};            // size of the figures on every fifth contour line; 0: none
};

}  // namespace oro
