#include "render/patches/patch_pipelines.h"

#include <array>
#include <span>

#include "render/pipelines/id_raster_state.h"
#include "render/pipelines/pipeline_parts.h"
#include "spirv/choose_patches_comp.h"
#include "spirv/patch_by_vertex_mesh.h"
#include "spirv/patch_frag.h"
#include "spirv/patch_mesh.h"
#include "spirv/patch_raster_comp.h"

namespace oro {
namespace {

Result<OwnedPipeline> create_patch_mesh(const Gpu& gpu, VkPipelineLayout layout,
                                        std::span<const std::uint32_t> words) {
    ORO_TRY(const OwnedShader mesh, create_shader(gpu, words, "patch.mesh"));
    ORO_TRY(const OwnedShader fragment, create_shader(gpu, patch_frag_spirv, "patch.frag"));
    const std::array stages{stage(VK_SHADER_STAGE_MESH_BIT_EXT, mesh, nullptr),
                            stage(VK_SHADER_STAGE_FRAGMENT_BIT, fragment, nullptr)};
    const IdRasterState state(false);
    VkGraphicsPipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO;
    info.stageCount = static_cast<std::uint32_t>(stages.size());
    info.pStages = stages.data();
    state.put_into(info);
    info.layout = layout;
    VkPipeline handle{};
    ORO_VK(vkCreateGraphicsPipelines(gpu.device(), VK_NULL_HANDLE, 1, &info, nullptr, &handle));
    gpu.name(VK_OBJECT_TYPE_PIPELINE, handle, "patch.mesh");
    return OwnedPipeline(gpu.device(), handle);
}

}  // namespace

Result<OwnedPipeline> create_patch_choice(const Gpu& gpu, VkPipelineLayout layout) {
    return create_plain_compute(gpu, layout, choose_patches_comp_spirv, "choose_patches.comp");
}

Result<OwnedPipeline> create_patch_pipeline(const Gpu& gpu, VkPipelineLayout layout, PatchWay way) {
    if (way == PatchWay::compute)
        return create_plain_compute(gpu, layout, patch_raster_comp_spirv, "patch_raster.comp");
    if (way == PatchWay::mesh) return create_patch_mesh(gpu, layout, patch_mesh_spirv);
    return create_patch_mesh(gpu, layout, patch_by_vertex_mesh_spirv);
}

}  // namespace oro
