// Heights of pages of made terrain, made by the GPU where it keeps the pages: the same bits as the CPU makes.
#pragma once

#include <memory>

#include "core/base/result.h"
#include "core/frame/height_quantization.h"
#include "core/made/made_ground.h"
#include "core/terrain/post_grid.h"
#include "render/device/resources.h"

namespace oro {

// Who makes heights of pages of made terrain, which have the same bits. fastest: the GPU, but where that is a
// processor, too.
enum class HeightMaker { fastest, processor, gpu };

// Makes heights of pages of one grid. The device outlives it.
class MadePageHeights {
  public:
    // Whether the device can: it has doubles (shaderFloat64), which N and exaggeration are added in.
    static bool can_run(const Gpu& gpu);
    // Whether it is to make those of pages with such a coding.
    static bool is_wanted(const Gpu& gpu, HeightMaker maker, const HeightQuantization& coding);
    // Of a grid with such posts, lifted and exaggerated so; coding: how heights lie in blocks, not packed.
    // Errors: the device.
    static Result<std::shared_ptr<const MadePageHeights>> create(const Gpu& gpu, const MadeGround& ground,
                                                                 const UndulationField& undulation,
                                                                 double exaggeration,
                                                                 const HeightQuantization& coding);

    // Records the making of one page's heights. Addresses on the device: of a gpu::MadePageSource, a multiple
    // of 8, and of PageBlock::heights. Whoever records waits for what is written (compute, storage).
    void record(VkCommandBuffer commands, VkDeviceAddress source, VkDeviceAddress heights) const;

  private:
    // As page_heights.comp takes it.
    struct Work {
        VkDeviceAddress rule, source, N_m, heights;
        double exaggeration;
        std::int32_t N_row, N_column, N_stride;
        std::uint32_t words, sixteen, code_shift;
        std::int32_t code_offset;
    };

    MadePageHeights() = default;
    Result<void> create_program(const Gpu& gpu);
    Result<void> send(const Gpu& gpu, const MadeGround& ground, const UndulationField& undulation);

    OwnedPipelineLayout layout_;
    OwnedPipeline program_;
    Buffer rule_, N_m_;
    Work work_{};
};

}  // namespace oro
