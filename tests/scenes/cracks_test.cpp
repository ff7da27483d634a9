// Must hold: no background shines through the terrain, between levels, pages and tiles, from any eye.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include "geo/opening/open_region.h"
#include "geo/region/region.h"
#include "tests/support/asked_count.h"
#include "tests/support/drawn/cracks.h"
#include "tests/support/drawn/drawn_scene.h"
#include "tests/support/net_terrain.h"
#include "tests/support/rough_terrain.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

constexpr int side_px = test::crack_side_px;

// Rough in places, smooth in others, so that levels meet everywhere.
HeightField patchy_field() {
    HeightField field = test::rough_field(47.0, 8.0, 900, 1100);
    for (int row = 0; row < field.grid.rows(); ++row) {
        for (int column = 0; column < field.grid.columns(); ++column) {
            const double calm = 0.5 + 0.5 * std::sin(row * 0.02) * std::cos(column * 0.017);
            float& H_m =
                field.H_m[static_cast<std::size_t>(row) * static_cast<std::size_t>(field.grid.columns()) +
                          static_cast<std::size_t>(column)];
            H_m = static_cast<float>(500.0 + static_cast<double>(H_m) * std::pow(calm, 4.0));
        }
    }
    return field;
}

int camera_count() {
    return test::asked_count("OROGRAPH_TEST_CAMERAS", 500);
}

class Cracks : public test::GpuTest, public ::testing::WithParamInterface<RasterPath> {
  protected:
    void look_for_holes(const char* name, const HeightField& field, int cameras, unsigned seed) {
        test::DrawnScene drawn(*gpu_, pages_in_memory(field, 1.0, 2), GetParam(), side_px, side_px);
        std::mt19937_64 random(seed);
        std::size_t ground = 0;
        int holes = 0;
        for (int i = 0; i < cameras; ++i) {
            const Camera camera = test::random_camera(random, field);
            const double tau_px = i % 5 == 0 ? 4.0 : 1.0;
            const test::DrawnFrame frame = drawn.draw(camera, tau_px);
            ground += static_cast<std::size_t>(side_px * side_px -
                                               std::count(frame.ids.begin(), frame.ids.end(), 0U));
            const int hole = test::pixel_of_a_hole(camera, frame.ids);
            if (hole < 0) continue;
            ++holes;
            ADD_FAILURE() << name << ", camera " << i << ": background within the terrain at pixel "
                          << hole % side_px << "," << hole / side_px << "; eye " << camera.eye.lat_deg << ","
                          << camera.eye.lon_deg << " h " << camera.eye.h_m << " heading "
                          << camera.attitude.heading_deg << " pitch " << camera.attitude.pitch_deg << " roll "
                          << camera.attitude.roll_deg << " fov " << camera.vertical_fov_deg << " tau "
                          << tau_px;
            if (holes > 5) return;
        }
        std::printf("%s, seed %u: %d cameras, %zu pixels of ground, pictures with background in them: %d\n",
                    name, seed, cameras, ground, holes);
        EXPECT_GT(ground, static_cast<std::size_t>(cameras) * 1000U);
    }

    void look_over_real_data(const char* folder, const char* tiles, unsigned seed) {
        const auto data = test::real_data(folder);
        if (!data) GTEST_SKIP() << "needs " << folder;
        RegionRequest request;
        request.paths = {data->string()};
        request.box = *parse_tile_range(tiles);
        auto region = open_region(request);
        ASSERT_TRUE(region.ok()) << region.error().line();
        if (region->grids[0].voids > 0) {
            // Holes are where voids are: these tiles' few are filled.
            request.fill_voids = true;
            region = open_region(request);
            ASSERT_TRUE(region.ok()) << region.error().line();
        }
        ASSERT_EQ(region->grids[0].voids, 0U);
        look_for_holes(folder, region->grids[0].field, camera_count() / 4, seed);
    }
};

TEST_P(Cracks, NoneInMadeTerrain) {
    look_for_holes("made terrain", patchy_field(), camera_count() / 4, 101);
}
TEST_P(Cracks, NoneOnNets) {
    for (const auto& [name, plane] :
         {std::pair("a turned net", test::PlaneOfPosts{900, 1100, {46.5, 8.0}, 80.0, 27.0}),
          std::pair("a net over the pole", test::PlaneOfPosts{700, 700, {89.9, 40.0}, 90.0, 0.0}),
          std::pair("a continent", test::PlaneOfPosts{400, 600, {-82.0, 40.0}, 10000.0, 30.0})})
        look_for_holes(name, test::net_field(plane, test::patchy_H_m, 40.0F), camera_count() / 8, 105);
}
TEST_P(Cracks, NoneInTheAlps) {
    look_over_real_data("alps", "N46E006:N47E009", 102);
}
TEST_P(Cracks, NoneInPoland) {
    look_over_real_data("poland", "N51E018:N52E020", 103);
}
TEST_P(Cracks, NoneInTheHimalaya) {
    look_over_real_data("himalaya", "N28E080:N30E083", 104);
}

INSTANTIATE_TEST_SUITE_P(Paths, Cracks, ::testing::Values(RasterPath::mesh, RasterPath::compute),
                         [](const auto& path) { return name_of(path.param); });

// The check can fail: with a picture of ground that has one pixel of background in it.
TEST(CracksCheck, FindsAPinhole) {
    Camera camera;
    camera.width_px = camera.height_px = side_px;
    camera.eye = {46.5, 8.5, 3000.0};
    camera.attitude.pitch_deg = -60.0;
    std::vector<std::uint32_t> ids(static_cast<std::size_t>(side_px * side_px), 1U);
    EXPECT_EQ(test::pixel_of_a_hole(camera, ids), -1);
    for (int y = 0; y < 20; ++y) std::fill_n(ids.begin() + y * side_px, side_px, 0U);
    EXPECT_EQ(test::pixel_of_a_hole(camera, ids), -1) << "sky above the ground is none";
    ids[static_cast<std::size_t>(50 * side_px + 40)] = 0;
    EXPECT_EQ(test::pixel_of_a_hole(camera, ids), 50 * side_px + 40);
}

}  // namespace
}  // namespace oro
