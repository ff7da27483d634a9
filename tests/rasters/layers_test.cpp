// Must hold: what layers tell of a pixel is what its own sight line truly meets. Against the oracle, over all
// pixels of views of made and real terrain at full resolution.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>

#include "apps/layers/picture_layers.h"
#include "core/base/parallel.h"
#include "core/terrain/horn_slope.h"
#include "core/truth/oracle.h"
#include "core/truth/view_set.h"
#include "tests/styles/drawn_style.h"
#include "tests/support/drawn/region_scene.h"
#include "tests/support/real_views.h"
#include "tests/support/rough_terrain.h"

namespace oro {
namespace {

constexpr int width_px = 240, height_px = 160;
constexpr double allowed_px = 0.01;

double allowed_m(double distance_m) {
    return 1.0e-3 + 3.2e-7 * distance_m;
}

struct Tally {
    std::uint64_t ground{}, same{}, at_edges{}, others{}, missed{}, shadows{}, shadows_differ{};
    double largest_m{}, largest_share{}, largest_px{};
};

class LayersOfPictures : public test::GpuTest {
  protected:
    Tally all;

    // Where the layers have a pixel's place: from the eye, as it is seen.
    static glm::dvec3 seen_m(const PictureLayers& layers, std::size_t i, const Sight& sight) {
        const Geodetic place{layers.latitude_deg[i], layers.longitude_deg[i],
                             static_cast<double>(layers.h_m[i])};
        return sight.refraction.apparent_m(ecef_from_geodetic(place).m - sight.eye.m);
    }

    // Whether a sight line within a hundredth of a pixel meets ground where the layers have it: the pixel's
    // middle is then at an edge, where two grounds meet to less than drawing can tell apart.
    static bool is_at_edge(const Oracle& oracle, const Camera& camera, double x, double y, float layer_m) {
        for (int i = 0; i < 32; ++i) {
            const double away_px = i < 16 ? allowed_px : 0.5 * allowed_px, turn = i * std::numbers::pi / 8.0;
            const auto hit = oracle.first_hit(
                camera.ecef_direction_at({x + away_px * std::cos(turn), y + away_px * std::sin(turn)}),
                sight_reach_m(camera.eye.h_m));
            if (std::isnan(layer_m) ? !hit : hit && std::abs(hit->distance_m - layer_m) < 0.005 * layer_m)
                return true;
        }
        return false;
    }

    void compare(const PictureLayers& layers, const TrueSurface& surface, const View& view, Tally& tally) {
        const Camera& camera = view.camera;
        const Sight sight = sight_from(camera.eye, view.model.air);
        const Oracle oracle(surface, sight);
        const auto hits = oracle.cast_picture(camera, thread_count());
        const double px_per_rad = height_px / (2.0 * camera.half_fov_tangent().y);
        for (std::size_t i = 0; i < hits.size(); ++i) {
            const bool has_layers = !std::isnan(layers.latitude_deg[i]);
            tally.ground += has_layers;
            if (!has_layers && !hits[i]) continue;
            const double x = static_cast<double>(i % width_px) + 0.5,
                         y = static_cast<double>(i / width_px) + 0.5;
            if (has_layers && hits[i]) {
                // Float32 holds heights to a quarter of a millimetre; what is compared is the place.
                Geodetic place = hits[i]->point;
                const double h_m = place.h_m;
                place.lat_deg = layers.latitude_deg[i];
                place.lon_deg = layers.longitude_deg[i];
                const double off_m = std::hypot(
                    glm::length(ecef_from_geodetic(place).m - ecef_from_geodetic(hits[i]->point).m),
                    static_cast<double>(layers.h_m[i]) - h_m);
                if (off_m <= allowed_m(hits[i]->distance_m)) {
                    ++tally.same;
                    tally.largest_m = std::max(tally.largest_m, off_m);
                    tally.largest_share =
                        std::max(tally.largest_share, off_m / allowed_m(hits[i]->distance_m));
                    const double off_px =
                        px_per_rad * glm::length(glm::cross(glm::normalize(seen_m(layers, i, sight)),
                                                            camera.ecef_direction_at({x, y})));
                    // A float32 height alone is as far off as that.
                    const double rounded_px = px_per_rad * 2.5e-4 / hits[i]->distance_m;
                    tally.largest_px = std::max(tally.largest_px, off_px - rounded_px);
                    continue;
                }
            }
            ++(is_at_edge(oracle, camera, x, y, layers.distance_m[i]) ? tally.at_edges : tally.others);
        }
        tally.missed += layers.missed_px;
    }

    // Sight lines of their own towards the sun, each with an oracle made for it.
    static void compare_shadows(const PictureLayers& layers, const TrueSurface& surface, const View& view,
                                const SunDirection& sun, Tally& tally) {
        const SineCosine a = sine_cosine_deg(sun.azimuth_deg), e = sine_cosine_deg(sun.elevation_deg);
        const Geodetic& eye = view.camera.eye;
        const glm::dvec3 towards = ecef_from_enu(eye.lat_deg, eye.lon_deg) *
                                   glm::dvec3(e.cosine * a.sine, e.cosine * a.cosine, e.sine);
        for (std::size_t i = 0; i < layers.shadow.size(); i += 23) {
            const auto h_m = surface.h_m(layers.latitude_deg[i], layers.longitude_deg[i]);
            if (std::isnan(layers.latitude_deg[i]) || !h_m) continue;
            const Geodetic place{layers.latitude_deg[i], layers.longitude_deg[i], *h_m + 0.02};
            const bool dark = first_hit(surface, sight_from(place), towards, 1.5e6).has_value();
            ++tally.shadows;
            tally.shadows_differ += dark != (layers.shadow[i] == 0.0F);
        }
    }

    void look_over(const char* name, Region region, std::uint64_t seed, int views, const Air& air) {
        auto scene = test::create_scene(*gpu_, region);
        ASSERT_TRUE(scene.ok()) << scene.error().line();
        const TrueSurface surface(region.grids[0].field, 1.0, thread_count());
        // And level ones, whose skylines and ridges have edges.
        std::vector<Camera> cameras = made_cameras(seed, region.grids[0].field, views, width_px, height_px);
        for (const double heading_deg : {25.0, 205.0}) {
            Camera level = cameras.front();
            level.attitude = {heading_deg, -3.0, 4.0};
            level.eye.h_m = surface.h_m(level.eye.lat_deg, level.eye.lon_deg).value() + 300.0;
            cameras.push_back(level);
        }
        for (const Camera& camera : cameras) {
            View view;
            view.camera = camera;
            view.tau_px = 0.0;
            view.model.air = air;
            Style style{};
            style.sun = {135.0, 20.0, {}};
            const auto layers = picture_layers(*gpu_, *scene, view, *RegionGround::of(region, 1.0).value(),
                                               style, RasterPath::compute, {});
            ASSERT_TRUE(layers.ok()) << layers.error().line();
            Tally tally;
            compare(*layers, surface, view, tally);
            compare_shadows(*layers, surface, view, style.sun, tally);
            std::printf(
                "%s: eye %.4f,%.4f h %9.1f: %6llu px of ground, %6llu the same (largest %.2g m, %.2g of what "
                "is allowed, %.2g px), %3llu at edges, %llu other; %llu rays beside; %llu of %llu shadows "
                "differ\n",
                name, camera.eye.lat_deg, camera.eye.lon_deg, camera.eye.h_m,
                static_cast<unsigned long long>(tally.ground), static_cast<unsigned long long>(tally.same),
                tally.largest_m, tally.largest_share, tally.largest_px,
                static_cast<unsigned long long>(tally.at_edges),
                static_cast<unsigned long long>(tally.others), static_cast<unsigned long long>(tally.missed),
                static_cast<unsigned long long>(tally.shadows_differ),
                static_cast<unsigned long long>(tally.shadows));
            EXPECT_EQ(tally.others, 0U);
            EXPECT_LE(tally.largest_px, allowed_px);
            all.ground += tally.ground;
            all.same += tally.same;
            all.at_edges += tally.at_edges;
            all.shadows += tally.shadows;
            all.shadows_differ += tally.shadows_differ;
        }
    }

    void judge(std::uint64_t seed) const {
        std::printf("seed %llu: %llu px of ground, %llu the same as the oracle's, %llu at edges (%.4f %%)\n",
                    static_cast<unsigned long long>(seed), static_cast<unsigned long long>(all.ground),
                    static_cast<unsigned long long>(all.same), static_cast<unsigned long long>(all.at_edges),
                    100.0 * static_cast<double>(all.at_edges) / static_cast<double>(all.ground));
        EXPECT_GT(all.same, 50'000U) << "or the test sees no ground";
        EXPECT_LE(static_cast<double>(all.at_edges), 0.002 * static_cast<double>(all.ground));
        EXPECT_EQ(all.shadows_differ, 0U);
        EXPECT_GT(all.shadows, 1'000U);
    }
};

TEST_F(LayersOfPictures, OfMadeTerrainAreTheOracles) {
    Region region{std::vector<RegionGrid>(1)};
    region.grids[0].field = test::rough_field(47.0, 8.0, 500, 600);
    look_over("made terrain", region, 503, 4, {});
    look_over("made terrain, standard air", std::move(region), 504, 2, standard_air);
    judge(503);
}

TEST_F(LayersOfPictures, OfRealTerrainAreTheOracles) {
    constexpr std::uint64_t seed = 505;
    for (const test::RealRegion& real : test::real_regions) {
        if (!test::real_data(real.folder)) GTEST_SKIP() << "needs " << real.folder;
        RegionRequest request;
        request.paths = {test::real_data(real.folder)->string()};
        request.box = *parse_tile_range(real.tiles);
        auto region = open_region(request);
        ASSERT_TRUE(region.ok()) << region.error().line();
        look_over(real.folder, std::move(*region), seed, 3, standard_air);
    }
    judge(seed);
}

// With detail left out the place is on what is drawn: on its own ray, and as near to the truth as tau says.
TEST_F(LayersOfPictures, OfCoarserPicturesLieOnTheirRays) {
    Region region{std::vector<RegionGrid>(1)};
    region.grids[0].field = test::rough_field(47.0, 8.0, 500, 600);
    auto scene = test::create_scene(*gpu_, region);
    ASSERT_TRUE(scene.ok());
    View view;
    view.camera = {{46.9, 8.2, 9000.0}, {30.0, -15.0, 0.0}, 45.0, width_px, height_px};
    view.tau_px = 2.0;
    view.model.air = standard_air;
    Style style{};
    style.sun = {135.0, 20.0, {}};
    const auto layers = picture_layers(*gpu_, *scene, view, *RegionGround::of(region, 1.0).value(), style,
                                       RasterPath::compute, {});
    ASSERT_TRUE(layers.ok()) << layers.error().line();
    const Sight sight = sight_from(view.camera.eye, view.model.air);
    const double px_per_rad = height_px / (2.0 * view.camera.half_fov_tangent().y);
    double largest_px = 0.0;
    std::size_t ground = 0;
    for (std::size_t i = 0; i < layers->h_m.size(); ++i) {
        if (std::isnan(layers->h_m[i])) continue;
        ++ground;
        const glm::dvec3 ray = view.camera.ecef_direction_at(
            {static_cast<double>(i % width_px) + 0.5, static_cast<double>(i / width_px) + 0.5});
        largest_px = std::max(
            largest_px, px_per_rad * glm::length(glm::cross(glm::normalize(seen_m(*layers, i, sight)), ray)));
    }
    std::printf("%zu px of ground, at most %.2g px off their rays\n", ground, largest_px);
    EXPECT_GT(ground, 5'000U);
    EXPECT_LE(largest_px, allowed_px);
}

// A plane that rises 10 m in 100 to the east: atan(0.1) = 5.7106 degrees, at posts, between them and at rims.
// The posts are 100 m apart at 1,500 m, in the middle: elsewhere by up to 0.07 % less or more.
TEST(HornSlope, OfAPlaneIsItsAngle) {
    const HeightField field =
        test::square_field(46.5, 8.0, 100.0, 60, [](int, int column) { return 10.0 * column; });
    for (const double row : {0.0, 12.25, 30.0, 58.0, 59.0})
        for (const double column : {1.0, 17.75, 30.0, 58.0})
            EXPECT_NEAR(*horn_slope_deg(field, row, column), 5.7106, 0.0045) << row << " " << column;
    for (const double column : {0.0, 59.0})
        EXPECT_NEAR(*horn_slope_deg(field, 30.0, column), 5.7106, 0.0045) << column;
    EXPECT_FALSE(horn_slope_deg(field, -0.1, 3.0));
    EXPECT_FALSE(horn_slope_deg(field, 3.0, 59.1));
}

// Of gdaldem slope on the same posts.
TEST(HornSlope, AtPostsIsGdaldems) {
    const HeightField field = test::square_field(46.5, 8.0, 90.0, 80, [](int row, int column) {
        return 1500.0 + 300.0 * std::sin(0.21 * row) * std::cos(0.17 * column) +
               3.0 * ((row * 7 + column * 13) % 11);
    });
    const auto bands = test::gdaldem(test::local_raster(field, 90.0, 90.0), "slope");
    ASSERT_EQ(bands.size(), 1U);
    double largest_deg = 0.0;
    for (int row = 1; row < 79; ++row)
        for (int column = 1; column < 79; ++column)
            largest_deg = std::max(largest_deg, std::abs(*horn_slope_deg(field, row, column) -
                                                         static_cast<double>(bands[0].at(row, column))));
    std::printf("largest difference from gdaldem: %.4f degrees\n", largest_deg);
    EXPECT_LT(largest_deg, 0.02);
}

}  // namespace
}  // namespace oro
