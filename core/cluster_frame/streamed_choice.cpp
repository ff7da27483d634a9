#include "core/cluster_frame/streamed_choice.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>

namespace oro {
namespace {

// open: gives way, as far as is known. unread: would, and nobody knows to what. closed: would, and must not.
enum class Answer : char { no, hidden, stands, unread, open, closed };
// Whether it shows, as far as the last frame reported.
enum class Sight : char { unknown, hidden, shows };

// A cluster that the rule comes to.
struct Met {
    double distance_m;  // ClusterView::Look
    std::uint32_t cluster;
    std::uint32_t user;   // the group that it comes from
    std::uint32_t maker;  // the group that made it
    ClusterView::Seen seen;
    bool is_known;  // where it reaches; what nobody knows of may be seen
    bool is_here;   // once find_here() was called, of what may be seen
};
struct Opened {
    std::uint32_t group;
    std::size_t first, last;  // of what it uses, among those that are met
};

}  // namespace

// Of each group: an answer and what comes of it, as no choice had them; the groups that a choice has asked
// are listed, and are put back when the next one begins.
struct StreamedChoiceMemory::Kept {
    std::vector<Answer> answers;
    std::vector<Sight> group_sights;
    std::vector<char> needed;
    std::vector<std::uint32_t> asked;
    std::vector<std::uint32_t> opened_numbers;  // of an opened group, among those
    std::vector<std::uint32_t> met_numbers;     // of a cluster that is met, among those
    std::vector<std::uint32_t> next, wave, closing;
    std::vector<Opened> opened;
    std::vector<Met> met;  // coarsest first
    std::vector<const ClusterReach*> reaches;
    std::vector<Sight> sights;
    std::vector<Sight> reported;  // of each cluster that a frame reported of, while sights are found
    OfferMemory offer;

    void begin(std::size_t groups) {
        answers.resize(groups, Answer::no);
        group_sights.resize(groups, Sight::unknown);
        needed.resize(groups);
        opened_numbers.resize(groups);
        for (const std::uint32_t group : asked) {
            answers[group] = Answer::no;
            group_sights[group] = Sight::unknown;
            needed[group] = 0;
        }
        asked.clear();
        next.clear();
        closing.clear();
        opened.clear();
        met.clear();
        sights.clear();
    }
};

namespace {

// What a look at a reach reads of it.
void prefetch(const ClusterReach* reach) {
#if defined(__GNUC__)
    __builtin_prefetch(reach);
    __builtin_prefetch(reinterpret_cast<const char*>(reach) + offsetof(ClusterReach, horizon));
#else
    static_cast<void>(reach);
#endif
}

class StreamedCut {
  public:
    // One at a time has the memory.
    StreamedCut(RegionClusters& clusters, const ClusterView& view, const IsClusterHere& is_here,
                StreamedChoiceMemory::Kept& kept)
        : clusters_(clusters), view_(view), is_here_(is_here), kept_(kept) {
        kept_.begin(clusters.groups().size());
    }

    // Finds what the rule says of all that is known.
    void walk() {
        meet(clusters_.roots(), no_group);
        // Users lie on the level above: wave after wave is level after level.
        while (!kept_.next.empty()) {
            kept_.wave.clear();
            kept_.wave.swap(kept_.next);
            for (const std::uint32_t group : kept_.wave) {
                const std::size_t first = kept_.met.size();
                meet(clusters_.read_part(group)->members, group);
                kept_.opened_numbers[group] = static_cast<std::uint32_t>(kept_.opened.size());
                kept_.opened.push_back({group, first, kept_.met.size()});
            }
        }
        for (const Met& met : kept_.met)
            in_cut_ += met.user != no_group && met.is_known && is_seen(met) && is_of_cut(met) ? 1U : 0U;
    }
    // Clusters of the cut that can be seen, without the roots.
    [[nodiscard]] std::size_t in_cut() const { return in_cut_; }

    // What may not give way yet does not.
    void close_what_lacks() {
        find_here();
        for (const Opened& opened : kept_.opened)
            if (answer(opened.group) == Answer::open && !may_open(opened)) close(opened.group);
        if (kept_.closing.empty()) return;
        number_met();
        while (!kept_.closing.empty()) {
            const std::uint32_t group = kept_.closing.back();
            kept_.closing.pop_back();
            const Opened& opened = kept_.opened[kept_.opened_numbers[group]];
            for (std::size_t i = opened.first; i < opened.last; ++i) {
                const std::uint32_t maker = kept_.met[i].maker;
                if (maker != no_group && answer(maker) == Answer::open) close(maker);
            }
            // Now it is drawn what it made, where that is met.
            const ClusterGroup& closed = clusters_.groups()[group];
            for (std::uint32_t made = closed.first_made; made < closed.first_made + closed.made; ++made) {
                const Met* const met = find_met(made);
                if (met == nullptr || !lacks(*met)) continue;
                if (met->user != no_group && answer(met->user) == Answer::open) close(met->user);
            }
        }
    }

    Result<StreamedChoice> take(std::size_t room, const ShownClusters& shown, LackingCut lacking) {
        want(room, shown);
        if (lacking == LackingCut::is_left_out && choice_.missing > 0) return std::move(choice_);
        OfferedCut offered(clusters_, view_, kept_.offer);
        for (const Met& met : kept_.met) {
            if (met.user != no_group && answer(met.user) != Answer::open) continue;
            const Answer made_by = met.maker == no_group ? Answer::stands : answer(met.maker);
            if (made_by == Answer::hidden) continue;
            if (made_by == Answer::open) {
                if (is_seen(met)) offered.add_coarser(met.distance_m, met.cluster, met.user, met.is_here);
                continue;
            }
            ClusterView::Look look{met.seen, met.distance_m};
            if (!met.is_known && met.is_here) {
                ORO_TRY(const ClusterReach reach, clusters_.reach(met.cluster));
                look = view_.look_at(reach);
            }
            ClusterChoice& drawn = choice_.drawn;
            drawn.beyond_frustum += look.seen == ClusterView::Seen::beyond_frustum ? 1U : 0U;
            drawn.beyond_horizon += look.seen == ClusterView::Seen::beyond_horizon ? 1U : 0U;
            if (look.seen != ClusterView::Seen::yes || !met.is_here) continue;
            offered.add_of_cut(look.distance_m, met.cluster, met.user);
        }
        std::vector<std::uint32_t> opened;
        for (const Opened& group : kept_.opened)
            if (answer(group.group) == Answer::open) opened.push_back(group.group);
        choice_.offer = offered.take(opened);
        for (const OfferedCluster& cluster : std::span(choice_.offer.clusters).first(choice_.offer.in_cut)) {
            choice_.drawn.clusters.push_back(cluster.cluster);
            choice_.drawn.groups.push_back(cluster.group);
        }
        return std::move(choice_);
    }

  private:
    [[nodiscard]] Answer answer(std::uint32_t group) const { return kept_.answers[group]; }

    void meet(std::span<const std::uint32_t> clusters, std::uint32_t user) {
        // Reaches lie anywhere in memory: all of a group are on their way before the first is looked at.
        kept_.reaches.clear();
        for (const std::uint32_t cluster : clusters) {
            const std::uint32_t maker = clusters_.maker(cluster);
            if (maker != no_group && answer(maker) == Answer::no) ask(maker);
            const ClusterReach* const reach = clusters_.known_reach(cluster);
            prefetch(reach);
            kept_.reaches.push_back(reach);
        }
        for (std::size_t i = 0; i < clusters.size(); ++i) {
            const std::uint32_t maker = clusters_.maker(clusters[i]);
            if (maker != no_group && answer(maker) == Answer::hidden) continue;
            const ClusterReach* const reach = kept_.reaches[i];
            const ClusterView::Look look =
                reach != nullptr ? view_.look_at(*reach) : ClusterView::Look{ClusterView::Seen::yes, 0.0};
            kept_.met.push_back(
                {look.distance_m, clusters[i], user, maker, look.seen, reach != nullptr, false});
        }
    }

    void ask(std::uint32_t number) {
        const ClusterGroup& group = clusters_.groups()[number];
        kept_.asked.push_back(number);
        if (view_.is_beyond_frustum(group)) {
            ++choice_.drawn.beyond_frustum;
            kept_.answers[number] = Answer::hidden;
            return;
        }
        const bool is_read = clusters_.use_part(number) != nullptr;
        if (!is_read) choice_.groups_wanted.push_back(number);
        if (view_.stands(group)) {
            kept_.answers[number] = Answer::stands;
        } else {
            kept_.answers[number] = is_read ? Answer::open : Answer::unread;
            ++choice_.drawn.groups_opened;
            if (is_read) kept_.next.push_back(number);
        }
    }

    [[nodiscard]] static bool is_seen(const Met& met) { return met.seen == ClusterView::Seen::yes; }
    [[nodiscard]] static bool lacks(const Met& met) { return is_seen(met) && !met.is_here; }
    // Of the cut that the rule asks for, as far as groups are read.
    [[nodiscard]] bool is_of_cut(const Met& met) const {
        return met.maker == no_group || answer(met.maker) == Answer::stands ||
               answer(met.maker) == Answer::unread;
    }
    void find_here() {
        for (Met& met : kept_.met) met.is_here = is_seen(met) && is_here_(met.cluster);
    }

    // A cluster is met once. Numbers of those that are not met mean nothing.
    void number_met() {
        for (std::size_t i = 0; i < kept_.met.size(); ++i) {
            const std::uint32_t cluster = kept_.met[i].cluster;
            if (cluster >= kept_.met_numbers.size()) kept_.met_numbers.resize(cluster + std::size_t{1});
            kept_.met_numbers[cluster] = static_cast<std::uint32_t>(i);
        }
    }
    [[nodiscard]] const Met* find_met(std::uint32_t cluster) const {
        if (cluster >= kept_.met_numbers.size()) return nullptr;
        const std::uint32_t number = kept_.met_numbers[cluster];
        if (number >= kept_.met.size() || kept_.met[number].cluster != cluster) return nullptr;
        return &kept_.met[number];
    }

    // A group that uses what this one made and was not asked has none above it in view, or an unread one.
    [[nodiscard]] bool deselected(std::uint32_t user) const {
        if (user == no_group || answer(user) == Answer::open || answer(user) == Answer::hidden) return true;
        return answer(user) == Answer::no && view_.is_beyond_frustum(clusters_.groups()[user]);
    }
    [[nodiscard]] bool may_open(const Opened& opened) const {
        const GroupPart& part = *clusters_.read_part(opened.group);
        std::uint32_t last = no_group;  // most are used by the same group as that before
        for (const Cluster& made : part.made)
            if (made.used_by != last && !deselected(last = made.used_by)) return false;
        return std::none_of(kept_.met.begin() + static_cast<std::ptrdiff_t>(opened.first),
                            kept_.met.begin() + static_cast<std::ptrdiff_t>(opened.last),
                            [&](const Met& met) { return lacks(met) && is_of_cut(met); });
    }
    void close(std::uint32_t group) {
        kept_.answers[group] = Answer::closed;
        kept_.closing.push_back(group);
    }

    // Of each cluster that was met what is known of it, or of what is drawn in its place. A group shows where
    // any does that it made, and is hidden where one is and none shows.
    void find_sights(const ShownClusters& shown) {
        for (const auto& [cluster, shows] : shown) {
            if (cluster >= kept_.reported.size())
                kept_.reported.resize(cluster + std::size_t{1}, Sight::unknown);
            kept_.reported[cluster] = shows ? Sight::shows : Sight::hidden;
        }
        for (const Met& met : kept_.met) {
            Sight sight = met.cluster < kept_.reported.size() ? kept_.reported[met.cluster] : Sight::unknown;
            if (sight == Sight::unknown && is_seen(met))
                sight = met.user != no_group && kept_.group_sights[met.user] == Sight::hidden ? Sight::hidden
                                                                                              : Sight::shows;
            kept_.sights.push_back(sight);
            if (met.maker != no_group)
                kept_.group_sights[met.maker] = std::max(kept_.group_sights[met.maker], sight);
        }
        for (const auto& [cluster, shows] : shown) kept_.reported[cluster] = Sight::unknown;
        add_needed();
    }

    // What shows comes with what must be here before it may be drawn: all that the groups use that give way
    // with its own. Of what is below that no more.
    void add_needed() {
        const std::vector<Met>& met = kept_.met;
        for (std::size_t i = met.size(); i-- > 0;) {
            const std::uint32_t maker = met[i].maker, user = met[i].user;
            const bool deselected =
                maker != no_group && answer(maker) != Answer::stands && kept_.needed[maker] != 0;
            if (user != no_group && (deselected || kept_.sights[i] == Sight::shows)) kept_.needed[user] = 1;
        }
        for (std::size_t i = 0; i < met.size(); ++i) {
            if (met[i].user == no_group || kept_.needed[met[i].user] == 0) continue;
            kept_.sights[i] = Sight::shows;
            if (met[i].maker != no_group) kept_.group_sights[met[i].maker] = Sight::shows;
        }
    }

    void want(std::size_t room, const ShownClusters& shown) {
        // Where nothing is known nothing is hidden.
        const bool any_known = !shown.empty();
        if (any_known) find_sights(shown);
        std::vector<const Met*> hidden;
        std::size_t left = room - std::min(room, in_cut_);
        for (std::size_t i = 0; i < kept_.met.size(); ++i) {
            const Met& met = kept_.met[i];
            if (!is_seen(met)) continue;
            const bool of_cut = is_of_cut(met);
            if (of_cut && lacks(met)) ++choice_.missing;
            // Nobody can send what was not read.
            if (met.maker != no_group && clusters_.read_part(met.maker) == nullptr) continue;
            if (!of_cut && met.user != no_group) {
                if (left == 0) continue;
                --left;
            }
            if (any_known && kept_.sights[i] == Sight::hidden)
                hidden.push_back(&met);
            else
                add_wanted(met);
        }
        const std::size_t to_come = choice_.clusters_to_come.size();
        for (const Met* const met : hidden) add_wanted(*met);
        choice_.clusters_hidden = hidden.size();
        choice_.to_come_hidden = choice_.clusters_to_come.size() - to_come;
        std::vector<std::uint32_t>& wanted = choice_.groups_wanted;
        const auto seen_end = std::stable_partition(wanted.begin(), wanted.end(), [&](std::uint32_t group) {
            return kept_.group_sights[group] != Sight::hidden;
        });
        choice_.groups_hidden = static_cast<std::size_t>(wanted.end() - seen_end);
        for (const std::uint32_t group : kept_.asked)
            choice_.missing += answer(group) == Answer::unread || answer(group) == Answer::closed ? 1U : 0U;
    }
    void add_wanted(const Met& met) {
        choice_.clusters_wanted.push_back(met.cluster);
        if (!met.is_here) choice_.clusters_to_come.push_back(met.cluster);
    }

    RegionClusters& clusters_;
    const ClusterView& view_;
    const IsClusterHere& is_here_;
    StreamedChoiceMemory::Kept& kept_;
    std::size_t in_cut_{};
    StreamedChoice choice_;
};

}  // namespace

StreamedChoiceMemory::StreamedChoiceMemory() : kept_(std::make_unique<Kept>()) {}
StreamedChoiceMemory::StreamedChoiceMemory(StreamedChoiceMemory&&) noexcept = default;
StreamedChoiceMemory& StreamedChoiceMemory::operator=(StreamedChoiceMemory&&) noexcept = default;
StreamedChoiceMemory::~StreamedChoiceMemory() = default;

Result<StreamedChoice> select_resident_cut(RegionClusters& clusters, const ClusterView& view,
                                           std::size_t room, const IsClusterHere& is_here,
                                           const ShownClusters& shown, StreamedChoiceMemory* memory,
                                           LackingCut lacking) {
    StreamedChoiceMemory own;
    StreamedChoiceMemory::Kept& kept = memory != nullptr ? memory->kept() : own.kept();
    std::size_t without_room = 0;
    {
        StreamedCut cut(clusters, view, is_here, kept);
        cut.walk();
        if (cut.in_cut() <= room) {
            cut.close_what_lacks();
            return cut.take(room, shown, lacking);
        }
        without_room = cut.in_cut() - room;
    }
    const ClusterView coarser = view.coarser(coarser_steps_until([&](unsigned steps) {
        const ClusterView asked = view.coarser(steps);
        StreamedCut cut(clusters, asked, is_here, kept);
        cut.walk();
        return cut.in_cut() <= room;
    }));
    StreamedCut fitting(clusters, coarser, is_here, kept);
    fitting.walk();
    fitting.close_what_lacks();
    ORO_TRY(StreamedChoice choice, fitting.take(room, shown, LackingCut::is_drawn));
    choice.without_room = without_room;
    choice.missing = std::max(choice.missing, without_room);
    return choice;
}

}  // namespace oro
