#include "render/pipelines/pipeline_parts.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <span>

#include "render/pipelines/id_raster_state.h"
#include "shaders/shared.h"
#include "spirv/cluster_mesh.h"
#include "spirv/terrain_count_frag.h"
#include "spirv/terrain_frag.h"
#include "spirv/terrain_mesh.h"
#include "spirv/terrain_mesh_halves.h"
#include "spirv/terrain_mesh_two.h"
#include "spirv/terrain_task.h"
#include "spirv/terrain_task_halves.h"
#include "spirv/terrain_ties_frag.h"

namespace oro {
namespace {

// By constant_id: local size; record_positions; parts_per_group; leave_out_small.
struct StageConstants {
    std::uint32_t local_size;
    VkBool32 record_positions;
    std::uint32_t parts_per_group;
    std::uint32_t leave_out_small;
};
constexpr std::array<VkSpecializationMapEntry, 4> stage_constants_map{
    VkSpecializationMapEntry{0, offsetof(StageConstants, local_size), sizeof(std::uint32_t)},
    VkSpecializationMapEntry{1, offsetof(StageConstants, record_positions), sizeof(VkBool32)},
    VkSpecializationMapEntry{2, offsetof(StageConstants, parts_per_group), sizeof(std::uint32_t)},
    VkSpecializationMapEntry{3, offsetof(StageConstants, leave_out_small), sizeof(std::uint32_t)}};

// Draws ids and depth by some shaders.
Result<OwnedPipeline> create_raster_pipeline(const Gpu& gpu, const Pipelines& pipelines,
                                             std::span<const VkPipelineShaderStageCreateInfo> stages,
                                             bool ties, const char* name) {
    const IdRasterState state(ties);
    VkGraphicsPipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO;
    info.stageCount = static_cast<std::uint32_t>(stages.size());
    info.pStages = stages.data();
    state.put_into(info);
    info.layout = pipelines.layout.get();
    VkPipeline handle{};
    ORO_VK(vkCreateGraphicsPipelines(gpu.device(), VK_NULL_HANDLE, 1, &info, nullptr, &handle));
    gpu.name(VK_OBJECT_TYPE_PIPELINE, handle, name);
    return OwnedPipeline(gpu.device(), handle);
}

// What the terrain's pipelines are made of besides their fragment shaders.
struct TerrainStages {
    std::span<const std::uint32_t> task_words, mesh_words;
    StageConstants task, mesh;
    bool whole_subgroups{};  // mesh workgroups vote (shaders/raster/slots.glsl)
};

Result<OwnedPipeline> create_terrain_pipeline(const Gpu& gpu, const Pipelines& pipelines,
                                              const TerrainStages& of, bool ties, bool overdraw) {
    ORO_TRY(const OwnedShader task, create_shader(gpu, of.task_words, "terrain.task"));
    ORO_TRY(const OwnedShader mesh, create_shader(gpu, of.mesh_words, "terrain.mesh"));
    const std::span<const std::uint32_t> fragment_words =
        ties       ? std::span<const std::uint32_t>(terrain_ties_frag_spirv)
        : overdraw ? std::span<const std::uint32_t>(terrain_count_frag_spirv)
                   : std::span<const std::uint32_t>(terrain_frag_spirv);
    ORO_TRY(const OwnedShader fragment,
            create_shader(gpu, fragment_words, ties ? "terrain_ties.frag" : "terrain.frag"));
    const VkSpecializationInfo task_info{3, stage_constants_map.data(), sizeof(of.task), &of.task};
    const VkSpecializationInfo mesh_info{4, stage_constants_map.data(), sizeof(of.mesh), &of.mesh};
    const AllConstants mesh_all(&mesh_info, pipelines);
    std::array stages{stage(VK_SHADER_STAGE_TASK_BIT_EXT, task, &task_info),
                      stage(VK_SHADER_STAGE_MESH_BIT_EXT, mesh, mesh_all.info()),
                      stage(VK_SHADER_STAGE_FRAGMENT_BIT, fragment, nullptr)};
    if (of.whole_subgroups) stages[1].flags = VK_PIPELINE_SHADER_STAGE_CREATE_REQUIRE_FULL_SUBGROUPS_BIT;
    return create_raster_pipeline(gpu, pipelines, stages, ties, ties ? "terrain ties" : "terrain");
}

std::uint32_t mesh_group_size(const Gpu& gpu) {
    const MeshShaderLimits& limits = gpu.report().mesh;
    return std::clamp(std::min(limits.preferred_mesh_invocations, limits.max_mesh_invocations), 1U, 128U);
}

// Workgroups of whole meshlets, as large as the device prefers.
TerrainStages stages_of_meshlets(const Gpu& gpu) {
    const MeshShaderLimits& limits = gpu.report().mesh;
    // Two meshlets where a workgroup has room for them and is as large as one of them has triangles: a small
    // one has its lanes busy with one (measured on an H200, whose groups are of 32: 8.4 M triangles in 8.3 ms
    // one by one, 10.2 ms by twos).
    const bool two = limits.max_output_vertices >= 2 * gpu::meshlet_vertices &&
                     limits.max_output_primitives >= 2 * gpu::meshlet_triangles &&
                     limits.preferred_mesh_invocations >= gpu::meshlet_triangles;
    TerrainStages of{.task_words = terrain_task_spirv,
                     .mesh_words = terrain_mesh_spirv,
                     .task = {},
                     .mesh = {},
                     .whole_subgroups = false};
    if (two) of.mesh_words = terrain_mesh_two_spirv;
    of.mesh.local_size = mesh_group_size(gpu);
    of.mesh.parts_per_group = two ? 2 : 1;
    return of;
}

// Workgroups of half a meshlet and one subgroup each. Measured on an H100 and an H200, whose subgroups have
// 32: of 64 invocations they take more than whole meshlets (docs/notes, half-a-meshlet).
TerrainStages stages_of_halves(const Gpu& gpu) {
    TerrainStages of{.task_words = terrain_task_halves_spirv,
                     .mesh_words = terrain_mesh_halves_spirv,
                     .task = {},
                     .mesh = {},
                     .whole_subgroups = true};
    of.mesh.local_size = gpu.report().subgroup_size;
    of.mesh.parts_per_group = 1;
    return of;
}

}  // namespace

Result<void> add_mesh_pipelines(const Gpu& gpu, const PipelineWants& wants, Pipelines& pipelines) {
    const MeshShaderLimits& limits = gpu.report().mesh;
    const bool halves = meshlet_split_for(wants.split, gpu.report()) == MeshletSplit::halves;
    TerrainStages of = halves ? stages_of_halves(gpu) : stages_of_meshlets(gpu);
    // A power of two that divides the meshlets of a page. A payload holds so many parts of them.
    pipelines.meshlets_per_task =
        std::bit_floor(std::clamp(std::min(limits.preferred_task_invocations, limits.max_task_invocations),
                                  8U, gpu::parts_per_task_max / (halves ? 2 : 1)));
    of.mesh.record_positions = wants.record_positions ? VK_TRUE : VK_FALSE;
    of.mesh.leave_out_small = wants.leave_out_small ? 1 : 0;
    of.task = of.mesh;
    of.task.local_size = pipelines.meshlets_per_task;
    ORO_TRY(pipelines.terrain, create_terrain_pipeline(gpu, pipelines, of, false, wants.overdraw));
    ORO_TRY(pipelines.terrain_ties, create_terrain_pipeline(gpu, pipelines, of, true, false));
    return {};
}

Result<OwnedPipeline> create_cluster_terrain(const Gpu& gpu, const Pipelines& pipelines, bool ties) {
    ORO_TRY(const OwnedShader mesh, create_shader(gpu, cluster_mesh_spirv, "cluster.mesh"));
    const std::span<const std::uint32_t> fragment_words =
        ties ? std::span<const std::uint32_t>(terrain_ties_frag_spirv)
             : std::span<const std::uint32_t>(terrain_frag_spirv);
    ORO_TRY(const OwnedShader fragment,
            create_shader(gpu, fragment_words, ties ? "terrain_ties.frag" : "terrain.frag"));
    const std::uint32_t size = mesh_group_size(gpu);
    const VkSpecializationMapEntry entry{0, 0, sizeof(size)};
    const VkSpecializationInfo constants{1, &entry, sizeof(size), &size};
    const std::array stages{stage(VK_SHADER_STAGE_MESH_BIT_EXT, mesh, &constants),
                            stage(VK_SHADER_STAGE_FRAGMENT_BIT, fragment, nullptr)};
    return create_raster_pipeline(gpu, pipelines, stages, ties, ties ? "cluster ties" : "clusters");
}

}  // namespace oro
