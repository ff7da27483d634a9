// The programs that a frame runs: rasterise meshlets into ids and depth, shade pixels.
#pragma once

#include <array>

#include "render/device/gpu.h"
#include "shaders/shared.h"

namespace oro {

inline constexpr VkFormat id_format = VK_FORMAT_R32_UINT;
inline constexpr VkFormat depth_format = VK_FORMAT_D32_SFLOAT;
inline constexpr VkFormat sum_format = VK_FORMAT_R32G32B32A32_SFLOAT;
inline constexpr VkFormat picture_format_vk = VK_FORMAT_R8G8B8A8_UNORM;

struct Pipelines {
    OwnedSetLayout set;  // 0 ids, 1 sum, 2 picture: storage images of the shading pass; 3 FrameConstants
    OwnedPipelineLayout layout;        // that set alone
    OwnedPipeline accept, live_pages;  // levels chosen, in this order
    OwnedPipeline terrain;             // mesh path: task, mesh, fragment
    std::uint32_t meshlets_per_task{1};
    std::uint32_t meshlets_per_group{1};                    // of a mesh workgroup
    OwnedPipeline cull, raster, raster_clip, raster_large;  // compute path, in this order
    OwnedPipeline shade;                                    // compute, 8 x 8
    OwnedPipeline shade_map;                                // the same for maps; see create_map_shading
    OwnedPipeline shade_air;                                // the same in air
    std::array<OwnedPipeline, 3> shade_draped;  // shade, shade_map and shade_air with images over the ground
    OwnedPipeline drape_wants;                  // what tiles of them are wanted, compute, 8 x 8
    std::array<OwnedPipeline, 4> air;           // its tables, in this order, 64 entries a workgroup
    OwnedPipeline triangles;                    // what each pixel shows, compute, 8 x 8
};

// What a renderer is asked for besides triangle ids.
struct PipelineWants {
    bool record_positions{false};  // the mesh shader writes each placed post to FrameConstants.recorded
    bool shades{true};             // false: `shade` is left out
    bool triangles{false};         // `triangles` is there
};

// Sizes of workgroups follow the device's preferred limits.
Result<Pipelines> create_pipelines(const Gpu& gpu, RasterPath path, const PipelineWants& wants);
// `air` and `shade_air`, for styles that have it: nothing else waits for them to be compiled.
Result<void> add_air_pipelines(const Gpu& gpu, RasterPath path, Pipelines& pipelines);

// Those that a style with images over the ground needs, as far as they are not there.
Result<void> add_drape_pipelines(const Gpu& gpu, RasterPath path, const gpu::FrameStyle& style,
                                 Pipelines& pipelines);
// The one of `shade_draped` for a style.
const OwnedPipeline& draped_shading(const Pipelines& pipelines, const gpu::FrameStyle& style);

// Whether a style is drawn by `shade_map`: it is more than tints by height in sunlight and air.
bool is_drawn_as_map(const gpu::FrameStyle& style);
// Makes `shade_map`, once there is a style for it.
Result<void> create_map_shading(const Gpu& gpu, RasterPath path, Pipelines& pipelines);

}  // namespace oro
