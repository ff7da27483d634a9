#include "core/cache/handle_table.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdio>
#include <map>
#include <random>

namespace oro {
namespace {

// Against a map, with keys that often share a place, while they come and go.
TEST(HandleTable, FindsWhatAMapFinds) {
    constexpr std::uint64_t seed = 5102;
    std::printf("seed %llu\n", static_cast<unsigned long long>(seed));
    std::mt19937_64 random(seed);
    HandleTable<std::uint64_t> table;
    std::map<std::uint64_t, std::uint32_t> map;
    EXPECT_EQ(table.find(3), table.none);
    table.erase(3);
    for (int i = 0; i < 60'000; ++i) {
        // Grows to some hundred, then mostly shrinks, and so on.
        const bool grows = i / 6000 % 2 == 0;
        const std::uint64_t key = random() % 700 << 40U;
        if (random() % 4 < (grows ? 3U : 1U)) {
            map[key] = static_cast<std::uint32_t>(i);
            table.set(key, static_cast<std::uint32_t>(i));
        } else {
            map.erase(key);
            table.erase(key);
        }
        const std::uint64_t asked = random() % 700 << 40U;
        const auto found = map.find(asked);
        ASSERT_EQ(table.find(asked), found == map.end() ? table.none : found->second) << "step " << i;
    }
    for (std::uint64_t key = 0; key < 700; ++key) {
        const auto found = map.find(key << 40U);
        ASSERT_EQ(table.find(key << 40U), found == map.end() ? table.none : found->second);
    }
    EXPECT_GT(map.size(), 100U);
}

}  // namespace
}  // namespace oro
