#include "core/cluster_frame/cluster_choice.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace oro {
namespace {

enum class Asked : char { no, hidden, stands, deselected };

class Cut {
  public:
    Cut(RegionClusters& clusters, const ClusterView& view)
        : clusters_(clusters), view_(view), asked_(clusters.groups().size(), Asked::no) {}

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
        if (view_.is_beyond_frustum(group)) {
            ++choice_.beyond_frustum;
            asked_[number] = Asked::hidden;
        } else if (view_.stands(group)) {
            asked_[number] = Asked::stands;
        } else {
            asked_[number] = Asked::deselected;
            ++choice_.groups_opened;
            open_.push_back(number);
        }
    }

    Result<void> draw(std::uint32_t cluster, std::uint32_t group) {
        ORO_TRY(const ClusterReach reach, clusters_.reach(cluster));
        const ClusterView::Look look = view_.look_at(reach);
        choice_.beyond_frustum += look.seen == ClusterView::Seen::beyond_frustum ? 1U : 0U;
        choice_.beyond_horizon += look.seen == ClusterView::Seen::beyond_horizon ? 1U : 0U;
        if (look.seen == ClusterView::Seen::yes) found_.emplace_back(look.distance_m, cluster, group);
        return {};
    }

    RegionClusters& clusters_;
    const ClusterView& view_;
    std::vector<Asked> asked_;  // of each group
    std::vector<std::uint32_t> open_;
    std::vector<std::uint32_t> cut_;     // of what may be seen,
    std::vector<std::uint32_t> groups_;  // and their groups
    std::vector<std::tuple<double, std::uint32_t, std::uint32_t>> found_;
    ClusterChoice choice_;
};

}  // namespace

Result<ClusterChoice> choose_clusters(RegionClusters& clusters, const ClusterView& view) {
    return Cut(clusters, view).choose();
}

Result<ClusterChoice> choose_clusters(RegionClusters& clusters, const Camera& camera, const Tile& tile,
                                      double tau_px, const WorldModel& model, const HorizonOccluder& occluder,
                                      const HeightQuantization& coding, std::optional<std::uint32_t> level) {
    return choose_clusters(clusters, ClusterView(camera, tile, tau_px, model, occluder, coding, level));
}

unsigned coarser_steps_until(const std::function<bool(unsigned steps)>& holds) {
    unsigned too_few = 0, enough = GroupRule::most_coarser_steps;
    while (enough - too_few > 1) {
        const unsigned middle = (too_few + enough) / 2;
        (holds(middle) ? enough : too_few) = middle;
    }
    return enough;
}

}  // namespace oro
