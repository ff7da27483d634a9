// What triangles of meshes cost a frame: houses before each eye, and more behind it.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "apps/bench/bench_path.h"
#include "apps/bench/times/bench_options.h"
#include "core/frame/region_pages.h"
#include "core/seam/seam.h"
#include "render/frame/frame_renderer.h"
#include "render/scene/scene.h"

namespace oro {

// Where houses stand: ahead of an eye, within most of its picture's width, or the other way.
enum class HousesLie { ahead, behind };

// So many boxes of 10 triangles on the ground, 100 m to 4 km from the eye, evenly by the logarithm of that.
// One seed, the same houses. Errors: a file that cannot be read.
Result<Seam> houses_around(const RegionPages& pages, const Camera& camera, HousesLie lie, int count,
                           std::uint64_t seed);

// Times the eyes without houses, with options.houses of them ahead, and with nine times as many behind as
// well; prints a line each, or gives them as JSON. Errors: as houses_around() and time_frames().
Result<nlohmann::ordered_json> time_houses(const Gpu& gpu, Scene& scene, FrameRenderer& renderer,
                                           const std::vector<BenchEye>& eyes, const BenchOptions& options);

}  // namespace oro
