// A baked mesh may have more triangles than are drawn at once.
#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "apps/drawing/mesh_cut.h"
#include "geo/meshes/placed_mesh.h"

namespace oro {
namespace {

Region region_of_triangles(std::size_t triangles) {
    PlacedMesh mesh;
    mesh.path = "scan.ply";
    mesh.triangles.resize(triangles);
    Region region;
    region.meshes = std::make_shared<const std::vector<PlacedMesh>>(std::vector{std::move(mesh)});
    return region;
}

TEST(MeshDrawnWhole, OfMoreTrianglesThanAreDrawnNamesTheClusters) {
    EXPECT_TRUE(mesh_detail_of(region_of_triangles(5'000'000), View()).ok());
    const auto refused = mesh_detail_of(region_of_triangles(5'000'001), View());
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().kind, ErrorKind::usage);
    EXPECT_EQ(refused.error().line(),
              "scan.ply: has 5,000,001 triangles, and 5,000,000 triangles are drawn at once: --mesh clusters "
              "draws as many as the picture needs");
}

}  // namespace
}  // namespace oro
