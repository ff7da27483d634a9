// The view without --at holds the whole region with a margin of 5 %, whatever its shape and the picture's.
#include "apps/view/overview.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "core/terrain/drawn_heights.h"
#include "tests/support/made_terrain.h"

namespace oro {
namespace {

// Where on the picture a region's posts are: (-1, -1) is its lower left corner, (1, 1) its upper right one.
struct Extent {
    glm::dvec2 low{2.0};
    glm::dvec2 high{-2.0};
    bool all_before_eye{true};

    // The side that posts come nearest to: 0.9 is the margin.
    [[nodiscard]] double nearest() const { return std::max({-low.x, -low.y, high.x, high.y}); }
    // Of the pair of sides that posts come nearest to on both, the side that they are farther from.
    [[nodiscard]] double touched() const {
        return std::max(std::min(-low.x, high.x), std::min(-low.y, high.y));
    }
};

Extent extent_of(const View& view, const HeightField& field) {
    Extent extent;
    const glm::dmat3 view_from_ecef = view.camera.view_from_ecef();
    const glm::dvec3 eye = view.camera.eye_ecef().m;
    for (int row = 0; row < field.grid.rows(); ++row) {
        for (int column = 0; column < field.grid.columns(); ++column) {
            if (is_void(field.H_at_post_m(row, column))) continue;
            const glm::dvec3 at = view_from_ecef * (post_ecef(field, row, column, view.exaggeration).m - eye);
            const glm::dvec2 on_picture =
                glm::dvec2(at) / (std::max(-at.z, 1e-9) * view.camera.half_fov_tangent());
            extent.all_before_eye = extent.all_before_eye && at.z < 0.0;
            extent.low = glm::min(extent.low, on_picture);
            extent.high = glm::max(extent.high, on_picture);
        }
    }
    return extent;
}

// Hills of up to `relief_m`, on columns and rows as far apart as each other on the ground's grid.
HeightField hills(double north_deg, double west_deg, double posts_per_deg, int rows, int columns,
                  float relief_m) {
    return test::made_field(north_deg, west_deg, posts_per_deg, rows, columns, [&](double lat, double lon) {
        const double lat_share = (north_deg - lat) * posts_per_deg,
                     lon_share = (lon - west_deg) * posts_per_deg;
        return relief_m *
               static_cast<float>(0.5 + 0.5 * std::sin(0.21 * lat_share) * std::cos(0.17 * lon_share));
    });
}

View seen(const HeightField& field, const ViewOptions& options, int width_px, int height_px) {
    View view;
    view.camera.width_px = width_px;
    view.camera.height_px = height_px;
    if (options.vertical_fov_deg) view.camera.vertical_fov_deg = *options.vertical_fov_deg;
    Region region{std::vector<RegionGrid>(1)};
    region.grids[0].field = field;
    const Result<void> placed = see_whole_region(view, options, region);
    EXPECT_TRUE(placed.ok()) << placed.error().line();
    return view;
}

struct Case {
    const char* name;
    HeightField field;
};

std::vector<Case> cases() {
    std::vector<Case> all;
    all.push_back({"one tile of the Alps", hills(47, 8, 60, 61, 61, 4000)});
    all.push_back({"74 tiles", hills(56, 12, 10, 81, 121, 2500)});
    all.push_back({"wide", hills(46, 2, 20, 11, 241, 4000)});
    all.push_back({"tall", hills(60, 10, 20, 241, 11, 2000)});
    all.push_back({"across the antimeridian", hills(-15, 177, 30, 121, 181, 1200)});
    all.push_back({"at 89 N", hills(89.5, 20, 60, 61, 61, 3000)});
    all.push_back({"around the pole", hills(90, -180, 2, 11, 721, 3000)});
    all.push_back({"half the Earth", hills(60, -60, 0.5, 61, 61, 5000)});
    all.push_back({"the whole Earth", hills(90, -180, 0.5, 91, 181, 8000)});
    all.push_back({"a survey of 20 m", hills(46.5, 7.5, 360000, 61, 61, 3)});
    all.push_back({"a cliff of 9 km in a survey", hills(46.5, 7.5, 36000, 61, 61, 9000)});
    all.push_back({"a plain at -400 m", hills(31.7, 35.4, 60, 31, 31, 0)});
    for (float& H_m : all.back().field.H_m) H_m = -400.0F;
    all.push_back({"a disc of data in a void square", hills(47, 8, 60, 61, 61, 4000)});
    for (int row = 0; row < 61; ++row) {
        for (int column = 0; column < 61; ++column) {
            if (std::hypot(row - 30, column - 30) > 28.0)
                all.back().field.H_m[static_cast<std::size_t>(row * 61 + column)] = void_height_m;
        }
    }
    return all;
}

TEST(Overview, HoldsEveryRegionInEveryPicture) {
    double loosest = 1.0;
    std::string loosest_of;
    for (const auto& [name, field] : cases()) {
        for (const auto& [width_px, height_px] :
             {std::pair{1280, 720}, {500, 500}, {300, 900}, {2400, 300}}) {
            SCOPED_TRACE(testing::Message() << name << ", " << width_px << "x" << height_px);
            const View view = seen(field, {}, width_px, height_px);
            const Extent extent = extent_of(view, field);
            EXPECT_TRUE(extent.all_before_eye);
            EXPECT_LE(extent.nearest(), 0.9 + 5e-4);  // 5 % of the picture on each side
            EXPECT_GE(extent.touched(), 0.9 - 0.02);  // within 1 % of the picture
            EXPECT_EQ(view.camera.vertical_fov_deg, 30.0);
            if (extent.touched() < loosest) {
                loosest = extent.touched();
                loosest_of = name;
            }
        }
    }
    std::printf("loosest fit: %.6f of 0.9 (%s)\n", loosest, loosest_of.c_str());
}

TEST(Overview, LooksAsTheOptionsSay) {
    constexpr unsigned seed = 20261124;
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    for (int i = 0; i < 40; ++i) {
        ViewOptions options;
        options.heading_deg = 360.0 * share(random);
        options.pitch_deg = -10.0 - 80.0 * share(random);
        options.vertical_fov_deg = 5.0 + 95.0 * share(random);
        const double per_deg = std::pow(10.0, 0.5 + 3.0 * share(random));
        const HeightField field = hills(-80.0 + 160.0 * share(random), -180.0 + 360.0 * share(random),
                                        per_deg, 20, 30, static_cast<float>(3000.0 * share(random)));
        const View view = seen(field, options, 640, 100 + static_cast<int>(600.0 * share(random)));
        const Extent extent = extent_of(view, field);
        SCOPED_TRACE(testing::Message()
                     << "region " << i << ": " << field.grid.north_deg() << "," << field.grid.west_deg()
                     << ", " << 1.0 / per_deg << " degrees a post, heading " << *options.heading_deg
                     << ", pitch " << *options.pitch_deg << ", fov " << *options.vertical_fov_deg);
        EXPECT_TRUE(extent.all_before_eye);
        EXPECT_LE(extent.nearest(), 0.9 + 5e-4);
        // Where the upper rim of the picture is above the horizon, the nearest post may hold the eye back.
        if (*options.pitch_deg + 0.5 * *options.vertical_fov_deg < 0.0) {
            EXPECT_GE(extent.touched(), 0.9 - 0.02);
        }
        EXPECT_EQ(view.camera.vertical_fov_deg, *options.vertical_fov_deg);
    }
}

// A tile of one degree is seen from the south, 40 degrees down; its horizon is level.
TEST(Overview, IsObliqueFromTheSouth) {
    const View view = seen(hills(47, 8, 60, 61, 61, 4000), {}, 1280, 720);
    EXPECT_LT(view.camera.eye.lat_deg, 46.0);
    EXPECT_NEAR(view.camera.eye.lon_deg, 8.5, 0.1);
    EXPECT_NEAR(view.camera.attitude.pitch_deg, -41.0, 2.0);
    EXPECT_EQ(view.camera.attitude.roll_deg, 0.0);
}

// From so far away that no view's file could hold it.
TEST(Overview, RefusesAnEyeBeyondWhatAViewHolds) {
    View view;
    view.camera.width_px = view.camera.height_px = 100;
    ViewOptions options;
    options.vertical_fov_deg = view.camera.vertical_fov_deg = 0.05;
    Region region{std::vector<RegionGrid>(1)};
    region.grids[0].field = hills(90, -180, 0.5, 91, 181, 8000);
    const Result<void> placed = see_whole_region(view, options, region);
    ASSERT_FALSE(placed.ok());
    EXPECT_EQ(placed.error().kind, ErrorKind::usage);
}

}  // namespace
}  // namespace oro
