// A bake that several machines share: what one of them does, and what is taken of all.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/baked/bake.h"
#include "core/baked/measured_parts.h"
#include "core/base/result.h"
#include "geo/region/region.h"

namespace oro {

struct SharedBakeReport {
    std::vector<std::string> files;  // of the part, one for each grid
    std::uint64_t rows{};            // of nodes that were measured; 0 where all were there already
    std::size_t windows{};           // of clusters
};

// Does a part of what takes long in baking a region: measures its share of the nodes of a grid, and with
// clusters builds its share of the first windows. how: as for bake_region(), or for bake_clusters(), of the
// same region. Adds to the report. Errors: those of measure_part() and bake_windows_of_part().
Result<void> bake_shared(const HeightField& field, const BakeOptions& how, const BakePart& part,
                         bool clusters, const std::function<void(double, const char*)>& on_progress,
                         SharedBakeReport& report);

// Removes the files of parts that were joined.
void remove_parts(const MeasuredParts& parts);

}  // namespace oro
