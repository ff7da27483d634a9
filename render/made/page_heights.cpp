#include "render/made/page_heights.h"

#include <cstring>
#include <span>

#include "core/made_pages/page_source.h"
#include "render/pipelines/pipeline_parts.h"
#include "render/pipelines/plan_pass.h"
#include "spirv/page_heights_comp.h"

namespace oro {
namespace {

constexpr std::uint32_t words_a_group = 64;
constexpr std::uint32_t work_bytes = 68;  // without what fills up to a multiple of 8

template <class T>
Result<Buffer> on_device(const Gpu& gpu, std::span<const T> values, const char* name) {
    ORO_TRY(Buffer buffer,
            create_buffer(gpu, values.size_bytes(),
                          VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT,
                          MemoryKind::mapped_device, name));
    std::memcpy(buffer.mapped, values.data(), values.size_bytes());
    return buffer;
}

}  // namespace

bool MadePageHeights::can_run(const Gpu& gpu) {
    return PlanPass::can_run(gpu);
}

bool MadePageHeights::is_wanted(const Gpu& gpu, HeightMaker maker, const HeightQuantization& coding) {
    const bool wanted = maker == HeightMaker::gpu ||
                        (maker == HeightMaker::fastest && gpu.report().kind != VK_PHYSICAL_DEVICE_TYPE_CPU);
    return wanted && !coding.packed && can_run(gpu);
}

Result<std::shared_ptr<const MadePageHeights>> MadePageHeights::create(const Gpu& gpu,
                                                                       const MadeGround& ground,
                                                                       const UndulationField& undulation,
                                                                       double exaggeration,
                                                                       const HeightQuantization& coding) {
    MadePageHeights made;
    made.work_.exaggeration = exaggeration;
    made.work_.words = coding.sixteen ? (gpu::page_heights + 1) / 2 : gpu::page_heights;
    made.work_.sixteen = coding.sixteen ? 1 : 0;
    made.work_.code_shift = static_cast<std::uint32_t>(coding.shift);
    made.work_.code_offset = coding.offset_steps;
    ORO_CHECK(made.create_program(gpu));
    ORO_CHECK(made.send(gpu, ground, undulation));
    return std::make_shared<const MadePageHeights>(std::move(made));
}

Result<void> MadePageHeights::create_program(const Gpu& gpu) {
    ORO_TRY(layout_, create_push_layout(gpu, VK_SHADER_STAGE_COMPUTE_BIT, work_bytes, "heights of pages"));
    ORO_TRY(program_, create_plain_compute(gpu, layout_.get(), page_heights_comp_spirv, "heights of pages"));
    return {};
}

Result<void> MadePageHeights::send(const Gpu& gpu, const MadeGround& ground,
                                   const UndulationField& undulation) {
    ORO_TRY(rule_, on_device(gpu, std::span(&ground.rule, 1), "rule of made pages"));
    work_.rule = rule_.address;
    work_.N_row = -1;
    if (undulation.N_m.empty()) return {};
    ORO_TRY(N_m_, on_device(gpu, std::span(undulation.N_m), "N of made pages"));
    work_.N_m = N_m_.address;
    work_.N_stride = undulation.lon.count;
    work_.N_row = undulation.lat.count > 1 ? undulation.lon.count : 0;
    work_.N_column = undulation.lon.count > 1 ? 1 : 0;
    return {};
}

void MadePageHeights::record(VkCommandBuffer commands, VkDeviceAddress source,
                             VkDeviceAddress heights) const {
    static_assert(offsetof(Work, code_offset) + sizeof(std::int32_t) == work_bytes);
    Work work = work_;
    work.source = source;
    work.heights = heights;
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, program_.get());
    vkCmdPushConstants(commands, layout_.get(), VK_SHADER_STAGE_COMPUTE_BIT, 0, work_bytes, &work);
    vkCmdDispatch(commands, (work.words + words_a_group - 1) / words_a_group, 1, 1);
}

}  // namespace oro
