// Pictures whose shadows are held against the oracle: each pixel's place on the ground against the sight line
// from there to the sun's middle.
#pragma once

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <span>

#include "core/base/parallel.h"
#include "core/measure/shown_place.h"
#include "core/truth/oracle.h"
#include "core/truth/view_set.h"
#include "geo/region/region.h"
#include "geo/together/cut_regions.h"
#include "geo/together/region_ground.h"
#include "render/frame/depth_picture.h"
#include "tests/scenes/scene_of_grids.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/height_storage.h"
#include "tests/support/real_views.h"

namespace oro::test {

inline constexpr double edge_px = 2.0;

// The share of the sun's disc that shows is the light of the pixel: no slope, no air, no other light.
inline gpu::FrameStyle shares_alone(const glm::dvec3& sun_enu) {
    gpu::FrameStyle style{};
    style.tint_count = 1;
    style.tints[0] = {0.0F, gpu::vec3(static_cast<float>(1.0 / sun_enu.z))};
    style.relief = 1e-6F;
    style.sun_enu = gpu::vec3(sun_enu);
    style.haze_distance_m = 1e20F;
    style.sky_scale_height_m = 8000.0F;
    style.shadows = 1;
    return style;
}

enum class Truth : std::uint8_t { none, lit, dark };

// Sight lines begin a little above the ground, so that they do not meet the triangle that they begin on.
inline Truth truth_at(const TrueGround& ground, const Oracle& oracle, const DrawnPoint& point,
                      const glm::dvec3& sun_ecef) {
    constexpr double lift_m = 0.02, reach_m = 1.0e6;
    const TrueSurface& surface = ground.surface(point.grid);
    const auto h_m = surface.h_at_m(point.row, point.column);
    if (point.background() || !h_m) return Truth::none;
    const PostPlace at = surface.field().grid.place_at(point.row, point.column);
    const Ecef from = ecef_from_geodetic({at.lat_deg, at.lon_deg, *h_m + lift_m});
    return oracle.first_hit_from(from, sun_ecef, reach_m) ? Truth::dark : Truth::lit;
}

// What lies between grids has no posts of its own: by those of the grid whose ground is the highest there,
// for a step is a line on these pictures. Rims are where they are to a hundredth of a post.
inline void place_on_grids(const TrueGround& ground, const Camera& camera, std::vector<DrawnPoint>& points) {
    const Sight sight = sight_from(camera.eye);
    for (std::size_t i = 0; i < points.size(); ++i) {
        DrawnPoint& point = points[i];
        if (point.background() || point.grid < ground.grids()) continue;
        const auto width = static_cast<std::size_t>(camera.width_px);
        const glm::dvec2 pixel(static_cast<double>(i % width) + 0.5, static_cast<double>(i / width) + 0.5);
        const PostPlace at = place_of(point, ground, sight, camera, pixel);
        double highest_m = -1.0e9;
        point.grid = 0;
        for (std::size_t grid = 0; grid < ground.grids(); ++grid) {
            const PostGrid& posts = ground.surface(grid).field().grid;
            const PostNumber there = posts.post_at(at.lat_deg, at.lon_deg);
            const double row = std::clamp(there.row, 0.0, posts.rows() - 1.0),
                         column = std::clamp(there.column, 0.0, posts.columns() - 1.0);
            if (std::max(std::abs(row - there.row), std::abs(column - there.column)) > 0.01) continue;
            const auto h_m = ground.surface(grid).h_at_m(row, column);
            if (!h_m || *h_m <= highest_m) continue;
            highest_m = *h_m;
            point.grid = static_cast<std::uint32_t>(grid);
            point.row = row;
            point.column = column;
        }
    }
}

struct Tally {
    std::uint64_t asked{}, dark{}, differ{}, far{};
};

class ShadowsOfPictures : public GpuTest {
  protected:
    Tally all;
    int width_px = 192, height_px = 108;

    // A place between pixels, from those around it; nothing where they show ground that is apart.
    [[nodiscard]] DrawnPoint between(const std::vector<DrawnPoint>& points, double x, double y) const {
        const int left = static_cast<int>(std::floor(x)), up = static_cast<int>(std::floor(y));
        if (left < 0 || up < 0 || left + 1 >= width_px || up + 1 >= height_px) return {};
        const auto at = [&](int i, int j) -> const DrawnPoint& {
            return points[static_cast<std::size_t>(j * width_px + i)];
        };
        const std::array four{&at(left, up), &at(left + 1, up), &at(left, up + 1), &at(left + 1, up + 1)};
        double nearest_m = four[0]->z_m, farthest_m = nearest_m;
        for (const DrawnPoint* one : four) {
            if (one->grid != four[0]->grid) return {};
            nearest_m = std::min(nearest_m, one->z_m);
            farthest_m = std::max(farthest_m, one->z_m);
        }
        if (nearest_m <= 0.0 || farthest_m > 1.1 * nearest_m) return {};
        const double i = x - left, j = y - up;
        const auto mixed = [&](double DrawnPoint::*value) {
            return (four[0]->*value * (1.0 - i) + four[1]->*value * i) * (1.0 - j) +
                   (four[2]->*value * (1.0 - i) + four[3]->*value * i) * j;
        };
        return {mixed(&DrawnPoint::row), mixed(&DrawnPoint::column), mixed(&DrawnPoint::z_m),
                mixed(&DrawnPoint::h_m), four[0]->grid};
    }

    // Shadows smaller than a pixel have edges, too.
    [[nodiscard]] bool near_small_edge(const TrueGround& ground, const Oracle& oracle,
                                       const std::vector<DrawnPoint>& points, int x, int y, Truth own,
                                       const glm::dvec3& sun_ecef) const {
        constexpr int steps = 16;
        for (int j = -steps; j <= steps; ++j)
            for (int i = -steps; i <= steps; ++i) {
                if (std::hypot(i, j) > steps) continue;
                const DrawnPoint there = between(points, x + i * edge_px / steps, y + j * edge_px / steps);
                const Truth truth = truth_at(ground, oracle, there, sun_ecef);
                if (truth != own && truth != Truth::none) return true;
            }
        return false;
    }

    [[nodiscard]] bool near_edge(const std::vector<Truth>& truth, int x, int y, Truth own) const {
        const int reach = static_cast<int>(edge_px);
        for (int j = std::max(0, y - reach); j <= std::min(height_px - 1, y + reach); ++j)
            for (int i = std::max(0, x - reach); i <= std::min(width_px - 1, x + reach); ++i) {
                const Truth there = truth[static_cast<std::size_t>(j * width_px + i)];
                if (there != own && there != Truth::none && std::hypot(i - x, j - y) <= edge_px) return true;
            }
        return false;
    }

    void look(const char* name, Scene& scene, DepthPainter& painter, const TrueGround& ground,
              const Camera& camera, double azimuth_deg, double elevation_deg) {
        const SineCosine a = sine_cosine_deg(azimuth_deg), e = sine_cosine_deg(elevation_deg);
        const glm::dvec3 sun_enu{e.cosine * a.sine, e.cosine * a.cosine, e.sine};
        const glm::dvec3 sun_ecef = ecef_from_enu(camera.eye.lat_deg, camera.eye.lon_deg) * sun_enu;
        DepthPictureOptions options;
        options.skyline = false;
        auto picture = painter.draw(scene, camera, shares_alone(sun_enu), options);
        ASSERT_TRUE(picture.ok()) << picture.error().line();
        ASSERT_TRUE(picture->settled);
        place_on_grids(ground, camera, picture->points);
        const Oracle oracle(ground, sight_from(camera.eye));
        std::vector<Truth> truth(picture->points.size());
        in_parallel(height_px, thread_count(), [&](int y) {
            for (int x = 0; x < width_px; ++x) {
                const auto i = static_cast<std::size_t>(y * width_px + x);
                truth[i] = truth_at(ground, oracle, picture->points[i], sun_ecef);
            }
        });
        Tally tally;
        std::string worst;
        for (int y = 0; y < height_px; ++y)
            for (int x = 0; x < width_px; ++x) {
                const auto i = static_cast<std::size_t>(y * width_px + x);
                if (truth[i] == Truth::none) continue;
                constexpr int half = 188;  // half of the light, as a code of sRGB
                const Truth drawn = picture->rgba[4 * i] >= half ? Truth::lit : Truth::dark;
                ++tally.asked;
                tally.dark += truth[i] == Truth::dark;
                if (drawn == truth[i]) continue;
                ++tally.differ;
                constexpr std::uint64_t enough = 100;  // a look around a pixel takes hundreds of lines
                if (near_edge(truth, x, y, truth[i]) ||
                    (tally.far < enough &&
                     near_small_edge(ground, oracle, picture->points, x, y, truth[i], sun_ecef)))
                    continue;
                ++tally.far;
                if (worst.empty())
                    worst = " e.g. " + std::to_string(x) + "," + std::to_string(y) + " code " +
                            std::to_string(picture->rgba[4 * i]) + " grid " +
                            std::to_string(picture->points[i].grid) + " row " +
                            std::to_string(picture->points[i].row) + " column " +
                            std::to_string(picture->points[i].column);
            }
        std::printf(
            "%s: eye %.4f,%.4f h %8.0f heading %4.0f pitch %4.0f, sun %4.0f,%4.1f: %6llu px, %5.1f %% dark, "
            "%4llu differ, %3llu of them not at an edge; %.3f s shading%s\n",
            name, camera.eye.lat_deg, camera.eye.lon_deg, camera.eye.h_m, camera.attitude.heading_deg,
            camera.attitude.pitch_deg, azimuth_deg, elevation_deg,
            static_cast<unsigned long long>(tally.asked),
            tally.asked > 0 ? 100.0 * static_cast<double>(tally.dark) / static_cast<double>(tally.asked)
                            : 0.0,
            static_cast<unsigned long long>(tally.differ), static_cast<unsigned long long>(tally.far),
            picture->report.shade_s, worst.c_str());
        all.asked += tally.asked;
        all.dark += tally.dark;
        all.differ += tally.differ;
        all.far += tally.far;
    }

    void look_over(const char* name, const HeightField& field, int views) {
        auto made = Scene::create(*gpu_, pages_in_memory(field, 1.0, thread_count()),
                                  {std::uint64_t{1} << 30U, 0}, asked_heights());
        ASSERT_TRUE(made.ok()) << made.error().line();
        Scene scene = std::move(made).value();
        const TrueSurface surface(field, 1.0, thread_count());
        DepthPainter painter(*gpu_, RasterPath::compute);
        std::mt19937_64 random(real_view_seed);
        std::uniform_real_distribution<double> azimuth_deg(0.0, 360.0), high_deg(20.0, 60.0),
            low_deg(8.0, 20.0), lowest_deg(1.0, 8.0);
        for (const Camera& camera : made_cameras(real_view_seed, field, views, width_px, height_px))
            for (auto* elevation : {&high_deg, &low_deg, &lowest_deg}) {
                const double towards_deg = azimuth_deg(random);
                ASSERT_NO_FATAL_FAILURE(
                    look(name, scene, painter, surface, camera, towards_deg, (*elevation)(random)));
            }
    }

    // From eyes that look down on a place by 30 degrees, and from others, under some suns.
    void look_over_grids(const char* name, const Region& region, std::span<const Camera> cameras,
                         std::initializer_list<std::pair<double, double>> suns) {
        const auto cuts = cut_regions(region);
        ASSERT_TRUE(cuts.ok()) << cuts.error().line();
        const auto ground = RegionGround::of(region, *cuts, 1.0);
        ASSERT_TRUE(ground.ok()) << ground.error().line();
        Scene scene = scene_of_grids(*gpu_, region, *cuts, seam_between(region, *cuts, 1.0));
        DepthPainter painter(*gpu_, RasterPath::compute);
        for (const Camera& camera : cameras) {
            width_px = camera.width_px;
            height_px = camera.height_px;
            for (const auto& [azimuth_deg, elevation_deg] : suns)
                ASSERT_NO_FATAL_FAILURE(
                    look(name, scene, painter, (*ground)->ground(), camera, azimuth_deg, elevation_deg));
        }
    }

    void judge(int views, int suns = 3) {
        std::printf(
            "seed %llu, %d views at %d suns: %llu pixels, %llu in shadow, %llu differ (%.3f %%), %llu of "
            "them "
            "not "
            "within %.0f px of an edge\n",
            static_cast<unsigned long long>(real_view_seed), views, suns,
            static_cast<unsigned long long>(all.asked), static_cast<unsigned long long>(all.dark),
            static_cast<unsigned long long>(all.differ),
            100.0 * static_cast<double>(all.differ) / static_cast<double>(all.asked),
            static_cast<unsigned long long>(all.far), edge_px);
        EXPECT_GT(all.dark, all.asked / 50) << "or the test sees no shadow";
        EXPECT_LE(static_cast<double>(all.differ), 0.005 * static_cast<double>(all.asked));
        EXPECT_EQ(all.far, 0U);
    }
};

}  // namespace oro::test
