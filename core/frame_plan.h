// What a frame draws: the pages that can be seen from an eye, each with its place in view coordinates.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/camera.h"
#include "core/page.h"
#include "shaders/shared.h"

namespace oro {

// One frame of one tile, ready for the GPU but for device addresses and style.
struct FramePlan {
    gpu::FrameConstants constants{};        // addresses, counts and style are left to the renderer
    std::vector<gpu::FramePage> pages;      // nearest first; `block` is left to the renderer
    std::vector<std::size_t> page_numbers;  // which page of the region each one is
    std::size_t pages_beyond_frustum{};
    std::size_t pages_beyond_horizon{};
};

// Chooses the pages that can be seen (conservative: none that can is left out) and places them relative to
// the eye. Placing a page's frame in view coordinates adds at most 6e-8 of its distance to the error of its
// posts.
FramePlan plan_frame(std::span<const PageSummary> pages, const RegionShape& shape, const Camera& camera,
                     const Tile& tile);

}  // namespace oro
