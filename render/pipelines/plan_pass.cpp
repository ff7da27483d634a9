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
    const VkPushConstantRange terms{VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(gpu::uvec2)};
    VkPipelineLayoutCreateInfo layout{};
    layout.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    layout.pushConstantRangeCount = 1;
    layout.pPushConstantRanges = &terms;
    VkPipelineLayout layout_handle{};
    ORO_VK(vkCreatePipelineLayout(gpu.device(), &layout, nullptr, &layout_handle));
    pass.layout_ = OwnedPipelineLayout(gpu.device(), layout_handle);
    gpu.name(VK_OBJECT_TYPE_PIPELINE_LAYOUT, layout_handle, "plan");
    ORO_TRY(const OwnedShader shader, create_shader(gpu, plan_terms_comp_spirv, "terms of a plan"));
    VkComputePipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
    info.stage = stage(VK_SHADER_STAGE_COMPUTE_BIT, shader, nullptr);
    info.layout = layout_handle;
    VkPipeline handle{};
    ORO_VK(vkCreateComputePipelines(gpu.device(), VK_NULL_HANDLE, 1, &info, nullptr, &handle));
    pass.pipeline_ = OwnedPipeline(gpu.device(), handle);
    gpu.name(VK_OBJECT_TYPE_PIPELINE, handle, "terms of a plan");
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
