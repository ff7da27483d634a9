// Houses of a region that are dropped onto its ground: against the true surface, and against files whose
// ground is another one.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <glm/geometric.hpp>
#include <memory>
#include <optional>
#include <random>

#include "core/base/container.h"
#include "core/mesh_file/mesh_check.h"
#include "core/mesh_file/stored_mesh.h"
#include "core/truth/true_surface.h"
#include "geo/together/baked_meshes.h"
#include "geo/together/mesh_detail.h"
#include "geo/together/mesh_ground.h"
#include "geo/together/mesh_surface.h"
#include "tests/geo/together/made_houses.h"
#include "tests/support/rough_terrain.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

// Places on the triangles that are drawn, at most a metre apart.
std::vector<glm::dvec3> places_on(const PlacedMesh& mesh) {
    const std::vector<glm::dvec3> at = drawn_places_m(mesh, {}, 1.0);
    std::vector<glm::dvec3> places;
    constexpr int parts = 20;
    for (const auto& [a, b, c] : mesh.triangles)
        for (int i = 0; i <= parts; ++i)
            for (int k = 0; i + k <= parts; ++k)
                places.push_back(at[a] + (at[b] - at[a]) * (static_cast<double>(i) / parts) +
                                 (at[c] - at[a]) * (static_cast<double>(k) / parts));
    return places;
}

class MeshDrops : public ::testing::Test {
  protected:
    void SetUp() override {
        region_.grids.resize(1);
        region_.grids[0].field = test::rough_field(47.0, 8.0, 90, 90);
        surface_.emplace(region_.grids[0].field, 1.0, 1);
        region_.meshes =
            std::make_shared<const std::vector<PlacedMesh>>(std::vector{test::houses_on(*surface_)});
    }
    [[nodiscard]] MeshCut cut_from(const MeshDetail& detail, double distance_m) const {
        Camera camera;
        camera.eye = {46.967 - distance_m / 111200.0, 8.032, 3000.0};
        camera.vertical_fov_deg = 30.0, camera.width_px = 800, camera.height_px = 600;
        return detail.cut(camera, 1.0, {}, {}).value();
    }

    // From places of the true surface a metre apart, up to 14 m around: 0.71 m too far at most on even
    // ground.
    [[nodiscard]] double to_ground_m(const PlacedVertex& vertex) const {
        const glm::dvec3 at = ecef_from_geodetic({vertex.lat_deg, vertex.lon_deg, vertex.H_m}).m;
        double least_m = 1.0e9;
        for (int north = -14; north <= 14; ++north)
            for (int east = -14; east <= 14; ++east) {
                const double lat_deg = vertex.lat_deg + north / 111200.0,
                             lon_deg = vertex.lon_deg + east / 76000.0;
                const double h_m = surface_->h_m(lat_deg, lon_deg).value();
                least_m = std::min(least_m, glm::distance(at, ecef_from_geodetic({lat_deg, lon_deg, h_m}).m));
            }
        return least_m;
    }

    Region region_;
    std::optional<TrueSurface> surface_;
};

TEST_F(MeshDrops, HousesThatAreNotDrawnAreWithinTheErrorOfTheTrueGround) {
    const MeshDetail detail = MeshDetail::of(region_, 1.0, 2);
    const std::size_t all = region_.meshes->front().triangles.size();
    ASSERT_EQ(all, 1440U);
    EXPECT_EQ(cut_from(detail, 500.0).triangles, all);
    // From 30 km a pixel is 27 m: of houses of up to 15 m one cluster is left.
    const MeshCut cut = cut_from(detail, 30000.0);
    EXPECT_LE(cut.triangles, 128U);
    EXPECT_LE(cut.error_px, 1.0);
    EXPECT_LT(cut.error_m, 25.0);
    const std::vector<glm::dvec3> drawn = places_on(cut.meshes->front());
    int on_ground = 0;
    for (const PlacedVertex& vertex : region_.meshes->front().vertices) {
        const glm::dvec3 at = ecef_from_geodetic({vertex.lat_deg, vertex.lon_deg, vertex.H_m}).m;
        double least_m = 1.0e9;
        for (const glm::dvec3& other : drawn) least_m = std::min(least_m, glm::distance(at, other));
        if (least_m <= cut.error_m + 0.75) continue;
        ++on_ground;
        EXPECT_LE(to_ground_m(vertex), cut.error_m + 0.75);
    }
    EXPECT_GT(on_ground, 800);
    // Without the ground houses are as far from those that stay as these are from each other.
    const PlacedMesh& mesh = region_.meshes->front();
    const auto alone = MeshDetail::graph_of(mesh, {}, 1.0, 2);
    EXPECT_EQ(alone.ground_fingerprint, 0U);
    EXPECT_GT(alone.graph->largest_error_m(), 60.0);
    EXPECT_LT(detail.graph(0).largest_error_m(), 25.0);
}

// Posts lie 90 m apart: each triangle lies on the true surface, at its corners, its sides and its middle.
TEST_F(MeshDrops, TheGroundIsTheTrueOne) {
    const PlacedMesh& mesh = region_.meshes->front();
    const std::vector<glm::dvec3> places = drawn_places_m(mesh, {}, 1.0);
    const MeshGround ground = ground_below_parts(places, mesh.triangles, glm::dvec3(0.0), region_, 1.0);
    ASSERT_GE(ground.triangles.size(), 40U);
    EXPECT_GT(ground.off_m, 1.0e-4);
    EXPECT_LT(ground.off_m, 0.02);
    for (const auto& [a, b, c] : ground.triangles)
        for (const glm::dvec3& at :
             {a, b, c, 0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a), (a + b + c) / 3.0}) {
            const Geodetic place = geodetic_from_ecef(Ecef{at});
            const auto h_m = surface_->h_m(place.lat_deg, place.lon_deg);
            if (!h_m) continue;  // rounding, at the rim
            EXPECT_NEAR(place.h_m, *h_m, ground.off_m);
        }
    // A grid of a smaller rank over it may be the ground there.
    Region two = region_;
    two.grids[0].rank = 1;
    two.grids.push_back(two.grids[0]);
    two.grids[1].rank = 0;
    const MeshGround of_two = ground_below_parts(places, mesh.triangles, glm::dvec3(0.0), two, 1.0);
    EXPECT_EQ(of_two.triangles.size(), ground.triangles.size());
    // A void post has no ground around it.
    for (float& H_m : two.grids[1].field.H_m) H_m = void_height_m;
    EXPECT_TRUE(ground_below_parts(places, mesh.triangles, glm::dvec3(0.0), two, 1.0).triangles.empty());
}

TEST_F(MeshDrops, AreBuiltAgainOverOtherGroundThanTheFiles) {
    const std::string path = (test::scratch_folder() / "houses.mesh").string();
    ASSERT_TRUE(write_baked_mesh(path, region_.meshes->front(), {}, 2, &region_).ok());
    const auto container = Container::open(path);
    ASSERT_TRUE(container.ok());
    auto meshes = read_baked_meshes(**container, {});
    ASSERT_TRUE(meshes.ok()) << meshes.error().line();
    const StoredMesh& stored = *meshes->front().stored();
    EXPECT_NE(stored.ground_fingerprint, 0U);
    const MeshGround ground = ground_below_parts(stored, region_, 1.0);
    EXPECT_EQ(fingerprint_of(ground, stored.origin_ecef_m()), stored.ground_fingerprint);
    const auto wrong = understated_error(stored, 2, &ground);
    EXPECT_FALSE(wrong) << *wrong;
    EXPECT_TRUE(understated_error(stored, 2)) << "without its ground";
    Region baked = region_;
    baked.meshes = std::make_shared<const std::vector<PlacedMesh>>(std::move(*meshes));
    EXPECT_EQ(MeshDetail::of(baked, 1.0, 2).built(), 0U);
    for (float& H_m : baked.grids[0].field.H_m) H_m -= 30.0F;
    EXPECT_EQ(MeshDetail::of(baked, 1.0, 2).built(), 1U);
}

}  // namespace
}  // namespace oro
