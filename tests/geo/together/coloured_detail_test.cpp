// Colours of vertices in cluster graphs and baked files: each drawn vertex has that of its place.
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <span>
#include <vector>

#include "core/base/checksum.h"
#include "core/base/container.h"
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
        const MeshCut cut = detail.cut(camera, 1.0, {}, level);
        const PlacedMesh& drawn = cut.meshes->front();
        const std::array<std::size_t, 2> counts = right_and_wrong(drawn);
        EXPECT_EQ(counts[0], 3 * drawn.triangles.size()) << level;
        EXPECT_EQ(counts[1], 0U) << level;
        EXPECT_EQ(drawn.crease_deg, 45.0);
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
