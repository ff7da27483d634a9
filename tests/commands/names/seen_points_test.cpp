// Which named points an eye sees: against a walk along each sight line in small steps.
#include "apps/names/seen_points.h"
#include "geo/opening/open_region.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <memory>
#include <optional>
#include <random>

#include "apps/names/names_in_view.h"
#include "core/base/parallel.h"
#include "core/terrain/ground.h"
#include "geo/region/region.h"
#include "tests/support/made_terrain.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

// A view over a tile, towards a field of points.
struct Stage {
    std::unique_ptr<Region> region;
    std::unique_ptr<TrueSurface> surface;
    Camera camera;
};

std::optional<Stage> alps() {
    const auto tile = test::real_data("alps/N46E010.SRTMGL3.hgt.zip");
    if (!tile) return std::nullopt;
    RegionRequest request;
    request.paths = {tile->string()};
    auto region = open_region(request);
    EXPECT_TRUE(region.ok());
    Stage stage{std::make_unique<Region>(std::move(*region)), nullptr, {}};
    stage.surface = std::make_unique<TrueSurface>(stage.region->grids[0].field, 1.0, thread_count());
    Camera& camera = stage.camera;
    camera.eye = {46.95, 10.3, 0.0};
    camera.eye.h_m = *stage.surface->h_m(camera.eye.lat_deg, camera.eye.lon_deg) + 1500.0;
    camera.attitude = {140.0, -8.0, 5.0};
    camera.width_px = 1920, camera.height_px = 1080;
    return stage;
}

// How high above the ground the sight line to a place passes at its lowest, walked in steps of 4 m. Where the
// line is straight it is a chord; bent, each of its points is lifted back.
double lowest_passage_m(const Stage& stage, const WorldModel& model, const Geodetic& target) {
    const Refraction refraction(stage.camera.eye, model.air);
    const glm::dvec3 eye = stage.camera.eye_ecef().m;
    const glm::dvec3 seen_at = refraction.apparent_m(ecef_from_geodetic(target).m - eye);
    const double distance_m = glm::length(seen_at);
    double lowest_m = 1e9;
    for (double at_m = 1.0; at_m < distance_m - 0.5; at_m += 4.0) {
        const Geodetic point = geodetic_from_ecef({eye + refraction.true_m(seen_at * (at_m / distance_m))});
        if (const auto h_m = stage.surface->h_m(point.lat_deg, point.lon_deg))
            lowest_m = std::min(lowest_m, point.h_m - *h_m);
    }
    return lowest_m;
}

TEST(SeenPoints, AreThoseThatAWalkAlongTheSightLineSees) {
    const auto stage = alps();
    if (!stage) GTEST_SKIP() << "needs alps/N46E010";
    for (const WorldModel& model :
         {WorldModel{}, WorldModel{Earth::ellipsoid, {0.13, AirLaw::constant}, {}}}) {
        const PointsInView view(*stage->surface, stage->camera, model);
        std::mt19937 random(7);  // the seed
        std::uniform_real_distribution<double> lat_deg(46.55, 46.93), lon_deg(10.32, 10.9);
        int seen = 0, hidden = 0;
        for (int i = 0; i < 300; ++i) {
            Geodetic point{lat_deg(random), lon_deg(random), 0.0};
            point.h_m = *stage->surface->h_m(point.lat_deg, point.lon_deg);
            const Geodetic above{point.lat_deg, point.lon_deg, point.h_m + seen_above_m};
            const double passage_m = lowest_passage_m(*stage, model, above);
            const bool sees = view.sees(point, seen_above_m);
            // What grazes ground between two steps of the walk is in doubt.
            EXPECT_TRUE(sees || passage_m <= 0.5) << i << ": " << passage_m;
            EXPECT_FALSE(sees && passage_m < 0.0) << i << ": " << passage_m;
            seen += sees ? 1 : 0;
            hidden += sees ? 0 : 1;
        }
        EXPECT_GT(seen, 10);
        EXPECT_GT(hidden, 100);
    }
}

// The camera's own inverse: the sight line through that point of the picture goes to the place.
TEST(SeenPoints, StandWhereTheCameraLooksAtThem) {
    const auto stage = alps();
    if (!stage) GTEST_SKIP() << "needs alps/N46E010";
    const WorldModel model{Earth::ellipsoid, standard_air, {}};
    const PointsInView view(*stage->surface, stage->camera, model);
    const Oracle oracle(*stage->surface, sight_of(model, stage->camera.eye));
    int looked_at = 0;
    for (double x = 100.5; x < 1920.0; x += 180.0) {
        for (double y = 400.5; y < 1080.0; y += 90.0) {
            const auto hit = oracle.first_hit(stage->camera.ecef_direction_at({x, y}), 2e5);
            if (!hit) continue;
            const auto place = view.place_px(hit->point);
            ASSERT_TRUE(place);
            EXPECT_LT(glm::length(*place - glm::dvec2(x, y)), 1e-4);  // pixels
            ++looked_at;
        }
    }
    EXPECT_GT(looked_at, 30);
    EXPECT_FALSE(view.place_px({47.5, 10.0, 1000.0})) << "behind the eye";
}

// None of the names on a picture of real peaks is of one that the walk finds hidden.
TEST(SeenPoints, NoRealPeakIsNamedThatIsHidden) {
    const auto stage = alps();
    const auto peaks = test::real_data("vector/tirol_peaks.geojson");
    if (!stage || !peaks) GTEST_SKIP() << "needs alps/N46E010 and vector/tirol_peaks.geojson";
    const auto file = read_vectors(peaks->string());
    ASSERT_TRUE(file.ok());
    const auto face = TextFace::open();
    ASSERT_TRUE(face.ok());
    const WorldModel model{Earth::ellipsoid, {0.13, AirLaw::constant}, {}};
    const std::vector<NamedPoint> points = named_points(*file, "name");
    const PointsInView view(*stage->surface, stage->camera, model);
    NamesInView names;
    double seeing_s = 1e9, placing_s = 1e9;
    for (int i = 0; i < 5; ++i) {
        auto found = names_in_view(points, view, stage->camera, *face);
        ASSERT_TRUE(found.ok());
        names = std::move(*found);
        seeing_s = std::min(seeing_s, names.seeing_s);
        placing_s = std::min(placing_s, names.placing_s);
    }
    const std::size_t asked =
        names.labels.size() + static_cast<std::size_t>(names.without_room + names.counts.hidden);
    for (const NameLabel& label : names.labels) {
        Geodetic above = label.point.place;
        above.h_m += seen_above_m;
        EXPECT_GT(lowest_passage_m(*stage, model, above), -0.01) << label.point.name;
    }
    std::printf(
        "%zu points of a file; %zu in the picture: %zu named, %d seen without room, %d hidden; told in %.2f "
        "ms which are seen, placed and drawn in %.2f ms (the best of five)\n",
        points.size(), asked, names.labels.size(), names.without_room, names.counts.hidden, 1e3 * seeing_s,
        1e3 * placing_s);
    EXPECT_GT(names.labels.size(), 10U);
    EXPECT_GT(names.counts.hidden, 20);
    EXPECT_EQ(names.without_letters, 0);
}

NamedPoint named(const char* name, double lat_deg, double lon_deg) {
    NamedPoint point;
    point.name = name;
    point.lat_deg = lat_deg;
    point.lon_deg = lon_deg;
    return point;
}

TEST(SeenPoints, HaveTheirOwnHeightWhereItCanBe) {
    const auto stage = alps();
    if (!stage) GTEST_SKIP() << "needs alps/N46E010";
    const PointsInView view(*stage->surface, stage->camera, {});
    // A place that is surely seen: the ground in the picture's lower middle.
    const Oracle oracle(*stage->surface, sight_of({}, stage->camera.eye));
    std::optional<SightHit> hit;
    for (double y_px = 900.0; !hit || hit->distance_m < 8e3; y_px -= 10.0) {
        ASSERT_GT(y_px, 100.0) << "no ground 8 km away";
        hit = oracle.first_hit(stage->camera.ecef_direction_at({960.0, y_px}), 2e5);
    }
    const double N_m = stage->region->grids[0].field.undulation.at_m(hit->point.lat_deg, hit->point.lon_deg),
                 ground_H_m = hit->point.h_m - N_m;
    const auto seen_as = [&](HeightAbove heights, double height_m, std::optional<double> reported) {
        NamedPoint point = named("p", hit->point.lat_deg, hit->point.lon_deg);
        point.heights = heights, point.height_m = height_m, point.stated_H_m = reported;
        PointCounts counts;
        const auto seen = view.seen({point}, counts);
        EXPECT_EQ(seen.size(), 1U);
        return seen.empty() ? SeenPoint() : seen.front();
    };
    const double slack_m = 1e-6;
    EXPECT_NEAR(seen_as(HeightAbove::nothing, 0.0, {}).place.h_m, hit->point.h_m, slack_m);
    EXPECT_NEAR(seen_as(HeightAbove::nothing, 0.0, {}).H_m, ground_H_m, slack_m);
    // A tower of 80 m, told in three ways.
    EXPECT_NEAR(seen_as(HeightAbove::sea_level, ground_H_m + 80.0, {}).place.h_m, hit->point.h_m + 80.0,
                slack_m);
    EXPECT_NEAR(seen_as(HeightAbove::ellipsoid, hit->point.h_m + 80.0, {}).H_m, ground_H_m + 80.0, slack_m);
    EXPECT_NEAR(seen_as(HeightAbove::ground, 80.0, {}).H_m, ground_H_m + 80.0, slack_m);
    // Below the ground, and far above it: on the ground.
    EXPECT_NEAR(seen_as(HeightAbove::sea_level, ground_H_m - 30.0, {}).place.h_m, hit->point.h_m, slack_m);
    EXPECT_NEAR(seen_as(HeightAbove::sea_level, ground_H_m - 30.0, {}).H_m, ground_H_m - 30.0, slack_m);
    EXPECT_NEAR(seen_as(HeightAbove::sea_level, 1e5, {}).H_m, ground_H_m, slack_m);
    // A field's height is written, and moves nothing.
    EXPECT_NEAR(seen_as(HeightAbove::nothing, 0.0, ground_H_m + 55.0).H_m, ground_H_m + 55.0, slack_m);
    EXPECT_NEAR(seen_as(HeightAbove::nothing, 0.0, ground_H_m + 55.0).place.h_m, hit->point.h_m, slack_m);
    EXPECT_NEAR(seen_as(HeightAbove::nothing, 0.0, ground_H_m + 500.0).H_m, ground_H_m, slack_m);
    // A sharp summit that the posts cut off by a twelfth; feet that were taken for metres.
    ASSERT_GT(ground_H_m, 1100.0);
    EXPECT_NEAR(seen_as(HeightAbove::nothing, 0.0, 1.09 * ground_H_m).H_m, 1.09 * ground_H_m, slack_m);
    EXPECT_NEAR(seen_as(HeightAbove::nothing, 0.0, ground_H_m / 0.3048).H_m, ground_H_m, slack_m);
}

TEST(SeenPoints, AreCountedWhereTheyAreNotNamed) {
    const auto stage = alps();
    if (!stage) GTEST_SKIP() << "needs alps/N46E010";
    const PointsInView view(*stage->surface, stage->camera, {});
    PointCounts counts;
    const auto seen = view.seen({named("beyond", 45.0, 10.0), named("behind", 46.99, 10.1)}, counts);
    EXPECT_TRUE(seen.empty());
    EXPECT_EQ(counts.beyond_data, 1);
    EXPECT_EQ(counts.outside, 1);
}

// A pyramid of 40 m a post, 1,000 m high at row 10 and column 10, and a point one post behind its top.
TEST(SeenPoints, AreMovedWhereTheyMayBeSummitsAndKeepTheirH) {
    const HeightField field =
        test::made_field(47.0, 8.0, 1200.0, 21, 21, [](double, double) { return 0.0F; });
    HeightField pyramid = field;
    for (int row = 0; row < 21; ++row)
        for (int column = 0; column < 21; ++column)
            pyramid.H_m[static_cast<std::size_t>(21 * row + column)] =
                1000.0F - 40.0F * static_cast<float>(std::max(std::abs(row - 10), std::abs(column - 10)));
    const TrueSurface surface(pyramid, 1.0, 1);
    Camera camera;
    camera.eye = {47.0 - 19.0 / 1200.0, 8.0 + 10.0 / 1200.0, 850.0};
    camera.attitude = {0.0, 5.0, 0.0};
    camera.width_px = 800, camera.height_px = 600;
    const PointsInView view(surface, camera, {});
    NamedPoint point = named("p", 47.0 - 9.0 / 1200.0, 8.0 + 10.0 / 1200.0);
    PointCounts counts;
    EXPECT_TRUE(view.seen({point}, counts).empty()) << "a place that is hidden stays where it is";
    EXPECT_EQ(counts.hidden, 1);
    point.may_be_summit = true;
    const auto moved = view.seen({point}, counts);
    ASSERT_EQ(moved.size(), 1U);
    EXPECT_TRUE(moved[0].is_moved);
    EXPECT_NEAR(moved[0].place.lat_deg, 47.0 - 10.0 / 1200.0, 1e-9);
    EXPECT_NEAR(moved[0].place.h_m, 1000.0, 1e-6);
    EXPECT_NEAR(moved[0].H_m, 960.0, 1e-6) << "that of its own ground, from wherever it is seen";
    // From the north it is seen where it is.
    camera.eye.lat_deg = 47.0 - 1.0 / 1200.0;
    camera.attitude.heading_deg = 180.0;
    const auto stays = PointsInView(surface, camera, {}).seen({point}, counts);
    ASSERT_EQ(stays.size(), 1U);
    EXPECT_FALSE(stays[0].is_moved);
    EXPECT_NEAR(stays[0].H_m, 960.0, 1e-6);
}

TEST(NamedPoints, MayBeSummitsWhereTheirFileSaysSo) {
    const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / "kinds_of_points.geojson";
    const auto feature = [](const std::string& fields, const std::string& place) {
        return R"({"type":"Feature","properties":{)" + fields +
               R"(},"geometry":{"type":"Point","coordinates":[)" + place + "]}}";
    };
    std::ofstream(path) << R"({"type":"FeatureCollection","features":[)" +
                               feature(R"("name":"peak","natural":"peak")", "9.5,47.2") + "," +
                               feature(R"("name":"saddle","natural":"saddle")", "9.5,47.2") + "," +
                               feature(R"("name":"ele","ele":"665")", "9.5,47.2") + "," +
                               feature(R"("name":"village","place":"village")", "9.5,47.2") + "," +
                               feature(R"("name":"bare")", "9.5,47.2") + "]}";
    const auto file = read_vectors(path.string());
    ASSERT_TRUE(file.ok()) << file.error().line();
    std::string may_be;
    for (const NamedPoint& point : named_points(*file, "name"))
        if (point.may_be_summit) may_be += point.name + " ";
    EXPECT_EQ(may_be, "peak saddle ele ");
}

TEST(NamedPoints, ReadMetresAsPeopleWriteThem) {
    EXPECT_EQ(metres_from("2962"), 2962.0);
    EXPECT_EQ(metres_from("2962.5 m"), 2962.5);
    EXPECT_EQ(metres_from("2,962"), 2962.0);
    EXPECT_EQ(metres_from("-12m"), -12.0);
    for (const char* none : {"", "m", "high", "12 ft", "1e99", "12-13", "nan", "99999999"})
        EXPECT_FALSE(metres_from(none)) << none;
}

}  // namespace
}  // namespace oro
