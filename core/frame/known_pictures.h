// Pictures that are known before anything of them is drawn.
#pragma once

#include <vector>

#include "core/frame/casters.h"
#include "core/frame/frame_plan.h"

namespace oro {

// None: any picture.
struct KnownPictures {
    std::vector<FrameView> views;
    ShadowRequest light;  // of each, as its style asks for it
};

}  // namespace oro
