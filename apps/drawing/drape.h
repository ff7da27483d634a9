// A view's images over the ground, from their files to a scene.
#pragma once

#include <memory>

#include "apps/options/options.h"
#include "apps/view/view.h"
#include "core/drape/post_colours.h"
#include "render/scene/scene.h"

namespace oro {

// Memory for a view's pages: beside images they have half of what was allowed.
MemoryOptions memory_of_pages(const View& view, const MemoryOptions& memory);

// Lays a view's images and its land cover over all grids of a scene of its region, and over what lies between
// them. Their tiles take the other half of the GPU's memory that was allowed; where nothing was said, a
// quarter of what the device has, at most 1 GiB. `quiet`: what a user must know of them is not said. Errors:
// as images_over()'s; the device. colours: laid over all images, where there are some. grids_beside: of other
// scenes, that take as much of the memory each as one of this scene's.
Result<void> lay_images(const View& view, const MemoryOptions& memory, const Gpu& gpu, Scene& scene,
                        bool quiet, const std::shared_ptr<const PostColours>& colours = nullptr,
                        std::size_t grids_beside = 0);

}  // namespace oro
