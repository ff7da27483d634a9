// Draws made terrain as patches of fixed size, a workgroup each, to time them against levels of any size
// (docs/notes, fixed-patches-against-levels): patches of 2, 3, 5 or 9 posts a side, chosen by distance.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/earth/camera.h"
#include "render/device/resources.h"
#include "render/made/made_posts.h"
#include "shaders/patches/shared_patches.h"

namespace oro {

enum class PatchWay {
    mesh,            // mesh shaders, 32 invocations a workgroup
    mesh_by_vertex,  // mesh shaders, an invocation for each vertex, as published
    compute,         // a square an invocation, into a visibility buffer by 64-bit atomics
};
inline constexpr std::array patch_ways{PatchWay::mesh, PatchWay::mesh_by_vertex, PatchWay::compute};
// "mesh", "mesh, an invocation a vertex", "compute".
std::string name_of(PatchWay way);

// What a patch's border does where its neighbour is coarser.
enum class PatchBorders {
    open,    // nothing: there are gaps
    mean,    // its vertices get the mean height of the neighbour's beside them, as published
    shared,  // it has the neighbour's vertices alone
};

// What a frame of patches is asked for.
struct PatchRequest {
    Camera camera;                       // far from the ground; its size is the renderer's
    std::optional<std::uint32_t> level;  // 2^level squares along a patch's side, 0 to 3; none: by distance
    PatchBorders borders{PatchBorders::open};
    bool makes_heights{true};  // noise in this frame; else heights are those of a frame before
};

// What a frame took, seconds of GPU timestamps.
struct PatchFrameReport {
    double noise_s{};  // 0 where heights were kept
    double choose_s{};
    double draw_s{};
};

// One square of patches on the GPU with what all ways need; a way's programs are made when it first draws.
// One thread at a time; `gpu` outlives it.
class FixedPatches {
  public:
    // Patches that cover a terrain of 8 * patches + 1 posts along both sides; patches: 1 to 2,000. Errors:
    // the device is out of memory, or cannot make the programs.
    static Result<FixedPatches> create(const Gpu& gpu, const MadeTerrain& terrain, std::uint32_t width_px,
                                       std::uint32_t height_px);

    // Whether the device can draw so. Errors (no_device): it lacks mesh shaders, or 64-bit atomics, or starts
    // too few workgroups.
    [[nodiscard]] Result<void> check(PatchWay way) const;
    // Draws a frame and waits for it. Errors: as check(); the device.
    Result<PatchFrameReport> draw(PatchWay way, const PatchRequest& request);
    // Of the last frame: for each pixel, row by row from the top, the number of the triangle that it shows:
    // patch * 128 + triangle + 1; 0: none. Errors: the device.
    Result<std::vector<std::uint32_t>> ids();
    // Of the last frame: how many patches have each level. Errors: the device.
    Result<std::array<std::uint32_t, 4>> patches_of_levels();
    // Heights of all posts as they are drawn, row by row from the north, H in 2^-11 m. Errors: the device.
    Result<std::vector<std::int32_t>> heights();

    // Along a side.
    [[nodiscard]] std::uint32_t patches() const { return patches_; }

  private:
    FixedPatches(const Gpu& gpu, const MadeTerrain& terrain) : gpu_(&gpu), terrain_(terrain) {}
    Result<void> create_buffers();
    Result<void> create_layout();
    [[nodiscard]] gpu::PatchFrame frame_for(const PatchRequest& request) const;
    void record(VkCommandBuffer commands, PatchWay way, const gpu::PatchFrame& frame, bool makes_heights);
    void record_drawn(VkCommandBuffer commands, PatchWay way) const;
    void record_compute(VkCommandBuffer commands) const;
    Result<Buffer> read_back(const Buffer& from, VkDeviceSize bytes);

    const Gpu* gpu_;
    MadeTerrain terrain_;
    std::uint32_t patches_{};
    VkExtent2D extent_{};
    PatchWay last_way_{};
    std::optional<MadePosts> posts_;
    Buffer heights_, levels_, visibility_, mesh_groups_;
    Image ids_, depth_;
    OwnedQueryPool timestamps_;
    OwnedPipelineLayout layout_;
    VkShaderStageFlags stages_{};  // that the layout pushes to
    OwnedPipeline choose_;
    std::array<OwnedPipeline, patch_ways.size()> ways_;
    Commands commands_;  // declared last: what is under way ends before what it uses
};

}  // namespace oro
