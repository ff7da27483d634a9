// Draws a field of grass by four ways, to time them against each other: what the ways leave is the number of
// the blade that each pixel shows.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "render/device/resources.h"
#include "render/grass/grass_scene.h"

namespace oro {

enum class GrassWay {
    vertex,   // instances of a strip with 32 vertices or with 6, by two indirect draws: as published
    clumps,   // mesh shaders, a workgroup for each clump, 32 to 6 vertices: as published
    packed,   // mesh shaders, workgroups filled with blades of equally many vertices
    compute,  // a blade an invocation, into a visibility buffer by 64-bit atomics
};
inline constexpr std::array grass_ways{GrassWay::vertex, GrassWay::clumps, GrassWay::packed,
                                       GrassWay::compute};
// "vertex", "mesh, a clump a group" and so on.
std::string name_of(GrassWay way);

// What a frame took, by GPU timestamps, and what it drew.
struct GrassFrameReport {
    double cull_s{};
    double draw_s{};
    std::uint32_t blades_near{};  // that are nearer than the switch distance,
    std::uint32_t blades_far{};   // and those that are not
    std::uint32_t mesh_groups{};  // 0 by other ways
};

// One field on the GPU with what all ways need; a way's programs are made when it first draws. One thread at
// a time; `gpu` outlives it.
class GrassRenderer {
  public:
    // Places the field's clumps. Errors: the device is out of memory, or cannot make the programs.
    static Result<GrassRenderer> create(const Gpu& gpu, const gpu::GrassField& field, std::uint32_t width_px,
                                        std::uint32_t height_px);

    // Whether the device can draw so. Errors (no_device): it lacks mesh shaders, or 64-bit atomics, or room
    // for as many workgroups as the field has clumps.
    [[nodiscard]] Result<void> check(GrassWay way) const;
    // Draws a frame and waits for it. Errors: as check(); the device.
    Result<GrassFrameReport> draw(GrassWay way, const GrassRequest& request);
    // Of the last frame: for each pixel, row by row from the top, the number of the blade that it shows, from
    // 1 on; 0: none. Errors: the device.
    Result<std::vector<std::uint32_t>> blades();

  private:
    explicit GrassRenderer(const Gpu& gpu) : gpu_(&gpu) {}
    Result<void> create_buffers();
    Result<void> create_layout();
    Result<void> add_pipelines(GrassWay way);
    [[nodiscard]] gpu::GrassFrame frame_for(const GrassRequest& request) const;
    void push(VkCommandBuffer commands, const gpu::GrassFrame& frame) const;
    void dispatch(VkCommandBuffer commands, const OwnedPipeline& pipeline, std::uint32_t groups) const;
    void record(VkCommandBuffer commands, GrassWay way, gpu::GrassFrame frame) const;
    void record_cull(VkCommandBuffer commands, const gpu::GrassFrame& frame) const;
    void record_drawn(VkCommandBuffer commands, GrassWay way, gpu::GrassFrame& frame) const;
    void record_compute(VkCommandBuffer commands) const;

    const Gpu* gpu_;
    gpu::GrassField field_{};
    VkExtent2D extent_{};
    GrassWay last_way_{};
    Buffer clumps_, lists_, visibility_, lists_read_;
    Image ids_, depth_;
    OwnedQueryPool timestamps_;
    OwnedPipelineLayout layout_;
    VkShaderStageFlags stages_{};  // that the layout pushes to
    OwnedPipeline place_, cull_;
    std::array<OwnedPipeline, grass_ways.size()> ways_;
    Commands commands_;  // declared last: what is under way ends before what it uses
};

}  // namespace oro
