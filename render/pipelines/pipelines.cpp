#include "render/pipelines/pipelines.h"

#include <array>
#include <compare>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <utility>

#include "render/pipelines/pipeline_parts.h"
#include "shaders/shared.h"
#include "spirv/choose_clusters_comp.h"
#include "spirv/cull_comp.h"
#include "spirv/cull_second_pass_comp.h"
#include "spirv/live_pages_comp.h"
#include "spirv/lod_test_comp.h"
#include "spirv/pyramid_comp.h"
#include "spirv/pyramid_images_comp.h"
#include "spirv/show_comp.h"
#include "spirv/triangles_clusters_comp.h"
#include "spirv/triangles_comp.h"

namespace oro {
namespace {

// Which of a device's pipelines: those of one way of drawing, as PipelineWants says.
struct PipelinesKey {
    RasterPath path{};
    bool record_positions{};
    bool leave_out_small{};
    bool overdraw{};
    bool packed_heights{};
    bool meshes{};
    bool shares_triangles{};
    MeshletSplit split{MeshletSplit::whole};
    ListRoom list_room{};
    auto operator<=>(const PipelinesKey&) const = default;
};

// What a device keeps.
using KeptPipelines = std::map<PipelinesKey, std::shared_ptr<Pipelines>>;

KeptPipelines& kept_pipelines(const Gpu& gpu) {
    if (!gpu.kept()) gpu.kept() = std::make_shared<KeptPipelines>();
    return *static_cast<KeptPipelines*>(gpu.kept().get());
}

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

// What decides in each round what is drawn.
Result<void> create_rounds(const Gpu& gpu, RasterPath path, Pipelines& pipelines) {
    const bool compute = path == RasterPath::compute;
    const VkBool32 for_compute = compute ? VK_TRUE : VK_FALSE;
    const VkSpecializationMapEntry entry{0, 0, sizeof(for_compute)};
    const VkSpecializationInfo constants{1, &entry, sizeof(for_compute), &for_compute};
    ORO_TRY(pipelines.cull, create_compute_pipeline(gpu, pipelines, cull_comp_spirv, "cull", &constants));
    ORO_TRY(pipelines.cull_second_pass, create_compute_pipeline(gpu, pipelines, cull_second_pass_comp_spirv,
                                                                "second culling pass", &constants));
    const std::span<const std::uint32_t> words =
        compute ? std::span<const std::uint32_t>(pyramid_comp_spirv)
                : std::span<const std::uint32_t>(pyramid_images_comp_spirv);
    ORO_TRY(pipelines.pyramid, create_compute_pipeline(gpu, pipelines, words, "depth pyramid"));
    return {};
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
                                   first ? "choose clusters" : "second pass of clusters", &constants);
}

Result<void> create_choice(const Gpu& gpu, Pipelines& pipelines) {
    ORO_TRY(pipelines.lod_test,
            create_compute_pipeline(gpu, pipelines, lod_test_comp_spirv, "level-of-detail test"));
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
    pipelines.meshes = wants.meshes;
    pipelines.list_room = wants.list_room;
    ORO_CHECK(create_layouts(gpu, path, pipelines));
    ORO_CHECK(path == RasterPath::mesh ? add_mesh_pipelines(gpu, wants, pipelines)
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
        ORO_TRY(pipelines.choose_clusters_second_pass, create_choose_clusters(gpu, path, false, pipelines));
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

MeshletSplit meshlet_split_for(MeshletSplit request, const DeviceReport& device) {
    if (request == MeshletSplit::whole || !device.mesh_ballots) return MeshletSplit::whole;
    if (request == MeshletSplit::halves) return MeshletSplit::halves;
    // Measured on a card whose subgroups have so many (docs/notes, half-a-meshlet).
    constexpr std::uint32_t of_halves = 32;
    return device.subgroup_size == of_halves ? MeshletSplit::halves : MeshletSplit::whole;
}

Result<std::shared_ptr<Pipelines>> shared_pipelines(const Gpu& gpu, RasterPath path,
                                                    const PipelineWants& wants) {
    const bool small = wants.leave_out_small && path == RasterPath::mesh;
    const bool shares = wants.shares_triangles && path == RasterPath::compute;
    const MeshletSplit split =
        path == RasterPath::mesh ? meshlet_split_for(wants.split, gpu.report()) : MeshletSplit::whole;
    std::shared_ptr<Pipelines>& kept =
        kept_pipelines(gpu)[{path, wants.record_positions, small, wants.overdraw, wants.packed_heights,
                             wants.meshes, shares, split, wants.list_room}];
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
