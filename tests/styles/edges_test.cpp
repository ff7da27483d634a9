// Smooth edges of pictures of one sample, against 64 samples of the same view.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <random>
#include <span>
#include <utility>

#include "apps/view/style.h"
#include "core/terrain/ground.h"
#include "render/frame/picture_renderer.h"
#include "tests/styles/region_with_means.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/real_views.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

constexpr int width_px = 192, height_px = 108, samples = 64;

// RGBA, and what decides where edges are.
struct Drawn {
    std::vector<std::uint8_t> rgba;
    std::vector<float> depths;  // reversed: 0 is the background
    std::vector<std::uint32_t> ids;
};

class SmoothEdges : public test::GpuTest {
  protected:
    void SetUp() override {
        const auto alps = test::real_data("alps");
        if (!alps) GTEST_SKIP() << "needs alps";
        GpuTest::SetUp();
        ASSERT_NO_FATAL_FAILURE(test::open_with_means(
            *gpu_,
            {(*alps / "N46E007.SRTMGL3.hgt.zip").string(), (*alps / "N46E008.SRTMGL3.hgt.zip").string()},
            region_, scene_));
        View view;
        view.sun = SunDirection{215.0, 35.0};
        const auto style = load_style(view, region_.grids[0].field);
        ASSERT_TRUE(style.ok()) << style.error().line();
        style_ = style->frame;
    }
    void TearDown() override {
        renderers_.clear();
        scene_.reset();
        GpuTest::TearDown();
    }

    Drawn draw(const Camera& camera, int count, bool smooth, RasterPath path = RasterPath::compute) {
        FrameRendererOptions options;
        options.extent = {width_px, height_px};
        options.several_samples = count > 1;
        options.smooth_edges = smooth;
        options.keep_depths = true;
        options.path = path;
        std::optional<FrameRenderer>& renderer =
            renderers_[{options.several_samples, smooth, path == RasterPath::mesh}];
        if (!renderer) {
            auto made = FrameRenderer::create(*gpu_, options);
            EXPECT_TRUE(made.ok()) << made.error().line();
            renderer.emplace(std::move(*made));
        }
        for (int i = 0; i < count; ++i) {
            auto plan =
                scene_->settled_plan({camera, {0, 0, width_px, height_px, sample_place(i, count)}, 1.0});
            EXPECT_TRUE(plan.ok()) << plan.error().line();
            const auto drawn = renderer->draw(std::move(*plan), style_, static_cast<std::uint32_t>(i),
                                              static_cast<std::uint32_t>(count));
            EXPECT_TRUE(drawn.ok()) << drawn.error().line();
        }
        return {*renderer->read_picture(width_px, height_px), *renderer->read_depths(width_px, height_px),
                *renderer->read_ids(width_px, height_px)};
    }

    // Pixels at either side of an edge: where depth, which is linear over a plane, jumps by 2 % or more and
    // by more than twice what it changes by on either side.
    static std::vector<bool> next_to_edges(const std::vector<float>& depths) {
        std::vector<bool> next_to(depths.size());
        const auto look = [&](int x, int y, int dx, int dy) {
            const auto at = [&](int step) {
                const int cx = std::clamp(x + step * dx, 0, width_px - 1),
                          cy = std::clamp(y + step * dy, 0, height_px - 1);
                return static_cast<std::size_t>(cy) * width_px + static_cast<std::size_t>(cx);
            };
            const double here = depths[at(0)], there = depths[at(1)];
            const auto slope = [&](std::size_t one, std::size_t other) {
                return depths[one] > 0.0F && depths[other] > 0.0F
                           ? std::abs(static_cast<double>(depths[one]) - depths[other])
                           : 0.0;
            };
            const double jump = std::abs(here - there);
            const bool edge = here == 0.0 || there == 0.0
                                  ? here != there
                                  : jump >= 0.02 * std::min(here, there) &&
                                        jump > 2.0 * std::max(slope(at(-1), at(0)), slope(at(1), at(2)));
            if (edge) next_to[at(0)] = next_to[at(1)] = true;
        };
        for (int y = 0; y < height_px; ++y) {
            for (int x = 0; x < width_px; ++x) {
                look(x, y, 1, 0);
                look(x, y, 0, 1);
            }
        }
        return next_to;
    }

    // Mean difference of those pixels, 8-bit codes.
    static double difference(const Drawn& one, const Drawn& truth, const std::vector<bool>& of) {
        double sum = 0.0, count = 0.0;
        for (std::size_t i = 0; i < of.size(); ++i) {
            if (!of[i]) continue;
            for (std::size_t k = 4 * i; k < 4 * i + 3; ++k) sum += std::abs(one.rgba[k] - truth.rgba[k]);
            count += 3.0;
        }
        return sum / count;
    }

    [[nodiscard]] Camera over(double lat_deg, double lon_deg, double above_m, double heading_deg,
                              double pitch_deg, double fov_deg) const {
        const double h_m = ground_h_m(region_.grids[0].field, lat_deg, lon_deg, 1.0).value_or(0.0) + above_m;
        return Camera{{lat_deg, lon_deg, h_m}, {heading_deg, pitch_deg, 0.0}, fov_deg, width_px, height_px};
    }

    // Against 64 samples: far nearer than the picture without smooth edges; and no more than `bound` where
    // the style has no materials, whose contrast is what edges are mixed of.
    void hold(const char* what, const Camera& camera, double bound) {
        const gpu::uint materials = std::exchange(style_.materials.on, 0U);
        const double smooth = hold_share(what, camera);
        EXPECT_LE(smooth, bound) << what;
        style_.materials.on = materials;
        hold_share("... of materials", camera);
    }
    double hold_share(const char* what, const Camera& camera) {
        const Drawn truth = draw(camera, samples, false), steps = draw(camera, 1, false);
        const std::vector<bool> edges = next_to_edges(steps.depths);
        const auto count = std::count(edges.begin(), edges.end(), true);
        EXPECT_GT(count, 200) << what;
        const double without = difference(steps, truth, edges),
                     smooth = difference(draw(camera, 1, true), truth, edges);
        std::printf("%-32s %4td pixels: %.2f codes, %.2f without smooth edges\n", what, count, smooth,
                    without);
        EXPECT_LE(smooth, 0.6 * without) << what;
        return smooth;
    }

    // Pixels of two pictures that differ by more than `codes`.
    static std::vector<bool> apart(const std::vector<std::uint8_t>& one,
                                   const std::vector<std::uint8_t>& other, int bytes_a_px, int codes) {
        std::vector<bool> differ(one.size() / static_cast<std::size_t>(bytes_a_px));
        for (std::size_t i = 0; i < one.size(); ++i) {
            if (std::abs(one[i] - other[i]) > codes) differ[i / static_cast<std::size_t>(bytes_a_px)] = true;
        }
        return differ;
    }

    // Every such pixel is one of `ties`, or beside one.
    static void hold_next_to(const std::vector<bool>& differ, const std::vector<bool>& ties) {
        for (int y = 0; y < height_px; ++y) {
            for (int x = 0; x < width_px; ++x) {
                if (!differ[static_cast<std::size_t>(y) * width_px + static_cast<std::size_t>(x)]) continue;
                bool next_to = false;
                for (int row = std::max(0, y - 1); row <= std::min(height_px - 1, y + 1); ++row) {
                    for (int column = std::max(0, x - 1); column <= std::min(width_px - 1, x + 1); ++column)
                        next_to =
                            next_to ||
                            ties[static_cast<std::size_t>(row) * width_px + static_cast<std::size_t>(column)];
                }
                EXPECT_TRUE(next_to) << "pixel " << x << "," << y;
            }
        }
    }

    std::vector<std::uint8_t> in_tiles(const Camera& camera, bool smooth, int tile_px) {
        gpu::FrameStyle style = style_;
        style.smooth_edges = smooth ? 1 : 0;
        style.shadows = style.sky_openness = 0;  // they are found in whole groups of pixels
        PictureOptions options;
        options.largest_tile_px = tile_px;
        options.path = RasterPath::compute;
        std::vector<std::uint8_t> rgb;
        const auto report = render_picture(*gpu_, *scene_, camera, style, options,
                                           [&](std::span<const std::uint8_t> row) -> Result<void> {
                                               rgb.insert(rgb.end(), row.begin(), row.end());
                                               return {};
                                           });
        EXPECT_TRUE(report.ok()) << report.error().line();
        EXPECT_EQ(rgb.size(), std::size_t{3} * width_px * height_px);
        return rgb;
    }

    [[nodiscard]] Camera over_grindelwald() const { return over(46.66, 8.06, 300.0, 205.0, 3.0, 14.0); }

    Region region_{std::vector<RegionGrid>(1)};
    std::optional<Scene> scene_;
    gpu::FrameStyle style_{};
    // By what they are made for: several samples, smooth edges, mesh shaders.
    std::map<std::array<bool, 3>, std::optional<FrameRenderer>> renderers_;
};

TEST_F(SmoothEdges, AreThoseOfSixtyFourSamples) {
    hold("over Grindelwald", over_grindelwald(), 3.7);
    hold("the same, half the angle", over(46.66, 8.06, 300.0, 205.0, 3.0, 7.0), 4.3);
    hold("over the lake of Brienz", over(46.72, 7.95, 500.0, 150.0, 2.0, 30.0), 1.3);
    hold("from 20 km", over(46.2, 8.0, 20000.0, 0.0, -10.0, 30.0), 1.5);
    hold("from a summit", over(46.5776, 8.0053, 100.0, 60.0, -3.0, 14.0), 2.1);
    constexpr unsigned seed = 20261122;
    std::printf("seed %u\n", seed);
    std::mt19937 random(seed);
    const auto between = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    for (int i = 0; i < test::view_count(1); ++i) {
        const double above_m = between(30.0, 1500.0), pitch_deg = between(-6.0, 0.0),
                     fov_deg = between(7.0, 30.0);
        const Camera camera =
            over(between(46.3, 46.7), between(7.3, 8.7), above_m, between(0.0, 360.0), pitch_deg, fov_deg);
        char what[80];
        std::snprintf(what, sizeof what, "%.0f m up, pitch %.0f, fov %.0f", above_m, pitch_deg, fov_deg);
        hold(what, camera, 2.9);
    }
}

// Straight down over gentle ground (the plains around Berne) none hides other ground.
TEST_F(SmoothEdges, LeaveGroundWithoutEdgesAlone) {
    for (const double above_m : {3000.0, 20000.0}) {
        const Camera down = over(46.9, 7.35, above_m, 0.0, -90.0, 25.0);
        const Drawn steps = draw(down, 1, false);
        EXPECT_EQ(std::count(steps.depths.begin(), steps.depths.end(), 0.0F), 0) << "background is seen";
        const std::vector<bool> changed = apart(draw(down, 1, true).rgba, steps.rgba, 4, 0);
        EXPECT_EQ(std::count(changed.begin(), changed.end(), true), 0) << above_m << " m up";
    }
}

// But beside pixels whose middle lies on an edge of two triangles.
TEST_F(SmoothEdges, AreTheSameByBothWaysOfDrawing) {
    const Camera camera = over_grindelwald();
    const Drawn compute = draw(camera, 1, true), mesh = draw(camera, 1, true, RasterPath::mesh);
    std::vector<bool> ties(compute.ids.size());
    for (std::size_t i = 0; i < ties.size(); ++i) ties[i] = compute.ids[i] != mesh.ids[i];
    const std::vector<bool> differ = apart(compute.rgba, mesh.rgba, 4, 0);
    std::printf("%td pixels differ, %td show another triangle\n",
                std::count(differ.begin(), differ.end(), true), std::count(ties.begin(), ties.end(), true));
    EXPECT_LE(std::count(ties.begin(), ties.end(), true), 12);
    hold_next_to(differ, ties);
    EXPECT_NE(compute.rgba, draw(camera, 1, false).rgba) << "no edge is smooth";
}

// A tile's own projection rounds differently: where triangles are far smaller than pixels another of them may
// be the one whose edge counts. Those are about one in a hundred of the pixels beside edges.
TEST_F(SmoothEdges, FitTogetherInTiles) {
    const Camera camera = over_grindelwald();
    const auto count_apart = [&](bool smooth, int tile_px) {
        const auto differ = apart(in_tiles(camera, smooth, 0), in_tiles(camera, smooth, tile_px), 3, 1);
        return std::count(differ.begin(), differ.end(), true);
    };
    const auto smooth = count_apart(true, 16), steps = count_apart(false, 16);
    std::printf("%td pixels differ by 2 codes or more, %td without smooth edges\n", smooth, steps);
    EXPECT_LE(steps, 4);
    EXPECT_LE(smooth, 12);
}

}  // namespace
}  // namespace oro
