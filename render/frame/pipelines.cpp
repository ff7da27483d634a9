#include "render/frame/pipelines.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "render/raster/raster_pipelines.h"
#include "shaders/shared.h"
#include "spirv/accept_comp.h"
#include "spirv/choose_clusters_comp.h"
#include "spirv/cluster_mesh.h"
#include "spirv/cull_comp.h"
#include "spirv/live_pages_comp.h"
#include "spirv/pyramid_comp.h"
#include "spirv/pyramid_images_comp.h"
#include "spirv/show_comp.h"
#include "spirv/terrain_count_frag.h"
#include "spirv/terrain_frag.h"
#include "spirv/terrain_mesh.h"
#include "spirv/terrain_mesh_two.h"
#include "spirv/terrain_task.h"
#include "spirv/terrain_ties_frag.h"
#include "spirv/triangles_clusters_comp.h"
#include "spirv/triangles_comp.h"
#include "spirv/uncover_comp.h"

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

// A program's own constants, and those that many programs have: all that read heights
// (shaders/place/heights.glsl), and all that list triangles (shaders/choose/lists.glsl).
class AllConstants {
  public:
    AllConstants(const VkSpecializationInfo* own, const Pipelines& pipelines) {
        if (own != nullptr) {
            entries_.assign(own->pMapEntries, own->pMapEntries + own->mapEntryCount);
            const auto* const values = static_cast<const std::byte*>(own->pData);
            values_.assign(values, values + own->dataSize);
        }
        constexpr std::uint32_t heights_packed = 100;
        const ListRoom& room = pipelines.list_room;
        const std::array<std::uint32_t, 5> common{pipelines.packed_heights ? VK_TRUE : VK_FALSE, room.boxes,
                                                  room.large, room.tasks, room.clips};
        for (std::uint32_t id = heights_packed; const std::uint32_t& value : common) {
            entries_.push_back({id++, static_cast<std::uint32_t>(values_.size()), sizeof(value)});
            const auto* const bytes = reinterpret_cast<const std::byte*>(&value);
            values_.insert(values_.end(), bytes, bytes + sizeof(value));
        }
        info_ = {static_cast<std::uint32_t>(entries_.size()), entries_.data(), values_.size(),
                 values_.data()};
    }
    AllConstants(const AllConstants&) = delete;
    AllConstants& operator=(const AllConstants&) = delete;
    [[nodiscard]] const VkSpecializationInfo* info() const { return &info_; }

  private:
    std::vector<VkSpecializationMapEntry> entries_;
    std::vector<std::byte> values_;
    VkSpecializationInfo info_{};
};

Result<void> create_layouts(const Gpu& gpu, RasterPath path, Pipelines& pipelines) {
    std::array<VkDescriptorSetLayoutBinding, 5> bindings{};
    for (std::uint32_t i = 0; i < bindings.size(); ++i) {
        bindings[i].binding = i;
        bindings[i].descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
        bindings[i].descriptorCount = 1;
        bindings[i].stageFlags = VK_SHADER_STAGE_COMPUTE_BIT;
    }
    bindings[3].descriptorType = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
    bindings[4].binding = depth_binding;
    bindings[4].descriptorType = VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE;
    pipelines.round_stages = VK_SHADER_STAGE_COMPUTE_BIT;
    if (path == RasterPath::mesh) {
        bindings[3].stageFlags |=
            VK_SHADER_STAGE_TASK_BIT_EXT | VK_SHADER_STAGE_MESH_BIT_EXT | VK_SHADER_STAGE_FRAGMENT_BIT;
        pipelines.round_stages |= VK_SHADER_STAGE_TASK_BIT_EXT | VK_SHADER_STAGE_MESH_BIT_EXT;
    }
    VkDescriptorSetLayoutCreateInfo set{};
    set.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
    set.bindingCount = static_cast<std::uint32_t>(bindings.size());
    set.pBindings = bindings.data();
    VkDescriptorSetLayout set_handle{};
    ORO_VK(vkCreateDescriptorSetLayout(gpu.device(), &set, nullptr, &set_handle));
    pipelines.set = OwnedSetLayout(gpu.device(), set_handle);
    gpu.name(VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT, set_handle, "frame");

    VkPipelineLayoutCreateInfo layout{};
    layout.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    layout.setLayoutCount = 1;
    layout.pSetLayouts = &set_handle;
    const VkPushConstantRange round{pipelines.round_stages, 0, sizeof(gpu::FrameRound)};
    layout.pushConstantRangeCount = 1;
    layout.pPushConstantRanges = &round;
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

// By constant_id: local size; record_positions; meshlets_per_group; leave_out_small.
struct StageConstants {
    std::uint32_t local_size;
    VkBool32 record_positions;
    std::uint32_t meshlets_per_group;
    std::uint32_t leave_out_small;
};
constexpr std::array<VkSpecializationMapEntry, 4> stage_constants_map{
    VkSpecializationMapEntry{0, offsetof(StageConstants, local_size), sizeof(std::uint32_t)},
    VkSpecializationMapEntry{1, offsetof(StageConstants, record_positions), sizeof(VkBool32)},
    VkSpecializationMapEntry{2, offsetof(StageConstants, meshlets_per_group), sizeof(std::uint32_t)},
    VkSpecializationMapEntry{3, offsetof(StageConstants, leave_out_small), sizeof(std::uint32_t)}};

// What of the terrain's pipeline is no shader: ids and reversed depth, nothing blended, nothing culled. Its
// parts point at each other, so it stays where it is.
class TerrainState {
  public:
    // ties: only what is as near as what is there.
    explicit TerrainState(bool ties) {
        viewport_.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO;
        viewport_.viewportCount = viewport_.scissorCount = 1;
        raster_.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO;
        raster_.cullMode = VK_CULL_MODE_NONE;  // seen from below, the ground still hides what is behind it
        raster_.lineWidth = 1.0F;
        samples_.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO;
        samples_.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
        depth_.sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO;
        depth_.depthTestEnable = VK_TRUE;
        depth_.depthWriteEnable = ties ? VK_FALSE : VK_TRUE;
        depth_.depthCompareOp = ties ? VK_COMPARE_OP_EQUAL : VK_COMPARE_OP_GREATER;
        attachment_.colorWriteMask = VK_COLOR_COMPONENT_R_BIT;
        blend_.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO;
        blend_.attachmentCount = 1;
        blend_.pAttachments = &attachment_;
        dynamics_.sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO;
        dynamics_.dynamicStateCount = static_cast<std::uint32_t>(dynamic.size());
        dynamics_.pDynamicStates = dynamic.data();
        rendering_.sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO;
        rendering_.colorAttachmentCount = 1;
        rendering_.pColorAttachmentFormats = &id_format;
        rendering_.depthAttachmentFormat = depth_format;
    }
    TerrainState(const TerrainState&) = delete;
    TerrainState& operator=(const TerrainState&) = delete;

    void put_into(VkGraphicsPipelineCreateInfo& info) const {
        info.pNext = &rendering_;
        info.pViewportState = &viewport_;
        info.pRasterizationState = &raster_;
        info.pMultisampleState = &samples_;
        info.pDepthStencilState = &depth_;
        info.pColorBlendState = &blend_;
        info.pDynamicState = &dynamics_;
    }

  private:
    static constexpr std::array dynamic{VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
    VkPipelineViewportStateCreateInfo viewport_{};
    VkPipelineRasterizationStateCreateInfo raster_{};
    VkPipelineMultisampleStateCreateInfo samples_{};
    VkPipelineDepthStencilStateCreateInfo depth_{};
    VkPipelineColorBlendAttachmentState attachment_{};
    VkPipelineColorBlendStateCreateInfo blend_{};
    VkPipelineDynamicStateCreateInfo dynamics_{};
    VkPipelineRenderingCreateInfo rendering_{};
};

// Draws ids and depth by some shaders.
Result<OwnedPipeline> create_raster_pipeline(const Gpu& gpu, const Pipelines& pipelines,
                                             std::span<const VkPipelineShaderStageCreateInfo> stages,
                                             bool ties, const char* name) {
    const TerrainState state(ties);
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

Result<OwnedPipeline> create_terrain_pipeline(const Gpu& gpu, const Pipelines& pipelines,
                                              StageConstants task_constants, StageConstants mesh_constants,
                                              bool ties, bool overdraw) {
    ORO_TRY(const OwnedShader task, create_shader(gpu, terrain_task_spirv, "terrain.task"));
    const std::span<const std::uint32_t> mesh_words =
        mesh_constants.meshlets_per_group == 2 ? std::span<const std::uint32_t>(terrain_mesh_two_spirv)
                                               : std::span<const std::uint32_t>(terrain_mesh_spirv);
    ORO_TRY(const OwnedShader mesh, create_shader(gpu, mesh_words, "terrain.mesh"));
    const std::span<const std::uint32_t> fragment_words =
        ties       ? std::span<const std::uint32_t>(terrain_ties_frag_spirv)
        : overdraw ? std::span<const std::uint32_t>(terrain_count_frag_spirv)
                   : std::span<const std::uint32_t>(terrain_frag_spirv);
    ORO_TRY(const OwnedShader fragment,
            create_shader(gpu, fragment_words, ties ? "terrain_ties.frag" : "terrain.frag"));
    const VkSpecializationInfo task_info{3, stage_constants_map.data(), sizeof(task_constants),
                                         &task_constants};
    const VkSpecializationInfo mesh_info{4, stage_constants_map.data(), sizeof(mesh_constants),
                                         &mesh_constants};
    const AllConstants mesh_all(&mesh_info, pipelines);
    const std::array stages{stage(VK_SHADER_STAGE_TASK_BIT_EXT, task, &task_info),
                            stage(VK_SHADER_STAGE_MESH_BIT_EXT, mesh, mesh_all.info()),
                            stage(VK_SHADER_STAGE_FRAGMENT_BIT, fragment, nullptr)};
    return create_raster_pipeline(gpu, pipelines, stages, ties, ties ? "terrain ties" : "terrain");
}

std::uint32_t mesh_group_size(const Gpu& gpu) {
    const MeshShaderLimits& limits = gpu.report().mesh;
    return std::clamp(std::min(limits.preferred_mesh_invocations, limits.max_mesh_invocations), 1U, 128U);
}

Result<void> create_mesh_path(const Gpu& gpu, const PipelineWants& wants, Pipelines& pipelines) {
    const MeshShaderLimits& limits = gpu.report().mesh;
    // A power of two that divides the meshlets of a page.
    pipelines.meshlets_per_task =
        std::bit_floor(std::clamp(std::min(limits.preferred_task_invocations, limits.max_task_invocations),
                                  8U, gpu::meshlets_per_task_max));
    // Two meshlets where a workgroup has room for them and is as large as one of them has triangles: a small
    // one has its lanes busy with one (measured on an H200, whose groups are of 32: 8.4 M triangles in 8.3 ms
    // one by one, 10.2 ms by twos).
    pipelines.meshlets_per_group = limits.max_output_vertices >= 2 * gpu::meshlet_vertices &&
                                           limits.max_output_primitives >= 2 * gpu::meshlet_triangles &&
                                           limits.preferred_mesh_invocations >= gpu::meshlet_triangles
                                       ? 2
                                       : 1;
    const std::uint32_t mesh_size = mesh_group_size(gpu);
    const VkBool32 recording = wants.record_positions ? VK_TRUE : VK_FALSE;
    const std::uint32_t together = pipelines.meshlets_per_group, small = wants.leave_out_small ? 1 : 0;
    const StageConstants task{pipelines.meshlets_per_task, recording, together, small};
    const StageConstants mesh{mesh_size, recording, together, small};
    ORO_TRY(pipelines.terrain, create_terrain_pipeline(gpu, pipelines, task, mesh, false, wants.overdraw));
    ORO_TRY(pipelines.terrain_ties, create_terrain_pipeline(gpu, pipelines, task, mesh, true, false));
    return {};
}

// What decides in each round what is drawn.
Result<void> create_rounds(const Gpu& gpu, RasterPath path, Pipelines& pipelines) {
    const bool compute = path == RasterPath::compute;
    const VkBool32 for_compute = compute ? VK_TRUE : VK_FALSE;
    const VkSpecializationMapEntry entry{0, 0, sizeof(for_compute)};
    const VkSpecializationInfo constants{1, &entry, sizeof(for_compute), &for_compute};
    ORO_TRY(pipelines.cull, create_compute_pipeline(gpu, pipelines, cull_comp_spirv, "cull", &constants));
    ORO_TRY(pipelines.uncover,
            create_compute_pipeline(gpu, pipelines, uncover_comp_spirv, "uncover", &constants));
    const std::span<const std::uint32_t> words =
        compute ? std::span<const std::uint32_t>(pyramid_comp_spirv)
                : std::span<const std::uint32_t>(pyramid_images_comp_spirv);
    ORO_TRY(pipelines.pyramid, create_compute_pipeline(gpu, pipelines, words, "depth pyramid"));
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

// By constant_id: 0 for_compute; 2 is_first (shaders/clusters/choose_clusters.comp).
Result<OwnedPipeline> create_choose_clusters(const Gpu& gpu, RasterPath path, bool first,
                                             const Pipelines& pipelines) {
    const std::array<VkBool32, 2> values{path == RasterPath::compute ? VK_TRUE : VK_FALSE,
                                         first ? VK_TRUE : VK_FALSE};
    const std::array entries{VkSpecializationMapEntry{0, 0, sizeof(VkBool32)},
                             VkSpecializationMapEntry{2, sizeof(VkBool32), sizeof(VkBool32)}};
    const VkSpecializationInfo constants{2, entries.data(), sizeof(values), values.data()};
    return create_compute_pipeline(gpu, pipelines, choose_clusters_comp_spirv,
                                   first ? "choose clusters" : "uncover clusters", &constants);
}

Result<void> create_choice(const Gpu& gpu, Pipelines& pipelines) {
    ORO_TRY(pipelines.accept, create_compute_pipeline(gpu, pipelines, accept_comp_spirv, "accept"));
    const std::uint32_t task_groups = gpu::meshlets_per_page / pipelines.meshlets_per_task;
    const VkSpecializationMapEntry entry{1, 0, sizeof(task_groups)};
    const VkSpecializationInfo constants{1, &entry, sizeof(task_groups), &task_groups};
    ORO_TRY(pipelines.live_pages,
            create_compute_pipeline(gpu, pipelines, live_pages_comp_spirv, "live pages", &constants));
    return {};
}

Result<Pipelines> create_pipelines(const Gpu& gpu, RasterPath path, const PipelineWants& wants) {
    Pipelines pipelines;
    pipelines.packed_heights = wants.packed_heights;
    pipelines.list_room = wants.list_room;
    ORO_CHECK(create_layouts(gpu, path, pipelines));
    ORO_CHECK(path == RasterPath::mesh ? create_mesh_path(gpu, wants, pipelines)
                                       : add_raster_pipelines(gpu, wants, pipelines));
    ORO_CHECK(create_choice(gpu, pipelines));
    ORO_CHECK(create_rounds(gpu, path, pipelines));
    return pipelines;
}

Result<OwnedPipeline> create_triangles(const Gpu& gpu, RasterPath path, std::span<const std::uint32_t> words,
                                       const Pipelines& pipelines) {
    const VkBool32 compute = path == RasterPath::compute ? VK_TRUE : VK_FALSE;
    const VkSpecializationMapEntry entry{0, 0, sizeof(compute)};
    const VkSpecializationInfo constants{1, &entry, sizeof(compute), &compute};
    return create_compute_pipeline(gpu, pipelines, words, "triangles", &constants,
                                   VK_PIPELINE_CREATE_DISPATCH_BASE_BIT);
}

}  // namespace

Result<void> add_cluster_pipelines(const Gpu& gpu, RasterPath path, bool triangles, Pipelines& pipelines) {
    if (!pipelines.choose_clusters) {
        ORO_TRY(pipelines.uncover_clusters, create_choose_clusters(gpu, path, false, pipelines));
        ORO_TRY(pipelines.choose_clusters, create_choose_clusters(gpu, path, true, pipelines));
    }
    if (path == RasterPath::mesh && !pipelines.cluster_terrain) {
        ORO_TRY(pipelines.cluster_ties, create_cluster_terrain(gpu, pipelines, true));
        ORO_TRY(pipelines.cluster_terrain, create_cluster_terrain(gpu, pipelines, false));
    }
    if (path == RasterPath::compute && !pipelines.cluster_raster)
        ORO_CHECK(add_cluster_raster(gpu, pipelines));
    if (triangles && !pipelines.cluster_triangles) {
        ORO_TRY(pipelines.cluster_triangles,
                create_triangles(gpu, path, triangles_clusters_comp_spirv, pipelines));
    }
    return {};
}

Result<OwnedPipeline> create_compute_pipeline(const Gpu& gpu, const Pipelines& pipelines,
                                              std::span<const std::uint32_t> words, const char* name,
                                              const VkSpecializationInfo* constants,
                                              VkPipelineCreateFlags flags) {
    ORO_TRY(const OwnedShader shader, create_shader(gpu, words, name));
    VkComputePipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
    info.flags = flags;
    const AllConstants all(constants, pipelines);
    info.stage = stage(VK_SHADER_STAGE_COMPUTE_BIT, shader, all.info());
    info.layout = pipelines.layout.get();
    VkPipeline handle{};
    ORO_VK(vkCreateComputePipelines(gpu.device(), VK_NULL_HANDLE, 1, &info, nullptr, &handle));
    gpu.name(VK_OBJECT_TYPE_PIPELINE, handle, name);
    return OwnedPipeline(gpu.device(), handle);
}

Result<std::shared_ptr<Pipelines>> shared_pipelines(const Gpu& gpu, RasterPath path,
                                                    const PipelineWants& wants) {
    const bool small = wants.leave_out_small && path == RasterPath::mesh;
    const bool shares = wants.shares_triangles && path == RasterPath::compute;
    std::shared_ptr<Pipelines>& kept = gpu.kept_pipelines(
        {path, wants.record_positions, small, wants.overdraw, wants.packed_heights, shares, wants.list_room});
    if (!kept) {
        ORO_TRY(Pipelines pipelines, create_pipelines(gpu, path, wants));
        kept = std::make_shared<Pipelines>(std::move(pipelines));
    }
    const VkBool32 compute = path == RasterPath::compute ? VK_TRUE : VK_FALSE;
    const VkSpecializationMapEntry entry{0, 0, sizeof(compute)};
    const VkSpecializationInfo constants{1, &entry, sizeof(compute), &compute};
    if (wants.show && !kept->show) {
        ORO_TRY(kept->show, create_compute_pipeline(gpu, *kept, show_comp_spirv, "show", &constants));
    }
    if (wants.triangles && !kept->triangles) {
        ORO_TRY(kept->triangles, create_triangles(gpu, path, triangles_comp_spirv, *kept));
    }
    return kept;
}

}  // namespace oro
