// What meshes take of the sun's light, from the ground of all grids and from each other.
#pragma once

#include <array>

#include "core/frame/frame_plan.h"
#include "render/device/resources.h"
#include "render/pipelines/pipelines.h"
#include "render/pipelines/shading_pipelines.h"
#include "render/shading/caster_buffers.h"
#include "shaders/shared_mesh_casters.h"

namespace oro {

// A frame's; holds on to nothing of its plan.
class MeshShadowFrame {
  public:
    // What the frame is told of the meshes of its grids; the pipeline on first use. Nothing happens where no
    // grid has meshes, or none of the frame's terrain casts shadows, and on other Earths than the ellipsoid.
    // slot: the frame's, of frames_in_flight. Errors: the device's.
    Result<void> prepare(const Gpu& gpu, RasterPath path, Pipelines& pipelines, const FramePlan& plan,
                         const SharedShares& shared, std::size_t slot);
    [[nodiscard]] bool is_on() const { return is_on_; }
    // Joins their shares to those of all grids; after these. A grid's set is bound that has shadows.
    void record(VkCommandBuffer commands, const Pipelines& pipelines) const;

  private:
    std::array<Buffer, frames_in_flight> tables_;  // gpu::MeshShadows
    std::size_t slot_{};
    std::uint32_t width_px_{}, height_px_{};
    bool is_on_{};
};

}  // namespace oro
