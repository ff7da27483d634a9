// Posts of made terrain for whoever measures it, made by the GPU.
#pragma once

#include <memory>

#include "core/base/result.h"
#include "core/made/post_maker.h"
#include "render/device/gpu.h"

namespace oro {

// A maker for the thread that calls this, which is the one that submits to the device; for others it makes
// nothing. Its program and buffers are made when it is asked first, so that one that nobody asks takes
// nothing. The device outlives it.
std::shared_ptr<MadePostMaker> gpu_post_maker(const Gpu& gpu);

}  // namespace oro
