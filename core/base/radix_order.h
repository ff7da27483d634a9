// Sorts many items by a number that is not negative: in a few passes over them, where a comparison each would
// cost several times as much.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace oro {

// By distance_of(item), a double that is at least 0 and finite, and among equal ones by `less`, which orders
// by distance first. room: kept from call to call, holds nothing.
template <class Item, class DistanceOf, class Less>
void sort_by_distance(std::vector<Item>& items, std::vector<Item>& room, const DistanceOf& distance_of,
                      const Less& less) {
    constexpr std::size_t few = 256;
    if (items.size() < few) {
        std::sort(items.begin(), items.end(), less);
        return;
    }
    // Doubles that are not negative are in the order of their bits: the upper 33 of these, without the sign.
    // E. Friend, Sorting on Electronic Computer Systems, J. ACM 3, 1956: from the lowest digit on.
    constexpr unsigned digits = 3, digit_bits = 11, first_bit = 63 - digits * digit_bits;
    constexpr std::size_t values = std::size_t{1} << digit_bits;
    constexpr std::uint64_t sign = std::uint64_t{1} << 63U;
    const auto upper = [&](const Item& item) {
        return (std::bit_cast<std::uint64_t>(distance_of(item)) & ~sign) >> first_bit;
    };
    const auto digit = [&](const Item& item, unsigned number) {
        return static_cast<std::size_t>(upper(item) >> (number * digit_bits)) & (values - 1);
    };
    std::array<std::array<std::uint32_t, values>, digits> first{};
    for (const Item& item : items)
        for (unsigned number = 0; number < digits; ++number) ++first[number][digit(item, number)];
    for (auto& counts : first) {
        std::uint32_t before = 0;
        for (std::uint32_t& count : counts) before += std::exchange(count, before);
    }
    room.resize(items.size());
    for (unsigned number = 0; number < digits; ++number) {
        for (const Item& item : items) room[first[number][digit(item, number)]++] = item;
        items.swap(room);
    }
    // What these bits do not tell apart lies side by side: few, as a rule.
    for (std::size_t begin = 0; begin < items.size();) {
        const std::uint64_t its_upper = upper(items[begin]);
        std::size_t end = begin + 1;
        while (end < items.size() && upper(items[end]) == its_upper) ++end;
        if (end - begin > 1)
            std::sort(items.begin() + static_cast<std::ptrdiff_t>(begin),
                      items.begin() + static_cast<std::ptrdiff_t>(end), less);
        begin = end;
    }
}

}  // namespace oro
