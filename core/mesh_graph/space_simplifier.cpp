#include "core/mesh_graph/space_simplifier.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <utility>

namespace oro {
namespace {

constexpr double no_limit = std::numeric_limits<double>::infinity();
constexpr std::uint32_t no_target = ~std::uint32_t{0};
// Triangles less than so high, as a share of their length, are not made; nor such as turn by more.
constexpr double least_height = 1.0e-4, least_cosine = 0.2;
// Of its diagonal that a part costs at least where it is dropped onto the ground.
constexpr double share_of_diagonal = 0.25;

// The largest squared distance of places from some triangles, at least from2; once it is above stop2, enough.
ORO_WIDE double farthest2(const TriangleBlock* blocks, std::size_t count, const glm::dvec3* places,
                          std::size_t place_count, double from2, double stop2) {
    double most2 = from2;
    for (std::size_t i = 0; i < place_count && most2 <= stop2; ++i) {
        double least2 = no_limit;
        for (std::size_t k = 0; k < count && least2 > most2; ++k) {
            FourDoubles d2;
            blocks[k].distances2(places[i], d2);
            for (int lane = 0; lane < 4; ++lane) least2 = d2[lane] < least2 ? d2[lane] : least2;
        }
        if (least2 > most2) most2 = least2;
    }
    return most2;
}

bool has(const LevelTriangle& triangle, std::uint32_t corner) {
    return triangle.corners[0] == corner || triangle.corners[1] == corner || triangle.corners[2] == corner;
}

std::vector<TriangleBlock> blocks_of(std::span<const std::array<glm::dvec3, 3>> triangles) {
    std::vector<TriangleBlock> blocks;
    for (std::size_t i = 0; i < triangles.size(); i += 4)
        blocks.emplace_back(&triangles[i], static_cast<int>(std::min<std::size_t>(4, triangles.size() - i)));
    return blocks;
}

}  // namespace

bool SpaceSimplifier::Ring::is_rim() const {
    return std::find(shared.begin(), shared.end(), 1) != shared.end();
}

void SpaceSimplifier::begin(std::vector<LevelTriangle> triangles) {
    triangles_ = std::move(triangles);
    std::unordered_map<std::uint32_t, std::uint32_t> numbers;
    numbers.reserve(triangles_.size());
    for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
        for (std::uint32_t& corner : triangles_[i].corners) {
            const auto [found, is_new] =
                numbers.try_emplace(corner, static_cast<std::uint32_t>(vertices_.size()));
            if (is_new) vertices_.push_back(corner), around_.emplace_back();
            corner = found->second;
            around_[corner].push_back(i);
        }
    }
    count_ = triangles_.size();
    alive_.assign(count_, 1);
    const std::size_t vertices = vertices_.size();
    stays_.assign(vertices, 0), gone_.assign(vertices, 0), stale_.assign(vertices, 0);
    checked_.assign(vertices, 0), cost_m_.assign(vertices, no_limit), target_.assign(vertices, no_target);
}

void SpaceSimplifier::ring_of(std::uint32_t vertex, Ring& ring) {
    ring.neighbours.clear(), ring.shared.clear(), ring.is_fan = false;
    bool is_crowded = false;
    for (const std::uint32_t triangle : around_[vertex]) {
        for (const std::uint32_t corner : triangles_[triangle].corners) {
            if (corner == vertex) continue;
            const auto found = std::find(ring.neighbours.begin(), ring.neighbours.end(), corner);
            if (found == ring.neighbours.end()) {
                ring.neighbours.push_back(corner), ring.shared.push_back(1);
            } else if (++ring.shared[static_cast<std::size_t>(found - ring.neighbours.begin())] > 2) {
                is_crowded = true;
            }
        }
    }
    const auto rim = std::count(ring.shared.begin(), ring.shared.end(), 1);
    if (is_crowded || (rim != 0 && rim != 2)) return;
    if (around_[vertex].size() + (rim != 0 ? 1 : 0) != ring.neighbours.size()) return;
    ring.is_fan = is_one_fan(vertex);
}

// Whether one triangle's neighbours, and theirs, are all that there are.
bool SpaceSimplifier::is_one_fan(std::uint32_t vertex) {
    std::vector<std::uint32_t>& all = around_[vertex];
    std::size_t reached = 1;
    for (std::size_t i = 0; i < reached && reached < all.size(); ++i) {
        for (std::size_t k = reached; k < all.size(); ++k) {
            int shared = 0;
            for (const std::uint32_t corner : triangles_[all[k]].corners)
                shared += corner != vertex && has(triangles_[all[i]], corner) ? 1 : 0;
            if (shared > 0) std::swap(all[k], all[reached++]);
        }
    }
    return reached >= all.size();
}

bool SpaceSimplifier::are_adjacent(std::uint32_t a, std::uint32_t b) const {
    return std::any_of(around_[a].begin(), around_[a].end(),
                       [&](std::uint32_t triangle) { return has(triangles_[triangle], b); });
}

bool SpaceSimplifier::may_collapse(std::uint32_t vertex, std::uint32_t onto, const Ring& ring) const {
    if (!ring.is_fan) return may_collapse_fans(vertex, onto, ring);
    const auto found = std::find(ring.neighbours.begin(), ring.neighbours.end(), onto);
    const int shared = ring.shared[static_cast<std::size_t>(found - ring.neighbours.begin())];
    if (ring.is_rim() && shared != 1) return false;
    int common = 0;
    for (const std::uint32_t other : ring.neighbours) {
        if (other == onto) continue;
        const bool adjacent = are_adjacent(other, onto);
        common += adjacent ? 1 : 0;
        if (!adjacent && stays_[onto] != 0 && stays_[other] != 0) return false;
    }
    return common == shared;
}

// Where several fans or sheets meet. They stay joined, for all of them go with the vertex; no edge gets more
// triangles than one of those that it is made of has, none becomes a rim, and no triangle is there twice.
bool SpaceSimplifier::may_collapse_fans(std::uint32_t vertex, std::uint32_t onto, const Ring& ring) const {
    const auto has_both = [&](std::uint32_t triangle, std::uint32_t a, std::uint32_t b) {
        return has(triangles_[triangle], a) && has(triangles_[triangle], b);
    };
    const bool is_rim = ring.is_rim();
    for (std::size_t i = 0; i < ring.neighbours.size(); ++i) {
        const std::uint32_t other = ring.neighbours[i];
        if (other == onto) {
            if (is_rim && ring.shared[i] != 1) return false;
            continue;
        }
        const bool is_border = stays_[onto] != 0 && stays_[other] != 0;
        const auto there =
            static_cast<int>(std::count_if(around_[onto].begin(), around_[onto].end(),
                                           [&](std::uint32_t k) { return has(triangles_[k], other); }));
        if (there == 0) {
            if (is_border) return false;
            continue;
        }
        const auto common =
            static_cast<int>(std::count_if(around_[vertex].begin(), around_[vertex].end(),
                                           [&](std::uint32_t k) { return has_both(k, onto, other); }));
        const int after = ring.shared[i] + there - 2 * common;
        if (common == 0 || after > std::max({2, ring.shared[i], there})) return false;
        if (after == 1 && ring.shared[i] != 1 && there != 1) return false;
        if (is_border && after != there) return false;
    }
    return std::none_of(around_[vertex].begin(), around_[vertex].end(), [&](std::uint32_t k) {
        if (has(triangles_[k], onto)) return false;
        std::array<std::uint32_t, 2> side{};
        std::size_t count = 0;
        for (const std::uint32_t corner : triangles_[k].corners)
            if (corner != vertex) side[count++] = corner;
        return std::any_of(around_[onto].begin(), around_[onto].end(),
                           [&](std::uint32_t there) { return has_both(there, side[0], side[1]); });
    });
}

bool SpaceSimplifier::make_fan(std::uint32_t vertex, std::uint32_t onto) {
    fan_.clear();
    for (const std::uint32_t number : around_[vertex]) {
        const LevelTriangle& triangle = triangles_[number];
        if (has(triangle, onto)) continue;
        std::array<glm::dvec3, 3> before{}, after{};
        for (std::size_t i = 0; i < 3; ++i) {
            before[i] = at(triangle.corners[i]);
            after[i] = triangle.corners[i] == vertex ? at(onto) : before[i];
        }
        const glm::dvec3 one = glm::cross(before[1] - before[0], before[2] - before[0]),
                         other = glm::cross(after[1] - after[0], after[2] - after[0]);
        const double area = glm::length(one), new_area = glm::length(other);
        const auto side2 = [&](std::size_t i, std::size_t k) {
            return glm::dot(after[i] - after[k], after[i] - after[k]);
        };
        if (new_area < least_height * std::max({side2(0, 1), side2(1, 2), side2(2, 0)})) return false;
        if (area > 1.0e-6 && glm::dot(one, other) < least_cosine * area * new_area) return false;
        fan_.push_back(after);
    }
    if (fan_.empty()) return false;
    fan_blocks_ = blocks_of(fan_);
    return true;
}

double SpaceSimplifier::cost_to_new(std::uint32_t vertex, double stop_m) const {
    const double stop2 = stop_m * stop_m;
    double most2 = farthest2(fan_blocks_.data(), fan_blocks_.size(), &at(vertex), 1, 0.0, stop2);
    for (const std::uint32_t number : around_[vertex]) {
        if (most2 > stop2) break;
        const std::vector<glm::dvec3>& samples = triangles_[number].samples;
        most2 =
            farthest2(fan_blocks_.data(), fan_blocks_.size(), samples.data(), samples.size(), most2, stop2);
    }
    return std::sqrt(most2);
}

// At points half a spacing apart along new edges, and less close within the new triangles.
double SpaceSimplifier::cost_to_mesh(std::uint32_t vertex, std::uint32_t onto, double from_m, double stop_m) {
    double most2 = from_m * from_m;
    const double end2 = 1.11 * stop_m * stop_m;
    std::uint32_t hint = NearestTriangles::nothing;
    const auto ask = [&](const glm::dvec3& place) {
        const NearestTriangles::Near near = mesh_.within(place, most2, no_limit, hint);
        hint = near.place, most2 = std::max(most2, near.distance2);
    };
    const glm::dvec3& tip = at(onto);
    std::vector<std::uint32_t> seen;
    for (const std::uint32_t number : around_[vertex]) {
        const LevelTriangle& triangle = triangles_[number];
        if (has(triangle, onto)) continue;
        std::array<glm::dvec3, 2> ends{};
        std::size_t count = 0;
        for (const std::uint32_t corner : triangle.corners) {
            if (corner == vertex) continue;
            ends[count++] = at(corner);
            if (std::find(seen.begin(), seen.end(), corner) != seen.end()) continue;
            seen.push_back(corner);
            const int parts =
                std::clamp(static_cast<int>(2.0 * glm::distance(at(corner), tip) / limits_.spacing_m), 2, 10);
            for (int i = 1; i < parts; ++i) ask(tip + (at(corner) - tip) * (static_cast<double>(i) / parts));
            if (most2 > end2) return no_limit;
        }
        const double longest = std::max(
            {glm::distance(ends[0], tip), glm::distance(ends[1], tip), glm::distance(ends[0], ends[1])});
        const int parts = std::clamp(static_cast<int>(1.5 * longest / limits_.spacing_m), 3, 6);
        for (int i = 1; i < parts; ++i)
            for (int k = 1; i + k < parts; ++k)
                ask(tip + (ends[0] - tip) * (static_cast<double>(i) / parts) +
                    (ends[1] - tip) * (static_cast<double>(k) / parts));
        if (most2 > end2) return no_limit;
    }
    return std::sqrt(most2);
}

void SpaceSimplifier::evaluate(std::uint32_t vertex) {
    cost_m_[vertex] = no_limit, target_[vertex] = no_target, stale_[vertex] = 0, checked_[vertex] = 0;
    if (stays_[vertex] != 0 || gone_[vertex] != 0 || around_[vertex].empty()) return;
    ring_of(vertex, ring_);
    double shortest2 = 0.0;
    for (const std::uint32_t onto : ring_.neighbours) {
        if (!may_collapse(vertex, onto, ring_) || !make_fan(vertex, onto)) continue;
        const double cost = cost_to_new(vertex, cost_m_[vertex]);
        const glm::dvec3 way = at(onto) - at(vertex);
        const double length2 = glm::dot(way, way);
        if (cost > cost_m_[vertex] || (cost == cost_m_[vertex] && length2 >= shortest2)) continue;
        cost_m_[vertex] = cost, target_[vertex] = onto, shortest2 = length2;
    }
}

bool SpaceSimplifier::check_both_ways(std::uint32_t vertex, double most_m) {
    ring_of(vertex, ring_);
    std::vector<std::pair<double, std::uint32_t>> targets;
    for (const std::uint32_t onto : ring_.neighbours) {
        if (!may_collapse(vertex, onto, ring_) || !make_fan(vertex, onto)) continue;
        const double cost = cost_to_new(vertex, most_m);
        if (cost <= most_m) targets.emplace_back(cost, onto);
    }
    std::sort(targets.begin(), targets.end());
    const double before = cost_m_[vertex];
    cost_m_[vertex] = no_limit, target_[vertex] = no_target, checked_[vertex] = 1;
    for (const auto& [cost, onto] : targets) {
        if (cost >= cost_m_[vertex]) break;
        const double from = std::max({cost, reached_m_, limits_.noise_m});
        const double both = cost_to_mesh(vertex, onto, from, std::min(cost_m_[vertex], most_m));
        if (both < cost_m_[vertex]) cost_m_[vertex] = both, target_[vertex] = onto;
    }
    return target_[vertex] != no_target && cost_m_[vertex] <= std::max(before, reached_m_);
}

void SpaceSimplifier::push(std::uint32_t vertex) {
    if (target_[vertex] == no_target) return;
    queue_.push_back({cost_m_[vertex], vertex});
    std::push_heap(queue_.begin(), queue_.end());
}

void SpaceSimplifier::run(std::size_t aim) {
    for (std::uint32_t i = 0; i < vertices_.size(); ++i) evaluate(i), push(i);
    reached_m_ = limits_.free_m;
    for (;;) {
        drop_onto_ground(queue_.empty() ? no_limit : queue_.front().cost_m, aim);
        if (queue_.empty()) break;
        std::pop_heap(queue_.begin(), queue_.end());
        const Queued next = queue_.back();
        queue_.pop_back();
        const std::uint32_t vertex = next.vertex;
        if (gone_[vertex] != 0 || next.cost_m != cost_m_[vertex]) continue;
        const double most = count_ > aim ? std::max(limits_.most_m, reached_m_) : reached_m_;
        if (stale_[vertex] != 0) {
            evaluate(vertex);
            if (cost_m_[vertex] > next.cost_m) {
                push(vertex);
                continue;
            }
        }
        if (target_[vertex] == no_target) continue;
        if (cost_m_[vertex] > most) break;
        if (checked_[vertex] == 0 && !check_both_ways(vertex, most)) {
            push(vertex);
            continue;
        }
        const std::uint32_t onto = target_[vertex];
        ring_of(vertex, ring_);
        if (!may_collapse(vertex, onto, ring_) || !make_fan(vertex, onto)) {
            evaluate(vertex), push(vertex);
            continue;
        }
        reached_m_ = std::max(reached_m_, cost_m_[vertex]);
        const std::vector<std::uint32_t> neighbours = ring_.neighbours;
        collapse(vertex, onto);
        for (const std::uint32_t other : neighbours) {
            if (gone_[other] != 0 || stays_[other] != 0) continue;
            stale_[other] = 1;
            if (target_[other] == no_target) evaluate(other), push(other);
        }
    }
}

void SpaceSimplifier::collapse(std::uint32_t vertex, std::uint32_t onto) {
    std::vector<std::uint32_t> kept;
    std::vector<glm::dvec3> samples{at(vertex)};
    for (const std::uint32_t number : around_[vertex]) {
        LevelTriangle& triangle = triangles_[number];
        samples.insert(samples.end(), triangle.samples.begin(), triangle.samples.end());
        triangle.samples.clear();
        if (!has(triangle, onto)) {
            kept.push_back(number);
            continue;
        }
        alive_[number] = 0, --count_;
        for (const std::uint32_t corner : triangle.corners)
            if (corner != vertex) std::erase(around_[corner], number);
    }
    for (const std::uint32_t number : kept) {
        LevelTriangle& triangle = triangles_[number];
        for (std::uint32_t& corner : triangle.corners)
            if (corner == vertex) corner = onto;
        triangle.from_original_m = -1.0;
        around_[onto].push_back(number);
    }
    around_[vertex].clear(), gone_[vertex] = 1;
    share_samples(samples, kept);
}

// Each goes to the nearest triangle, which keeps the farthest.
void SpaceSimplifier::share_samples(std::vector<glm::dvec3>& samples, std::span<const std::uint32_t> among) {
    fan_.clear();
    for (const std::uint32_t number : among)
        fan_.push_back({at(triangles_[number].corners[0]), at(triangles_[number].corners[1]),
                        at(triangles_[number].corners[2])});
    fan_blocks_ = blocks_of(fan_);
    using Far = std::pair<double, const glm::dvec3*>;
    std::vector<std::vector<Far>> shares(among.size());
    for (const glm::dvec3& sample : samples) {
        double least2 = no_limit;
        std::size_t nearest = 0;
        for (std::size_t i = 0; i < fan_.size(); ++i) {
            const double d2 = fan_blocks_[i / 4].distance2(static_cast<int>(i % 4), sample);
            if (d2 < least2) least2 = d2, nearest = i;
        }
        shares[nearest].emplace_back(least2, &sample);
    }
    for (std::size_t i = 0; i < among.size(); ++i) {
        std::vector<Far>& share = shares[i];
        if (share.size() > most_samples) {
            std::sort(share.begin(), share.end(), [](const Far& a, const Far& b) {
                return a.first != b.first ? a.first > b.first : a.second < b.second;
            });
            share.resize(most_samples);
        }
        for (const Far& far : share) triangles_[among[i]].samples.push_back(*far.second);
    }
}

// How far the samples of a part are from all else; no_limit where there is nothing else, or the border.
double SpaceSimplifier::cost_of_dropping(std::span<const std::uint32_t> part,
                                         const std::vector<std::uint32_t>& part_of,
                                         std::uint32_t number) const {
    std::vector<std::array<glm::dvec3, 3>> rest;
    for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
        if (alive_[i] == 0 || part_of[triangles_[i].corners[0]] == number) continue;
        rest.push_back(
            {at(triangles_[i].corners[0]), at(triangles_[i].corners[1]), at(triangles_[i].corners[2])});
    }
    if (rest.empty()) return no_limit;
    const NearestTriangles tree(rest);
    double most2 = 0.0;
    for (const std::uint32_t i : part) {
        for (const glm::dvec3& sample : triangles_[i].samples)
            most2 = std::max(most2, tree.nearest(sample).distance2);
        for (const std::uint32_t corner : triangles_[i].corners)
            most2 = std::max(most2, tree.nearest(at(corner)).distance2);
    }
    return std::sqrt(most2);
}

// Vertices that hang together, by the least of them.
SpaceSimplifier::Parts SpaceSimplifier::parts() {
    Parts found;
    std::vector<std::uint32_t>& part_of = found.of_vertex;
    part_of.resize(vertices_.size());
    for (std::uint32_t i = 0; i < part_of.size(); ++i) part_of[i] = i;
    const auto first = [&](std::uint32_t vertex) {
        while (part_of[vertex] != vertex) vertex = part_of[vertex] = part_of[part_of[vertex]];
        return vertex;
    };
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
        if (alive_[i] == 0) continue;
        for (const std::size_t k : {1U, 2U}) {
            const std::uint32_t a = first(triangles_[i].corners[0]), b = first(triangles_[i].corners[k]);
            part_of[std::max(a, b)] = std::min(a, b);
        }
    }
    for (std::uint32_t i = 0; i < part_of.size(); ++i) part_of[i] = first(i);
    found.triangles.resize(vertices_.size());
    found.is_held.assign(vertices_.size(), 0);
    for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
        if (alive_[i] == 0) continue;
        found.triangles[part_of[triangles_[i].corners[0]]].push_back(i);
        for (const std::uint32_t corner : triangles_[i].corners)
            if (stays_[corner] != 0) found.is_held[part_of[corner]] = 1;
    }
    return found;
}

// How far the corners and samples of a part are from the ground; no_limit where that is above the limits.
double SpaceSimplifier::height_over_ground(std::span<const std::uint32_t> part) const {
    const double reach_m = std::max(limits_.most_m, limits_.free_m) - limits_.ground_off_m;
    if (reach_m < 0.0) return no_limit;
    double most2 = 0.0;
    std::uint32_t hint = NearestTriangles::nothing;
    const auto is_within = [&](const glm::dvec3& place) {
        const NearestTriangles::Near near = limits_.ground->within(place, most2, reach_m * reach_m, hint);
        if (near.place == NearestTriangles::nothing) return false;
        hint = near.place, most2 = std::max(most2, near.distance2);
        return true;
    };
    for (const std::uint32_t i : part) {
        for (const std::uint32_t corner : triangles_[i].corners)
            if (!is_within(at(corner))) return no_limit;
        for (const glm::dvec3& sample : triangles_[i].samples)
            if (!is_within(sample)) return no_limit;
    }
    return std::sqrt(most2) + limits_.ground_off_m;
}

void SpaceSimplifier::find_drops() {
    parts_ = parts();
    for (std::uint32_t i = 0; i < parts_.triangles.size(); ++i) {
        const std::vector<std::uint32_t>& part = parts_.triangles[i];
        parts_left_ += part.empty() ? 0 : 1;
        if (part.empty() || parts_.is_held[i] != 0) continue;
        GroundDrop drop{0.0, i, 0.0};
        PartBox box;
        for (const std::uint32_t triangle : part) {
            for (const std::uint32_t corner : triangles_[triangle].corners) box.add(at(corner));
            for (const glm::dvec3& sample : triangles_[triangle].samples) box.add(sample);
        }
        drop.least_m = share_of_diagonal * box.diagonal_m();
        drop.cost_m = std::max(height_over_ground(part), drop.least_m);
        if (drop.cost_m < no_limit) drops_.push_back(drop);
    }
    std::sort(drops_.begin(), drops_.end(), [](const GroundDrop& a, const GroundDrop& b) {
        return a.cost_m != b.cost_m ? a.cost_m > b.cost_m : a.part > b.part;
    });
}

void SpaceSimplifier::drop_onto_ground(double next_m, std::size_t aim) {
    while (!drops_.empty() && parts_left_ > 1) {
        const GroundDrop& drop = drops_.back();
        const double most_m = count_ > aim ? std::max(limits_.most_m, reached_m_) : reached_m_;
        if (drop.cost_m > next_m || drop.cost_m > most_m) return;
        reached_m_ = std::max(reached_m_, drop.cost_m);
        least_error_m_ = std::max(least_error_m_, drop.least_m);
        for (const std::uint32_t triangle : parts_.triangles[drop.part]) {
            if (alive_[triangle] != 0) --count_;
            alive_[triangle] = 0;
            for (const std::uint32_t vertex : triangles_[triangle].corners)
                gone_[vertex] = 1, around_[vertex].clear();
        }
        drops_.pop_back(), --parts_left_;
    }
}

void SpaceSimplifier::drop_parts(std::size_t aim) {
    if (count_ <= aim) return;
    const Parts all = parts();
    std::vector<std::pair<double, std::uint32_t>> costs;
    constexpr std::size_t most_triangles = 64;
    for (std::uint32_t i = 0; i < all.triangles.size(); ++i)
        if (!all.triangles[i].empty() && all.is_held[i] == 0 && all.triangles[i].size() <= most_triangles)
            costs.emplace_back(cost_of_dropping(all.triangles[i], all.of_vertex, i), i);
    std::sort(costs.begin(), costs.end());
    for (const auto& [before, i] : costs) {
        if (count_ <= aim || before > limits_.most_m) break;
        const double cost = cost_of_dropping(all.triangles[i], all.of_vertex, i);
        if (cost > limits_.most_m) continue;
        reached_m_ = std::max(reached_m_, cost);
        for (const std::uint32_t triangle : all.triangles[i]) alive_[triangle] = 0, --count_;
    }
}

std::vector<LevelTriangle> SpaceSimplifier::take() {
    std::vector<LevelTriangle> taken;
    taken.reserve(count_);
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
        if (alive_[i] == 0) continue;
        for (std::uint32_t& corner : triangles_[i].corners) corner = vertices_[corner];
        taken.push_back(std::move(triangles_[i]));
    }
    return taken;
}

}  // namespace oro
