// A frame with all that shows in it, where the GPU may be too small for all that is asked for.
#pragma once

#include "core/earth/camera.h"
#include "core/earth/world_model.h"
#include "render/frame/frame_renderer.h"
#include "render/scene/scene.h"

namespace oro {

// What may be asked of one part of one view, over and over, until nothing new is told of what shows there.
inline constexpr int most_settling_frames = 64;

struct SettledFrame {
    FrameReport report;
    std::uint64_t page_bytes{};  // of the pages that it read, Scene::block_bytes()
    bool settled{};              // what is missing, if anything, does not show
};

// Draws one sample of a tile with all that tau asks for. Where the GPU cannot hold that, it draws again until
// no frame tells anything new of what shows: then all of that is there, or does not fit.
Result<SettledFrame> draw_settled(Scene& scene, FrameRenderer& renderer, const FrameView& view,
                                  const gpu::FrameStyle& style);

}  // namespace oro
