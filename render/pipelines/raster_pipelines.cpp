#include "render/pipelines/pipeline_parts.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "spirv/cluster_clip_comp.h"
#include "spirv/cluster_raster_comp.h"
#include "spirv/raster_boxes_comp.h"
#include "spirv/raster_clear_comp.h"
#include "spirv/raster_clip_comp.h"
#include "spirv/raster_comp.h"
#include "spirv/raster_large_comp.h"

namespace oro {
namespace {

// By constant_id: 1 pixels of the largest box that an invocation draws by itself
// (shaders/raster/draw_alone.glsl); 3 triangles are counted into FrameConstants.overdraw.
struct RasterConstants {
    std::int32_t alone_max_px;
    VkBool32 counts_overdraw;
};
constexpr std::array<VkSpecializationMapEntry, 2> raster_constants_map{
    VkSpecializationMapEntry{1, offsetof(RasterConstants, alone_max_px), sizeof(std::int32_t)},
    VkSpecializationMapEntry{3, offsetof(RasterConstants, counts_overdraw), sizeof(VkBool32)}};

}  // namespace

Result<void> add_raster_pipelines(const Gpu& gpu, const PipelineWants& wants, Pipelines& pipelines) {
    // Measured: a software driver takes a third less time where no triangle of up to 64 x 64 pixels is handed
    // on, and an H100 least where those above 16 pixels are.
    const bool alone = gpu.report().kind == VK_PHYSICAL_DEVICE_TYPE_CPU && !wants.shares_triangles;
    pipelines.alone_max_px = alone ? 4096 : 16;
    const RasterConstants values{pipelines.alone_max_px, wants.overdraw ? VK_TRUE : VK_FALSE};
    const VkSpecializationInfo all{2, raster_constants_map.data(), sizeof(values), &values};
    const VkSpecializationInfo counts{1, &raster_constants_map[1], sizeof(values), &values};
    ORO_TRY(pipelines.raster_clear,
            create_compute_pipeline(gpu, pipelines, raster_clear_comp_spirv, "raster clear"));
    ORO_TRY(pipelines.raster, create_compute_pipeline(gpu, pipelines, raster_comp_spirv, "raster", &all));
    ORO_TRY(pipelines.raster_clip,
            create_compute_pipeline(gpu, pipelines, raster_clip_comp_spirv, "raster clip", &counts));
    ORO_TRY(pipelines.raster_boxes,
            create_compute_pipeline(gpu, pipelines, raster_boxes_comp_spirv, "raster boxes", &counts));
    ORO_TRY(pipelines.raster_large,
            create_compute_pipeline(gpu, pipelines, raster_large_comp_spirv, "raster large", &counts));
    return {};
}

Result<void> add_cluster_raster(const Gpu& gpu, Pipelines& pipelines) {
    // Measured: clusters have more triangles of some size, and an H100 takes least where those above 64
    // pixels are handed on.
    const RasterConstants values{std::max(64, pipelines.alone_max_px), VK_FALSE};
    const VkSpecializationInfo alone{1, raster_constants_map.data(), sizeof(values), &values};
    ORO_TRY(pipelines.cluster_raster,
            create_compute_pipeline(gpu, pipelines, cluster_raster_comp_spirv, "cluster raster", &alone));
    ORO_TRY(pipelines.cluster_clip,
            create_compute_pipeline(gpu, pipelines, cluster_clip_comp_spirv, "cluster clip"));
    return {};
}

}  // namespace oro
