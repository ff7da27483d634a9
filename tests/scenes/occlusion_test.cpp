// Occlusion over real ground, and where grids meet by seams: the ids in every pixel are those of frames that
// draw all.
#include <glm/geometric.hpp>
#include <random>

#include "core/seam/mesh_pages.h"
#include "core/seam/seam_pages.h"
#include "core/terrain/ground.h"
#include "geo/together/cut_regions.h"
#include "tests/scenes/real_tiles.h"
#include "tests/support/drawn/occlusion_pairs.h"
#include "tests/support/height_storage.h"
#include "tests/support/test_data.h"
#include "tests/support/three_grids.h"

namespace oro {
namespace {

constexpr int width_px = 251, height_px = 142;

class OccludedScene : public test::GpuTest, public ::testing::WithParamInterface<RasterPath> {
  protected:
    Scene scene_of(std::unique_ptr<RegionPages> pages) {
        auto scene =
            Scene::create(*gpu_, std::move(pages), {std::uint64_t{384} << 20U, 0}, test::asked_heights());
        EXPECT_TRUE(scene.ok()) << scene.error().line();
        return std::move(scene).value();
    }
};

// Where people stand: valleys and ridges of the Bernese Alps.
TEST_P(OccludedScene, TheAlpsAreThoseWithout) {
    if (!test::real_data("alps")) GTEST_SKIP() << "needs alps";
    const auto region = test::open_tiles("alps", "N46E007:N46E008");
    ASSERT_TRUE(region.ok()) << region.error().line();
    Scene scene = scene_of(pages_in_memory(region->grids[0].field, 1.0, 2));
    const test::EyeGround where{46.3, 46.8, 7.4, 8.6, [&](double lat_deg, double lon_deg) {
                                    return ground_h_m(region->grids[0].field, lat_deg, lon_deg).value_or(0.0);
                                }};
    test::OcclusionPair renderers(*gpu_, GetParam(), width_px, height_px);
    EXPECT_EQ(test::draw_pairs(renderers, scene, where, 91, test::occlusion_pairs(25), width_px, height_px),
              0U);
    EXPECT_LT(3 * renderers.drawn_with, 2 * renderers.drawn_without);
}

// Steps between grids reach out by tau in the shader, and are never left out; what they hide may be.
TEST_P(OccludedScene, GridsWithSeamsAreThoseWithout) {
    Region region = test::three_grids(500);
    auto cuts = cut_regions(region);
    ASSERT_TRUE(cuts.ok()) << cuts.error().line();
    const Seam seam = seam_between(region, *cuts, 1.0);
    std::optional<Scene> scene;
    const std::vector<RegionGrid>& grids = region.grids;
    for (std::size_t i = 0; i < grids.size(); ++i) {
        HeightField rest = grids[i].field;
        const GridClip& cut = cuts->grids[i];
        for (std::size_t post = 0; post < cut.masked_posts.size(); ++post)
            if (cut.masked_posts[post] != 0) rest.H_m[post] = void_height_m;
        Scene one = scene_of(pages_in_memory(rest, 1.0, 2));
        if (i == 0)
            scene.emplace(std::move(one));
        else
            scene->add(std::move(one));
    }
    auto pages = seam_pages(seam, {}, region_shape(region.grids[0].field, 1.0));
    ASSERT_TRUE(pages.ok()) << pages.error().line();
    scene->add(scene_of(std::move(pages).value()));
    const double middle = 0.5 * 500 / 1200.0;
    const test::EyeGround where{
        47.0 - middle - 0.05, 47.0 - middle + 0.05, 8.0 + middle - 0.05, 8.0 + middle + 0.07,
        [&](double lat_deg, double lon_deg) {
            double highest_m = -1000.0;
            for (const RegionGrid& grid : grids)
                highest_m = std::max(highest_m, ground_h_m(grid.field, lat_deg, lon_deg).value_or(-1000.0));
            return highest_m;
        }};
    test::OcclusionPair renderers(*gpu_, GetParam(), width_px, height_px);
    EXPECT_EQ(test::draw_pairs(renderers, *scene, where, 92, test::occlusion_pairs(25), width_px, height_px),
              0U);
    EXPECT_LT(renderers.drawn_with, renderers.drawn_without);
}

// Triangles of meshes over rolling ground: some high above it, most of them behind hills or behind each
// other.
Seam triangles_over(const HeightField& field, const test::EyeGround& where, unsigned seed) {
    std::mt19937 random(seed);
    const auto between = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    Seam seam;
    for (int i = 0; i < 6000; ++i) {
        const double lat_deg = between(where.south_deg, where.north_deg),
                     lon_deg = between(where.west_deg, where.east_deg);
        const double ground_m = ground_h_m(field, lat_deg, lon_deg).value_or(0.0);
        const double above_m = i % 10 == 0 ? between(0.0, 400.0) : between(0.0, 20.0);
        const Ecef middle = ecef_from_geodetic({lat_deg, lon_deg, ground_m + above_m});
        const double size_m = i % 50 == 0 ? 300.0 : 25.0;
        SeamPiece piece;
        piece.two_sided = true;
        for (SeamCorner& corner : piece.corners) {
            corner.at = {middle.m +
                         size_m * glm::dvec3(between(-1.0, 1.0), between(-1.0, 1.0), between(-1.0, 1.0))};
            corner.h_m = geodetic_from_ecef(corner.at).h_m;
            corner.normal = glm::normalize(middle.m);
        }
        seam.pieces.push_back(piece);
    }
    return seam;
}

TEST_P(OccludedScene, MeshesAreThoseWithout) {
    const Region region = test::three_grids(500);
    const HeightField& field = region.grids[0].field;
    const double middle_deg = 0.5 * 500 / 1200.0;
    const test::EyeGround where{
        47.0 - middle_deg - 0.05, 47.0 - middle_deg + 0.05, 8.0 + middle_deg - 0.05, 8.0 + middle_deg + 0.07,
        [&](double lat_deg, double lon_deg) { return ground_h_m(field, lat_deg, lon_deg).value_or(0.0); }};
    Scene scene = scene_of(pages_in_memory(field, 1.0, 2));
    auto pages = mesh_pages(triangles_over(field, where, 93), {}, region_shape(field, 1.0));
    ASSERT_TRUE(pages.ok()) << pages.error().line();
    scene.add(scene_of(std::move(pages).value()));
    test::OcclusionPair renderers(*gpu_, GetParam(), width_px, height_px);
    EXPECT_EQ(test::draw_pairs(renderers, scene, where, 93, test::occlusion_pairs(25), width_px, height_px),
              0U);
    EXPECT_LT(3 * renderers.drawn_with, 2 * renderers.drawn_without);
}

INSTANTIATE_TEST_SUITE_P(Paths, OccludedScene, ::testing::Values(RasterPath::mesh, RasterPath::compute),
                         [](const auto& path) {
                             return std::string(path.param == RasterPath::mesh ? "mesh" : "compute");
                         });

}  // namespace
}  // namespace oro
