#include "core/clusters/simplify_group.h"

#include <algorithm>
#include <cmath>

namespace oro {
namespace {

constexpr double never = OriginalSurface::no_limit;

std::size_t at(int number) {
    return static_cast<std::size_t>(number);
}

// Twice the area between two places and the vertex that their offsets are from.
std::int64_t cross(const SurfaceVertex& a, const SurfaceVertex& b) {
    return std::int64_t{a.column} * b.row - std::int64_t{a.row} * b.column;
}

}  // namespace

void GroupSimplifier::look_around(const GroupMesh& mesh, int vertex) {
    mesh.ring_of(vertex, ring_);
    const SurfaceVertex& middle = mesh.place(vertex);
    around_.clear();
    offsets_.clear();
    areas_.clear();
    for (const int other : ring_.vertices) {
        const SurfaceVertex& place = mesh.place(other);
        around_.push_back(place);
        offsets_.push_back({place.row - middle.row, place.column - middle.column, place.steps});
    }
    least_ = most_ = offsets_.front();
    for (const SurfaceVertex& offset : offsets_) {
        least_.row = std::min(least_.row, offset.row);
        least_.column = std::min(least_.column, offset.column);
        most_.row = std::max(most_.row, offset.row);
        most_.column = std::max(most_.column, offset.column);
    }
    for (int i = 0; i < ring_.triangles(); ++i)
        areas_.push_back(cross(offsets_[at(i)], offsets_[at(i + 1 == ring_.count() ? 0 : i + 1)]));
}

// Those beside it in the ring are there already.
bool GroupSimplifier::makes_long_edge(const SurfaceVertex& to) const {
    return std::max(most_.row - to.row, to.row - least_.row) > edges_.rows ||
           std::max(most_.column - to.column, to.column - least_.column) > edges_.columns;
}

// A trial is possible where all new triangles have an area; the one that covers the vertex says what the
// trial costs at least. Areas come from those of triangles with the vertex itself.
void GroupSimplifier::add_trial(int target, double below) {
    const SurfaceVertex& to = offsets_[at(target)];
    if (makes_long_edge(to)) return;
    const int count = ring_.count(), triangles = ring_.triangles();
    int covering = none;
    std::int64_t to_covering{}, from_covering{};
    std::int64_t to_a = cross(to, offsets_[0]);
    for (int i = 0; i < triangles; ++i) {
        const int j = i + 1 == count ? 0 : i + 1;
        const std::int64_t to_b = cross(to, offsets_[at(j)]);
        if (i != target && j != target) {
            if (to_a + areas_[at(i)] - to_b <= 0) return;
            if (to_a >= 0 && to_b <= 0) {
                covering = i;
                to_covering = to_a;
                from_covering = to_b;
            }
        }
        to_a = to_b;
    }
    double least = 0.0;
    if (covering != none) {
        const int next = covering + 1 == count ? 0 : covering + 1;
        const std::int64_t area = to_covering + areas_[at(covering)] - from_covering;
        const auto rise = [&](int vertex) {
            return static_cast<double>(offsets_[at(vertex)].steps) - middle_steps_;
        };
        least = std::abs(static_cast<double>(areas_[at(covering)]) * rise(target) +
                         static_cast<double>(to_covering) * rise(next) -
                         static_cast<double>(from_covering) * rise(covering)) /
                static_cast<double>(area);
    }
    if (least < below) trials_.push_back({least, target});
}

double GroupSimplifier::chord_difference(int from, int to, double limit) {
    if (from > to) std::swap(from, to);
    const KnownDifferences::Key key{ring_.vertices[at(from)], ring_.vertices[at(to)]};
    return chords_.find(key, limit,
                        [&] { return surface_.edge_difference(around_[at(from)], around_[at(to)], limit); });
}

double GroupSimplifier::trial_difference(int target, double limit) {
    const int count = ring_.count(), triangles = ring_.triangles();
    double largest = 0.0;
    for (int i = 0; i < count; ++i) {
        const int apart = std::abs(i - target);
        const bool adjacent = apart <= 1 || (apart == count - 1 && !ring_.on_rim);
        if (adjacent) continue;
        largest = std::max(largest, chord_difference(target, i, limit));
        if (largest > limit) return largest;
    }
    for (int i = 0; i < triangles; ++i) {
        const int j = i + 1 == count ? 0 : i + 1;
        if (i == target || j == target) continue;
        largest = std::max(
            largest, surface_.inner_difference(around_[at(target)], around_[at(i)], around_[at(j)], limit));
        if (largest > limit) return largest;
    }
    return largest;
}

GroupSimplifier::Choice GroupSimplifier::best_choice(const GroupMesh& mesh, int vertex, double below) {
    look_around(mesh, vertex);
    const SurfaceVertex& middle = mesh.place(vertex);
    middle_steps_ = static_cast<double>(middle.steps);
    trials_.clear();
    if (ring_.on_rim) {
        if (ring_.triangles() < 2 || twice_area(around_.front(), middle, around_.back()) != 0)
            return {below, none};
        add_trial(0, below);
        add_trial(ring_.count() - 1, below);
    } else {
        for (int target = 0; target < ring_.count(); ++target) add_trial(target, below);
    }
    std::sort(trials_.begin(), trials_.end());
    Choice best{below, none};
    for (const Trial& trial : trials_) {
        if (trial.least >= best.difference) break;
        const double difference = std::max(trial.least, trial_difference(trial.target, best.difference));
        if (difference < best.difference) best = {difference, trial.target};
    }
    return best;
}

void GroupSimplifier::sift_up(int slot) {
    const int vertex = queue_[at(slot)];
    while (slot > 0 && sooner(vertex, queue_[at((slot - 1) / 2)])) {
        queue_[at(slot)] = queue_[at((slot - 1) / 2)];
        slot_[at(queue_[at(slot)])] = slot;
        slot = (slot - 1) / 2;
    }
    queue_[at(slot)] = vertex;
    slot_[at(vertex)] = slot;
}

void GroupSimplifier::sift_down(int slot) {
    const int vertex = queue_[at(slot)];
    const int count = static_cast<int>(queue_.size());
    for (int below = 2 * slot + 1; below < count; below = 2 * slot + 1) {
        if (below + 1 < count && sooner(queue_[at(below + 1)], queue_[at(below)])) ++below;
        if (!sooner(queue_[at(below)], vertex)) break;
        queue_[at(slot)] = queue_[at(below)];
        slot_[at(queue_[at(slot)])] = slot;
        slot = below;
    }
    queue_[at(slot)] = vertex;
    slot_[at(vertex)] = slot;
}

void GroupSimplifier::take_first() {
    slot_[at(queue_.front())] = none;
    const int last = queue_.back();
    queue_.pop_back();
    if (queue_.empty()) return;
    queue_.front() = last;
    sift_down(0);
}

void GroupSimplifier::change_cost(int vertex, double cost) {
    const bool grows = cost > cost_[at(vertex)];
    cost_[at(vertex)] = cost;
    if (grows)
        sift_down(slot_[at(vertex)]);
    else
        sift_up(slot_[at(vertex)]);
}

void GroupSimplifier::fill_queue(const GroupMesh& mesh) {
    cost_.assign(at(mesh.vertices()), never);
    target_.assign(at(mesh.vertices()), none);
    outdated_.assign(at(mesh.vertices()), 0);
    slot_.assign(at(mesh.vertices()), none);
    queue_.clear();
    for (int vertex = 0; vertex < mesh.vertices(); ++vertex) {
        if (mesh.is_locked(vertex)) continue;
        const Choice choice = best_choice(mesh, vertex, never);
        cost_[at(vertex)] = choice.difference;
        target_[at(vertex)] = choice.target;
        queue_.push_back(vertex);
        sift_up(static_cast<int>(queue_.size()) - 1);
    }
}

void GroupSimplifier::simplify(GroupMesh& mesh, const Aim& aim) {
    edges_ = aim.edges;
    chords_.forget();
    fill_queue(mesh);
    const auto most = static_cast<int>(aim.most_share * static_cast<double>(queue_.size()));
    double reached = aim.free_difference;
    for (int collapses = 0; !queue_.empty();) {
        const int vertex = queue_.front();
        const double cost = cost_[at(vertex)];
        const double limit = mesh.triangles() > aim.triangles && collapses < most ? aim.limit : reached;
        if (cost == never || cost > limit) return;
        Choice choice{cost, target_[at(vertex)]};
        if (outdated_[at(vertex)] == 0) {
            mesh.ring_of(vertex, ring_);
        } else {
            choice = best_choice(mesh, vertex, never);
            outdated_[at(vertex)] = 0;
            target_[at(vertex)] = choice.target;
            if (choice.difference > cost) {
                change_cost(vertex, choice.difference);
                if (queue_.front() != vertex || choice.difference > limit || choice.target == none) continue;
            }
        }
        reached = std::max(reached, choice.difference);
        take_first();
        mesh.collapse(vertex, ring_, choice.target);
        ++collapses;
        touched_.clear();
        for (const int other : ring_.vertices) {
            if (slot_[at(other)] == none) continue;
            touched_.push_back(other);
        }
        // From now on their costs are no more than they truly are.
        for (const int other : touched_) {
            outdated_[at(other)] = 1;
            const double sooner_now = best_choice(mesh, other, cost_[at(other)]).difference;
            if (sooner_now < cost_[at(other)]) change_cost(other, sooner_now);
        }
    }
}

}  // namespace oro
