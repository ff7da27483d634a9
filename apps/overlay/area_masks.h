// The areas of a view's polygons as its picture shows them.
#pragma once

#include <vector>

#include "apps/text/inked_rows.h"
#include "apps/view/view.h"
#include "core/truth/true_ground.h"
#include "render/frame/picture_renderer.h"

namespace oro {

// Whether a view's --overlay files have any that is filled.
[[nodiscard]] bool has_areas(const View& view);

// What they cover of the ground in each pixel's middle, the first drawn first. A feature's fields `fill`
// (#rrggbb) and `fill-opacity` (0 to 1) win over the view's colour and opacity, as in simplestyle. ground: of
// the scene's grids. Errors: those of the device and of pages.
Result<std::vector<InkedText>> area_masks(const Gpu& gpu, Scene& scene, const View& view,
                                          const TrueGround& ground, const PictureOptions& options);

}  // namespace oro
