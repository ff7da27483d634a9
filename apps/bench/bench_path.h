// Fixed eyes for the benchmark, read from a file.
#pragma once

#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/earth/camera.h"
#include "core/terrain/post_grid.h"

namespace oro {

struct BenchEye {
    std::string name;
    Camera camera;
};

// {"eyes": [{"name", "lat_deg", "lon_deg", "H_m" or "h_m", "heading_deg", "pitch_deg", "roll_deg" (0),
// "fov_deg" (45)}, ...]}; H is lifted by the region's own undulation. Errors: the file, and what in it is
// wrong.
Result<std::vector<BenchEye>> read_bench_path(const std::string& path, const UndulationField& undulation,
                                              int width_px, int height_px);

}  // namespace oro
