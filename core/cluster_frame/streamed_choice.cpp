#include "core/cluster_frame/streamed_choice.h"

#include <algorithm>
#include <optional>
#include <ranges>
#include <utility>

namespace oro {
namespace {

// open: gives way, as far as is known. unread: would, and nobody knows to what. closed: would, and must not.
enum class Answer : char { no, hidden, stands, unread, open, closed };
// Whether it shows, as far as the last frame told.
enum class Sight : char { unknown, hidden, shows };

// Where in a list a number is.
class Places {
  public:
    template <class T>
    Places(const std::vector<T>& list, std::uint32_t T::*number) {
        places_.reserve(list.size());
        for (std::size_t i = 0; i < list.size(); ++i) places_.emplace_back(list[i].*number, i);
        std::ranges::sort(places_);
    }
    [[nodiscard]] std::optional<std::size_t> find(std::uint32_t number) const {
        const auto at = std::ranges::lower_bound(places_, std::pair(number, std::size_t{0}));
        if (at == places_.end() || at->first != number) return std::nullopt;
        return at->second;
    }

  private:
    std::vector<std::pair<std::uint32_t, std::size_t>> places_;
};

class StreamedCut {
  public:
    StreamedCut(RegionClusters& clusters, const ClusterView& view, const IsClusterHere& is_here)
        : clusters_(clusters), view_(view), is_here_(is_here), asked_(clusters.groups().size(), Answer::no) {}

    // Finds what the rule says of all that is known.
    void walk() {
        meet(clusters_.roots(), no_group);
        // Users lie on the level above: wave after wave is level after level.
        std::vector<std::uint32_t> wave;
        while (!next_.empty()) {
            wave.clear();
            wave.swap(next_);
            for (const std::uint32_t group : wave) {
                const std::size_t first = met_.size();
                meet(clusters_.read_part(group)->members, group);
                opened_.push_back({group, first, met_.size()});
            }
        }
        for (const Met& met : met_)
            in_cut_ += is_of_cut(met) && met.is_known && is_seen(met) && met.user != no_group ? 1U : 0U;
    }
    // Clusters of the cut that can be seen, without the roots.
    [[nodiscard]] std::size_t in_cut() const { return in_cut_; }

    // What may not give way yet does not.
    void close_what_lacks() {
        for (const Opened& opened : opened_)
            if (asked_[opened.group] == Answer::open && !may_open(opened)) close(opened.group);
        if (closing_.empty()) return;
        const Places opened_at(opened_, &Opened::group), met_at(met_, &Met::cluster);
        while (!closing_.empty()) {
            const std::uint32_t group = closing_.back();
            closing_.pop_back();
            const Opened& opened = opened_[*opened_at.find(group)];
            for (std::size_t i = opened.first; i < opened.last; ++i) {
                const std::uint32_t maker = clusters_.maker(met_[i].cluster);
                if (maker != no_group && asked_[maker] == Answer::open) close(maker);
            }
            // Now it is drawn what it made, where that is met.
            const ClusterGroup& closed = clusters_.groups()[group];
            for (std::uint32_t made = closed.first_made; made < closed.first_made + closed.made; ++made) {
                const auto at = met_at.find(made);
                if (!at || !lacks(met_[*at])) continue;
                const std::uint32_t user = met_[*at].user;
                if (user != no_group && asked_[user] == Answer::open) close(user);
            }
        }
    }

    Result<StreamedChoice> take(std::size_t room, const ShownClusters& shown) {
        want(room, shown);
        OfferedCut offered(clusters_, view_);
        for (const Met& met : met_) {
            if (met.user != no_group && asked_[met.user] != Answer::open) continue;
            const std::uint32_t maker = clusters_.maker(met.cluster);
            if (maker != no_group && asked_[maker] == Answer::hidden) continue;
            if (maker != no_group && asked_[maker] == Answer::open) {
                if (is_seen(met))
                    offered.add_coarser(met.look.distance_m, met.cluster, met.user, is_here_(met.cluster));
                continue;
            }
            ClusterView::Look look = met.look;
            if (!met.is_known && is_here_(met.cluster)) {
                ORO_TRY(const ClusterReach reach, clusters_.reach(met.cluster));
                look = view_.look_at(reach);
            }
            ClusterChoice& drawn = choice_.drawn;
            drawn.beyond_frustum += look.seen == ClusterView::Seen::beyond_frustum ? 1U : 0U;
            drawn.beyond_horizon += look.seen == ClusterView::Seen::beyond_horizon ? 1U : 0U;
            if (look.seen != ClusterView::Seen::yes || !is_here_(met.cluster)) continue;
            offered.add_of_cut(look.distance_m, met.cluster, met.user);
        }
        std::vector<std::uint32_t> opened;
        for (const Opened& group : opened_)
            if (asked_[group.group] == Answer::open) opened.push_back(group.group);
        choice_.offer = offered.take(opened);
        for (const OfferedCluster& cluster :
             choice_.offer.clusters | std::views::take(choice_.offer.in_cut)) {
            choice_.drawn.clusters.push_back(cluster.cluster);
            choice_.drawn.groups.push_back(cluster.group);
        }
        return std::move(choice_);
    }

  private:
    // A cluster that the rule comes to.
    struct Met {
        std::uint32_t cluster;
        std::uint32_t user;  // the group that it comes from
        bool is_known;       // where it reaches; what nobody knows of may be seen
        ClusterView::Look look;
    };
    struct Opened {
        std::uint32_t group;
        std::size_t first, last;  // of what it uses, in met_
    };

    void meet(std::span<const std::uint32_t> clusters, std::uint32_t user) {
        for (const std::uint32_t cluster : clusters) {
            const std::uint32_t maker = clusters_.maker(cluster);
            if (maker != no_group && asked_[maker] == Answer::no) ask(maker);
            if (maker != no_group && asked_[maker] == Answer::hidden) continue;
            const ClusterReach* const reach = clusters_.known_reach(cluster);
            met_.push_back(
                {cluster, user, reach != nullptr,
                 reach != nullptr ? view_.look_at(*reach) : ClusterView::Look{ClusterView::Seen::yes, 0.0}});
        }
    }

    void ask(std::uint32_t number) {
        const ClusterGroup& group = clusters_.groups()[number];
        if (view_.is_beyond_frustum(group)) {
            ++choice_.drawn.beyond_frustum;
            asked_[number] = Answer::hidden;
            return;
        }
        const bool is_read = clusters_.use_part(number) != nullptr;
        if (!is_read) choice_.groups_wanted.push_back(number);
        if (view_.stands(group)) {
            asked_[number] = Answer::stands;
        } else {
            asked_[number] = is_read ? Answer::open : Answer::unread;
            ++choice_.drawn.groups_opened;
            if (is_read) next_.push_back(number);
        }
    }

    [[nodiscard]] static bool is_seen(const Met& met) { return met.look.seen == ClusterView::Seen::yes; }
    [[nodiscard]] bool lacks(const Met& met) const { return is_seen(met) && !is_here_(met.cluster); }
    // Of the cut that the rule asks for, as far as groups are read.
    [[nodiscard]] bool is_of_cut(const Met& met) const {
        const std::uint32_t maker = clusters_.maker(met.cluster);
        return maker == no_group || asked_[maker] == Answer::stands || asked_[maker] == Answer::unread;
    }

    // A group that uses what this one made and was not asked has none above it in view, or an unread one.
    [[nodiscard]] bool deselected(std::uint32_t user) const {
        if (user == no_group || asked_[user] == Answer::open || asked_[user] == Answer::hidden) return true;
        return asked_[user] == Answer::no && view_.is_beyond_frustum(clusters_.groups()[user]);
    }
    [[nodiscard]] bool may_open(const Opened& opened) const {
        const GroupPart& part = *clusters_.read_part(opened.group);
        return std::ranges::all_of(part.made,
                                   [&](const Cluster& made) { return deselected(made.used_by); }) &&
               std::none_of(met_.begin() + static_cast<std::ptrdiff_t>(opened.first),
                            met_.begin() + static_cast<std::ptrdiff_t>(opened.last),
                            [&](const Met& met) { return is_of_cut(met) && lacks(met); });
    }
    void close(std::uint32_t group) {
        asked_[group] = Answer::closed;
        closing_.push_back(group);
    }

    // Of each cluster that was met what is known of it, or of what is drawn in its place. A group shows where
    // any does that it made, and is hidden where one is and none shows.
    std::vector<Sight> find_sights(const ShownClusters& shown) {
        std::vector<Sight> sights;
        group_sights_.resize(asked_.size(), Sight::unknown);
        for (const Met& met : met_) {
            const auto known = shown.find(met.cluster);
            Sight sight = Sight::unknown;
            if (known != shown.end())
                sight = known->second ? Sight::shows : Sight::hidden;
            else if (is_seen(met))
                sight = met.user != no_group && group_sights_[met.user] == Sight::hidden ? Sight::hidden
                                                                                         : Sight::shows;
            sights.push_back(sight);
            const std::uint32_t maker = clusters_.maker(met.cluster);
            if (maker != no_group) group_sights_[maker] = std::max(group_sights_[maker], sight);
        }
        add_needed(sights);
        return sights;
    }

    // What shows comes with what must be here before it may be drawn: all that the groups use that give way
    // with its own. Of what is below that no more.
    void add_needed(std::vector<Sight>& sights) {
        std::vector<bool> needed(asked_.size());
        for (std::size_t i = met_.size(); i-- > 0;) {
            const std::uint32_t maker = clusters_.maker(met_[i].cluster), user = met_[i].user;
            const bool deselected = maker != no_group && asked_[maker] != Answer::stands && needed[maker];
            if (user != no_group && (deselected || sights[i] == Sight::shows)) needed[user] = true;
        }
        for (std::size_t i = 0; i < met_.size(); ++i) {
            if (met_[i].user == no_group || !needed[met_[i].user]) continue;
            const std::uint32_t maker = clusters_.maker(met_[i].cluster);
            sights[i] = Sight::shows;
            if (maker != no_group) group_sights_[maker] = Sight::shows;
        }
    }

    void want(std::size_t room, const ShownClusters& shown) {
        const std::vector<Sight> sights = find_sights(shown);
        std::vector<std::uint32_t> hidden;
        std::size_t left = room - std::min(room, in_cut_);
        for (std::size_t i = 0; i < met_.size(); ++i) {
            const Met& met = met_[i];
            if (!is_seen(met)) continue;
            const bool of_cut = is_of_cut(met);
            if (of_cut && lacks(met)) ++choice_.missing;
            // Nobody can send what was not read.
            const std::uint32_t maker = clusters_.maker(met.cluster);
            if (maker != no_group && clusters_.read_part(maker) == nullptr) continue;
            if (!of_cut && met.user != no_group) {
                if (left == 0) continue;
                --left;
            }
            (sights[i] == Sight::hidden ? hidden : choice_.clusters_wanted).push_back(met.cluster);
        }
        choice_.clusters_hidden = hidden.size();
        choice_.clusters_wanted.insert(choice_.clusters_wanted.end(), hidden.begin(), hidden.end());
        choice_.groups_hidden =
            std::ranges::stable_partition(choice_.groups_wanted, [&](std::uint32_t group) {
                return group_sights_[group] != Sight::hidden;
            }).size();
        for (const Answer asked : asked_)
            choice_.missing += asked == Answer::unread || asked == Answer::closed ? 1U : 0U;
    }

    RegionClusters& clusters_;
    const ClusterView& view_;
    const IsClusterHere& is_here_;
    std::vector<Answer> asked_;        // of each group
    std::vector<Sight> group_sights_;  // likewise
    std::vector<std::uint32_t> next_, closing_;
    std::vector<Opened> opened_;
    std::vector<Met> met_;  // coarsest first
    std::size_t in_cut_{};
    StreamedChoice choice_;
};

}  // namespace

Result<StreamedChoice> select_resident_cut(RegionClusters& clusters, const ClusterView& view,
                                           std::size_t room, const IsClusterHere& is_here,
                                           const ShownClusters& shown) {
    const auto cut_for = [&](const ClusterView& asked) {
        StreamedCut cut(clusters, asked, is_here);
        cut.walk();
        return cut;
    };
    StreamedCut cut = cut_for(view);
    if (cut.in_cut() <= room) {
        cut.close_what_lacks();
        return cut.take(room, shown);
    }
    const std::size_t without_room = cut.in_cut() - room;
    const ClusterView coarser = view.coarser(
        coarser_steps_until([&](unsigned steps) { return cut_for(view.coarser(steps)).in_cut() <= room; }));
    StreamedCut fitting = cut_for(coarser);
    fitting.close_what_lacks();
    ORO_TRY(StreamedChoice choice, fitting.take(room, shown));
    choice.without_room = without_room;
    choice.missing = std::max(choice.missing, without_room);
    return choice;
}

}  // namespace oro
