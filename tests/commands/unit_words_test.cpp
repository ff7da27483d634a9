// Metres and kilometres, feet and miles.
#include "apps/window/unit_words.h"

#include <gtest/gtest.h>

namespace {
using oro::UnitSystem;

TEST(UnitWords, HeightsAndDistances) {
    EXPECT_EQ(oro::height_in_units(3967.0, UnitSystem::metric), "3967 m");
    EXPECT_EQ(oro::height_in_units(3967.0, UnitSystem::imperial), "13,015 ft");  // 13,015.09
    EXPECT_EQ(oro::height_in_units(-430.0, UnitSystem::imperial), "-1,411 ft");
    EXPECT_EQ(oro::distance_in_units(850.0, UnitSystem::metric), "850 m");
    EXPECT_EQ(oro::distance_in_units(2400.0, UnitSystem::metric), "2.4 km");
    EXPECT_EQ(oro::distance_in_units(277'850.0, UnitSystem::metric), "278 km");
    EXPECT_EQ(oro::distance_in_units(850.0, UnitSystem::imperial), "2,789 ft");  // 2,788.7
    EXPECT_EQ(oro::distance_in_units(2400.0, UnitSystem::imperial), "1.5 mi");
}

TEST(UnitWords, RoundLengthsAreTheLongestThatFit) {
    const auto words = [](double most_m, UnitSystem units) { return oro::round_length(most_m, units).words; };
    EXPECT_EQ(words(999.0, UnitSystem::metric), "500 m");
    EXPECT_EQ(words(1000.0, UnitSystem::metric), "1 km");
    EXPECT_EQ(words(47'000.0, UnitSystem::metric), "20 km");
    EXPECT_EQ(words(0.3, UnitSystem::metric), "0.2 m");
    EXPECT_EQ(words(1000.0, UnitSystem::imperial), "2000 ft");
    EXPECT_EQ(words(9000.0, UnitSystem::imperial), "5 mi");
    EXPECT_NEAR(oro::round_length(9000.0, UnitSystem::imperial).length_m, 8046.72, 1e-9);
    EXPECT_EQ(oro::round_length(47'000.0, UnitSystem::metric).length_m, 20'000.0);
}

}  // namespace
