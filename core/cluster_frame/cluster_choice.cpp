#include "core/cluster_frame/cluster_choice.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <glm/geometric.hpp>
#include <tuple>
#include <utility>

#include "core/cluster_frame/group_rule.h"
#include "core/frame/culling.h"

namespace oro {
namespace {

enum class Asked : char { no, hidden, stands, gives_way };

class Cut {
  public:
    Cut(RegionClusters& clusters, const Camera& camera, const Tile& tile, double tau_px,
        const WorldModel& model, const HorizonOccluder& occluder, const HeightQuantization& coding,
        std::optional<std::uint32_t> level)
        : clusters_(clusters),
          rule_(camera, tau_px, model.air, level),
          planes_(frustum_planes_view(projection_of_tile(camera, tile))),
          asked_(clusters.groups().size(), Asked::no) {
        const ModelView view(camera, model, coding);
        horizon_ = view.horizon(occluder);
        // Drawn places are rounded.
        for (Plane& plane : planes_) plane.w += view.rounding_m() + 0.01;
    }

    Result<ClusterChoice> choose() {
        meet(clusters_.roots(), no_group);
        // Wave by wave, so that what must be read is read together.
        std::vector<std::uint32_t> wave;
        while (!open_.empty()) {
            wave.clear();
            wave.swap(open_);
            ORO_CHECK(clusters_.read(wave));
            for (const std::uint32_t group : wave) {
                ORO_TRY(const std::span<const std::uint32_t> members, clusters_.members(group));
                meet(members, group);
            }
        }
        ORO_CHECK(clusters_.reach_all(cut_));
        for (std::size_t i = 0; i < cut_.size(); ++i) ORO_CHECK(draw(cut_[i], groups_[i]));
        std::ranges::sort(found_);
        for (const auto& [distance_m, cluster, group] : found_) {
            choice_.clusters.push_back(cluster);
            choice_.groups.push_back(group);
        }
        return std::move(choice_);
    }

  private:
    // Clusters that no group stands for: each is of the cut, or what it was made of is met in its turn. user:
    // the group that they come from.
    void meet(std::span<const std::uint32_t> clusters, std::uint32_t user) {
        for (const std::uint32_t cluster : clusters) {
            const std::uint32_t maker = clusters_.maker(cluster);
            if (maker != no_group && asked_[maker] == Asked::no) ask(maker);
            if (maker != no_group && asked_[maker] != Asked::stands) continue;
            cut_.push_back(cluster);
            groups_.push_back(maker == no_group ? user : maker);
        }
    }

    // A group's sphere holds what it made, too: where it is hidden nobody needs to read the group.
    void ask(std::uint32_t number) {
        const ClusterGroup& group = clusters_.groups()[number];
        const GroupRule::SeenSphere seen = rule_.seen(group.centre, group.radius_m);
        if (beyond_frustum(planes_, seen.centre_m, seen.radius_m)) {
            ++choice_.beyond_frustum;
            asked_[number] = Asked::hidden;
        } else if (rule_.stands(group)) {
            asked_[number] = Asked::stands;
        } else {
            asked_[number] = Asked::gives_way;
            ++choice_.groups_opened;
            open_.push_back(number);
        }
    }

    Result<void> draw(std::uint32_t cluster, std::uint32_t group) {
        ORO_TRY(const ClusterReach* const reach, clusters_.reach(cluster));
        const GroupRule::SeenSphere seen = rule_.seen(reach->centre, reach->radius_m);
        if (beyond_frustum(planes_, seen.centre_m, seen.radius_m)) {
            ++choice_.beyond_frustum;
            return {};
        }
        if (beyond_horizon(horizon_.eye,
                           {reach->horizon.direction, reach->horizon.angle_rad * horizon_.stretch})) {
            ++choice_.beyond_horizon;
            return {};
        }
        found_.emplace_back(std::max(0.0, glm::length(seen.centre_m) - seen.radius_m), cluster, group);
        return {};
    }

    RegionClusters& clusters_;
    GroupRule rule_;
    std::array<Plane, 5> planes_;
    SeenHorizon horizon_;
    std::vector<Asked> asked_;  // of each group
    std::vector<std::uint32_t> open_;
    std::vector<std::uint32_t> cut_;     // of what may be seen,
    std::vector<std::uint32_t> groups_;  // and their groups
    std::vector<std::tuple<double, std::uint32_t, std::uint32_t>> found_;
    ClusterChoice choice_;
};

}  // namespace

Result<ClusterChoice> choose_clusters(RegionClusters& clusters, const Camera& camera, const Tile& tile,
                                      double tau_px, const WorldModel& model, const HorizonOccluder& occluder,
                                      const HeightQuantization& coding, std::optional<std::uint32_t> level) {
    assert(model.earth == Earth::ellipsoid);
    return Cut(clusters, camera, tile, tau_px, model, occluder, coding, level).choose();
}

}  // namespace oro
