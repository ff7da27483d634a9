// The tables of the air that a style has (shaders/air): made when they are first asked for, and again only
// when what they are made of has changed.
#pragma once

#include <optional>

#include "render/device/resources.h"
#include "render/pipelines/pipelines.h"
#include "shaders/shared.h"

namespace oro {

class AirTables {
  public:
    // Room for a frame's tables, and where they are into its constants; the pipelines on first use. Nothing
    // happens for a style without air. exactly: false where tables will do that were made for an eye a little
    // higher or lower (3 % of its height, 30 m at least) and a sun at most half a degree away: of frames of
    // an eye that moves.
    Result<void> prepare(const Gpu& gpu, Pipelines& pipelines, gpu::FrameConstants& constants, bool exactly);
    // Fills those of them that are not as the constants of the last prepare() ask. The frame's set is bound.
    void record(VkCommandBuffer commands, const Pipelines& pipelines);

    [[nodiscard]] const Buffer& entries() const { return entries_; }

  private:
    // What the tables depend on: the first three on the model alone, the sky on all of it.
    struct Made {
        gpu::AirModel model{};
        float earth_radius_m{};
        float eye_h_m{};
        gpu::vec3 sun_enu{};
    };
    [[nodiscard]] static bool will_do(const Made& made, const Made& wanted);

    Buffer entries_;
    std::optional<Made> made_, wanted_;
};

}  // namespace oro
