#include "render/grass/grass_pipelines.h"

#include <span>
#include <vector>

#include "render/pipelines/id_raster_state.h"
#include "render/pipelines/pipeline_parts.h"
#include "spirv/clumps_mesh.h"
#include "spirv/clumps_task.h"
#include "spirv/cull_clumps_comp.h"
#include "spirv/grass_frag.h"
#include "spirv/grass_primitive_frag.h"
#include "spirv/grass_raster_comp.h"
#include "spirv/grass_vert.h"
#include "spirv/packed_mesh.h"
#include "spirv/packed_task.h"
#include "spirv/place_clumps_comp.h"

namespace oro {
namespace {

using ShaderWords = std::span<const std::uint32_t>;

struct GrassStage {
    VkShaderStageFlagBits bit;
    ShaderWords words;
    const char* name;
};

// Stages in order; those that begin with vertices draw strips of them, without any that are fed.
Result<OwnedPipeline> create_grass_graphics(const Gpu& gpu, VkPipelineLayout layout,
                                            std::span<const GrassStage> of) {
    std::vector<OwnedShader> shaders;
    std::vector<VkPipelineShaderStageCreateInfo> stages;
    for (const GrassStage& one : of) {
        ORO_TRY(OwnedShader shader, create_shader(gpu, one.words, one.name));
        shaders.push_back(std::move(shader));
        stages.push_back(stage(one.bit, shaders.back(), nullptr));
    }
    const IdRasterState state(false);
    VkPipelineVertexInputStateCreateInfo fed{};
    fed.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO;
    VkPipelineInputAssemblyStateCreateInfo assembly{};
    assembly.sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO;
    assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP;
    VkGraphicsPipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO;
    info.stageCount = static_cast<std::uint32_t>(stages.size());
    info.pStages = stages.data();
    state.put_into(info);
    if (of[0].bit == VK_SHADER_STAGE_VERTEX_BIT) {
        info.pVertexInputState = &fed;
        info.pInputAssemblyState = &assembly;
    }
    info.layout = layout;
    VkPipeline handle{};
    ORO_VK(vkCreateGraphicsPipelines(gpu.device(), VK_NULL_HANDLE, 1, &info, nullptr, &handle));
    gpu.name(VK_OBJECT_TYPE_PIPELINE, handle, of[0].name);
    return OwnedPipeline(gpu.device(), handle);
}

}  // namespace

Result<OwnedPipeline> create_clump_placer(const Gpu& gpu, VkPipelineLayout layout) {
    return create_plain_compute(gpu, layout, place_clumps_comp_spirv, "place_clumps.comp");
}

Result<OwnedPipeline> create_clump_cull(const Gpu& gpu, VkPipelineLayout layout) {
    return create_plain_compute(gpu, layout, cull_clumps_comp_spirv, "cull_clumps.comp");
}

Result<OwnedPipeline> create_grass_pipeline(const Gpu& gpu, VkPipelineLayout layout, GrassWay way) {
    if (way == GrassWay::compute)
        return create_plain_compute(gpu, layout, grass_raster_comp_spirv, "grass_raster.comp");
    std::vector<GrassStage> stages;
    if (way == GrassWay::vertex) {
        stages = {{VK_SHADER_STAGE_VERTEX_BIT, grass_vert_spirv, "grass.vert"},
                  {VK_SHADER_STAGE_FRAGMENT_BIT, grass_frag_spirv, "grass.frag"}};
    } else if (way == GrassWay::clumps) {
        stages = {{VK_SHADER_STAGE_TASK_BIT_EXT, clumps_task_spirv, "clumps.task"},
                  {VK_SHADER_STAGE_MESH_BIT_EXT, clumps_mesh_spirv, "clumps.mesh"},
                  {VK_SHADER_STAGE_FRAGMENT_BIT, grass_primitive_frag_spirv, "grass.frag"}};
    } else {
        stages = {{VK_SHADER_STAGE_TASK_BIT_EXT, packed_task_spirv, "packed.task"},
                  {VK_SHADER_STAGE_MESH_BIT_EXT, packed_mesh_spirv, "packed.mesh"},
                  {VK_SHADER_STAGE_FRAGMENT_BIT, grass_primitive_frag_spirv, "grass.frag"}};
    }
    return create_grass_graphics(gpu, layout, stages);
}

}  // namespace oro
