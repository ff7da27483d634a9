// Images laid over a region: the tiles that the GPU gets of them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/drape/ground_image.h"
#include "geo/drape/image_source.h"

namespace oro {

// Later images lie over earlier ones. `outside` names those that lie nowhere over the region. Errors: a CRS
// that PROJ knows no way to.
Result<std::unique_ptr<GroundImage>> images_over(const PostGrid& grid, std::vector<ImageSource> images,
                                                 std::vector<std::string>& outside);

}  // namespace oro
