// The calibration finishes, measures both ways of drawing and knows the faster.
#include "render/frame/calibration.h"

#include <cstdio>

#include "tests/support/gpu_fixture.h"

namespace oro {
namespace {

class CalibrationTest : public test::GpuTest {};

TEST_F(CalibrationTest, MeasuresBothWays) {
    if (!gpu_->report().mesh_shader || !gpu_->report().compute_raster)
        GTEST_SKIP() << "needs a device with both ways of drawing";
    const auto measured = calibrate(*gpu_);
    ASSERT_TRUE(measured.ok()) << measured.error().line();
    std::printf("%s: mesh %.3f ms, compute %.3f ms, best of %d, all in %.0f ms\n",
                gpu_->report().name.c_str(), 1e3 * measured->mesh_s, 1e3 * measured->compute_s,
                measured->rounds, 1e3 * measured->took_s);
    // More than one tick of a clock that does not run, less than any frame of 256 meshlets may take.
    EXPECT_GT(measured->mesh_s, 1e-8);
    EXPECT_GT(measured->compute_s, 1e-8);
    EXPECT_LT(measured->mesh_s, 10.0);
    EXPECT_LT(measured->compute_s, 10.0);
    EXPECT_GE(measured->rounds, 1);
    EXPECT_LE(measured->rounds, 5);
    EXPECT_GE(measured->took_s, measured->rounds * (measured->mesh_s + measured->compute_s));
    EXPECT_EQ(measured->faster(),
              measured->mesh_s < measured->compute_s ? RasterPath::mesh : RasterPath::compute);
}

TEST_F(CalibrationTest, TheFasterIsTheOneThatTookLess) {
    Calibration calibration;
    calibration.mesh_s = 0.002;
    calibration.compute_s = 0.001;
    EXPECT_EQ(calibration.faster(), RasterPath::compute);
    calibration.compute_s = 0.003;
    EXPECT_EQ(calibration.faster(), RasterPath::mesh);
}

}  // namespace
}  // namespace oro
