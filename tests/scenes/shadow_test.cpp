// Must hold: what lies in shadow on a picture lies in shadow in truth. Each pixel's place on the ground
// against the oracle's sight line from there to the sun's middle.
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>

#include "core/base/parallel.h"
#include "core/truth/oracle.h"
#include "core/truth/view_set.h"
#include "geo/region/region.h"
#include "render/frame/depth_picture.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/height_storage.h"
#include "tests/support/net_terrain.h"
#include "tests/support/real_views.h"
#include "tests/support/rough_terrain.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

constexpr int width_px = 192, height_px = 108;
constexpr double edge_px = 2.0;

// The share of the sun's disc that shows is the light of the pixel: no slope, no air, no other light.
gpu::FrameStyle shares_alone(const glm::dvec3& sun_enu) {
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
Truth truth_at(const TrueSurface& surface, const DrawnPoint& point, const glm::dvec3& sun_ecef,
               double reach_m) {
    constexpr double lift_m = 0.02;
    const PostGrid& grid = surface.field().grid;
    const auto h_m = surface.h_at_m(point.row, point.column);
    if (point.background() || !h_m) return Truth::none;
    const PostPlace at = grid.place_at(point.row, point.column);
    const Geodetic place{at.lat_deg, at.lon_deg, *h_m + lift_m};
    return first_hit(surface, sight_from(place), sun_ecef, reach_m) ? Truth::dark : Truth::lit;
}

struct Tally {
    std::uint64_t asked{}, dark{}, differ{}, far{};
};

class ShadowsOfPictures : public test::GpuTest {
  protected:
    Tally all;

    // A place between pixels, from those around it; nothing where they show ground that is apart.
    static DrawnPoint between(const std::vector<DrawnPoint>& points, double x, double y) {
        const int left = static_cast<int>(std::floor(x)), up = static_cast<int>(std::floor(y));
        if (left < 0 || up < 0 || left + 1 >= width_px || up + 1 >= height_px) return {};
        const auto at = [&](int i, int j) -> const DrawnPoint& {
            return points[static_cast<std::size_t>(j * width_px + i)];
        };
        const std::array four{&at(left, up), &at(left + 1, up), &at(left, up + 1), &at(left + 1, up + 1)};
        double nearest_m = four[0]->z_m, farthest_m = nearest_m;
        for (const DrawnPoint* one : four) {
            nearest_m = std::min(nearest_m, one->z_m);
            farthest_m = std::max(farthest_m, one->z_m);
        }
        if (nearest_m <= 0.0 || farthest_m > 1.1 * nearest_m) return {};
        const double i = x - left, j = y - up;
        const auto mixed = [&](double DrawnPoint::*value) {
            return (four[0]->*value * (1.0 - i) + four[1]->*value * i) * (1.0 - j) +
                   (four[2]->*value * (1.0 - i) + four[3]->*value * i) * j;
        };
        return {mixed(&DrawnPoint::row), mixed(&DrawnPoint::column), mixed(&DrawnPoint::z_m)};
    }

    // Shadows smaller than a pixel have edges, too.
    static bool near_small_edge(const TrueSurface& surface, const std::vector<DrawnPoint>& points, int x,
                                int y, Truth own, const glm::dvec3& sun_ecef) {
        constexpr int steps = 16;
        for (int j = -steps; j <= steps; ++j)
            for (int i = -steps; i <= steps; ++i) {
                if (std::hypot(i, j) > steps) continue;
                const DrawnPoint there = between(points, x + i * edge_px / steps, y + j * edge_px / steps);
                const Truth truth = truth_at(surface, there, sun_ecef, 1.0e6);
                if (truth != own && truth != Truth::none) return true;
            }
        return false;
    }

    static bool near_edge(const std::vector<Truth>& truth, int x, int y, Truth own) {
        const int reach = static_cast<int>(edge_px);
        for (int j = std::max(0, y - reach); j <= std::min(height_px - 1, y + reach); ++j)
            for (int i = std::max(0, x - reach); i <= std::min(width_px - 1, x + reach); ++i) {
                const Truth there = truth[static_cast<std::size_t>(j * width_px + i)];
                if (there != own && there != Truth::none && std::hypot(i - x, j - y) <= edge_px) return true;
            }
        return false;
    }

    void look(const char* name, Scene& scene, DepthPainter& painter, const TrueSurface& surface,
              const Camera& camera, double azimuth_deg, double elevation_deg) {
        const SineCosine a = sine_cosine_deg(azimuth_deg), e = sine_cosine_deg(elevation_deg);
        const glm::dvec3 sun_enu{e.cosine * a.sine, e.cosine * a.cosine, e.sine};
        const glm::dvec3 sun_ecef = ecef_from_enu(camera.eye.lat_deg, camera.eye.lon_deg) * sun_enu;
        const auto picture = painter.draw(scene, camera, shares_alone(sun_enu), {});
        ASSERT_TRUE(picture.ok()) << picture.error().line();
        ASSERT_TRUE(picture->settled);
        std::vector<Truth> truth(picture->points.size());
        in_parallel(height_px, thread_count(), [&](int y) {
            for (int x = 0; x < width_px; ++x) {
                const auto i = static_cast<std::size_t>(y * width_px + x);
                truth[i] = truth_at(surface, picture->points[i], sun_ecef, 1.0e6);
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
                if (near_edge(truth, x, y, truth[i]) ||
                    near_small_edge(surface, picture->points, x, y, truth[i], sun_ecef))
                    continue;
                ++tally.far;
                if (worst.empty())
                    worst = " e.g. " + std::to_string(x) + "," + std::to_string(y) + " code " +
                            std::to_string(picture->rgba[4 * i]) + " row " +
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
                                  {std::uint64_t{1} << 30U, 0}, test::asked_heights());
        ASSERT_TRUE(made.ok()) << made.error().line();
        Scene scene = std::move(made).value();
        const TrueSurface surface(field, 1.0, thread_count());
        DepthPainter painter(*gpu_, RasterPath::compute);
        std::mt19937_64 random(test::real_view_seed);
        std::uniform_real_distribution<double> azimuth_deg(0.0, 360.0), high_deg(20.0, 60.0),
            low_deg(8.0, 20.0), lowest_deg(1.0, 8.0);
        for (const Camera& camera : made_cameras(test::real_view_seed, field, views, width_px, height_px))
            for (auto* elevation : {&high_deg, &low_deg, &lowest_deg}) {
                const double towards_deg = azimuth_deg(random);
                ASSERT_NO_FATAL_FAILURE(
                    look(name, scene, painter, surface, camera, towards_deg, (*elevation)(random)));
            }
    }

    void judge(int views) {
        std::printf(
            "seed %llu, %d views at 3 suns: %llu pixels, %llu in shadow, %llu differ (%.3f %%), %llu of them "
            "not "
            "within %.0f px of an edge\n",
            static_cast<unsigned long long>(test::real_view_seed), views,
            static_cast<unsigned long long>(all.asked), static_cast<unsigned long long>(all.dark),
            static_cast<unsigned long long>(all.differ),
            100.0 * static_cast<double>(all.differ) / static_cast<double>(all.asked),
            static_cast<unsigned long long>(all.far), edge_px);
        EXPECT_GT(all.dark, all.asked / 50) << "or the test sees no shadow";
        EXPECT_LE(static_cast<double>(all.differ), 0.005 * static_cast<double>(all.asked));
        EXPECT_EQ(all.far, 0U);
    }
};

TEST_F(ShadowsOfPictures, OfMadeTerrainAreTheOracles) {
    const int views = (test::view_count(6) + 2) / 3;
    look_over("made terrain", test::rough_field(47.0, 8.0, 700, 900), views);
    judge(views);
}

// Posts that lie on nets: turned, and over a pole.
TEST_F(ShadowsOfPictures, OnNetsAreTheOracles) {
    const int views = (test::view_count(6) + 2) / 3;
    for (const auto& [name, plane] :
         {std::pair("a turned net", test::PlaneOfPosts{700, 900, {46.5, 8.0}, 80.0, 27.0}),
          std::pair("a net over the pole", test::PlaneOfPosts{700, 700, {89.9, 40.0}, 90.0, 0.0})})
        look_over(name, test::net_field(plane, test::patchy_H_m, 40.0F), views);
    judge(2 * views);
}

TEST_F(ShadowsOfPictures, OfRealTerrainAreTheOracles) {
    const int views = test::view_count(6);
    for (std::size_t i = 0; i < test::real_regions.size(); ++i) {
        const test::RealRegion& real = test::real_regions[i];
        if (!test::real_data(real.folder)) GTEST_SKIP() << "needs " << real.folder;
        RegionRequest request;
        request.paths = {test::real_data(real.folder)->string()};
        request.box = *parse_tile_range(real.tiles);
        const auto region = open_region(request);
        ASSERT_TRUE(region.ok()) << region.error().line();
        look_over(real.folder, region->field, test::views_of(i, views));
    }
    judge(views);
}

// Where a cell of posts covers hundreds of pixels, shaded smoothly, a triangle of it that is turned away from
// the sun was a dark patch with hard edges. The ground in the foreground has no other shadow on it here.
TEST_F(ShadowsOfPictures, HaveNoEdgesOfTrianglesNearTheEye) {
    const auto alps = test::real_data("alps");
    if (!alps) GTEST_SKIP() << "needs alps";
    RegionRequest request;
    request.paths = {alps->string()};
    request.box = *parse_tile_range("N46E007:N46E008");
    const auto region = open_region(request);
    ASSERT_TRUE(region.ok()) << region.error().line();
    auto made = Scene::create(*gpu_, pages_in_memory(region->field, 1.0, thread_count()),
                              {std::uint64_t{1} << 30U, 0});
    ASSERT_TRUE(made.ok()) << made.error().line();
    DepthPainter painter(*gpu_, RasterPath::compute);
    Camera camera{{46.67, 8.06, 2537.0}, {205.0, -4.0, 0.0}, 45.0, width_px, height_px};
    const SineCosine a = sine_cosine_deg(315.0), e = sine_cosine_deg(38.0);
    gpu::FrameStyle style = shares_alone({e.cosine * a.sine, e.cosine * a.cosine, e.sine});
    style.tints[0].colour = gpu::vec3(0.8F);
    style.relief = 1.2F;
    const auto with = painter.draw(*made, camera, style, {});
    style.shadows = 0;
    const auto without = painter.draw(*made, camera, style, {});
    ASSERT_TRUE(with.ok() && without.ok());
    int darker = 0, most = 0;
    for (int y = height_px * 3 / 4; y < height_px; ++y)
        for (int x = width_px / 2; x < width_px; ++x) {
            const auto i = static_cast<std::size_t>(4 * (y * width_px + x));
            const int by = without->rgba[i] - with->rgba[i];
            darker += by > 20;
            most = std::max(most, by);
        }
    std::printf("%d pixels darker by more than 20 codes, the darkest by %d\n", darker, most);
    EXPECT_LE(darker, 10);
}

}  // namespace
}  // namespace oro
