#include "render/pipelines.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <span>

#include "shaders/shared.h"
#include "spirv/cull_comp.h"
#include "spirv/raster_clip_comp.h"
#include "spirv/raster_comp.h"
#include "spirv/raster_large_comp.h"
#include "spirv/shade_comp.h"
#include "spirv/terrain_frag.h"
#include "spirv/terrain_mesh.h"
#include "spirv/terrain_task.h"

namespace oro {
namespace {

Result<OwnedShader> create_shader(const Gpu& gpu, std::span<const std::uint32_t> words, const char* name) {
    VkShaderModuleCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
    info.codeSize = words.size_bytes();
    info.pCode = words.data();
    VkShaderModule handle{};
    ORO_VK(vkCreateShaderModule(gpu.device(), &info, nullptr, &handle));
    gpu.name(VK_OBJECT_TYPE_SHADER_MODULE, handle, name);
    return OwnedShader(gpu.device(), handle);
}

Result<void> create_layouts(const Gpu& gpu, Pipelines& pipelines) {
    std::array<VkDescriptorSetLayoutBinding, 3> bindings{};
    for (std::uint32_t i = 0; i < bindings.size(); ++i) {
        bindings[i].binding = i;
        bindings[i].descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
        bindings[i].descriptorCount = 1;
        bindings[i].stageFlags = VK_SHADER_STAGE_COMPUTE_BIT;
    }
    VkDescriptorSetLayoutCreateInfo set{};
    set.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
    set.bindingCount = static_cast<std::uint32_t>(bindings.size());
    set.pBindings = bindings.data();
    VkDescriptorSetLayout set_handle{};
    ORO_VK(vkCreateDescriptorSetLayout(gpu.device(), &set, nullptr, &set_handle));
    pipelines.image_set = OwnedSetLayout(gpu.device(), set_handle);
    gpu.name(VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT, set_handle, "shading images");

    VkPushConstantRange push{};
    push.stageFlags = pipelines.push_stages;
    push.size = sizeof(PushBlock);
    VkPipelineLayoutCreateInfo layout{};
    layout.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    layout.setLayoutCount = 1;
    layout.pSetLayouts = &set_handle;
    layout.pushConstantRangeCount = 1;
    layout.pPushConstantRanges = &push;
    VkPipelineLayout handle{};
    ORO_VK(vkCreatePipelineLayout(gpu.device(), &layout, nullptr, &handle));
    pipelines.layout = OwnedPipelineLayout(gpu.device(), handle);
    gpu.name(VK_OBJECT_TYPE_PIPELINE_LAYOUT, handle, "frame");
    return {};
}

VkPipelineShaderStageCreateInfo stage(VkShaderStageFlagBits bit, const OwnedShader& shader,
                                      const VkSpecializationInfo* constants) {
    VkPipelineShaderStageCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage = bit;
    info.module = shader.get();
    info.pName = "main";
    info.pSpecializationInfo = constants;
    return info;
}

// constant_id 0: local size; constant_id 1: record_positions.
struct StageConstants {
    std::uint32_t local_size;
    VkBool32 record_positions;
};
constexpr std::array<VkSpecializationMapEntry, 2> stage_constants_map{
    VkSpecializationMapEntry{0, offsetof(StageConstants, local_size), sizeof(std::uint32_t)},
    VkSpecializationMapEntry{1, offsetof(StageConstants, record_positions), sizeof(VkBool32)}};

Result<OwnedPipeline> create_terrain_pipeline(const Gpu& gpu, const Pipelines& pipelines,
                                              StageConstants task_constants, StageConstants mesh_constants) {
    ORO_TRY(const OwnedShader task, create_shader(gpu, terrain_task_spirv, "terrain.task"));
    ORO_TRY(const OwnedShader mesh, create_shader(gpu, terrain_mesh_spirv, "terrain.mesh"));
    ORO_TRY(const OwnedShader fragment, create_shader(gpu, terrain_frag_spirv, "terrain.frag"));
    const VkSpecializationInfo task_info{1, stage_constants_map.data(), sizeof(task_constants),
                                         &task_constants};
    const VkSpecializationInfo mesh_info{2, stage_constants_map.data(), sizeof(mesh_constants),
                                         &mesh_constants};
    const std::array stages{stage(VK_SHADER_STAGE_TASK_BIT_EXT, task, &task_info),
                            stage(VK_SHADER_STAGE_MESH_BIT_EXT, mesh, &mesh_info),
                            stage(VK_SHADER_STAGE_FRAGMENT_BIT, fragment, nullptr)};
    VkPipelineViewportStateCreateInfo viewport{};
    viewport.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO;
    viewport.viewportCount = viewport.scissorCount = 1;
    VkPipelineRasterizationStateCreateInfo raster{};
    raster.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO;
    raster.cullMode = VK_CULL_MODE_NONE;  // seen from below, the ground still hides what is behind it
    raster.lineWidth = 1.0F;
    VkPipelineMultisampleStateCreateInfo samples{};
    samples.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO;
    samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
    VkPipelineDepthStencilStateCreateInfo depth{};
    depth.sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO;
    depth.depthTestEnable = depth.depthWriteEnable = VK_TRUE;
    depth.depthCompareOp = VK_COMPARE_OP_GREATER;
    VkPipelineColorBlendAttachmentState attachment{};
    attachment.colorWriteMask = VK_COLOR_COMPONENT_R_BIT;
    VkPipelineColorBlendStateCreateInfo blend{};
    blend.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO;
    blend.attachmentCount = 1;
    blend.pAttachments = &attachment;
    constexpr std::array dynamic{VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
    VkPipelineDynamicStateCreateInfo dynamics{};
    dynamics.sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO;
    dynamics.dynamicStateCount = static_cast<std::uint32_t>(dynamic.size());
    dynamics.pDynamicStates = dynamic.data();
    VkPipelineRenderingCreateInfo rendering{};
    rendering.sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO;
    rendering.colorAttachmentCount = 1;
    rendering.pColorAttachmentFormats = &id_format;
    rendering.depthAttachmentFormat = depth_format;

    VkGraphicsPipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO;
    info.pNext = &rendering;
    info.stageCount = static_cast<std::uint32_t>(stages.size());
    info.pStages = stages.data();
    info.pViewportState = &viewport;
    info.pRasterizationState = &raster;
    info.pMultisampleState = &samples;
    info.pDepthStencilState = &depth;
    info.pColorBlendState = &blend;
    info.pDynamicState = &dynamics;
    info.layout = pipelines.layout.get();
    VkPipeline handle{};
    ORO_VK(vkCreateGraphicsPipelines(gpu.device(), VK_NULL_HANDLE, 1, &info, nullptr, &handle));
    gpu.name(VK_OBJECT_TYPE_PIPELINE, handle, "terrain");
    return OwnedPipeline(gpu.device(), handle);
}

Result<OwnedPipeline> create_compute_pipeline(const Gpu& gpu, const Pipelines& pipelines,
                                              std::span<const std::uint32_t> words, const char* name,
                                              const VkSpecializationInfo* constants = nullptr) {
    ORO_TRY(const OwnedShader shader, create_shader(gpu, words, name));
    VkComputePipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
    info.stage = stage(VK_SHADER_STAGE_COMPUTE_BIT, shader, constants);
    info.layout = pipelines.layout.get();
    VkPipeline handle{};
    ORO_VK(vkCreateComputePipelines(gpu.device(), VK_NULL_HANDLE, 1, &info, nullptr, &handle));
    gpu.name(VK_OBJECT_TYPE_PIPELINE, handle, name);
    return OwnedPipeline(gpu.device(), handle);
}

Result<void> create_mesh_path(const Gpu& gpu, bool record_positions, Pipelines& pipelines) {
    const MeshShaderLimits& limits = gpu.report().mesh;
    // A power of two that divides the meshlets of a page.
    pipelines.meshlets_per_task =
        std::bit_floor(std::clamp(std::min(limits.preferred_task_invocations, limits.max_task_invocations),
                                  1U, gpu::meshlets_per_task_max));
    const std::uint32_t mesh_size =
        std::clamp(std::min(limits.preferred_mesh_invocations, limits.max_mesh_invocations), 1U, 128U);
    const VkBool32 recording = record_positions ? VK_TRUE : VK_FALSE;
    ORO_TRY(pipelines.terrain,
            create_terrain_pipeline(gpu, pipelines, {pipelines.meshlets_per_task, recording},
                                    {mesh_size, recording}));
    return {};
}

Result<void> create_compute_path(const Gpu& gpu, Pipelines& pipelines) {
    ORO_TRY(pipelines.cull, create_compute_pipeline(gpu, pipelines, cull_comp_spirv, "cull"));
    ORO_TRY(pipelines.raster, create_compute_pipeline(gpu, pipelines, raster_comp_spirv, "raster"));
    ORO_TRY(pipelines.raster_clip,
            create_compute_pipeline(gpu, pipelines, raster_clip_comp_spirv, "raster clip"));
    ORO_TRY(pipelines.raster_large,
            create_compute_pipeline(gpu, pipelines, raster_large_comp_spirv, "raster large"));
    return {};
}

}  // namespace

Result<Pipelines> create_pipelines(const Gpu& gpu, RasterPath path, bool record_positions) {
    const bool by_mesh = path == RasterPath::mesh;
    Pipelines pipelines;
    pipelines.push_stages = VK_SHADER_STAGE_COMPUTE_BIT;
    if (by_mesh) pipelines.push_stages |= VK_SHADER_STAGE_TASK_BIT_EXT | VK_SHADER_STAGE_MESH_BIT_EXT;
    ORO_CHECK(create_layouts(gpu, pipelines));
    ORO_CHECK(by_mesh ? create_mesh_path(gpu, record_positions, pipelines)
                      : create_compute_path(gpu, pipelines));
    const VkBool32 from_compute = by_mesh ? VK_FALSE : VK_TRUE;
    const VkSpecializationMapEntry entry{0, 0, sizeof(from_compute)};
    const VkSpecializationInfo constants{1, &entry, sizeof(from_compute), &from_compute};
    ORO_TRY(pipelines.shade, create_compute_pipeline(gpu, pipelines, shade_comp_spirv, "shade", &constants));
    return pipelines;
}

}  // namespace oro
