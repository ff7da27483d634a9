#include "render/pipelines/plan_pass.h"

#include "render/pipelines/pipeline_parts.h"
#include "spirv/plan_terms_comp.h"

namespace oro {

bool PlanPass::can_run(const Gpu& gpu) {
    VkPhysicalDeviceFeatures features{};
    vkGetPhysicalDeviceFeatures(gpu.physical(), &features);
    return features.shaderFloat64 == VK_TRUE;
}

Result<PlanPass> PlanPass::create(const Gpu& gpu) {
    PlanPass pass;
    ORO_TRY(pass.layout_, create_push_layout(gpu, VK_SHADER_STAGE_COMPUTE_BIT, sizeof(gpu::uvec2), "plan"));
    ORO_TRY(pass.pipeline_,
            create_plain_compute(gpu, pass.layout_.get(), plan_terms_comp_spirv, "terms of a plan"));
    return pass;
}

void PlanPass::record(VkCommandBuffer commands, const DevicePlan& plan, VkDeviceAddress terms_address) const {
    const gpu::PlanTerms& terms = plan.terms;
    const gpu::uint groups = terms.row_count + terms.column_count +
                             (terms.page_count + gpu::plan_pages_per_group - 1) / gpu::plan_pages_per_group;
    if (groups == 0) return;
    const gpu::uvec2 words = address_words(terms_address);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_.get());
    vkCmdPushConstants(commands, layout_.get(), VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(words), &words);
    vkCmdDispatch(commands, groups, 1, 1);
}

void PlanPass::record_end(VkCommandBuffer commands) {
    memory_barrier(commands, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                   VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                   VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT);
}

}  // namespace oro
