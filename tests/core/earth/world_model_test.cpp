// Where models of the world put a point, and that a frame's tables put it there.
#include "core/earth/world_model.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <random>

#include "core/frame/frame_tables.h"
#include "core/frame/placement_promise.h"
#include "tests/core/terrain/placed_posts.h"
#include "tests/support/made_terrain.h"

namespace oro {
namespace {

glm::dvec3 east_north_up_m(const WorldModel& model, const Geodetic& eye, const Geodetic& point) {
    return glm::transpose(ecef_from_enu(eye.lat_deg, eye.lon_deg)) * model_offset_m(model, eye, point);
}

// A degree of latitude at the equator is 110,574.3 m, one of longitude 111,319.5 m. Source: P. Osborne, The
// Mercator Projections, 2013, section 5.7.
TEST(WorldModel, LiteralsOnThePlane) {
    const WorldModel flat{Earth::flat, {}, Precision::relative};
    const glm::dvec3 at = east_north_up_m(flat, {0.0, 179.5, 100.0}, {-1.0, -179.5, 350.0});
    EXPECT_NEAR(at.x, 111319.5, 0.05);
    EXPECT_NEAR(at.y, -110574.3, 0.05);
    EXPECT_NEAR(at.z, 250.0, 1e-9);
    // At 60 degrees the parallel is half as long but for the flattening, wherever the point is: N(60) cos(60)
    // pi / 180 = 55,800.0 m.
    const glm::dvec3 north = east_north_up_m(flat, {60.0, 0.0, 0.0}, {70.0, 1.0, 0.0});
    EXPECT_NEAR(north.x, 55800.0, 0.05);
}

// A quarter of a sphere of 6,371,008.7714 m from the eye: as far down as away.
TEST(WorldModel, LiteralsOnTheSphere) {
    const WorldModel sphere{Earth::sphere, {}, Precision::relative};
    const glm::dvec3 at = east_north_up_m(sphere, {0.0, 10.0, 0.0}, {90.0, 0.0, 0.0});
    EXPECT_NEAR(at.y, 6371008.7714, 1e-6);
    EXPECT_NEAR(at.z, -6371008.7714, 1e-6);
    EXPECT_NEAR(model_eye_ecef(Earth::sphere, {0.0, 90.0, 1000.0}).m.y, 6372008.7714, 1e-6);
    EXPECT_NEAR(model_eye_ecef(Earth::flat, {0.0, 90.0, 1000.0}).m.y, 6379137.0, 1e-6);
}

// k s^2 / (2 R): 102.0 m at 100 km with k = 0.13 and R = 6,371 km; here R is 6,378.8 km (46 degrees), and the
// distance across the vertical a little shorter.
TEST(WorldModel, LiteralsOfBentLight) {
    const Geodetic eye{46.0, 8.0, 0.0}, point{46.0 + 100000.0 / 111146.0, 8.0, 0.0};
    const glm::dvec3 straight = model_offset_m({}, eye, point);
    const glm::dvec3 bent = model_offset_m({Earth::ellipsoid, {0.13}, Precision::relative}, eye, point);
    EXPECT_NEAR(glm::length(bent - straight), 101.9, 0.15);
    EXPECT_GT(glm::dot(bent - straight, ecef_from_enu(46.0, 8.0)[2]), 0.0);
    EXPECT_EQ(model_offset_m({}, eye, point), ecef_from_geodetic(point).m - ecef_from_geodetic(eye).m);
}

// A surveyor's (1 - k) d^2 / (2 R) is 244.703 m for d = 60 km and k = 0.13 at a pole, where all radii of
// curvature are a / sqrt(1 - e^2) = 6,399,593.6258 m. Source: Torge & Müller, Geodesy, 4th ed. 2012, section
// 5.1.1.2 and appendix. Fourth order in d / R: 2 mm. It was 10.94 m more from 3,000 m, where k was 0.0911.
TEST(WorldModel, ASurveyorsRefractionIsTheSameAtAllHeights) {
    const double lat_deg = 90.0 - 0.5371820418;
    for (const double h_m : {-400.0, 0.0, 3000.0, 8848.0, 400000.0}) {
        const glm::dvec3 at = east_north_up_m({Earth::ellipsoid, {0.13}, Precision::relative},
                                              {90.0, 0.0, h_m}, {lat_deg, 0.0, 0.0});
        EXPECT_NEAR(at.z, -h_m - 244.703, 0.01) << h_m;
    }
}

// 0.13 exp(-h / 8434 m): 0.091088 at 3,000 m, 0.04783 at 8,434 m, and nothing 400 km up.
TEST(WorldModel, StandardAirThinsWithHeight) {
    EXPECT_EQ(standard_air.k_at(-400.0), 0.13);
    EXPECT_EQ(standard_air.k_at(0.0), 0.13);
    EXPECT_NEAR(standard_air.k_at(3000.0), 0.091088, 1e-6);
    EXPECT_NEAR(standard_air.k_at(8434.0), 0.0478243, 1e-6);
    EXPECT_LT(standard_air.k_at(400000.0), 1e-20);
    EXPECT_EQ(Air{0.2}.k_at(400000.0), 0.2);
    EXPECT_TRUE(Refraction({46.0, 8.0, 0.0}, {}).straight());
    const double lat_deg = 90.0 - 0.5371820418;
    const glm::dvec3 at = east_north_up_m({Earth::ellipsoid, standard_air, Precision::relative},
                                          {90.0, 0.0, 3000.0}, {lat_deg, 0.0, 0.0});
    EXPECT_NEAR(at.z, -3000.0 - 244.703 - 10.945, 0.01);
}

struct Worst {
    double m{};
    double share{};  // of what is allowed
};

// 1 mm up to 4 km, 3.2e-7 of the distance more beyond: what holds for the ellipsoid.
Worst worst_of_tables(const HeightField& field, const Geodetic& eye, Earth earth) {
    FrameTables tables(field.grid, eye, earth);
    gpu::FramePage page{};
    tables.place({0, 0, 0}, page);
    const auto rows = tables.take_rows();
    const auto columns = tables.take_columns();
    const std::int32_t reference = height_steps(reference_height_m(eye));
    Worst worst;
    for (int row = 0; row < field.grid.rows(); ++row) {
        for (int column = 0; column < field.grid.columns(); ++column) {
            const double h_m = drawn_h_m(field, row, column, 1.0);
            const gpu::vec3 at =
                test::place_from_eye(rows[static_cast<std::size_t>(row)],
                                     columns[static_cast<std::size_t>(column)], reference, height_steps(h_m));
            const glm::dvec3 expected =
                model_offset_m(earth, eye, {field.grid.lat.at_deg(row), field.grid.lon.at_deg(column), h_m});
            const double error_m = glm::length(test::ecef_from_eye(eye) * glm::dvec3(at) - expected);
            worst.m = std::max(worst.m, error_m);
            worst.share = std::max(
                worst.share, error_m / (placement_near_m + placement_far_share * glm::length(expected)));
        }
    }
    return worst;
}

TEST(WorldModel, TablesPutPostsWhereTheModelDoes) {
    constexpr unsigned seed = 71;
    std::mt19937_64 random(seed);
    std::printf("seed %u\n", seed);
    const Geodetic eyes[] = {{46.5, 8.1, 2000.3},  {-33.0, 179.99, 150.0},  {0.0, 0.0, 0.5},
                             {89.9, 20.0, 3000.0}, {12.0, -77.0, 400000.0}, {60.0, 10.0, -11.0}};
    for (const Earth earth : {Earth::ellipsoid, Earth::sphere, Earth::flat}) {
        Worst worst;
        for (const Geodetic& eye : eyes) {
            for (const double per_deg : {6000.0, 1200.0, 40.0}) {  // some 2, 10 and 300 km across
                const HeightField field = test::made_field(
                    std::min(90.0, std::round((eye.lat_deg + 60.0 / per_deg) * per_deg) / per_deg),
                    std::round((eye.lon_deg - 70.0 / per_deg) * per_deg) / per_deg, per_deg, 129, 129,
                    [&](double, double) { return static_cast<float>(random() % 8000); });
                const Worst now = worst_of_tables(field, eye, earth);
                worst = {std::max(worst.m, now.m), std::max(worst.share, now.share)};
            }
        }
        std::printf("earth %d: worst %.4f m, %.0f %% of what is allowed\n", static_cast<int>(earth), worst.m,
                    100.0 * worst.share);
        EXPECT_LE(worst.share, 1.0);
    }
}

}  // namespace
}  // namespace oro
