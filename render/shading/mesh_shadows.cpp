#include "render/shading/mesh_shadows.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/earth/ellipsoid.h"
#include "spirv/mesh_shares_comp.h"

namespace oro {

Result<void> MeshShadowFrame::prepare(const Gpu& gpu, RasterPath path, Pipelines& pipelines,
                                      const FramePlan& plan, const SharedShares& shared, std::size_t slot) {
    const auto with_meshes =
        std::ranges::find_if(plan.grids, [](const GridPlan& grid) { return grid.mesh_casters != 0; });
    is_on_ = shared.is_on() && with_meshes != plan.grids.end() && plan.view.model.earth == Earth::ellipsoid;
    if (!is_on_) return {};
    slot_ = slot;
    width_px_ = plan.view.width_px(), height_px_ = plan.view.height_px();
    if (!pipelines.mesh_shares) {
        const VkBool32 from_compute = path == RasterPath::compute ? VK_TRUE : VK_FALSE;
        const VkSpecializationMapEntry entry{0, 0, sizeof(from_compute)};
        const VkSpecializationInfo constants{1, &entry, sizeof(from_compute), &from_compute};
        ORO_TRY(pipelines.mesh_shares, create_compute_pipeline(gpu, pipelines, mesh_shares_comp_spirv,
                                                               "shadows of meshes", &constants));
    }
    Buffer& table = tables_[slot_];
    if (table.size == 0) {
        ORO_TRY(table,
                create_buffer(gpu, sizeof(gpu::MeshShadows),
                              VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT,
                              MemoryKind::upload, "shadows of meshes"));
    }
    const Camera& camera = plan.view.camera;
    const double lon_rad = radians_from_deg(camera.eye.lon_deg).rad;
    gpu::MeshShadows shadows{};
    shadows.nodes = address_words(with_meshes->mesh_casters);
    shadows.triangles =
        address_words(with_meshes->mesh_casters + with_meshes->mesh_nodes * sizeof(gpu::MeshNode));
    shadows.eye_m = gpu::vec3(camera.eye_ecef().m - with_meshes->mesh_origin_m);
    shadows.meridian = gpu::vec2(glm::dvec2(std::cos(lon_rad), std::sin(lon_rad)));
    std::memcpy(table.mapped, &shadows, sizeof(shadows));
    return {};
}

void MeshShadowFrame::record(VkCommandBuffer commands, const Pipelines& pipelines) const {
    const gpu::uvec2 table = address_words(tables_[slot_].address);
    static_assert(sizeof(table) <= sizeof(gpu::FrameRound));
    vkCmdPushConstants(commands, pipelines.layout.get(), pipelines.round_stages, 0, sizeof(table), &table);
    constexpr std::uint32_t side_px = 8;
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipelines.mesh_shares.get());
    vkCmdDispatch(commands, (width_px_ + side_px - 1) / side_px, (height_px_ + side_px - 1) / side_px, 1);
    memory_barrier(commands, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                   VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                   VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT);
}

}  // namespace oro
