// Skylines and their errors against literal values.
#include "core/measure/skyline_error.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/core/measure/equator.h"

namespace oro {
namespace {

using test::eastward;
using SkylineOfTheEquator = test::Equator;

// Depths of one column with ground from some height downwards, at four heights within each pixel.
struct FourSamples {
    std::vector<std::vector<float>> depths;
    std::vector<DrawnDepths> samples;
    FourSamples(int rows, double ground_from_px) : depths(4) {
        for (std::size_t i = 0; i < 4; ++i) {
            const double y = (static_cast<double>(i) + 0.5) / 4.0;
            for (int row = 0; row < rows; ++row)
                depths[i].push_back(row + y >= ground_from_px ? 1.0e-5F : 0.0F);
        }
        // In any order.
        for (const std::size_t i : {2U, 0U, 3U, 1U})
            samples.push_back({depths[i], {0.5, (static_cast<double>(i) + 0.5) / 4.0}});
    }
};

Camera column_of(int rows) {
    Camera camera = eastward(100.0);
    camera.vertical_fov_deg = 2.0;
    camera.height_px = rows;
    return camera;
}

// The sea's horizon from 100 m: dip with tangent sqrt(2 a 100 + 100^2) / a. 101 rows in 2 degrees are 50.5 /
// tan 1 degree = 2893.11 px for a tangent of 1: the horizon lies at 50.5 + 16.20 = 66.7009 px.
TEST_F(SkylineOfTheEquator, SkylineIsFoundAndItsShiftMeasured) {
    const Camera camera = column_of(101);
    const Sight sight = sight_from(camera.eye);
    const Skyline truth = true_skyline(surface, sight, camera, 1);
    ASSERT_EQ(truth.y_px.size(), 1U);
    EXPECT_NEAR(truth.y_px[0], 66.7009, 1.0 / 128.0 + 1e-4);
    const auto error_px = [&](double ground_from_px) {
        const FourSamples drawn(101, ground_from_px);
        const SkylineError error = skyline_error(surface, sight, camera, drawn.samples, 1);
        EXPECT_EQ(error.in_one_only, 0U);
        EXPECT_EQ(error.summary_px.count, 1U);
        return error.summary_px.largest;
    };
    // Samples lie at .125, .375, .625 and .875: between .625 and .875 is where the horizon is.
    EXPECT_EQ(error_px(66.7), 0.0);
    EXPECT_NEAR(error_px(70.0), 69.875 - 66.7009, 1.0 / 128.0 + 1e-4);
    EXPECT_NEAR(error_px(60.0), 66.7009 - 60.125, 1.0 / 128.0 + 1e-4);
}

// Refraction lifts what is seen at s by c s^2 / 2, c = 0.13 exp(-100 / 8434) / (a sqrt(1 - e2)) = 2.02096e-8
// 1/m: the Earth looks 1 - c a = 0.8711 times as curved, and the dip shrinks by the root of that, from 16.20
// px to 15.1208 px (the largest tangent over the lifted circle, by search).
TEST_F(SkylineOfTheEquator, SkylineThroughBendingAir) {
    const Camera camera = column_of(101);
    const Skyline truth = true_skyline(surface, sight_from(camera.eye, standard_air), camera, 1);
    EXPECT_NEAR(truth.y_px[0], 50.5 + 15.1208, 1.0 / 128.0 + 1e-4);
}

TEST(SkylineError, CountsColumnsWithGroundInOneOnly) {
    const Camera camera = column_of(10);
    const FourSamples ground(10, 5.0), sky(10, 99.0), full(10, 0.0);
    const SkylineError drawn_only = skyline_error(Skyline{{not_measured}}, camera, ground.samples);
    EXPECT_EQ(drawn_only.in_one_only, 1U);
    EXPECT_EQ(drawn_only.summary_px.count, 0U);
    EXPECT_EQ(drawn_only.px[0], not_measured);
    EXPECT_EQ(skyline_error(Skyline{{5.0F}}, camera, sky.samples).in_one_only, 1U);
    EXPECT_EQ(skyline_error(Skyline{{not_measured}}, camera, sky.samples).in_one_only, 0U);
    // The last sample lies at 9.875: ground below it is in no drawn picture.
    EXPECT_EQ(skyline_error(Skyline{{9.8F}}, camera, sky.samples).in_one_only, 1U);
    EXPECT_EQ(skyline_error(Skyline{{9.9F}}, camera, sky.samples).in_one_only, 0U);
    // At the top in both: no skyline to compare.
    EXPECT_EQ(skyline_error(Skyline{{0.0F}}, camera, full.samples).summary_px.count, 0U);
    EXPECT_EQ(skyline_error(Skyline{{0.0F}}, camera, full.samples).in_one_only, 0U);
    // At the top in one: it is off by at least what is seen of it. Samples at 4.875 and 0.125 are the ends.
    EXPECT_EQ(skyline_error(Skyline{{0.0F}}, camera, ground.samples).summary_px.largest, 4.875);
    EXPECT_EQ(skyline_error(Skyline{{5.0F}}, camera, full.samples).summary_px.largest, 4.875);
}

}  // namespace
}  // namespace oro
