#include "core/clusters/simplify_group.h"

#include <algorithm>
#include <cmath>

namespace oro {
namespace {

constexpr double never = OriginalSurface::no_limit;

std::size_t at(int number) {
    return static_cast<std::size_t>(number);
}

// How far a triangle passes from a vertex that lies in it on the map.
double difference_at(const SurfaceVertex& a, const SurfaceVertex& b, const SurfaceVertex& c,
                     const SurfaceVertex& at) {
    const auto of_a = static_cast<double>(twice_area(b, c, at));
    const auto of_b = static_cast<double>(twice_area(c, a, at));
    const auto of_c = static_cast<double>(twice_area(a, b, at));
    return std::abs(of_a * (static_cast<double>(a.steps) - at.steps) +
                    of_b * (static_cast<double>(b.steps) - at.steps) +
                    of_c * (static_cast<double>(c.steps) - at.steps)) /
           (of_a + of_b + of_c);
}

}  // namespace

// A trial is possible where all new triangles have an area; the one that covers the vertex says what the
// trial costs at least.
void GroupSimplifier::add_trial(const SurfaceVertex& middle, int target) {
    const int count = ring_.count(), triangles = ring_.triangles();
    const SurfaceVertex& to = around_[at(target)];
    double least = 0.0;
    for (int i = 0; i < triangles; ++i) {
        const int j = i + 1 == count ? 0 : i + 1;
        if (i == target || j == target) continue;
        const SurfaceVertex &a = around_[at(i)], &b = around_[at(j)];
        if (twice_area(to, a, b) <= 0) return;
        if (twice_area(to, a, middle) >= 0 && twice_area(to, middle, b) >= 0)
            least = difference_at(to, a, b, middle);
    }
    trials_.push_back({least, target});
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
        const bool beside = apart <= 1 || (apart == count - 1 && !ring_.on_rim);
        if (beside) continue;
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

GroupSimplifier::Choice GroupSimplifier::best_choice(const GroupMesh& mesh, int vertex) {
    mesh.ring_of(vertex, ring_);
    const SurfaceVertex& middle = mesh.place(vertex);
    around_.clear();
    for (const int other : ring_.vertices) around_.push_back(mesh.place(other));
    trials_.clear();
    if (ring_.on_rim) {
        if (ring_.triangles() < 2 || twice_area(around_.front(), middle, around_.back()) != 0)
            return {never, none};
        add_trial(middle, 0);
        add_trial(middle, ring_.count() - 1);
    } else {
        for (int target = 0; target < ring_.count(); ++target) add_trial(middle, target);
    }
    std::sort(trials_.begin(), trials_.end());
    chords_.assign(at(ring_.count() * ring_.count()), -1.0);
    Choice best{never, none};
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
        cost_[at(vertex)] = best_choice(mesh, vertex).difference;
        queue_.push_back(vertex);
        sift_up(static_cast<int>(queue_.size()) - 1);
    }
}

void GroupSimplifier::simplify(GroupMesh& mesh, const Aim& aim) {
    fill_queue(mesh);
    const auto most = static_cast<int>(aim.most_share * static_cast<double>(queue_.size()));
    double reached = aim.free_difference;
    for (int collapses = 0; !queue_.empty();) {
        const int vertex = queue_.front();
        const double cost = cost_[at(vertex)];
        const double limit = mesh.triangles() > aim.triangles && collapses < most ? aim.limit : reached;
        if (cost == never || cost > limit) return;
        const Choice choice = best_choice(mesh, vertex);
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
        for (const int other : ring_.vertices) {
            if (slot_[at(other)] == none) continue;
            outdated_[at(other)] = 1;
            if (cost_[at(other)] == never) change_cost(other, choice.difference);
        }
    }
}

}  // namespace oro
