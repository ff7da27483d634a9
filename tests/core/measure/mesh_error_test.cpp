// How far drawn meshes are from true ones, and these from drawn ones, against literal values.
#include "core/measure/mesh_error.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "tests/core/measure/equator.h"

namespace oro {
namespace {

// A level plate 1 km long and 100 m wide, from 500 m east of 0 N 0 E, so far above the eye's level plane at
// the ground. Axes of ECEF: x is up, y is east.
TrueMesh plate(double up_m) {
    MeshTriangles mesh;
    const double x_m = wgs84_a_m + up_m;
    mesh.vertices_m = {{x_m, 500.0, -50.0}, {x_m, 1500.0, -50.0}, {x_m, 1500.0, 50.0}, {x_m, 500.0, 50.0}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    return {std::move(mesh), 1, 1};
}

class PlateOnTheEquator : public test::Equator {
  protected:
    // Of a picture from 100 m up whose row 530 alone shows something: its tangent is 30 / 500.5 below level,
    // so it sees a plate of 40 m at 60 * 500.5 / 30 = 1,001 m.
    GroundErrors measured(const DrawnPoint& point, std::span<const TrueMesh> drawn) const {
        const auto beside = std::make_shared<GroundBeside>();
        beside->meshes.push_back(plate(40.0));
        const TrueGround ground({{&surface, 0}}, beside);
        const Camera camera = test::eastward(100.0);
        std::vector<DrawnPoint> points(1001);
        std::vector<std::optional<SightHit>> seen(1001);
        points[530] = point;
        seen[530].emplace();
        seen[530]->point = geodetic_from_ecef({{wgs84_a_m + 40.0, 1001.0, 0.0}});
        seen[530]->mesh = 1;
        return ground_errors(ground, sight_from(camera.eye), camera, points, 2, MeshesMeasured{drawn, seen});
    }
    static DrawnPoint on_mesh(double z_m) { return {0.0, 0.0, z_m, 0.0, 1}; }
};

// Drawn 1 m too high: at 59 * 500.5 / 30 = 984.316667 m, where a metre is 500.5 / 984.316667 px. The place
// that is truly seen, at 1,001 m, is missed by 1 m, which is half a pixel there.
TEST_F(PlateOnTheEquator, IsMeasuredBothWays) {
    const std::vector<TrueMesh> drawn{plate(41.0)};
    const GroundErrors errors = measured(on_mesh(984.3166666667), drawn);
    ASSERT_TRUE(errors.meshes);
    EXPECT_NEAR(errors.meshes->drawn_m.largest, 1.0, 1e-6) << "m";
    EXPECT_NEAR(errors.meshes->drawn_px.largest, 0.5084746, 1e-6) << "px";
    EXPECT_NEAR(errors.meshes->missed_m.largest, 1.0, 1e-6) << "m";
    EXPECT_NEAR(errors.meshes->missed_px.largest, 0.5, 1e-6) << "px";
    EXPECT_NEAR(errors.summary_displacement_m.largest, 1.0, 1e-6) << "m";
    EXPECT_NEAR(errors.summary_displacement_px.largest, 0.5084746, 1e-6) << "px, the larger";
    EXPECT_NEAR(errors.surface_m[530], 1.0, 1e-6) << "m";
    EXPECT_EQ(errors.between, 1U);
    EXPECT_EQ(errors.beyond_data, 0U);
}

// Drawn as it is nothing is missed, and nothing is asked.
TEST_F(PlateOnTheEquator, DrawnAsItIsIsNotMissed) {
    const GroundErrors errors = measured(on_mesh(1001.0), {});
    ASSERT_TRUE(errors.meshes);
    EXPECT_NEAR(errors.meshes->drawn_m.largest, 0.0, 1e-6) << "m";
    EXPECT_EQ(errors.meshes->drawn_m.count, 1U);
    EXPECT_EQ(errors.meshes->missed_m.count, 0U);
}

// Where the ground is drawn in its place, the plate is missed by how high it lies over the ground: the root
// of (a + 40)^2 + 1001^2, less a, is 40.078550 m. The pixel is displaced by no less.
TEST_F(PlateOnTheEquator, DroppedOntoTheGroundIsMissedByItsHeight) {
    MeshTriangles far;
    far.vertices_m = {{0.0, 0.0, 6.4e6}, {1.0, 0.0, 6.4e6}, {0.0, 1.0, 6.4e6}};
    far.triangles = {{0, 1, 2}};
    const std::vector<TrueMesh> drawn{TrueMesh(std::move(far), 1, 1)};
    // The ground behind it, 6 rows from the region's north: (100 m) / tangent, by and large.
    const GroundErrors errors = measured({6.0, 30.9, 1668.0, 0.0, 0}, drawn);
    ASSERT_TRUE(errors.meshes);
    EXPECT_EQ(errors.meshes->drawn_m.count, 0U);
    EXPECT_NEAR(errors.meshes->missed_m.largest, 40.07855, 1e-4) << "m";
    EXPECT_NEAR(errors.meshes->missed_px.largest, 20.0, 0.1) << "px: 40 * 500.5 / 1001";
    EXPECT_GE(errors.summary_displacement_px.largest, 19.9) << "px";
}

}  // namespace
}  // namespace oro
