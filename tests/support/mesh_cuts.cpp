#include "tests/support/mesh_cuts.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <set>

namespace oro::test {
namespace {

using Corners = std::array<glm::dvec3, 3>;
using Edge = std::pair<std::uint32_t, std::uint32_t>;

double to_segment(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 way = b - a;
    const double length2 = glm::dot(way, way);
    const double t = length2 > 0.0 ? std::clamp(glm::dot(p - a, way) / length2, 0.0, 1.0) : 0.0;
    return glm::distance(p, a + t * way);
}

double to_triangle(const glm::dvec3& p, const Corners& at) {
    double least =
        std::min({to_segment(p, at[0], at[1]), to_segment(p, at[1], at[2]), to_segment(p, at[2], at[0])});
    const glm::dvec3 normal = glm::cross(at[1] - at[0], at[2] - at[0]);
    const double length = glm::length(normal);
    if (!(length > 0.0)) return least;
    for (std::size_t i = 0; i < 3; ++i)
        if (glm::dot(glm::cross(at[(i + 1) % 3] - at[i], p - at[i]), normal) < 0.0) return least;
    return std::min(least, std::abs(glm::dot(p - at[0], normal)) / length);
}

glm::dvec3 place_in(const Corners& at, std::mt19937_64& random) {
    std::uniform_real_distribution<double> share(0.0, 1.0);
    double x = share(random), y = share(random);
    if (x + y > 1.0) x = 1.0 - x, y = 1.0 - y;
    return at[0] + x * (at[1] - at[0]) + y * (at[2] - at[0]);
}

struct Balls {
    std::vector<Corners> triangles;
    std::vector<glm::dvec3> middles;
    std::vector<double> radii;

    void add(const Corners& at) {
        triangles.push_back(at);
        middles.push_back((at[0] + at[1] + at[2]) / 3.0);
        radii.push_back(std::max({glm::distance(middles.back(), at[0]), glm::distance(middles.back(), at[1]),
                                  glm::distance(middles.back(), at[2])}));
    }
    // 0 where a triangle is within that distance, else how much more the nearest needs.
    [[nodiscard]] double beyond(const glm::dvec3& p, double reach_m, std::size_t hint) const {
        if (hint < triangles.size() && to_triangle(p, triangles[hint]) <= reach_m) return 0.0;
        double least = HUGE_VAL;
        for (std::size_t i = 0; i < triangles.size(); ++i) {
            const glm::dvec3 way = p - middles[i];
            const double bound = std::min(least, reach_m) + radii[i];
            if (least < HUGE_VAL && glm::dot(way, way) > (least + radii[i]) * (least + radii[i])) continue;
            if (least == HUGE_VAL && glm::dot(way, way) > 4.0 * (bound + 1.0) * (bound + 1.0) && i % 64 != 0)
                continue;
            least = std::min(least, to_triangle(p, triangles[i]));
            if (least <= reach_m) return 0.0;
        }
        for (std::size_t i = 0; i < triangles.size(); ++i)
            least = std::min(least, to_triangle(p, triangles[i]));
        return least - reach_m;
    }
};

Corners corners_of(const SpaceMesh& mesh, const std::array<std::uint32_t, 3>& triangle) {
    return {mesh.vertices[triangle[0]], mesh.vertices[triangle[1]], mesh.vertices[triangle[2]]};
}

std::map<Edge, int> edges_of(std::span<const std::array<std::uint32_t, 3>> triangles) {
    std::map<Edge, int> edges;
    for (const auto& triangle : triangles)
        for (std::size_t i = 0; i < 3; ++i) ++edges[std::minmax(triangle[i], triangle[(i + 1) % 3])];
    return edges;
}

// Vertices on the rim of the mesh: an edge of one triangle lies between these, or is a crack.
void check_edges(const SpaceMesh& mesh, std::span<const std::array<std::uint32_t, 3>> drawn,
                 CutCheck& check) {
    const std::map<Edge, int> own = edges_of(mesh.triangles);
    std::set<std::uint32_t> rim;
    for (const auto& [edge, count] : own)
        if (count != 2) rim.insert(edge.first), rim.insert(edge.second);
    std::uint64_t crowded_before = 0, crowded = 0;
    int most_before = 2, most = 2;
    for (const auto& [edge, count] : own) {
        crowded_before += count > 2 ? 1U : 0U;
        most_before = std::max(most_before, count);
    }
    for (const auto& [edge, count] : edges_of(drawn)) {
        const bool on_rim = rim.contains(edge.first) && rim.contains(edge.second);
        if (count == 1 && !on_rim) ++check.open_edges;
        crowded += count > 2 ? 1U : 0U;
        most = std::max(most, count);
    }
    if (crowded > crowded_before) check.crowded += crowded - crowded_before;
    if (most > most_before) ++check.crowded;
}

std::set<std::pair<std::uint32_t, std::uint32_t>> links_of(const ClusterGraph& graph) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> links;
    for (const Cluster& cluster : graph.clusters)
        if (cluster.made_by != no_group && cluster.used_by != no_group)
            links.emplace(cluster.made_by, cluster.used_by);
    return links;
}

}  // namespace

std::vector<glm::dvec3> random_places(const SpaceMesh& mesh, std::mt19937_64& random) {
    std::vector<glm::dvec3> places;
    for (const auto& triangle : mesh.triangles)
        places.push_back(place_in(corners_of(mesh, triangle), random));
    return places;
}

std::vector<char> random_standing(const ClusterGraph& graph, std::mt19937_64& random) {
    std::uniform_real_distribution<double> share(0.0, 1.0);
    double top_m = 0.0, bottom_m = HUGE_VAL;
    for (const ClusterGroup& group : graph.groups) {
        top_m = std::max(top_m, group.error_m);
        bottom_m = std::min(bottom_m, std::max(group.error_m, 1.0e-4));
    }
    const double most_m = bottom_m * std::pow(top_m / bottom_m, 0.15 + 0.9 * share(random));
    const double chance = 0.6 + 0.4 * share(random);
    std::vector<char> stands(graph.groups.size(), 0);
    for (std::size_t i = 0; i < graph.groups.size(); ++i) {
        bool may = graph.groups[i].error_m <= most_m && share(random) < chance;
        for (const std::uint32_t member : graph.members_of(graph.groups[i])) {
            const std::uint32_t below = graph.clusters[member].made_by;
            if (below != no_group && stands[below] == 0) may = false;
        }
        stands[i] = may ? 1 : 0;
    }
    return stands;
}

void check_cut(const SpaceMesh& mesh, const MeshGraph& graph, const MeshPlaceChains& chains,
               const std::vector<char>& stands, std::size_t count, std::mt19937_64& random, CutCheck& check,
               const MeshGround* ground) {
    constexpr double slack_m = 1.0e-6;
    Balls all, drawn, below;
    if (ground != nullptr)
        for (const Corners& triangle : ground->triangles) below.add(triangle);
    for (const auto& triangle : mesh.triangles) all.add(corners_of(mesh, triangle));
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<std::uint32_t> made_by, original_of;
    for (const Cluster& cluster : graph.clusters.clusters) {
        if (cluster.made_by != no_group && stands[cluster.made_by] == 0) continue;
        if (cluster.used_by != no_group && stands[cluster.used_by] != 0) continue;
        for (std::uint32_t i = 0; i < cluster.triangles; ++i) {
            triangles.push_back(graph.clusters.triangles[cluster.first_triangle + i]);
            drawn.add(corners_of(mesh, triangles.back()));
            made_by.push_back(cluster.made_by);
            original_of.push_back(graph.original_of[cluster.first_triangle + i]);
        }
    }
    const auto links = links_of(graph.clusters);
    std::uniform_int_distribution<std::size_t> some(0, mesh.triangles.size() - 1),
        some_drawn(0, triangles.size() - 1);
    for (std::size_t k = 0; k < count; ++k) {
        const std::size_t i = some(random);
        double error_m = 0.0;
        const std::vector<std::uint32_t>& chain = chains.groups[i];
        std::size_t standing = 0;
        for (; standing < chain.size() && stands[chain[standing]] != 0; ++standing)
            error_m = graph.clusters.groups[chain[standing]].error_m;
        const bool is_on_ground = standing == chain.size() && chains.on_ground[i] != 0;
        check.on_ground += is_on_ground ? 1U : 0U;
        for (std::size_t step = 0; step + 1 < chain.size(); ++step)
            check.no_link += links.contains({chain[step], chain[step + 1]}) ? 0U : 1U;
        const Balls& near = is_on_ground ? below : drawn;
        const double beyond = near.beyond(chains.places[i], error_m + slack_m, near.triangles.size());
        ++check.places;
        check.places_over += beyond > 0.0 ? 1U : 0U;
        const std::size_t one = some_drawn(random);
        const double made_error_m =
            made_by[one] == no_group ? 0.0 : graph.clusters.groups[made_by[one]].error_m;
        const double drawn_beyond =
            all.beyond(place_in(drawn.triangles[one], random), made_error_m + slack_m, original_of[one]);
        ++check.drawn;
        check.drawn_over += drawn_beyond > 0.0 ? 1U : 0U;
        check.worst_m = std::max({check.worst_m, beyond, drawn_beyond});
    }
    check_edges(mesh, triangles, check);
}

std::vector<Corners> corners_of_all(const SpaceMesh& mesh,
                                    std::span<const std::array<std::uint32_t, 3>> triangles) {
    std::vector<Corners> all;
    all.reserve(triangles.size());
    for (const auto& triangle : triangles) all.push_back(corners_of(mesh, triangle));
    return all;
}

namespace {

// How far a place is from some triangles, and whether that is farther than a bound and a micrometre.
struct Measured {
    double distance_m{};
    bool is_over{};
};
Measured measured(const glm::dvec3& at, const NearestTriangles& tree, std::span<const Corners> triangles,
                  double bound_m) {
    constexpr double slack_m = 1.0e-6;
    Measured found{std::sqrt(tree.nearest(at).distance2)};
    if (found.distance_m <= bound_m + slack_m) return found;
    for (const Corners& triangle : triangles)
        found.distance_m = std::min(found.distance_m, to_triangle(at, triangle));
    found.is_over = found.distance_m > bound_m + slack_m;
    return found;
}

}  // namespace

void check_many(const SpaceMesh& mesh, const NearestTriangles& whole, const MeshGraph& graph,
                const MeshPlaceChains& chains, const std::vector<char>& stands, std::size_t every,
                std::mt19937_64& random, ManyPlaces& found) {
    const std::vector<ClusterGroup>& groups = graph.clusters.groups;
    found.farthest_m.resize(groups.size(), 0.0);
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<std::uint32_t> made_by;
    for (const Cluster& cluster : graph.clusters.clusters) {
        if (cluster.made_by != no_group && stands[cluster.made_by] == 0) continue;
        if (cluster.used_by != no_group && stands[cluster.used_by] != 0) continue;
        for (const VertexTriangle& triangle : graph.clusters.triangles_of(cluster))
            triangles.push_back(triangle);
        made_by.resize(triangles.size(), cluster.made_by);
    }
    const std::vector<Corners> drawn = corners_of_all(mesh, triangles);
    const NearestTriangles tree(drawn);
    for (std::size_t i = random() % every; i < chains.places.size(); i += every) {
        std::uint32_t last = no_group;
        for (const std::uint32_t group : chains.groups[i]) {
            if (stands[group] == 0) break;
            last = group;
        }
        const Measured place =
            measured(chains.places[i], tree, drawn, last == no_group ? 0.0 : groups[last].error_m);
        ++found.places, found.places_over += place.is_over ? 1U : 0U;
        if (last != no_group) found.farthest_m[last] = std::max(found.farthest_m[last], place.distance_m);
    }
    const std::vector<Corners> all = corners_of_all(mesh, mesh.triangles);
    for (std::size_t i = 0; i < drawn.size(); ++i) {
        if (made_by[i] == no_group) continue;  // the mesh itself
        const Measured place = measured(place_in(drawn[i], random), whole, all, groups[made_by[i]].error_m);
        ++found.drawn, found.drawn_over += place.is_over ? 1U : 0U;
        found.farthest_m[made_by[i]] = std::max(found.farthest_m[made_by[i]], place.distance_m);
    }
}

MeshPlaceChains wrong_users(const MeshGraph& graph, const MeshPlaceChains& chains, std::mt19937_64& random) {
    std::map<std::uint32_t, std::set<std::uint32_t>> users;
    for (const auto& [maker, user] : links_of(graph.clusters)) users[maker].insert(user);
    MeshPlaceChains wrong = chains;
    for (std::vector<std::uint32_t>& chain : wrong.groups) {
        if (chain.size() < 2) continue;
        const std::size_t step = std::uniform_int_distribution<std::size_t>(0, chain.size() - 2)(random);
        std::set<std::uint32_t> others = users[chain[step]];
        others.erase(chain[step + 1]);
        if (others.empty()) continue;
        auto other = others.begin();
        std::advance(other, std::uniform_int_distribution<std::size_t>(0, others.size() - 1)(random));
        chain.resize(step + 1);
        chain.push_back(*other);
    }
    return wrong;
}

std::vector<MeshGraph> dropped_for_nothing(const MeshGraph& graph, const MeshPlaceChains& chains) {
    std::set<std::uint32_t> droppers;
    for (std::size_t i = 0; i < chains.groups.size(); ++i)
        if (chains.on_ground[i] != 0) droppers.insert(chains.groups[i].back());
    std::vector<MeshGraph> mutants;
    for (const std::uint32_t number : droppers) {
        const ClusterGroup& group = graph.clusters.groups[number];
        const double below_m = largest_member_error_m(graph.clusters, group);
        if (group.error_m <= 1.01 * below_m) continue;
        mutants.push_back(graph);
        mutants.back().clusters.groups[number].error_m = below_m;
    }
    return mutants;
}

}  // namespace oro::test
