// A baked file as a whole: it holds one grid of posts or several, and of a grid its cluster graph, too;
// and meshes that lie on them, which geo reads.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/baked/region_file.h"
#include "core/base/result.h"
#include "core/cluster_file/cluster_file.h"

namespace oro {

// This is one grid of a baked file.
struct BakedGrid {
    std::shared_ptr<const RegionFile> region;
    std::shared_ptr<const ClusterFile> clusters;  // null: it has none
    std::uint32_t rank{};                         // 0 is the ground where several have some (Region::rank)
};
// This opens a file with all its grids, at least one, in their order. Errors: those of Container, RegionFile
// and ClusterFile; clusters over other posts; chunks that are no grid's.
[[nodiscard]] Result<std::vector<BakedGrid>> open_baked_file(const std::string& path);

}  // namespace oro
