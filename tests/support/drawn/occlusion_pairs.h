// Eyes in motion, drawn with occlusion and without: the ids in all pixels are the same.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "render/frame/frame_renderer.h"
#include "render/scene/scene.h"
#include "tests/support/asked_count.h"
#include "tests/support/drawn/made_renderer.h"
#include "tests/support/gpu_fixture.h"

namespace oro::test {

// How many pairs a test draws: OROGRAPH_OCCLUSION_PAIRS (500 take minutes), or what it asks for.
inline int occlusion_pairs(int asked) {
    return asked_count("OROGRAPH_OCCLUSION_PAIRS", asked);
}

// Where eyes may stand, and the highest ground there, above the ellipsoid.
struct EyeGround {
    double south_deg, north_deg, west_deg, east_deg;
    std::function<double(double lat_deg, double lon_deg)> ground_m;
};

// Two eyes 0 to 5 km and 0 to 180 degrees apart; half of them under 50 m above the ground, the others up to
// 20 km.
inline std::pair<Camera, Camera> eyes_in_motion(const EyeGround& where, std::mt19937& random, int width_px,
                                                int height_px) {
    const auto between = [&](double a, double b) {
        return std::uniform_real_distribution<double>(a, b)(random);
    };
    const bool low = random() % 2 == 0;
    const double above_m = low ? std::exp(between(std::log(0.5), std::log(50.0)))
                               : std::exp(between(std::log(50.0), std::log(20000.0)));
    Camera one;
    one.width_px = width_px;
    one.height_px = height_px;
    one.vertical_fov_deg = between(15.0, 80.0);
    one.eye = {between(where.south_deg, where.north_deg), between(where.west_deg, where.east_deg), 0.0};
    one.attitude = {between(0, 360), low ? between(-20, 15) : between(-80, 5), between(-30, 30)};
    Camera other = one;
    // Half of all steps are those of a walk or a flight.
    const double step_m = random() % 2 == 0 ? between(0.0, 5000.0) : std::exp(between(-3.0, std::log(500.0)));
    const double turn_deg = random() % 2 == 0 ? between(-180.0, 180.0) : between(-5.0, 5.0);
    const double direction = between(0.0, 2.0 * std::numbers::pi);
    other.eye.lat_deg += step_m * std::cos(direction) / 111000.0;
    other.eye.lon_deg += step_m * std::sin(direction) / 75000.0;
    other.attitude.heading_deg = std::fmod(other.attitude.heading_deg + turn_deg + 720.0, 360.0);
    one.eye.h_m = where.ground_m(one.eye.lat_deg, one.eye.lon_deg) + above_m;
    other.eye.h_m = where.ground_m(other.eye.lat_deg, other.eye.lon_deg) + above_m * between(0.7, 1.4);
    return {one, other};
}

// A renderer with occlusion and one without. The one with it draws as a GPU does, also where there is none;
// split: whole meshlets, or halves of them.
class OcclusionPair {
  public:
    OcclusionPair(const Gpu& gpu, RasterPath path, int width_px, int height_px, bool wrong = false,
                  MeshletSplit split = MeshletSplit::by_device) {
        FrameRendererOptions options;
        options.extent = {static_cast<std::uint32_t>(width_px), static_cast<std::uint32_t>(height_px)};
        options.path = path;
        options.shades = false;
        options.keep_triangles = true;  // ids are read
        options.occlusion = OcclusionUse::off;
        plain_.emplace(made_renderer(gpu, options));
        options.occlusion = OcclusionUse::on;
        options.leave_out_small = true;
        options.shares_triangles = true;
        options.nearest_pyramid = wrong;
        options.split = split;
        with_.emplace(made_renderer(gpu, options));
    }

    // Draws a plan by both; the pixels in which they differ.
    std::size_t differing(const FramePlan& plan) {
        const std::uint32_t width = plan.view.width_px(), height = plan.view.height_px();
        const std::vector<std::uint32_t> one = ids(*plain_, plan), two = ids(*with_, plan);
        std::size_t differ = 0;
        for (std::size_t i = 0; i < one.size(); ++i) {
            if (one[i] == two[i]) continue;
            ++differ;
            if (++reported_ <= 5)
                std::printf("pixel %zu, %zu of %u x %u: %u without, %u with\n", i % width, i / width, width,
                            height, one[i], two[i]);
        }
        pixels += one.size();
        background += static_cast<std::size_t>(std::count(two.begin(), two.end(), 0U));
        last_ids = two;
        return differ;
    }

    std::size_t pixels{}, background{};
    std::vector<std::uint32_t> last_ids;  // of the picture with occlusion that was drawn last
    std::uint64_t drawn_without{}, drawn_with{}, later{}, hidden{};

  private:
    std::vector<std::uint32_t> ids(FrameRenderer& renderer, const FramePlan& plan) {
        auto report = renderer.draw(plan, {});
        EXPECT_TRUE(report.ok()) << report.error().line();
        const gpu::FrameCounts& counts = report->counts;
        (&renderer == &*plain_ ? drawn_without : drawn_with) += counts.meshlets_drawn;
        later += counts.meshlets_drawn_later;
        hidden += counts.meshlets_hidden;
        auto read = renderer.read_ids(plan.view.width_px(), plan.view.height_px());
        EXPECT_TRUE(read.ok()) << read.error().line();
        return std::move(read).value();
    }

    std::optional<FrameRenderer> plain_, with_;
    int reported_{};
};

// Pairs of eyes over a scene: each eye's picture, and of some a part of it with the eye's rays moved, is
// drawn after the one before. The pixels in which pictures with and without occlusion differ.
inline std::size_t draw_pairs(OcclusionPair& renderers, Scene& scene, const EyeGround& where, unsigned seed,
                              int pairs, int width_px, int height_px, const WorldModel& model = {}) {
    std::mt19937 random(seed);
    std::size_t differ = 0;
    for (int i = 0; i < pairs; ++i) {
        const auto [one, other] = eyes_in_motion(where, random, width_px, height_px);
        const double tau_px = i % 3 == 0 ? 0.5 : 1.0;
        for (const Camera& camera : {one, other}) {
            Tile tile{0, 0, width_px, height_px, {0.5, 0.5}};
            if (random() % 4 == 0) tile.sample_px = {0.25, 0.8125};
            if (random() % 8 == 0)
                tile = {width_px / 3, height_px / 4, width_px / 2, height_px / 3, {0.5, 0.5}};
            auto plan = scene.settled_plan({camera, tile, tau_px, model});
            EXPECT_TRUE(plan.ok()) << plan.error().line();
            const std::size_t here = renderers.differing(*plan);
            if (here > 0 && differ == 0)
                std::printf(
                    "pair %d: eye %.6f, %.6f, h %.2f, heading %.1f, pitch %.1f, roll %.1f, fov %.1f\n", i,
                    camera.eye.lat_deg, camera.eye.lon_deg, camera.eye.h_m, camera.attitude.heading_deg,
                    camera.attitude.pitch_deg, camera.attitude.roll_deg, camera.vertical_fov_deg);
            differ += here;
        }
    }
    std::printf(
        "seed %u: %d pairs of eyes, %zu pixels, %zu of them differ; %llu meshlets without occlusion, %llu "
        "with, "
        "%llu of these not in the first round\n",
        seed, pairs, renderers.pixels, differ, static_cast<unsigned long long>(renderers.drawn_without),
        static_cast<unsigned long long>(renderers.drawn_with),
        static_cast<unsigned long long>(renderers.later));
    return differ;
}

}  // namespace oro::test
