// Pictures that are known before anything of them is drawn, and what a scene's pages can make of it.
#pragma once

#include <span>
#include <vector>

#include "apps/styles/style.h"
#include "apps/view/view.h"
#include "core/frame/known_pictures.h"

namespace oro {

// What the pages of a scene are for (make_grid_pages()) that is drawn for these cameras' pictures and no
// others, all in one style. Empty, which is for any picture: where pictures from several places have shadows,
// or heights are rounded on the GPU. oversampling: how much finer the cameras' pictures are than those of
// which the view has the tolerance.
KnownPictures known_pictures(const View& view, const Style& style, std::span<const Camera> cameras,
                             double oversampling = 1.0);

}  // namespace oro
