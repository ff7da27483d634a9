// Where measures are hard to take: near sloping ground, on walls, at spikes, and where ground moves sideways.
#include <GeographicLib/Geocentric.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <glm/geometric.hpp>
#include <random>
#include <string>

#include "core/base/parallel.h"
#include "geo/opening/open_region.h"
#include "geo/region/region.h"
#include "tests/extremes/accuracy_table.h"
#include "tests/extremes/stage.h"
#include "tests/support/rough_terrain.h"
#include "tests/support/test_data.h"

namespace oro::test {
namespace {

constexpr const char* measures_group = "Slopes, walls and spikes";
constexpr double metres_per_deg = 111200.0;

bool is_full() {
    const char* const wanted = std::getenv("OROGRAPH_EXTREMES");
    return wanted && std::strcmp(wanted, "full") == 0;
}

class ExtremeMeasures : public Extremes {
  protected:
    // The promise of a picture at full detail; what is found to 1/64 px may be off by that.
    static void expect_within_slack(const Camera& camera, const PictureErrors& errors) {
        const double slack_px = errors.slack_px;
        EXPECT_LE(errors.largest_px(), slack_px)
            << "displacement " << errors.ground.summary_displacement_px.largest << ", surface "
            << errors.ground.summary_surface_px.largest << ", seen " << errors.seen.summary_px.largest
            << ", skyline " << errors.skyline.summary_px.largest << " px; nearest " << errors.nearest_m
            << " m; eye " << camera.eye.lat_deg << "," << camera.eye.lon_deg << " h " << camera.eye.h_m
            << " heading " << camera.attitude.heading_deg << " pitch " << camera.attitude.pitch_deg
            << " roll " << camera.attitude.roll_deg << " fov " << camera.vertical_fov_deg;
        EXPECT_EQ(errors.ground.beyond_data, 0U);
    }

    static void record(const std::string& row, const PictureErrors& errors) {
        const auto add = [&](const char* measure, const ErrorSummary& of) {
            measured(measures_group, row + ", " + measure, of.largest, of.count);
        };
        add("displacement", errors.ground.summary_displacement_px);
        add("surface", errors.ground.summary_surface_px);
        add("seen", errors.seen.summary_px);
        add("skyline", errors.skyline.summary_px);
    }

    // Somewhere over the inner part of a field, so high above the ground.
    static Camera random_camera(std::mt19937_64& random, const Stage& stage, double above_m) {
        std::uniform_real_distribution<double> unit(0.0, 1.0);
        const PostGrid& grid = stage.field().grid;
        Geodetic eye;
        eye.lat_deg = grid.south_deg() + (0.3 + 0.4 * unit(random)) * (grid.north_deg() - grid.south_deg());
        eye.lon_deg = grid.west_deg() + (0.3 + 0.4 * unit(random)) * (grid.east_deg() - grid.west_deg());
        eye.h_m = stage.surface().h_m(eye.lat_deg, eye.lon_deg).value_or(0.0) + above_m;
        const double roll_deg = random() % 3 == 0 ? 360.0 * unit(random) : 0.0;
        Camera camera = strip_camera(eye, {360.0 * unit(random), -85.0 + 95.0 * unit(random), roll_deg});
        camera.width_px = 8;
        return camera;
    }
};

// Mostly 30 degrees, 18 to 40, rising to the north.
float slope_m(double lat_deg, double lon_deg) {
    const double north_m = (lat_deg - 46.0) * metres_per_deg, east_m = (lon_deg - 8.0) * 77000.0;
    return static_cast<float>(0.577 * north_m + 8.0 * std::sin(north_m / 32.0) * std::cos(east_m / 27.0));
}

struct Above {
    const char* row;
    double m;
};
constexpr Above heights_above[] = {
    {"0.5 m above slopes of 30 degrees", 0.5},     {"1 m above slopes of 30 degrees", 1.0},
    {"2 m above slopes of 30 degrees", 2.0},       {"5 m above slopes of 30 degrees", 5.0},
    {"10 m above slopes of 30 degrees", 10.0},     {"100 m above slopes of 30 degrees", 100.0},
    {"1,000 m above slopes of 30 degrees", 1000.0}};

TEST_F(ExtremeMeasures, AboveSlopes) {
    constexpr std::uint64_t seed = 1105;
    const int views = is_full() ? 15 : 1;
    std::printf("seed %llu, %d views of each height\n", static_cast<unsigned long long>(seed), views);
    Stage stage(*gpu_, made_field(46.1, 8.0, 3600.0, 300, 300, slope_m));
    std::mt19937_64 random(seed);
    for (const Above& above : heights_above) {
        for (int view = 0; view < views; ++view) {
            const Camera camera = random_camera(random, stage, above.m);
            const PictureErrors errors = stage.measure(camera, RasterPath::compute).errors;
            expect_within_slack(camera, errors);
            record(above.row, errors);
        }
    }
}

// The same over real ground; one of the eyes is where the floor once was 0.437 px at 2 m. No rows of the
// table: not everybody has the data.
TEST_F(ExtremeMeasures, AboveRealSlopes) {
    struct Ground {
        const char* folder;
        const char* tiles;
        Geodetic eye;  // 2 m above it
    };
    constexpr std::uint64_t seed = 1106;
    const int views = is_full() ? 5 : 0;
    double worst_share = 0.0;
    std::mt19937_64 random(seed);
    for (const Ground& ground : {Ground{"himalaya", "N29E082:N29E082", {29.1464, 82.6730, 0.0}},
                                 Ground{"alps", "N46E007:N46E007", {46.02, 7.74, 0.0}}}) {
        if (!is_full() && std::string(ground.folder) == "alps") continue;
        if (!real_data(ground.folder)) GTEST_SKIP() << "needs " << ground.folder;
        RegionRequest request;
        request.paths = {real_data(ground.folder)->string()};
        request.box = *parse_tile_range(ground.tiles);
        auto region = open_region(request);
        ASSERT_TRUE(region.ok()) << region.error().line();
        Stage stage(*gpu_, std::move(region->grids[0].field));
        const auto look = [&](const Camera& camera) {
            const PictureErrors errors = stage.measure(camera, RasterPath::compute).errors;
            expect_within_slack(camera, errors);
            worst_share = std::max(worst_share, errors.largest_px() / errors.slack_px);
        };
        for (const double heading_deg : {0.0, 120.0, 240.0}) {
            Geodetic eye = ground.eye;
            eye.h_m = stage.ground_h_m(eye.lat_deg, eye.lon_deg) + 2.0;
            look(strip_camera(eye, {heading_deg, -15.0, 0.0}));
        }
        for (const Above& above : heights_above) {
            for (int view = 0; view < views; ++view) {
                Camera camera = random_camera(random, stage, above.m);
                camera.vertical_fov_deg = std::uniform_real_distribution<double>(10.0, 100.0)(random);
                look(camera);
            }
        }
    }
    std::printf("seed %llu, %d views of each height: at most %.2f of what is promised\n",
                static_cast<unsigned long long>(seed), views, worst_share);
}

// 9 km of height from one post to the next.
TEST_F(ExtremeMeasures, WallOfNineKilometres) {
    const double wall_deg = 8.0 + 150.0 / 3600.0;
    Stage stage(*gpu_, made_field(46.1, 8.0, 3600.0, 300, 300, [&](double, double lon_deg) {
        return lon_deg < wall_deg ? 0.0F : 9000.0F;
    }));
    struct Look {
        const char* row;
        double west_m, h_m, pitch_deg;
    };
    for (const Look& look : {Look{"a wall of 9 km in one cell, from the side", 3000.0, 4500.0, 0.0},
                             Look{"a wall of 9 km in one cell, from the side", 600.0, 2000.0, 30.0},
                             Look{"a wall of 9 km in one cell, from above", 0.0, 11000.0, -90.0},
                             Look{"a wall of 9 km in one cell, from above", 1500.0, 12000.0, -80.0}}) {
        for (const double aside_deg : {0.0, 35.0}) {
            const Geodetic eye{46.06, wall_deg - (look.west_m + 10.0) / 77300.0, look.h_m};
            Camera camera = strip_camera(eye, {90.0 + aside_deg, look.pitch_deg, 0.0});
            camera.width_px = 8;
            const PictureErrors errors = stage.measure(camera, RasterPath::compute).errors;
            expect_within_slack(camera, errors);
            record(look.row, errors);
        }
    }
}

// One post high above a plain, wherever its tip lies between the columns of pixels.
TEST_F(ExtremeMeasures, Spikes) {
    constexpr std::uint64_t seed = 1107;
    const int views = is_full() ? 60 : 4;
    std::printf("seed %llu, %d views\n", static_cast<unsigned long long>(seed), views);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (const float high_m : {100.0F, 500.0F}) {
        int post = 0;
        const int spike = 40 * 600 + 300;
        Stage stage(*gpu_, made_field(46.1, 8.0, 3600.0, 600, 600,
                                      [&](double, double) { return post++ == spike ? high_m : 0.0F; }));
        const PostGrid& grid = stage.field().grid;
        const Geodetic tip{grid.lat.at_deg(40), grid.lon.at_deg(300), high_m};
        for (int view = 0; view < views; ++view) {
            const double away_m = 2000.0 + 13000.0 * unit(random);
            const Geodetic eye{tip.lat_deg - away_m / metres_per_deg, tip.lon_deg + 0.01 * unit(random),
                               2.0 + 300.0 * unit(random)};
            Camera camera = strip_camera(eye, attitude_towards(eye, tip));
            camera.width_px = 16;
            camera.attitude.heading_deg += 0.1 * unit(random);
            camera.attitude.roll_deg = 60.0 * unit(random) - 30.0;
            const PictureErrors errors = stage.measure(camera, RasterPath::compute).errors;
            expect_within_slack(camera, errors);
            measured(measures_group, "spikes of 100 and 500 m on a plain, skyline", errors.skyline.summary_px.largest,
                     errors.skyline.summary_px.count);
        }
    }
}

// Where ground and sky are the same in all pixels, the skyline is not off.
TEST_F(ExtremeMeasures, SkylineOfTheSameMask) {
    constexpr std::uint64_t seed = 1108;
    const int views = is_full() ? 5 : 1;
    std::printf("seed %llu, %d views\n", static_cast<unsigned long long>(seed), views);
    Stage stage(*gpu_, rough_field(47.0, 8.0, 500, 500));
    std::mt19937_64 random(seed);
    for (int view = 0; view < views; ++view) {
        std::uniform_real_distribution<double> unit(0.0, 1.0);
        Camera camera = random_camera(random, stage, 5.0 + 300.0 * unit(random));
        camera.width_px = is_full() ? 640 : 160;
        camera.height_px = is_full() ? 360 : 90;
        camera.attitude.pitch_deg = 10.0 * unit(random) - 5.0;
        const Stage::Measured all = stage.measure(camera, RasterPath::compute);
        const auto hits =
            Oracle(stage.surface(), sight_from(camera.eye)).cast_picture(camera, thread_count());
        int differ = 0;
        for (std::size_t i = 0; i < hits.size(); ++i)
            differ += hits[i].has_value() != !all.picture.points[i].background() ? 1 : 0;
        expect_within_slack(camera, all.errors);
        if (differ == 0)
            measured(measures_group, "the skyline where no pixel of the mask differs",
                     all.errors.skyline.summary_px.largest, all.errors.skyline.summary_px.count);
    }
}

// A plain from 60 km straight above, drawn on a sphere: its ground moves sideways along itself.
TEST_F(ExtremeMeasures, SidewaysOnASphere) {
    Stage stage(*gpu_, made_field(47.0, 9.0, 300.0, 301, 301, [](double, double) { return 500.0F; }));
    Camera camera = strip_camera({46.5, 9.5, 60000.0}, {0.0, -90.0, 0.0}, 60.0);
    camera.width_px = 1600;
    camera.height_px = 1000;
    DepthPictureOptions options;
    options.tau_px = 0.0;
    options.model.earth = Earth::sphere;
    options.skyline = false;
    DepthPainter painter(*gpu_, RasterPath::compute);
    const auto picture = painter.draw(stage.scene(), camera, {}, options);
    ASSERT_TRUE(picture.ok()) << picture.error().line();
    const auto& earth = GeographicLib::Geocentric::WGS84();
    glm::dvec3 eye;
    earth.Forward(camera.eye.lat_deg, camera.eye.lon_deg, camera.eye.h_m, eye.x, eye.y, eye.z);
    const glm::dmat3 view_from_ecef = camera.view_from_ecef();
    const double px_per_tangent = 0.5 * camera.height_px / camera.half_fov_tangent().y;
    const GroundMeter meter(stage.surface(), sight_from(camera.eye), camera);
    std::vector<double> moved_px;
    double apart_px = 0.0;
    for (std::size_t i = 0; i < picture->points.size(); i += 37) {
        const DrawnPoint& point = picture->points[i];
        if (point.background()) continue;
        const glm::dvec2 centre_px(static_cast<double>(i % 1600) + 0.5, static_cast<double>(i / 1600) + 0.5);
        glm::dvec3 truth;
        earth.Forward(47.0 - point.row / 300.0, 9.0 + point.column / 300.0, 500.0, truth.x, truth.y, truth.z);
        const glm::dvec3 seen = view_from_ecef * (truth - eye);
        const glm::dvec2 seen_px =
            glm::dvec2(800.0, 500.0) + px_per_tangent * glm::dvec2(seen.x, -seen.y) / -seen.z;
        moved_px.push_back(glm::length(seen_px - centre_px));
        const auto displacement = meter.displacement(centre_px, point);
        ASSERT_TRUE(displacement.has_value());
        apart_px = std::max(apart_px, std::abs(displacement->px - moved_px.back()));
    }
    ASSERT_GT(moved_px.size(), 10000U);
    std::sort(moved_px.begin(), moved_px.end());
    measured(measures_group, "--earth sphere straight down from 60 km", moved_px.back(), moved_px.size());
    measured(measures_group, "--earth sphere straight down from 60 km, median", moved_px[moved_px.size() / 2],
             moved_px.size());
    measured(measures_group, "--earth sphere straight down from 60 km, as measured", apart_px, moved_px.size());
}

}  // namespace
}  // namespace oro::test
