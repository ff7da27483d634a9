// Items sorted by digits are in the order that comparing them gives.
#include "core/base/radix_order.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace oro {
namespace {

struct Item {
    double distance_m;
    std::uint32_t number;
    bool operator==(const Item&) const = default;
};

TEST(RadixOrder, IsThatOfComparing) {
    constexpr unsigned seed = 5110;
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const auto less = [](const Item& a, const Item& b) {
        return a.distance_m != b.distance_m ? a.distance_m < b.distance_m : a.number < b.number;
    };
    std::vector<Item> room;
    for (const std::size_t count : {0, 1, 2, 255, 256, 257, 3000, 20000})
        for (int kind = 0; kind < 5; ++kind) {
            std::vector<Item> items;
            for (std::size_t i = 0; i < count; ++i) {
                double distance_m = 0.0;
                if (kind == 1) distance_m = std::pow(10.0, 600.0 * unit(random) - 300.0);
                if (kind == 2) distance_m = 1.0e4 + 1.0e-7 * unit(random);  // alike in their upper bits
                if (kind == 3) distance_m = std::floor(20.0 * unit(random)) * 1000.0;
                if (kind == 4) {
                    const double few[] = {0.0, std::numeric_limits<double>::denorm_min(),
                                          std::numeric_limits<double>::max(), 1.0};
                    distance_m = few[random() % 4];
                }
                items.push_back({distance_m, static_cast<std::uint32_t>(random())});
            }
            std::vector<Item> expected = items;
            std::sort(expected.begin(), expected.end(), less);
            sort_by_distance(
                items, room, [](const Item& item) { return item.distance_m; }, less);
            ASSERT_EQ(items, expected) << "seed " << seed << ", kind " << kind << ", " << count << " items";
        }
}

}  // namespace
}  // namespace oro
