// Whether places lie in polygons, against a count of all sides along the other axis.
#include "apps/overlay/ground_area.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>

namespace oro {
namespace {

VectorShape polygon(std::vector<std::vector<VectorPlace>> rings) {
    VectorShape shape;
    shape.kind = VectorKind::polygon;
    shape.paths = std::move(rings);
    return shape;
}

std::vector<VectorPlace> box(double south, double west, double north, double east) {
    return {{south, west, {}}, {south, east, {}}, {north, east, {}}, {north, west, {}}};
}

// Sides north of the place that its meridian crosses; all of them, whatever their order.
bool holds_by_meridian(const VectorShape& shape, double lat_deg, double lon_deg) {
    bool inside = false;
    for (const auto& ring : shape.paths) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const VectorPlace &a = ring[i], &b = ring[(i + 1) % ring.size()];
            const double from = std::remainder(a.lon_deg - lon_deg, 360.0);
            const double to = from + std::remainder(b.lon_deg - a.lon_deg, 360.0);
            // In the turn that the place is in, and those beside it.
            for (const double turn : {-360.0, 0.0, 360.0}) {
                const double one = from + turn, other = to + turn;
                if ((one > 0.0) == (other > 0.0)) continue;
                const double lat = a.lat_deg + (b.lat_deg - a.lat_deg) * one / (one - other);
                if (lat > lat_deg) inside = !inside;
            }
        }
    }
    return inside;
}

TEST(GroundArea, HasNoGroundInHoles) {
    const GroundArea area(polygon({box(46.0, 8.0, 47.0, 9.0), box(46.4, 8.4, 46.6, 8.6)}));
    EXPECT_TRUE(area.holds(46.2, 8.5));
    EXPECT_FALSE(area.holds(46.5, 8.5)) << "a hole";
    EXPECT_FALSE(area.holds(45.9, 8.5));
    EXPECT_FALSE(area.holds(46.5, 9.1));
}

// Fiji's way: from 178 E to 178 W, with a hole that begins in the west.
TEST(GroundArea, GoesOverTheAntimeridian) {
    const GroundArea area(polygon({box(-19.0, 178.0, -16.0, -178.0), box(-18.0, -179.5, -17.0, 179.5)}));
    EXPECT_TRUE(area.holds(-18.5, 180.0));
    EXPECT_TRUE(area.holds(-17.5, 178.5));
    EXPECT_TRUE(area.holds(-17.5, -178.5));
    EXPECT_TRUE(area.holds(-17.5, 181.5)) << "a longitude counted on";
    EXPECT_FALSE(area.holds(-17.5, -179.8)) << "a hole";
    EXPECT_FALSE(area.holds(-17.5, 0.0));
    EXPECT_FALSE(area.holds(-17.5, 177.9));
}

TEST(GroundArea, OfARingRoundAPoleThereIsNone) {
    std::vector<VectorPlace> ring;
    for (int i = 0; i < 12; ++i) ring.push_back({80.0, -165.0 + 30.0 * i, {}});
    const GroundArea area(polygon({ring}));
    EXPECT_TRUE(area.is_empty());
    EXPECT_FALSE(area.holds(85.0, 0.0));
}

TEST(GroundArea, OfALineThereIsNone) {
    EXPECT_TRUE(GroundArea(polygon({{{46.0, 8.0, {}}, {46.0, 9.0, {}}, {46.0, 8.5, {}}}})).is_empty());
    EXPECT_TRUE(GroundArea(polygon({})).is_empty());
}

// Stars of up to 5,000 places with holes, anywhere on Earth, some over the antimeridian.
TEST(GroundArea, AgreesWithAllSidesOfRandomPolygons) {
    constexpr unsigned seed = 20261123;
    std::mt19937 random(seed);
    const auto between = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    std::size_t held = 0, wrong = 0, asked = 0;
    for (int i = 0; i < 60; ++i) {
        const double lat = between(-70.0, 70.0),
                     lon = i % 3 == 0 ? between(170.0, 190.0) : between(-180.0, 180.0);
        const double size = between(0.01, 9.0);
        std::vector<std::vector<VectorPlace>> rings;
        for (const double reach : {1.0, 0.3}) {
            const auto count = static_cast<int>(std::pow(10.0, between(0.5, 3.7)));
            std::vector<VectorPlace> ring;
            for (int k = 0; k < count; ++k) {
                const double angle = 2.0 * std::numbers::pi * k / count;
                const double far = reach * size * between(0.5, 1.0);
                ring.push_back(
                    {lat + far * std::sin(angle), std::remainder(lon + far * std::cos(angle), 360.0), {}});
            }
            rings.push_back(std::move(ring));
        }
        const VectorShape shape = polygon(std::move(rings));
        const GroundArea area(shape);
        for (int k = 0; k < 300; ++k) {
            const double at_lat = lat + size * between(-1.1, 1.1);
            const double at_lon = std::remainder(lon + size * between(-1.1, 1.1), 360.0);
            const bool holds = area.holds(at_lat, at_lon);
            held += holds ? 1U : 0U;
            wrong += holds != holds_by_meridian(shape, at_lat, at_lon) ? 1U : 0U;
            ++asked;
        }
    }
    std::printf("seed %u: %zu places, %zu held, %zu wrong\n", seed, asked, held, wrong);
    EXPECT_GT(held, asked / 10);
    EXPECT_EQ(wrong, 0U);
}

}  // namespace
}  // namespace oro
