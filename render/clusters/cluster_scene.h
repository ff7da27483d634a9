// A region's clusters that are drawn: its graph, and those of its clusters that are on the GPU.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "core/frame/frame_plan.h"
#include "render/clusters/cluster_store.h"

namespace oro {

class RegionClusters;

class ClusterScene {
  public:
    ClusterScene(ClusterScene&&) noexcept;
    ClusterScene& operator=(ClusterScene&&) noexcept;
    ~ClusterScene();
    // Clusters may take `bytes` on the GPU. Errors: out of memory.
    static Result<ClusterScene> create(const Gpu& gpu, std::unique_ptr<RegionClusters> clusters,
                                       std::uint64_t bytes);

    // From now on the cut is that of a level of the graph, the same from everywhere; tau is for shading
    // alone.
    void keep_to_level(std::uint32_t level) { level_ = level; }

    // Puts the cut for an eye into the plan of its pages (plan_frame), and what of it is missing on the GPU.
    // model: on the ellipsoid. Errors: damage; too little memory for the cut; the device.
    Result<void> add_to(FramePlan& plan, const Camera& camera, const Tile& tile, double tau_px,
                        const WorldModel& model, const HorizonOccluder& occluder,
                        const HeightQuantization& coding);

    [[nodiscard]] const ClusterStore& store() const { return store_; }

  private:
    ClusterScene(std::unique_ptr<RegionClusters> clusters, ClusterStore store);

    std::unique_ptr<RegionClusters> clusters_;
    ClusterStore store_;
    std::optional<std::uint32_t> level_;
};

}  // namespace oro
