#include "core/frame/tile_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <random>
#include <vector>

namespace oro {
namespace {

// The tile's number in the order.
std::size_t turn_of(const std::vector<int>& columns, double x_px, int tile_width_px) {
    const int left_px = static_cast<int>(x_px) / tile_width_px * tile_width_px;
    return static_cast<std::size_t>(std::ranges::find(columns, left_px) - columns.begin());
}

// Where a place above one that is seen at a point of the picture is seen.
glm::dvec2 raised_px(const Camera& camera, const glm::dvec2& at_px, double up_by) {
    const glm::dmat3 view = camera.view_from_ecef();
    const glm::dvec3 place = view * (camera.ecef_direction_at(at_px) +
                                     up_by * ecef_from_enu(camera.eye.lat_deg, camera.eye.lon_deg)[2]);
    if (place.z >= -1.0e-6) return {-1.0, -1.0};
    const glm::dvec2 seen = glm::dvec2(place.x, -place.y) / -place.z / camera.half_fov_tangent();
    return 0.5 * (seen + 1.0) * glm::dvec2(camera.width_px, camera.height_px);
}

// Cameras that look level, up, down and are turned: whatever is over a place is in its tile, or in one that
// comes before.
TEST(TileOrder, HasWhatIsAboveFirst) {
    constexpr unsigned seed = 20261130;
    std::mt19937 random(seed);
    const auto number = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    std::size_t other_tiles = 0;
    for (int i = 0; i < 400; ++i) {
        Camera camera;
        camera.eye = {number(-80.0, 80.0), number(-180.0, 180.0), 500.0};
        camera.attitude = {number(0.0, 360.0), i % 4 == 0 ? 0.0 : number(-60.0, 40.0),
                           i % 3 == 0 ? 0.0 : number(-80.0, 80.0)};
        camera.vertical_fov_deg = number(10.0, 80.0);
        camera.width_px = 1000;
        camera.height_px = 600;
        const int tile_px = 60 + static_cast<int>(number(0.0, 400.0));
        const std::vector<int> columns = columns_by_uprights(camera, tile_px);
        std::vector<int> sorted = columns;
        std::ranges::sort(sorted);
        ASSERT_EQ(static_cast<int>(sorted.size()), (999 + tile_px) / tile_px);
        for (std::size_t k = 0; k < sorted.size(); ++k) ASSERT_EQ(sorted[k], static_cast<int>(k) * tile_px);
        for (int j = 0; j < 200; ++j) {
            const glm::dvec2 from(number(0.0, 1000.0), number(0.0, 600.0));
            const glm::dvec2 to = raised_px(camera, from, number(0.0, 1.5));
            if (to.x < 0.0 || to.y < 0.0 || to.x >= 1000.0 || to.y >= 600.0) continue;
            const std::size_t own = turn_of(columns, from.x, tile_px),
                              other = turn_of(columns, to.x, tile_px);
            ASSERT_LE(other, own) << "seed " << seed << ", camera " << i << ", pitch "
                                  << camera.attitude.pitch_deg << ", roll " << camera.attitude.roll_deg;
            other_tiles += other < own ? 1U : 0U;
        }
    }
    std::printf("seed %u: %zu places are seen in another tile than what is above them\n", seed, other_tiles);
    EXPECT_GT(other_tiles, 2000U);
}

// Upright lines part upwards where a camera looks down: the middle comes last. They meet where it looks up.
TEST(TileOrder, GoesInwardsOrOutwards) {
    Camera camera;
    camera.eye = {46.7, 8.0, 1000.0};
    camera.attitude = {120.0, -20.0, 0.0};
    camera.width_px = 500;
    camera.height_px = 300;
    EXPECT_EQ(columns_by_uprights(camera, 100), (std::vector<int>{400, 300, 0, 100, 200}));
    camera.attitude.pitch_deg = 20.0;
    EXPECT_EQ(columns_by_uprights(camera, 100), (std::vector<int>{200, 100, 0, 300, 400}));
    EXPECT_EQ(columns_by_uprights(camera, 500), std::vector<int>{0});
}

}  // namespace
}  // namespace oro
