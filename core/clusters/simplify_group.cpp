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

// Those beside it in the ring are there already.
bool GroupSimplifier::makes_long_edge(int target) const {
    const SurfaceVertex& to = offsets_[at(target)];
    return std::any_of(offsets_.begin(), offsets_.end(), [&](const SurfaceVertex& from) {
        return std::abs(from.row - to.row) > edges_.rows ||
               std::abs(from.column - to.column) > edges_.columns;
    });
}

// A trial is possible where all new triangles have an area; the one that covers the vertex says what the
// trial costs at least. Areas come from those of triangles with the vertex itself.
void GroupSimplifier::add_trial(const SurfaceVertex& middle, int target, double below) {
    if (makes_long_edge(target)) return;
    const int count = ring_.count(), triangles = ring_.triangles();
    const SurfaceVertex& to = offsets_[at(target)];
    double least = 0.0;
    std::int64_t to_a = cross(to, offsets_[0]);
    for (int i = 0; i < triangles; ++i) {
        const int j = i + 1 == count ? 0 : i + 1;
        const std::int64_t to_b = cross(to, offsets_[at(j)]);
        if (i != target && j != target) {
            const std::int64_t a_b = cross(offsets_[at(i)], offsets_[at(j)]);
            const std::int64_t area = to_a + a_b - to_b;
            if (area <= 0) return;
            if (to_a >= 0 && to_b <= 0) {
                const auto rise = [&](int vertex) {
                    return static_cast<double>(around_[at(vertex)].steps) - middle.steps;
                };
                least = std::abs(static_cast<double>(a_b) * rise(target) +
                                 static_cast<double>(to_a) * rise(j) - static_cast<double>(to_b) * rise(i)) /
                        static_cast<double>(area);
            }
        }
        to_a = to_b;
    }
    if (least < below) trials_.push_back({least, target});
}

double GroupSimplifier::chord_difference(int from, int to, double limit) {
    if (from > to) std::swap(from, to);
    double& known = chords_[at(from * ring_.count() + to)];
    if (known < 0.0) {
        known = surface_.edge_difference(around_[at(from)], around_[at(to)], limit);
    }
    return known;
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
    mesh.ring_of(vertex, ring_);
    const SurfaceVertex& middle = mesh.place(vertex);
    around_.clear();
    offsets_.clear();
    for (const int other : ring_.vertices) {
        const SurfaceVertex& place = mesh.place(other);
        around_.push_back(place);
        offsets_.push_back({place.row - middle.row, place.column - middle.column, 0});
    }
    trials_.clear();
    if (ring_.on_rim) {
        if (ring_.triangles() < 2 || twice_area(around_.front(), middle, around_.back()) != 0)
            return {below, none};
        add_trial(middle, 0, below);
        add_trial(middle, ring_.count() - 1, below);
    } else {
        for (int target = 0; target < ring_.count(); ++target) add_trial(middle, target, below);
    }
    std::sort(trials_.begin(), trials_.end());
    if (trials_.empty()) return {below, none};
    chords_.assign(at(ring_.count() * ring_.count()), -1.0);
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
    outdated_.assign(at(mesh.vertices()), 0);
    slot_.assign(at(mesh.vertices()), none);
    queue_.clear();
    for (int vertex = 0; vertex < mesh.vertices(); ++vertex) {
        if (mesh.is_locked(vertex)) continue;
        cost_[at(vertex)] = best_choice(mesh, vertex, never).difference;
        queue_.push_back(vertex);
        sift_up(static_cast<int>(queue_.size()) - 1);
    }
}

void GroupSimplifier::simplify(GroupMesh& mesh, const Aim& aim) {
    edges_ = aim.edges;
    fill_queue(mesh);
    const auto most = static_cast<int>(aim.most_share * static_cast<double>(queue_.size()));
    double reached = aim.free_difference;
    for (int collapses = 0; !queue_.empty();) {
        const int vertex = queue_.front();
        const double cost = cost_[at(vertex)];
        const double limit = mesh.triangles() > aim.triangles && collapses < most ? aim.limit : reached;
        if (cost == never || cost > limit) return;
        const Choice choice = best_choice(mesh, vertex, never);
        if (outdated_[at(vertex)] != 0) {
            outdated_[at(vertex)] = 0;
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
