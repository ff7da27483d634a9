// What the code samples in comments of headers speak of without declaring it: the parameters of the functions
// that samples.awk makes of them.
#pragma once

#include <cstdint>
#include <cstdio>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "apps/film/camera_path.h"
#include "apps/navigation/camera_flight.h"
#include "core/cache/loader.h"
#include "core/cluster_file/cluster_file.h"
#include "core/truth/oracle.h"
#include "core/truth/true_surface.h"
#include "geo/opening/open_region.h"
#include "render/frame/frame_renderer.h"
#include "render/frame/picture_renderer.h"

namespace oro::samples {

using Item = int;

}  // namespace oro::samples

#define SAMPLE_CONTEXT                                                                                    \
    [[maybe_unused]] const Region &region, [[maybe_unused]] const HeightField &field,                     \
        [[maybe_unused]] const RegionRequest &request, [[maybe_unused]] const TrueGround &ground,         \
        [[maybe_unused]] const Geodetic &eye, [[maybe_unused]] const Geodetic &target,                    \
        [[maybe_unused]] double N_m, [[maybe_unused]] const Camera &camera,                               \
        [[maybe_unused]] const Camera &there, [[maybe_unused]] const std::vector<Camera>&cameras,         \
        [[maybe_unused]] double time_s, [[maybe_unused]] const GroundHeightAt &ground_h_m,                \
        [[maybe_unused]] const std::function<void(const Camera&)>&draw,                                   \
        [[maybe_unused]] const std::vector<CameraKey>&keys, [[maybe_unused]] Loader<int, Item>&loader,    \
        [[maybe_unused]] const std::vector<int>&missing, [[maybe_unused]] const OriginalSurface &surface, \
        [[maybe_unused]] const GroundBounds &bounds, [[maybe_unused]] const std::string &path,            \
        [[maybe_unused]] bool overwrite, [[maybe_unused]] const std::vector<std::uint8_t>&bytes,          \
        [[maybe_unused]] const Gpu *gpu, [[maybe_unused]] Scene &scene, [[maybe_unused]] FramePlan plan,  \
        [[maybe_unused]] const gpu::FrameStyle &style, [[maybe_unused]] const RowSink &sink
