// An eye, as it is asked of groups whether they stand, and of groups and clusters whether they can be seen.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "core/cluster_frame/group_rule.h"
#include "core/cluster_frame/region_clusters.h"
#include "core/earth/camera.h"
#include "core/earth/world_model.h"
#include "core/frame/model_view.h"

namespace oro {

// Frustum and horizon are conservative.
class ClusterView {
  public:
    // model: on the ellipsoid. level: in the place of tau_px (GroupRule).
    ClusterView(const Camera& camera, const Tile& tile, double tau_px, const WorldModel& model,
                const HorizonOccluder& occluder, const HeightQuantization& coding,
                std::optional<std::uint32_t> level = {});

    // The view of this eye with a coarser cut (GroupRule::coarser).
    [[nodiscard]] ClusterView coarser(unsigned steps) const;

    [[nodiscard]] bool stands(const ClusterGroup& group) const { return rule_.stands(group); }
    // What the GPU needs for the same answer.
    [[nodiscard]] gpu::AskedGroup measured(const ClusterGroup& group) const { return rule_.measured(group); }
    [[nodiscard]] const gpu::CutRule& cut_rule() const { return rule_.cut_rule(); }
    // All that a group covers, of any detail.
    [[nodiscard]] bool is_beyond_frustum(const ClusterGroup& group) const;

    enum class Seen { yes, beyond_frustum, beyond_horizon };
    struct Look {
        Seen seen;
        double distance_m;  // of the nearest place that it may have
    };
    [[nodiscard]] Look look_at(const ClusterReach& reach) const;

  private:
    GroupRule rule_;
    std::array<Plane, 5> planes_;
    SeenHorizon horizon_;
};

}  // namespace oro
