#include "core/earth/ellipsoid.h"

#include <gtest/gtest.h>

#include <GeographicLib/Geocentric.hpp>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <random>

namespace oro {
namespace {

std::uint64_t bits(double value) {
    return std::bit_cast<std::uint64_t>(value);
}

glm::dvec3 by_geographiclib(const Geodetic& point) {
    glm::dvec3 m;
    GeographicLib::Geocentric::WGS84().Forward(point.lat_deg, point.lon_deg, point.h_m, m.x, m.y, m.z);
    return m;
}

double lon_difference_deg(double a, double b) {
    return std::abs(std::remainder(a - b, 360.0));
}

TEST(SineCosine, IsExactAtQuarterTurns) {
    for (int quarter = -12; quarter <= 12; ++quarter) {
        const SineCosine got = sine_cosine_deg(90.0 * quarter);
        const double sines[] = {0.0, 1.0, 0.0, -1.0};
        const double cosines[] = {1.0, 0.0, -1.0, 0.0};
        EXPECT_EQ(bits(got.sine), bits(sines[((quarter % 4) + 4) % 4])) << quarter;
        EXPECT_EQ(bits(got.cosine), bits(cosines[((quarter % 4) + 4) % 4])) << quarter;
    }
}

TEST(SineCosine, HasTheSameBitsAfterWholeTurns) {
    for (int eighth = -8 * 256; eighth <= 8 * 256; ++eighth) {
        const double angle_deg = eighth * 0.17578125;  // exact in double, as are its sums with 360
        const SineCosine a = sine_cosine_deg(angle_deg);
        for (const double turns_deg : {-720.0, -360.0, 360.0, 720.0}) {
            const SineCosine b = sine_cosine_deg(angle_deg + turns_deg);
            ASSERT_EQ(bits(a.sine), bits(b.sine)) << angle_deg;
            ASSERT_EQ(bits(a.cosine), bits(b.cosine)) << angle_deg;
        }
    }
}

TEST(SineCosine, IsWithinTwoUnitsInTheLastPlace) {
    const unsigned seed = 20240601;
    RecordProperty("seed", static_cast<int>(seed));
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> angles(-720.0, 720.0);
    for (int i = 0; i < 100000; ++i) {
        const double angle_deg = angles(random);
        const long double rad = std::fmod(static_cast<long double>(angle_deg), 360.0L) *
                                (3.14159265358979323846264338327950288L / 180.0L);
        const SineCosine got = sine_cosine_deg(angle_deg);
        // The reference itself is rounded at a whole turn's size: 64-bit mantissas leave 4e-19.
        const long double sine = std::sin(rad);
        const long double cosine = std::cos(rad);
        ASSERT_NEAR(static_cast<double>(got.sine - sine), 0.0, 4.5e-16 * std::abs(got.sine) + 1e-18);
        ASSERT_NEAR(static_cast<double>(got.cosine - cosine), 0.0, 4.5e-16 * std::abs(got.cosine) + 1e-18);
    }
}

TEST(NormalisedLongitude, Literals) {
    EXPECT_EQ(normalised_lon_deg(0.0), 0.0);
    EXPECT_EQ(normalised_lon_deg(180.0), 180.0);
    EXPECT_EQ(normalised_lon_deg(-180.0), 180.0);
    EXPECT_EQ(normalised_lon_deg(540.0), 180.0);
    EXPECT_EQ(normalised_lon_deg(181.5), -178.5);
    EXPECT_EQ(normalised_lon_deg(-359.0), 1.0);
    EXPECT_EQ(bits(normalised_lon_deg(-360.0)), bits(0.0));
}

TEST(Ellipsoid, RadiiOfCurvature) {
    // At the equator a and b^2 / a, at the poles a^2 / b. Source: Torge & Müller, Geodesy, 2012,
    // section 4.1.2.
    EXPECT_NEAR(prime_vertical_radius_m(0.0), 6378137.0, 1e-9);
    EXPECT_NEAR(meridian_radius_m(0.0), 6335439.3272928, 1e-6);
    EXPECT_NEAR(prime_vertical_radius_m(90.0), 6399593.6257585, 1e-6);
    EXPECT_NEAR(meridian_radius_m(-90.0), 6399593.6257585, 1e-6);
}

TEST(Ellipsoid, PolesAndAntimeridianAreOnePlace) {
    for (const double pole_deg : {-90.0, 90.0}) {
        const Ecef first = ecef_from_geodetic({pole_deg, 0.0, 1234.5});
        EXPECT_EQ(first.m.x, 0.0);
        EXPECT_EQ(first.m.y, 0.0);
        EXPECT_NEAR(std::abs(first.m.z), wgs84_b_m + 1234.5, 2e-9);
        for (int lon_deg = -180; lon_deg <= 360; lon_deg += 7) {
            const Ecef other = ecef_from_geodetic({pole_deg, static_cast<double>(lon_deg), 1234.5});
            for (int axis = 0; axis < 3; ++axis) ASSERT_EQ(bits(first.m[axis]), bits(other.m[axis]));
        }
    }
    for (int lat_deg = -90; lat_deg <= 90; ++lat_deg) {
        const Ecef west = ecef_from_geodetic({static_cast<double>(lat_deg), -180.0, -11000.0});
        const Ecef east = ecef_from_geodetic({static_cast<double>(lat_deg), 180.0, -11000.0});
        for (int axis = 0; axis < 3; ++axis) ASSERT_EQ(bits(west.m[axis]), bits(east.m[axis]));
    }
}

TEST(Ellipsoid, PositionsAgreeWithGeographicLib) {
    const unsigned seed = 7;
    RecordProperty("seed", static_cast<int>(seed));
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    double worst_m = 0.0;
    for (int i = 0; i < 100000; ++i) {
        const Geodetic point{unit(random) * 180.0 - 90.0, unit(random) * 720.0 - 360.0,
                             unit(random) * 21000.0 - 11000.0};
        worst_m = std::max(worst_m, glm::length(ecef_from_geodetic(point).m - by_geographiclib(point)));
    }
    std::printf("seed %u: positions differ from GeographicLib by at most %.2g nm\n", seed, worst_m * 1e9);
    EXPECT_LT(worst_m, 4e-9);
}

TEST(Ellipsoid, InverseAgreesWithGeographicLib) {
    const unsigned seed = 8;
    std::printf("seed %u\n", seed);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (int i = 0; i < 100000; ++i) {
        // Heights from the deepest trench to beyond the Moon, evenly over the decades; some near the poles.
        const double h_m = -11000.0 + std::pow(10.0, unit(random) * 8.6);
        double lat_deg = unit(random) * 180.0 - 90.0;
        if (i % 10 == 0) lat_deg = std::copysign(90.0 - std::pow(10.0, -12.0 * unit(random)), lat_deg);
        const glm::dvec3 m = by_geographiclib({lat_deg, unit(random) * 360.0 - 180.0, h_m});
        Geodetic expected;
        GeographicLib::Geocentric::WGS84().Reverse(m.x, m.y, m.z, expected.lat_deg, expected.lon_deg,
                                                   expected.h_m);
        const Geodetic got = geodetic_from_ecef(Ecef{m});
        const double scale =
            std::max(1.0, h_m / 1e6);  // beyond 1,000 km doubles are as coarse as the place is far
        ASSERT_NEAR(got.h_m, expected.h_m, 1e-8 * scale) << lat_deg << " " << h_m;
        ASSERT_NEAR(got.lat_deg, expected.lat_deg, 1e-13) << lat_deg << " " << h_m;
        ASSERT_LT(lon_difference_deg(got.lon_deg, expected.lon_deg), 1e-13) << lat_deg << " " << h_m;
        ASSERT_GT(got.lon_deg, -180.0);
        ASSERT_LE(got.lon_deg, 180.0);
    }
}

TEST(Ellipsoid, InverseGoesDownTo6300KilometresBelow) {
    std::mt19937_64 random(9);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (int i = 0; i < 10000; ++i) {
        const Geodetic point{unit(random) * 180.0 - 90.0, unit(random) * 360.0 - 180.0,
                             -6.29e6 * unit(random)};
        const glm::dvec3 m = by_geographiclib(point);
        const glm::dvec3 back = by_geographiclib(geodetic_from_ecef(Ecef{m}));
        ASSERT_LT(glm::length(m - back), 1e-6) << point.lat_deg << " " << point.h_m;
    }
}

TEST(Ellipsoid, InverseAtSpecialPlaces) {
    const Geodetic north = geodetic_from_ecef(Ecef{{0.0, 0.0, wgs84_b_m + 100.0}});
    EXPECT_EQ(north.lat_deg, 90.0);
    EXPECT_EQ(north.lon_deg, 0.0);
    EXPECT_NEAR(north.h_m, 100.0, 2e-9);
    const Geodetic south = geodetic_from_ecef(Ecef{{0.0, 0.0, -1.0e5}});
    EXPECT_EQ(south.lat_deg, -90.0);
    EXPECT_NEAR(south.h_m, 1.0e5 - wgs84_b_m, 2e-9);
    const Geodetic antimeridian = geodetic_from_ecef(Ecef{{-wgs84_a_m, -0.0, 0.0}});
    EXPECT_EQ(antimeridian.lat_deg, 0.0);
    EXPECT_EQ(antimeridian.lon_deg, 180.0);
    EXPECT_NEAR(antimeridian.h_m, 0.0, 2e-9);
    const Geodetic centre = geodetic_from_ecef(Ecef{{0.0, 0.0, 0.0}});
    EXPECT_TRUE(std::isfinite(centre.lat_deg) && std::isfinite(centre.h_m));
}

TEST(Ellipsoid, LocalFrame) {
    // At (0 N, 0 E) east is +y, north +z, up +x.
    EXPECT_EQ(ecef_from_enu(0.0, 0.0), glm::dmat3(0, 1, 0, 0, 0, 1, 1, 0, 0));
    // At the north pole, on the zero meridian, north is away from 0 E.
    EXPECT_EQ(ecef_from_enu(90.0, 0.0), glm::dmat3(0, 1, 0, -1, 0, 0, 0, 0, 1));
    const glm::dmat3 frame = ecef_from_enu(46.5, 8.25);
    const glm::dmat3 should_be_one = glm::transpose(frame) * frame;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) EXPECT_NEAR(should_be_one[i][j], i == j ? 1.0 : 0.0, 1e-15);
    EXPECT_NEAR(glm::determinant(frame), 1.0, 1e-15);
    const Geodetic low{46.5, 8.25, 0.0};
    const Geodetic high{46.5, 8.25, 1000.0};
    const glm::dvec3 rise = ecef_from_geodetic(high).m - ecef_from_geodetic(low).m;
    EXPECT_LT(glm::length(rise - 1000.0 * frame[2]), 4e-9);
}

}  // namespace
}  // namespace oro
