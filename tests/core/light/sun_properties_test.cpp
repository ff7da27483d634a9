// What must hold of the sun whatever the time and the place.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>
#include <vector>

#include "core/light/sun_position.h"

namespace oro {
namespace {

constexpr double from_1900_s = -2208988800.0, to_2100_s = 4102444800.0;
constexpr double day_s = 86400.0;

std::mt19937_64 random_of(unsigned seed) {
    std::printf("seed %u\n", seed);
    return std::mt19937_64(seed);
}

struct Drawn {
    double time_utc_s;
    Geodetic place;
};
Drawn drawn(std::mt19937_64& random) {
    std::uniform_real_distribution<double> times(from_1900_s, to_2100_s), sines(-1.0, 1.0),
        lons(-180.0, 180.0);
    const double time_utc_s = times(random), sine = sines(random), lon_deg = lons(random);
    return {time_utc_s, {deg_from_radians(Radians{std::asin(sine)}), lon_deg, 0.0}};
}

glm::dvec3 towards(const SunPosition& sun) {
    const SineCosine up = sine_cosine_deg(sun.airless_elevation_deg);
    const SineCosine east = sine_cosine_deg(sun.azimuth_deg);
    return {up.cosine * east.sine, up.cosine * east.cosine, up.sine};
}

double declination_deg(double time_utc_s) {
    return geocentric_sun(time_utc_s + delta_t_s(time_utc_s)).declination_deg;
}

// The sky turns by 15.041 seconds of arc in a second.
TEST(SunProperties, MovesWithTheSkyAndNeverJumps) {
    std::mt19937_64 random = random_of(101);
    for (int i = 0; i < 5000; ++i) {
        const auto [time_utc_s, place] = drawn(random);
        const SunPosition a = sun_position(time_utc_s, place), b = sun_position(time_utc_s + 1.0, place);
        ASSERT_LT(glm::length(towards(a) - towards(b)), 15.06 / 3600.0 * std::numbers::pi / 180.0)
            << time_utc_s;
        ASSERT_LE(a.airless_elevation_deg, a.elevation_deg);
        ASSERT_TRUE(a.azimuth_deg >= 0.0 && a.azimuth_deg < 360.0) << a.azimuth_deg;
        ASSERT_TRUE(a.radius_deg > 0.262 && a.radius_deg < 0.272) << a.radius_deg;
    }
}

// Where the formulae for delta T meet, the sun must not be seen to jump: 3 seconds make 0.12 second of arc.
TEST(SunProperties, DeltaTMeetsAtItsBorders) {
    for (const int year : {1900, 1920, 1941, 1961, 1986, 2005, 2050}) {
        const double border_s = 946728000.0 + (year - 2000) * 365.25 * day_s;
        EXPECT_NEAR(delta_t_s(border_s - 1.0), delta_t_s(border_s + 1.0), 3.5) << year;
    }
}

TEST(SunProperties, RefractionIsSmoothAndKeepsTheOrder) {
    double before_deg = -10.0;
    for (int i = 1; i <= 100000; ++i) {
        const double airless_deg = -10.0 + i * 0.001;
        const double seen_deg = airless_deg + refraction_deg(airless_deg, {});
        ASSERT_GT(seen_deg, before_deg) << airless_deg;
        ASSERT_LT(seen_deg - before_deg, 0.0015) << airless_deg;
        before_deg = seen_deg;
    }
    EXPECT_EQ(refraction_deg(10.0, {0.0, 10.0}), 0.0);
    EXPECT_EQ(refraction_deg(-5.0, {}), 0.0);
}

// When the sun crosses the meridian in the day, it stands due south or north, as high as latitude and
// declination say, and (but for the declination's own change) highest.
TEST(SunProperties, StandsInTheMeridianAtApparentNoon) {
    std::mt19937_64 random = random_of(102);
    for (int i = 0; i < 200; ++i) {
        auto [time_utc_s, place] = drawn(random);
        place.lat_deg *= 0.7;
        const SunDayEvents day = sun_day(time_utc_s, place);
        const double noon_deg = place.lat_deg > declination_deg(day.highest_utc_s) ? 180.0 : 0.0;
        if (std::abs(place.lat_deg - declination_deg(day.highest_utc_s)) < 1.0) continue;
        if (day.highest_utc_s < time_utc_s + 600.0 || day.highest_utc_s > time_utc_s + day_s - 600.0)
            continue;
        const auto side_deg = [&, &where = place](double at_s) {
            const double off = std::remainder(sun_position(at_s, where).azimuth_deg - noon_deg, 360.0);
            return noon_deg == 180.0 ? off : -off;
        };
        double low_s = day.highest_utc_s - 600.0, high_s = day.highest_utc_s + 600.0;
        ASSERT_LT(side_deg(low_s), 0.0);
        ASSERT_GT(side_deg(high_s), 0.0);
        while (high_s - low_s > 0.001) {
            const double middle_s = 0.5 * (low_s + high_s);
            (side_deg(middle_s) < 0.0 ? low_s : high_s) = middle_s;
        }
        const SunPosition sun = sun_position(low_s, place);
        EXPECT_NEAR(sun.airless_elevation_deg, 90.0 - std::abs(place.lat_deg - declination_deg(low_s)),
                    0.003);
        EXPECT_NEAR(sun.airless_elevation_deg, day.highest_deg, 0.003);
    }
}

// At a pole the elevation is the declination less the parallax, and the azimuth turns once in a day.
TEST(SunProperties, CirclesThePoles) {
    std::mt19937_64 random = random_of(103);
    for (int i = 0; i < 200; ++i) {
        const double time_utc_s = drawn(random).time_utc_s;
        for (const double pole : {1.0, -1.0}) {
            const Geodetic place{90.0 * pole, 0.0, 0.0};
            const double high_deg = pole * declination_deg(time_utc_s);
            const double parallax_deg = 8.77 / 3600.0 * sine_cosine_deg(high_deg).cosine;
            EXPECT_NEAR(sun_position(time_utc_s, place).airless_elevation_deg, high_deg - parallax_deg, 1e-4);
            double turned_deg = 0.0;
            for (int hour = 0; hour < 24; ++hour) {
                const double step_deg =
                    std::remainder(sun_position(time_utc_s + (hour + 1) * 3600.0, place).azimuth_deg -
                                       sun_position(time_utc_s + hour * 3600.0, place).azimuth_deg,
                                   360.0);
                EXPECT_NEAR(step_deg, pole * 15.0, 0.01);
                turned_deg += step_deg;
            }
            EXPECT_NEAR(turned_deg, pole * 360.0, 0.15);
        }
    }
}

TEST(SunProperties, KnowsNoAntimeridian) {
    std::mt19937_64 random = random_of(104);
    for (int i = 0; i < 500; ++i) {
        const auto [time_utc_s, place] = drawn(random);
        const SunPosition east = sun_position(time_utc_s, {place.lat_deg, 180.0, 0.0});
        const SunPosition west = sun_position(time_utc_s, {place.lat_deg, -180.0, 0.0});
        ASSERT_EQ(std::bit_cast<std::uint64_t>(east.azimuth_deg),
                  std::bit_cast<std::uint64_t>(west.azimuth_deg));
        ASSERT_EQ(east.elevation_deg, west.elevation_deg);
        const SunPosition just_east = sun_position(time_utc_s, {place.lat_deg, 179.9999, 0.0});
        const SunPosition just_west = sun_position(time_utc_s, {place.lat_deg, -179.9999, 0.0});
        ASSERT_LT(glm::length(towards(just_east) - towards(just_west)), 0.0003 * std::numbers::pi / 180.0);
    }
}

// Over a day the mean of the elevation's sine is that of latitude times that of declination: what the hour
// angle adds cancels.
TEST(SunProperties, ADaysMeanIsWhatLatitudeAndDeclinationSay) {
    std::mt19937_64 random = random_of(105);
    for (int i = 0; i < 100; ++i) {
        const auto [time_utc_s, place] = drawn(random);
        double mean = 0.0;
        for (int minute = 5; minute < 1440; minute += 10)
            mean +=
                sine_cosine_deg(sun_position(time_utc_s + minute * 60.0, place).airless_elevation_deg).sine /
                144.0;
        const double expected = sine_cosine_deg(place.lat_deg).sine *
                                sine_cosine_deg(declination_deg(time_utc_s + day_s / 2.0)).sine;
        EXPECT_NEAR(mean, expected, 1e-3);
    }
}

// Every change of side that steps of half a minute see is told, once, and nothing else.
TEST(SunProperties, RisesAndSetsWhereBruteForceSeesIt) {
    std::mt19937_64 random = random_of(106);
    std::uniform_real_distribution<double> polar(60.0, 90.0);
    int crossings = 0, quiet_days = 0;
    for (int i = 0; i < 150; ++i) {
        auto [time_utc_s, place] = drawn(random);
        if (i % 2 == 0) place.lat_deg = std::copysign(polar(random), place.lat_deg);
        const SunDayEvents day = sun_day(time_utc_s, place);
        const auto is_up = [&, &where = place](double at_s) {
            return sun_position(at_s, where).airless_elevation_deg >= plain_horizon_deg;
        };
        std::size_t next = 0;
        bool was_up = is_up(time_utc_s);
        EXPECT_EQ(day.day == SunDay::rises_or_sets, !day.crossings.empty());
        EXPECT_TRUE(!day.crossings.empty() || (day.day == SunDay::up_all_day) == was_up);
        for (double at_s = time_utc_s + 30.0; at_s <= time_utc_s + day_s; at_s += 30.0) {
            const bool up = is_up(at_s);
            if (up == was_up) continue;
            ASSERT_LT(next, day.crossings.size());
            EXPECT_GE(day.crossings[next].time_utc_s, at_s - 30.01);
            EXPECT_LE(day.crossings[next].time_utc_s, at_s + 0.01);
            EXPECT_EQ(day.crossings[next].rising, up);
            EXPECT_NEAR(sun_position(day.crossings[next].time_utc_s, place).airless_elevation_deg,
                        plain_horizon_deg, 0.01 * 15.05 / 3600.0);
            ++next;
            was_up = up;
        }
        EXPECT_EQ(next, day.crossings.size());
        crossings += static_cast<int>(next);
        quiet_days += day.crossings.empty() ? 1 : 0;
    }
    EXPECT_GT(crossings, 150);
    EXPECT_GT(quiet_days, 10);
}

// A horizon just below the sun's highest place is crossed twice within minutes, just above it never; also
// when the day begins right before noon, or right after.
TEST(SunProperties, AGrazingSunIsSeen) {
    const Geodetic bern{46.95, 7.45, 0.0};
    const SunDayEvents day = sun_day(1782000000.0, bern);  // 2026-06-21T00:00Z
    for (const double before_noon_s : {40000.0, 400.0, 200.0}) {
        const double from_s = day.highest_utc_s - before_noon_s;
        const SunDayEvents below = sun_day(from_s, bern, day.highest_deg - 1e-4);
        ASSERT_EQ(below.crossings.size(), 2U) << before_noon_s;
        EXPECT_TRUE(below.crossings[0].rising);
        EXPECT_FALSE(below.crossings[1].rising);
        EXPECT_LT(below.crossings[1].time_utc_s - below.crossings[0].time_utc_s, 120.0);
        EXPECT_EQ(sun_day(from_s, bern, day.highest_deg + 1e-4).day, SunDay::down_all_day) << before_noon_s;
    }
    const SunDayEvents after = sun_day(day.highest_utc_s + 1.0 - day_s, bern, day.highest_deg - 1e-4);
    ASSERT_GE(after.crossings.size(), 1U);
    EXPECT_TRUE(after.crossings.back().rising);
}

}  // namespace
}  // namespace oro
