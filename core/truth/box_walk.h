// A walk through a tree of boxes along a line, or away from a place, nearer boxes first. Within core.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

namespace oro {

// From node 0 on. begin_m(node): where the line meets its box, infinite where it does not; or how far the box
// is from the place. below(node): the
// two nodes below, nothing of a leaf. ask(leaf) may lessen most_m, beyond which nothing is asked.
template <class Begin, class Below, class Ask>
void walk_boxes(const double& most_m, const Begin& begin_m, const Below& below, const Ask& ask) {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    struct Waiting {
        std::uint32_t node;
        double begin_m;
    };
    std::array<Waiting, 64> waiting{};  // 2^32 triangles are 32 levels
    std::size_t count = 0;
    Waiting next{0, begin_m(0)};
    for (;;) {
        const std::optional<std::pair<std::uint32_t, std::uint32_t>> two = below(next.node);
        if (next.begin_m <= most_m && two) {
            Waiting near{two->first, begin_m(two->first)}, far{two->second, begin_m(two->second)};
            if (far.begin_m < near.begin_m) std::swap(near, far);
            if (far.begin_m < infinite) waiting[count++] = far;
            next = near;
            if (near.begin_m < infinite) continue;
        } else if (next.begin_m <= most_m) {
            ask(next.node);
        }
        if (count == 0) return;
        next = waiting[--count];
    }
}

// What walk_boxes() asks of a tree where the first node below another stands right behind it: second(number)
// gives the other one, or 0 where none is below.
template <class Second>
auto below_in_order(const Second& second) {
    return [second](std::uint32_t number) {
        const std::uint32_t other = second(number);
        return other > 0 ? std::optional(std::pair(number + 1, other)) : std::nullopt;
    };
}

}  // namespace oro
