// Several grids in one frame: two halves of a region are drawn as the whole of it is.
#include <array>
#include <cmath>
#include <cstdio>
#include <random>

#include "core/terrain/ground.h"
#include "render/frame/frame_renderer.h"
#include "render/scene/scene.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/rough_terrain.h"

namespace oro {
namespace {

constexpr int side_px = 96;

// Columns of a field, as a field of its own.
HeightField columns_of(const HeightField& field, int first, int count) {
    HeightField part;
    part.grid = field.grid;
    part.grid.lon.first += first;
    part.grid.lon.count = count;
    part.undulation = field.undulation;
    for (int row = 0; row < field.grid.rows(); ++row) {
        for (int column = first; column < first + count; ++column)
            part.H_m.push_back(field.H_at_post_m(row, column));
    }
    return part;
}

gpu::FrameStyle plain_style() {
    gpu::FrameStyle style{};
    style.tint_count = 1;
    style.tints[0].colour = gpu::vec3(0.5F);
    style.sun_enu = gpu::vec3(0.0F, 0.6F, 0.8F);
    style.relief = 1.0F;
    style.haze_distance_m = 1e5F;
    style.sky_scale_height_m = 8000.0F;
    return style;
}

class SeveralGrids : public test::GpuTest, public ::testing::WithParamInterface<RasterPath> {
  protected:
    struct Drawn {
        std::vector<float> depths;
        std::vector<std::uint8_t> rgba;
        gpu::FrameCounts counts;
    };
    Drawn draw(Scene& scene, const Camera& camera, double tau_px, std::uint32_t samples = 1) {
        FrameRendererOptions options;
        options.extent = {side_px, side_px};
        options.path = GetParam();
        options.keep_depths = true;
        options.several_samples = samples > 1;
        auto renderer = FrameRenderer::create(*gpu_, options);
        EXPECT_TRUE(renderer.ok()) << renderer.error().line();
        Drawn drawn{};
        for (std::uint32_t i = 0; i < samples; ++i) {
            auto plan = scene.settled_plan({camera, {0, 0, side_px, side_px, {0.5, 0.5}}, tau_px});
            EXPECT_TRUE(plan.ok()) << plan.error().line();
            auto report = renderer->draw(std::move(*plan), plain_style(), i, samples);
            EXPECT_TRUE(report.ok()) << report.error().line();
            drawn.counts = report->counts;
        }
        drawn.depths = *renderer->read_depths(side_px, side_px);
        drawn.rgba = *renderer->read_picture(side_px, side_px);
        return drawn;
    }
    Scene scene_of(const HeightField& field) {
        auto scene = Scene::create(*gpu_, pages_in_memory(field, 1.0, 2), {std::uint64_t{64} << 20U, 0});
        EXPECT_TRUE(scene.ok()) << scene.error().line();
        return std::move(scene).value();
    }
    static Camera camera_over(const HeightField& field, std::mt19937& random) {
        const auto between = [&](double a, double b) {
            return std::uniform_real_distribution<double>(a, b)(random);
        };
        Camera camera;
        const double lat_deg = between(46.7, 46.8), lon_deg = between(8.22, 8.32);
        camera.eye = {lat_deg, lon_deg,
                      *ground_h_m(field, lat_deg, lon_deg) + std::exp(between(std::log(5.0), std::log(2e4)))};
        camera.attitude = {between(0, 360), between(-80, -5), between(-30, 30)};
        camera.vertical_fov_deg = 60.0;
        camera.width_px = camera.height_px = side_px;
        return camera;
    }
};

// At full resolution the same triangles are drawn: the same depths, bit for bit.
TEST_P(SeveralGrids, AreDrawnAsOneOfAllTheirPosts) {
    constexpr unsigned seed = 63;
    std::mt19937 random(seed);
    // Cells beside the cut have not all the posts that else decide about their diagonals, and fall: along
    // these ridges all cells do.
    constexpr std::array<float, 8> ridges{0.0F, 7.0F, 10.0F, 7.0F, 0.0F, -7.0F, -10.0F, -7.0F};
    HeightField field = test::rough_field(46.9, 8.1, 400, 400);
    for (int row = 0; row < 400; ++row)
        for (int column = 0; column < 400; ++column)
            field.H_m[static_cast<std::size_t>(row * 400 + column)] =
                500.0F + 3.0F * static_cast<float>(row) + 2.0F * static_cast<float>(column) +
                ridges[static_cast<std::size_t>((row - column + 400) % 8)];
    Scene whole = scene_of(field), halves = scene_of(columns_of(field, 0, 201));
    halves.add(scene_of(columns_of(field, 200, 200)));
    Scene half = scene_of(columns_of(field, 0, 201));
    std::size_t ground = 0, others = 0, differ = 0, colours = 0;
    for (int i = 0; i < 20; ++i) {
        const Camera camera = camera_over(field, random);
        const Drawn one = draw(whole, camera, 0.0), two = draw(halves, camera, 0.0),
                    left = draw(half, camera, 0.0);
        for (std::size_t pixel = 0; pixel < one.depths.size(); ++pixel) {
            ground += one.depths[pixel] > 0.0F;
            others += left.depths[pixel] != one.depths[pixel];
            differ += one.depths[pixel] != two.depths[pixel];
            int most = 0;
            for (std::size_t c = 0; c < 3; ++c)
                most = std::max(most, std::abs(one.rgba[4 * pixel + c] - two.rgba[4 * pixel + c]));
            colours += most > 3;
        }
        EXPECT_GT(one.counts.triangles_drawn, 0U);
    }
    std::printf(
        "seed %u: %zu pixels of ground, %zu of them of the other half; depths of %zu differ, colours "
        "of %zu by more than 3 codes\n",
        seed, ground, others, differ, colours);
    EXPECT_GT(others, ground / 4);
    EXPECT_EQ(differ, 0U);
    // Slopes beside the seam have a post on one side alone.
    EXPECT_LE(colours, ground / 100);
}

// A coarser cut, and several samples: no hole between two grids, which are not stitched to each other, wider
// than a pixel's share of tau.
TEST_P(SeveralGrids, GiveEachPixelOnceInEverySample) {
    constexpr unsigned seed = 62;
    std::mt19937 random(seed);
    const HeightField field = test::rough_field(46.9, 8.1, 400, 400);
    Scene whole = scene_of(field), halves = scene_of(columns_of(field, 0, 201));
    halves.add(scene_of(columns_of(field, 200, 200)));
    std::size_t differ = 0, count = 0;
    for (int i = 0; i < 6; ++i) {
        const Camera camera = camera_over(field, random);
        const Drawn one = draw(whole, camera, 0.0, 4), two = draw(halves, camera, 0.0, 4);
        for (std::size_t pixel = 0; pixel < one.depths.size(); ++pixel, ++count) {
            int most = 0;
            for (std::size_t c = 0; c < 4; ++c)
                most = std::max(most, std::abs(one.rgba[4 * pixel + c] - two.rgba[4 * pixel + c]));
            differ += most > 3;
        }
    }
    std::printf("seed %u: %zu of %zu pixels of four samples differ by more than 3 codes\n", seed, differ,
                count);
    EXPECT_LE(differ, count / 100);
}

INSTANTIATE_TEST_SUITE_P(Paths, SeveralGrids, ::testing::Values(RasterPath::mesh, RasterPath::compute),
                         [](const auto& path) {
                             return std::string(path.param == RasterPath::mesh ? "mesh" : "compute");
                         });

}  // namespace
}  // namespace oro
