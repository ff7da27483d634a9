// Triangles of meshes as pages that are drawn beside those of grids.
#pragma once

#include <memory>
#include <vector>

#include "core/base/result.h"
#include "core/frame/region_pages.h"
#include "core/seam/seam.h"

namespace oro {

// Pages of one level, a row of them, all of which a frame draws that sees them; null where no piece is of a
// mesh. A page has up to 256 nodes of up to 128 triangles (core/seam/mesh_node.h), and takes what these take:
// 12 to 16 bytes a triangle of a mesh whose vertices are shared, and 12 KB. N is that of `undulation`. shape:
// of the grids. Errors: meshes that reach over more than 60 degrees.
Result<std::unique_ptr<RegionPages>> mesh_pages(const Seam& seam, const UndulationField& undulation,
                                                const RegionShape& shape);

// All of a seam: what lies between grids, then meshes; as many as there are, none or two. Errors: as
// seam_pages() and mesh_pages().
Result<std::vector<std::unique_ptr<RegionPages>>> pages_beside(const Seam& seam,
                                                               const UndulationField& undulation,
                                                               const RegionShape& shape);

}  // namespace oro
