// What is drawn of meshes for ten thousand cameras covers each place once: no cut of a graph that a camera
// asks for has a hole, or triangles twice, that the mesh itself has not.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <memory>
#include <numbers>
#include <optional>
#include <random>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/base/parallel.h"
#include "core/truth/true_mesh.h"
#include "core/truth/true_surface.h"
#include "geo/together/mesh_detail.h"
#include "geo/together/mesh_surface.h"
#include "tests/geo/together/made_houses.h"
#include "tests/geo/together/made_placed_mesh.h"
#include "tests/support/rough_terrain.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

using Random = std::mt19937_64;
using Edge = std::pair<std::uint32_t, std::uint32_t>;
struct CountedEdge {
    Edge edge;
    int triangles;
};

// How many triangles have each edge, by the edges' order.
std::vector<CountedEdge> edges_of(std::span<const VertexTriangle> triangles) {
    std::vector<Edge> all;
    all.reserve(3 * triangles.size());
    for (const VertexTriangle& triangle : triangles)
        for (std::size_t i = 0; i < 3; ++i) all.push_back(std::minmax({triangle[i], triangle[(i + 1) % 3]}));
    std::ranges::sort(all);
    std::vector<CountedEdge> edges;
    for (const Edge& edge : all) {
        if (edges.empty() || edges.back().edge != edge) edges.push_back({edge, 0});
        ++edges.back().triangles;
    }
    return edges;
}

struct Found {
    std::size_t cameras{}, cuts{};
    std::uint64_t fewest{~std::uint64_t{0}}, most{}, edges{};
    std::uint64_t open{}, crowded{}, over_tau{};
};

std::vector<VertexTriangle> triangles_of(const ClusterGraph& graph,
                                         const std::vector<std::uint32_t>& clusters) {
    std::vector<VertexTriangle> all;
    for (const std::uint32_t cluster : clusters)
        for (const VertexTriangle& triangle : graph.triangles_of(graph.clusters[cluster]))
            all.push_back(triangle);
    return all;
}

struct Crowding {
    std::uint64_t edges{};  // of three triangles and more
    int most{2};
    explicit Crowding(std::span<const CountedEdge> all) {
        for (const auto& [edge, triangles] : all)
            edges += triangles > 2 ? 1U : 0U, most = std::max(most, triangles);
    }
};

// Of a graph's leaves, which are the mesh: vertices where it is not closed, and how many triangles meet in
// edges.
struct WholeMesh {
    std::set<std::uint32_t> rim;
    std::optional<Crowding> crowding;
    explicit WholeMesh(const ClusterGraph& graph) {
        std::vector<VertexTriangle> leaves;
        for (const Cluster& cluster : graph.clusters)
            if (cluster.made_by == no_group)
                for (const VertexTriangle& triangle : graph.triangles_of(cluster)) leaves.push_back(triangle);
        const auto edges = edges_of(leaves);
        for (const auto& [edge, triangles] : edges)
            if (triangles != 2) rim.insert(edge.first), rim.insert(edge.second);
        crowding.emplace(edges);
    }
    // Counts what is drawn that the mesh has not: edges of one triangle within it; and more edges of three
    // and more than it has, as these may move (SpaceSimplifier), or more triangles in one.
    void check(std::span<const VertexTriangle> drawn, Found& found) const {
        const auto edges = edges_of(drawn);
        for (const auto& [edge, triangles] : edges) {
            const bool is_on_rim = rim.contains(edge.first) && rim.contains(edge.second);
            ++found.edges;
            found.open += triangles == 1 && !is_on_rim ? 1U : 0U;
        }
        const Crowding here(edges);
        found.crowded += here.edges > crowding->edges ? here.edges - crowding->edges : 0U;
        found.crowded += here.most > crowding->most ? 1U : 0U;
    }
};

// Around a place: from 20 m to 200 km away, from level with it to right above, with any lens and tau.
Camera random_camera(const Geodetic& middle, double nearest_m, Random& random) {
    std::uniform_real_distribution<double> share(0.0, 1.0);
    const double distance_m = nearest_m * std::pow(200000.0 / nearest_m, share(random)),
                 way = 2.0 * std::numbers::pi * share(random), up = std::asin(share(random));
    Camera camera;
    const double level_deg = distance_m * std::cos(up) / 111200.0;
    camera.eye = {
        middle.lat_deg + level_deg * std::cos(way),
        middle.lon_deg + level_deg * std::sin(way) / std::cos(middle.lat_deg * std::numbers::pi / 180.0),
        middle.h_m + distance_m * std::sin(up) + 2.0};
    camera.attitude = {360.0 * share(random), -90.0 + 180.0 * share(random), 0.0};
    // Half of them look at it.
    if (share(random) < 0.5)
        camera.attitude = {std::fmod(way * 180.0 / std::numbers::pi + 180.0, 360.0),
                           -up * 180.0 / std::numbers::pi, 0.0};
    camera.vertical_fov_deg = 2.0 + 100.0 * share(random) * share(random);
    camera.width_px = 1280, camera.height_px = 800;
    return camera;
}

template <class OfCut>
Found look_at(const MeshDetail& detail, const Geodetic& middle, double nearest_m, int cameras, unsigned seed,
              const OfCut& of_cut) {
    std::printf("seed %u\n", seed);
    Random random(seed);
    const ClusterGraph& graph = detail.graph(0).clusters;
    const WholeMesh whole(graph);
    std::set<std::vector<std::uint32_t>> seen;
    Found found;
    for (int i = 0; i < cameras; ++i) {
        const Camera camera = random_camera(middle, nearest_m, random);
        const double tau_px = std::array{0.3, 1.0, 1.0, 4.0}[random() % 4];
        const MeshCut cut = detail.cut(camera, tau_px, {}, {}).value();
        ++found.cameras;
        found.over_tau += cut.error_px <= tau_px ? 0U : 1U;
        of_cut(camera, cut, random);
        if (!seen.insert(cut.clusters[0]).second) continue;
        ++found.cuts;
        found.fewest = std::min(found.fewest, cut.triangles),
        found.most = std::max(found.most, cut.triangles);
        const std::vector<VertexTriangle> drawn = triangles_of(graph, cut.clusters[0]);
        whole.check(drawn, found);
    }
    std::printf("%zu cameras, %zu cuts of %llu to %llu triangles, %llu edges: %llu open, %llu crowded\n",
                found.cameras, found.cuts, static_cast<unsigned long long>(found.fewest),
                static_cast<unsigned long long>(found.most), static_cast<unsigned long long>(found.edges),
                static_cast<unsigned long long>(found.open), static_cast<unsigned long long>(found.crowded));
    return found;
}

void expect_whole(const Found& found, std::size_t least_cuts) {
    EXPECT_EQ(found.open, 0U);
    EXPECT_EQ(found.crowded, 0U);
    EXPECT_EQ(found.over_tau, 0U);
    EXPECT_GE(found.cuts, least_cuts);
}

const auto nothing_more = [](const Camera&, const MeshCut&, Random&) {};

constexpr int cameras_of_each = 2500;

void look_at_file(const std::string& name, const std::string& crs, unsigned seed, std::size_t least_cuts) {
    const auto file = test::real_data("meshes/" + name);
    if (!file) GTEST_SKIP() << "no " << name;
    MeshRequest request;
    request.files = {file->string()}, request.crs = crs;
    const auto meshes = open_meshes(request, false, {});
    ASSERT_TRUE(meshes.ok()) << meshes.error().line();
    Region region;
    region.grids.resize(1);
    region.meshes = *meshes;
    const MeshDetail detail = MeshDetail::of(region, 1.0, thread_count());
    const PlacedVertex& some = (*meshes)->front().vertices[(*meshes)->front().vertices.size() / 2];
    expect_whole(
        look_at(detail, {some.lat_deg, some.lon_deg, some.H_m}, 20.0, cameras_of_each, seed, nothing_more),
        least_cuts);
}

TEST(CameraCutsLong, OfASurveyCoverEachPlaceOnce) {
    look_at_file("olympus-new.xml", "+proj=tmerc +lat_0=47 +lon_0=-122.9 +datum=WGS84 +units=us-ft +type=crs",
                 5251, 300);
}

TEST(CameraCutsLong, OfDelftCoverEachPlaceOnce) {
    look_at_file("delft.city.json", "", 5252, 300);
}

TEST(CameraCutsLong, OfZurichCoverEachPlaceOnce) {
    look_at_file("zurich_subset_lod2.city.json", "", 5253, 50);
}

TEST(CameraCutsLong, OfHousesOnTheGroundCoverEachPlaceOnce) {
    Region region;
    region.grids.resize(1);
    region.grids[0].field = test::rough_field(47.0, 8.0, 90, 90);
    const TrueSurface surface(region.grids[0].field, 1.0, 1);
    region.meshes =
        std::make_shared<const std::vector<PlacedMesh>>(std::vector{test::houses_on(surface, 40)});
    const MeshDetail detail = MeshDetail::of(region, 1.0, thread_count());
    const Geodetic middle{46.976, 8.046, surface.h_m(46.976, 8.046).value()};
    const Found found = look_at(detail, middle, 20.0, cameras_of_each, 5254, nothing_more);
    expect_whole(found, 40);
    EXPECT_LE(found.fewest, 128U) << "houses are dropped";
    EXPECT_EQ(found.most, 16000U);
}

// Mutants: a cut without one of its clusters has a hole, and one with the clusters below one, too, has places
// twice.
TEST(CameraCuts, HolesAndPlacesTwiceAreFound) {
    const Region region = test::region_with(test::ball_of_two_features());
    const MeshDetail detail = MeshDetail::of(region, 1.0, 2);
    const ClusterGraph& graph = detail.graph(0).clusters;
    const WholeMesh whole(graph);
    const MeshCut cut = detail.cut(Camera{}, 1.0, {}, 1U).value();
    Found sound;
    whole.check(triangles_of(graph, cut.clusters[0]), sound);
    EXPECT_EQ(sound.open + sound.crowded, 0U);
    for (std::size_t i = 0; i < cut.clusters[0].size(); ++i) {
        std::vector<std::uint32_t> without = cut.clusters[0], twice = cut.clusters[0];
        without.erase(without.begin() + static_cast<std::ptrdiff_t>(i));
        Found hole;
        whole.check(triangles_of(graph, without), hole);
        EXPECT_GT(hole.open, 0U);
        const Cluster& cluster = graph.clusters[cut.clusters[0][i]];
        ASSERT_NE(cluster.made_by, no_group);
        const auto below = graph.members_of(graph.groups[cluster.made_by]);
        twice.insert(twice.end(), below.begin(), below.end());
        Found again;
        whole.check(triangles_of(graph, twice), again);
        EXPECT_GT(again.crowded, 0U);
    }
}

// A closed ball of hills of 57 to 63 m: each line from outside to within 15 m of its middle meets what is
// drawn, as long as that is within 20 m of the ball; no code of edges.
TEST(CameraCutsLong, NoLineGetsThroughABall) {
    const Region region = test::region_with(test::ball_of_two_features());
    const MeshDetail detail = MeshDetail::of(region, 1.0, 2);
    const Geodetic middle{47.0, 8.5, 800.0};
    const glm::dvec3 middle_m = ecef_from_geodetic(middle).m;
    std::uint64_t lines = 0, through = 0;
    const auto cast = [&](const Camera& camera, const MeshCut& cut, Random& random) {
        if (cut.error_m > 12.0) return;
        const TrueMesh drawn(true_triangles(cut.meshes->front(), {}, 1.0), 1, 1);
        std::uniform_real_distribution<double> beside(-8.0, 8.0);
        for (int i = 0; i < 40; ++i) {
            const glm::dvec3 aim = middle_m + glm::dvec3(beside(random), beside(random), beside(random));
            const Ecef eye = camera.eye_ecef();
            const double reach_m = glm::distance(aim, eye.m);
            ++lines;
            through += drawn.first_hit(eye, {}, glm::dvec3(0.0), (aim - eye.m) / reach_m, reach_m) ? 0U : 1U;
        }
    };
    const Found found = look_at(detail, middle, 60.0, cameras_of_each, 5255, cast);
    std::printf("%llu lines, %llu through\n", static_cast<unsigned long long>(lines),
                static_cast<unsigned long long>(through));
    expect_whole(found, 5);
    EXPECT_GT(lines, 50000U);
    EXPECT_EQ(through, 0U);
}

}  // namespace
}  // namespace oro
