// The names of a panorama over real summits: where GeographicLib has them, and those alone that a walk along
// the sight line sees.
#include "apps/panorama/panorama_names.h"
#include "geo/opening/open_region.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <vector>

#include "apps/panorama/elevations.h"
#include "apps/vectors/named_points.h"
#include "core/base/parallel.h"
#include "core/light/sun_position.h"
#include "geo/places/geodesic.h"
#include "geo/region/region.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

struct Peak {
    const char* name;
    double lat_deg;
    double lon_deg;
};
// Posts of SRTM that are the highest within 5 posts of the summits' published places (swisstopo's map, three
// decimals).
constexpr Peak peaks[]{{"Schreckhorn", 46.5891667, 8.1183333},
                       {"Lauteraarhorn", 46.5866667, 8.1275},
                       {"Eiger", 46.5775, 8.005},
                       {"Mönch", 46.5583333, 7.9975},
                       {"Jungfrau", 46.5366667, 7.9625},
                       {"Aletschhorn", 46.465, 7.9941667},
                       {"Gross Fiescherhorn", 46.5516667, 8.0608333},
                       {"Gross Grünhorn", 46.5308333, 8.0775},
                       {"Gross Wannenhorn", 46.4933333, 8.0983333},
                       {"Wetterhorn", 46.6391667, 8.1158333},
                       {"Mittelhorn", 46.635, 8.125},
                       {"Bietschhorn", 46.3925, 7.85},
                       {"Lauterbrunnen Breithorn", 46.4783333, 7.8766667},
                       {"Gspaltenhorn", 46.5125, 7.8308333},
                       {"Blüemlisalphorn", 46.4891667, 7.7725},
                       {"Balmhorn", 46.425, 7.6933333},
                       {"Doldenhorn", 46.4691667, 7.7341667},
                       {"Dammastock", 46.6433333, 8.4208333},
                       {"Galenstock", 46.6125, 8.4175},
                       {"Titlis", 46.7725, 8.4358333},
                       {"Sustenhorn", 46.6983333, 8.455},
                       {"Monte Leone", 46.25, 8.1108333},
                       {"Oberaarhorn", 46.5316667, 8.175},
                       {"Niesen", 46.6458333, 7.6525},
                       {"Tödi", 46.8116667, 8.915}};

struct Stage {
    std::unique_ptr<Region> region;
    std::unique_ptr<TrueSurface> surface;
    Camera camera;
    WorldModel model{Earth::ellipsoid, standard_air, {}};
};

std::optional<Stage> alps(double lat_deg, double lon_deg, double above_m) {
    RegionRequest request;
    for (const char* name : {"alps/N46E007.SRTMGL3.hgt.zip", "alps/N46E008.SRTMGL3.hgt.zip"}) {
        const auto tile = test::real_data(name);
        if (!tile) return std::nullopt;
        request.paths.push_back(tile->string());
    }
    auto region = open_region(request);
    EXPECT_TRUE(region.ok());
    Stage stage;
    stage.region = std::make_unique<Region>(std::move(*region));
    stage.surface = std::make_unique<TrueSurface>(stage.region->grids[0].field, 1.0, thread_count());
    stage.camera.eye = {lat_deg, lon_deg, *stage.surface->h_m(lat_deg, lon_deg) + above_m};
    stage.camera.width_px = 7200;
    return stage;
}

std::vector<NamedPoint> points() {
    std::vector<NamedPoint> all;
    for (const Peak& peak : peaks) {
        NamedPoint point;
        point.name = peak.name;
        point.lat_deg = peak.lat_deg;
        point.lon_deg = peak.lon_deg;
        all.push_back(std::move(point));
    }
    return all;
}

// How far above the ground a sight line passes at its lowest, walked in steps of 5 m; no oracle is asked.
double lowest_passage_m(const Stage& stage, const Geodetic& target) {
    const Refraction refraction(stage.camera.eye, stage.model.air);
    const glm::dvec3 eye = stage.camera.eye_ecef().m;
    const glm::dvec3 seen_at = refraction.apparent_m(ecef_from_geodetic(target).m - eye);
    const double distance_m = glm::length(seen_at);
    double lowest_m = 1e9;
    for (double at_m = 5.0; at_m < distance_m - 0.5; at_m += 5.0) {
        const Geodetic point = geodetic_from_ecef({eye + refraction.true_m(seen_at * (at_m / distance_m))});
        if (const auto h_m = stage.surface->h_m(point.lat_deg, point.lon_deg))
            lowest_m = std::min(lowest_m, point.h_m - *h_m);
    }
    return lowest_m;
}

TEST(PanoramaNames, AreThoseThatAreSeenAtTheAzimuthsOfGeographicLib) {
    // Finsteraarhorn's highest post; and Grosse Scheidegg, where walls hide most.
    int hidden = 0, named = 0;
    for (const auto& [lat_deg, lon_deg, above_m] :
         {std::tuple{46.5366667, 8.1258333, 2.0}, {46.6540, 8.1020, 2.0}}) {
        const auto stage = alps(lat_deg, lon_deg, above_m);
        if (!stage) GTEST_SKIP() << "needs alps/N46E007 and N46E008";
        const Cylinder around = cylinder_around(0.0, 360.0, -35.0, 70.0, 7200);
        const auto face = TextFace::open();
        ASSERT_TRUE(face.ok());
        const PointsInView in_view(*stage->surface, stage->camera, stage->model, around);
        const auto names = panorama_names(points(), in_view, around, *face, 12.0);
        ASSERT_TRUE(names.ok());
        EXPECT_EQ(names->counts.outside + names->counts.beyond_data + names->without_letters, 0);
        EXPECT_TRUE(names->without_room.empty());
        for (const Peak& peak : peaks) {
            const auto found = std::ranges::find(names->named, peak.name,
                                                 [](const PanoramaName& name) { return name.point.name; });
            const bool is_named = found != names->named.end();
            const Geodetic above{peak.lat_deg, peak.lon_deg,
                                 *stage->surface->h_m(peak.lat_deg, peak.lon_deg) + seen_above_m};
            const double passage_m = lowest_passage_m(*stage, above);
            // What grazes ground between two steps of the walk is in doubt; none of these does.
            EXPECT_GT(std::abs(passage_m), 0.2) << peak.name << " " << passage_m;
            EXPECT_EQ(is_named, passage_m > 0.0) << peak.name << " " << passage_m;
            (is_named ? named : hidden) += 1;
            if (!is_named) continue;
            const GeodesicPath path = geodesic_between(lat_deg, lon_deg, peak.lat_deg, peak.lon_deg);
            EXPECT_NEAR(std::remainder(found->azimuth_deg - path.bearing_deg, 360.0), 0.0, 0.001)
                << peak.name;
            EXPECT_NEAR(found->point.place_px.x, path.bearing_deg * 20.0, 0.02) << peak.name;
            // Over so short ways the two lengths differ by the heights and the curvature alone.
            EXPECT_NEAR(found->point.distance_m, path.distance_m, 0.03 * path.distance_m) << peak.name;
        }
    }
    std::printf("named %d, hidden %d\n", named, hidden);
    EXPECT_GE(named, 20);
    EXPECT_GE(hidden, 8);
}

TEST(PanoramaNames, TellWhereTheEyeStands) {
    const auto face = TextFace::open();
    ASSERT_TRUE(face.ok());
    std::vector<NamedPoint> all = points();
    EXPECT_EQ(*standpoint_name(all, {46.5775, 8.0065, 3967.0}, *face), "Eiger");  // 115 m east of it
    EXPECT_EQ(*standpoint_name(all, {46.5775, 8.0080, 3967.0}, *face), "");       // 230 m
    all[2].name = "\u5c71";
    EXPECT_EQ(*standpoint_name(all, {46.5775, 8.0065, 3967.0}, *face), "");
}

TEST(PanoramaNames, AreNotLongerThanTheRowMayBeHigh) {
    const auto stage = alps(46.5366667, 8.1258333, 2.0);
    if (!stage) GTEST_SKIP() << "needs alps/N46E007 and N46E008";
    const auto face = TextFace::open();
    ASSERT_TRUE(face.ok());
    const Cylinder around = cylinder_around(0.0, 360.0, -35.0, 70.0, 7200);
    const PointsInView in_view(*stage->surface, stage->camera, stage->model, around);
    std::vector<NamedPoint> all = points();
    const std::string longest(90, 'n');
    all[2].name = longest;
    const auto names = panorama_names(all, in_view, around, *face, 12.0);
    ASSERT_TRUE(names.ok());
    EXPECT_EQ(names->without_room, std::vector<std::string>{longest});
    EXPECT_LT(names->row_px, 41.0 * 12.0);
}

// Below the north wall of the Wetterhorn, which stands some 48 degrees high: nothing is hit above the
// elevations that are shown unasked, and something below.
TEST(PanoramaNames, HaveSkyAboveThem) {
    const auto stage = alps(46.6540, 8.1020, 2.0);
    if (!stage) GTEST_SKIP() << "needs alps/N46E007 and N46E008";
    const Elevations found = elevations_for(*stage->surface, stage->camera.eye, stage->model, 0.0, 360.0, 2);
    const Oracle oracle(*stage->surface, sight_of(stage->model, stage->camera.eye));
    const glm::dmat3 turn = ecef_from_enu(stage->camera.eye.lat_deg, stage->camera.eye.lon_deg);
    const double reach_m = sight_reach_m(stage->camera.eye.h_m);
    int free = 0, touched = 0;
    for (double azimuth_deg = 0.0; azimuth_deg < 360.0; azimuth_deg += 0.5) {
        free += oracle.first_hit(turn * enu_towards(azimuth_deg, found.high_deg), reach_m) ? 0 : 1;
        touched +=
            oracle.first_hit(turn * enu_towards(azimuth_deg, found.skyline_deg - 0.02), reach_m) ? 1 : 0;
    }
    EXPECT_EQ(free, 720);
    EXPECT_GE(touched, 1);
    EXPECT_GT(found.skyline_deg, 40.0);
    EXPECT_LT(found.skyline_deg, found.high_deg);
    EXPECT_FALSE(found.leaves_out_near);
    EXPECT_LE(found.low_deg, -10.0);
}

// On the flank of a summit, some metres below its highest post: the ground at the eye's feet is not what the
// picture is for.
TEST(PanoramaNames, LeaveOutTheGroundAtTheFeet) {
    const auto stage = alps(46.5372, 8.1262, 2.0);
    if (!stage) GTEST_SKIP() << "needs alps/N46E007 and N46E008";
    const Elevations found = elevations_for(*stage->surface, stage->camera.eye, stage->model, 0.0, 360.0, 2);
    EXPECT_TRUE(found.leaves_out_near);
    EXPECT_LT(found.high_deg, 25.0);
}

}  // namespace
}  // namespace oro
