// Places of names in a row: literal ones, and against all others that there could be.
#include "apps/panorama/panorama_names.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace oro {
namespace {

using Slots = std::vector<std::optional<double>>;

TEST(NameSlots, StandAboveTheirPlacesWhereThereIsRoom) {
    EXPECT_EQ(name_slots({50.0, 10.0, 90.0}, {0.0, 100.0, 20.0, 30.0}), (Slots{50.0, 10.0, 90.0}));
    EXPECT_EQ(name_slots({}, {0.0, 100.0, 20.0, 30.0}), Slots{});
}

TEST(NameSlots, GiveWayEvenlyAndInOrder) {
    EXPECT_EQ(name_slots({52.0, 48.0}, {0.0, 100.0, 20.0, 30.0}), (Slots{60.0, 40.0}));
    // At a border all give way to one side.
    EXPECT_EQ(name_slots({2.0, 4.0}, {5.0, 100.0, 20.0, 30.0}), (Slots{5.0, 25.0}));
    EXPECT_EQ(name_slots({98.0, 96.0}, {0.0, 95.0, 20.0, 30.0}), (Slots{95.0, 75.0}));
}

TEST(NameSlots, LeaveOutTheLowestInRank) {
    // Three would have to stand 20 px from their places; 12 are allowed.
    EXPECT_EQ(name_slots({50.0, 50.0, 50.0}, {0.0, 100.0, 20.0, 12.0}), (Slots{40.0, 60.0, std::nullopt}));
    EXPECT_EQ(name_slots({50.0}, {60.0, 40.0, 20.0, 30.0}), Slots{std::nullopt});  // no row at all
}

// The least sum of squares over slots on a lattice, found by trying all of them in order.
double least_squares(std::vector<double> places_px, const SlotRow& row) {
    std::ranges::sort(places_px);
    constexpr double step_px = 0.5;
    const auto count = static_cast<std::size_t>((row.high_px - row.low_px) / step_px) + 1;
    const auto apart = static_cast<std::size_t>(std::lround(row.apart_px / step_px));
    std::vector<double> best(count, 0.0);  // of the places so far, the last one at or left of a slot
    for (std::size_t i = 0; i < places_px.size(); ++i) {
        std::vector<double> next(count, std::numeric_limits<double>::infinity());
        for (std::size_t k = i * apart; k < count; ++k) {
            const double off_px = row.low_px + step_px * static_cast<double>(k) - places_px[i];
            const double before = i == 0 ? 0.0 : best[k - apart];
            next[k] = before + off_px * off_px;
            if (k > 0) next[k] = std::min(next[k], next[k - 1]);
        }
        best = std::move(next);
    }
    return best.back();
}

TEST(NameSlots, AreTheNearestThatThereAre) {
    std::mt19937 random(5);  // the seed
    std::uniform_real_distribution<double> place_px(0.0, 200.0);
    std::uniform_int_distribution<int> many(1, 9);
    for (int i = 0; i < 500; ++i) {
        std::vector<double> places(static_cast<std::size_t>(many(random)));
        for (double& place : places) place = place_px(random);
        const SlotRow row{0.0, 200.0, 20.0, 1e9};
        const Slots slots = name_slots(places, row);
        double sum = 0.0;
        for (std::size_t a = 0; a < places.size(); ++a) {
            ASSERT_TRUE(slots[a]) << i;
            EXPECT_GE(*slots[a], 0.0);
            EXPECT_LE(*slots[a], 200.0 + 1e-9);
            sum += (*slots[a] - places[a]) * (*slots[a] - places[a]);
            for (std::size_t b = 0; b < a; ++b) {
                EXPECT_GE(std::abs(*slots[a] - *slots[b]), 20.0 - 1e-9) << i;
                EXPECT_EQ(places[a] < places[b], *slots[a] < *slots[b]) << i;
            }
        }
        const double least = least_squares(places, row);
        EXPECT_LE(sum, least + 1e-6) << i;
        // The lattice misses each slot by 0.25 px at most.
        EXPECT_GE(sum, least - 0.5 * std::sqrt(least * static_cast<double>(places.size())) - 1.0) << i;
    }
}

}  // namespace
}  // namespace oro
