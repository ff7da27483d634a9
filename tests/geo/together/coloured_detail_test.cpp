// Colours of vertices in cluster graphs and baked files: each drawn vertex has that of its place.
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <map>
#include <set>
#include <span>
#include <vector>

#include "core/base/checksum.h"
#include "core/base/container.h"
#include "core/seam/cleared_map.h"
#include "geo/together/baked_meshes.h"
#include "geo/together/mesh_detail.h"
#include "geo/together/mesh_surface.h"
#include "tests/geo/together/made_placed_mesh.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

using test::ball_of_two_features, test::region_with;

// A colour that follows from a place of the lattice.
VertexColour colour_of_place(const glm::dvec3& at) {
    const std::array<double, 3> numbers{at.x, at.y, at.z};
    const std::uint64_t hash = xxh64(std::as_bytes(std::span(numbers)));
    return {static_cast<std::uint8_t>(hash), static_cast<std::uint8_t>(hash >> 8U),
            static_cast<std::uint8_t>(hash >> 16U), 1};
}

PlacedMesh coloured_ball() {
    PlacedMesh mesh = ball_of_two_features();
    for (const glm::dvec3& at : drawn_places_m(mesh, {}, 1.0)) mesh.colours.push_back(colour_of_place(at));
    mesh.crease_deg = 45.0;
    return mesh;
}

// How many corners of triangles have the colour of their place, and how many have not.
std::array<std::size_t, 2> right_and_wrong(const PlacedMesh& mesh) {
    const std::vector<glm::dvec3> at = drawn_places_m(mesh, {}, 1.0);
    std::array<std::size_t, 2> counts{};
    for (const SourceTriangle& triangle : mesh.triangles)
        for (const std::uint32_t corner : triangle)
            ++counts[corner < mesh.colours.size() && mesh.colours[corner] == colour_of_place(at[corner]) ? 0
                                                                                                         : 1];
    return counts;
}

TEST(ColouredDetail, CutsKeepTheColoursOfPlaces) {
    const MeshDetail detail = MeshDetail::of(region_with(coloured_ball()), 1.0, 1);
    Camera camera;
    camera.eye = {46.99, 8.5, 830.0};
    for (const std::uint32_t level : {0U, 2U, 5U}) {
        const MeshCut cut = detail.cut(camera, 1.0, {}, level).value();
        const PlacedMesh& drawn = cut.meshes->front();
        const std::array<std::size_t, 2> counts = right_and_wrong(drawn);
        EXPECT_EQ(counts[0], 3 * drawn.triangles.size()) << level;
        EXPECT_EQ(counts[1], 0U) << level;
        EXPECT_EQ(drawn.crease_deg, 45.0);
    }
}

// The code of a colour, and which cluster, group and level it stands for, of each drawn triangle.
struct DrawnParts {
    std::vector<std::uint32_t> codes, clusters, groups, levels;
};
DrawnParts parts_of(const MeshDetail& detail, const MeshCut& cut) {
    DrawnParts drawn;
    for (const VertexColour& colour : cut.meshes->front().part_colours)
        drawn.codes.push_back(colour.red | std::uint32_t{colour.green} << 8U |
                              std::uint32_t{colour.blue} << 16U);
    const ClusterGraph& graph = detail.graph(0).clusters;
    for (const std::uint32_t number : cut.clusters[0]) {
        const Cluster& cluster = graph.clusters[number];
        const bool is_leaf = cluster.made_by == no_group;
        for (std::uint32_t i = 0; i < cluster.triangles; ++i) {
            drawn.clusters.push_back(number);
            drawn.groups.push_back(is_leaf ? cluster.used_by : cluster.made_by);
            drawn.levels.push_back(is_leaf ? 0 : graph.groups[cluster.made_by].level);
        }
    }
    return drawn;
}

// Whether triangles have one colour where they are of one part, and different ones where they are not.
void expect_one_each(const std::vector<std::uint32_t>& codes, const std::vector<std::uint32_t>& parts) {
    ASSERT_EQ(codes.size(), parts.size());
    std::map<std::uint32_t, std::set<std::uint32_t>> colours_of, parts_of;
    for (std::size_t i = 0; i < codes.size(); ++i) {
        colours_of[parts[i]].insert(codes[i]);
        parts_of[codes[i]].insert(parts[i]);
    }
    for (const auto& [part, colours] : colours_of) EXPECT_EQ(colours.size(), 1U) << part;
    for (const auto& [colour, of] : parts_of) EXPECT_EQ(of.size(), 1U) << colour;
}

TEST(ColouredDetail, PartsHaveColoursOfTheirOwn) {
    const MeshDetail detail = MeshDetail::of(region_with(coloured_ball()), 1.0, 1);
    Camera camera;
    camera.eye = {46.99, 8.5, 830.0};
    const MeshCut plain = detail.cut(camera, 1.0, {}, {}).value();
    EXPECT_TRUE(plain.meshes->front().part_colours.empty()) << "not asked for";
    for (const std::optional<std::uint32_t>& level : {std::optional<std::uint32_t>(), {0U}, {2U}}) {
        const auto cut = [&](MeshParts parts) { return detail.cut(camera, 0.2, {}, level, nullptr, parts).value(); };
        const DrawnParts clusters = parts_of(detail, cut(MeshParts::clusters)),
                         groups = parts_of(detail, cut(MeshParts::groups));
        expect_one_each(clusters.codes, clusters.clusters);
        expect_one_each(groups.codes, groups.groups);
        if (level == 0U) {
            EXPECT_GT(std::set(clusters.codes.begin(), clusters.codes.end()).size(), 3U);
        }
        EXPECT_NE(clusters.codes, groups.codes);
    }
}

// Blue, teal, green, yellow: 0.16 0.38 0.78, 0.20 0.71 0.65, 0.47 0.77 0.26 and 0.95 0.82 0.22 of 255, by
// 0.85 to 1 of their light.
TEST(ColouredDetail, LevelsHaveTheColoursOfTheGroundsLevels) {
    constexpr std::array<std::array<double, 3>, 4> colours{
        {{40.8, 96.9, 198.9}, {51.0, 181.1, 165.8}, {119.9, 196.4, 66.3}, {242.3, 209.1, 56.1}}};
    const MeshDetail detail = MeshDetail::of(region_with(coloured_ball()), 1.0, 1);
    Camera camera;
    camera.eye = {46.99, 8.5, 830.0};
    for (const std::uint32_t level : {0U, 1U, 2U, 3U}) {
        const DrawnParts drawn =
            parts_of(detail, detail.cut(camera, 1.0, {}, level, nullptr, MeshParts::levels).value());
        ASSERT_EQ(drawn.codes.size(), drawn.levels.size());
        for (std::size_t i = 0; i < drawn.codes.size(); ++i) {
            ASSERT_LE(drawn.levels[i], level);
            for (std::size_t c = 0; c < 3; ++c) {
                const double code = drawn.codes[i] >> (8 * c) & 255U, most = colours[drawn.levels[i]][c];
                EXPECT_GE(code, 0.85 * most - 0.5);
                EXPECT_LE(code, most + 0.5);
            }
        }
    }
}

// What is drawn has the same corners and normals in any colours; each piece has that of its triangle.
TEST(ColouredDetail, PartsChangeColoursAlone) {
    const MeshDetail detail = MeshDetail::of(region_with(coloured_ball()), 1.0, 1);
    Camera camera;
    camera.eye = {46.99, 8.5, 830.0};
    const MeshCut plain = detail.cut(camera, 1.0, {}, 2U).value();
    const MeshCut shown = detail.cut(camera, 1.0, {}, 2U, &plain, MeshParts::clusters).value();
    EXPECT_NE(shown.meshes, plain.meshes) << "the same clusters in other colours";
    EXPECT_EQ(detail.cut(camera, 1.0, {}, 2U, &shown, MeshParts::clusters).value().meshes, shown.meshes);
    Seam one, other;
    add_mesh(plain.meshes->front(), {}, 1.0, one);
    add_mesh(shown.meshes->front(), {}, 1.0, other);
    ASSERT_EQ(one.pieces.size(), other.pieces.size());
    ASSERT_EQ(other.pieces.size(), shown.meshes->front().part_colours.size());
    for (std::size_t i = 0; i < one.pieces.size(); ++i) {
        EXPECT_EQ(other.pieces[i].look, gpu::mesh_look_coloured);
        for (std::size_t k = 0; k < 3; ++k) {
            EXPECT_EQ(other.pieces[i].colours[k], shown.meshes->front().part_colours[i]);
            EXPECT_EQ(one.pieces[i].corners[k].at.m, other.pieces[i].corners[k].at.m);
            EXPECT_EQ(one.pieces[i].corners[k].normal, other.pieces[i].corners[k].normal);
        }
    }
}

TEST(ColouredDetail, BakedMeshesKeepTheColoursOfPlaces) {
    const std::filesystem::path path = test::scratch_folder() / "coloured.mesh";
    const PlacedMesh mesh = coloured_ball();
    ASSERT_TRUE(write_baked_mesh(path.string(), mesh, {}, 1).ok());
    const auto container = Container::open(path.string());
    ASSERT_TRUE(container.ok());
    const auto meshes = read_baked_meshes(**container, {});
    ASSERT_TRUE(meshes.ok()) << meshes.error().line();
    const std::array<std::size_t, 2> counts = right_and_wrong(meshes->front());
    EXPECT_EQ(counts[0], 3 * mesh.triangles.size());
    EXPECT_EQ(counts[1], 0U);
    EXPECT_EQ(meshes->front().crease_deg, 45.0);
}

}  // namespace
}  // namespace oro
