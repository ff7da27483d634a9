// A walk through a tree of boxes along a line, nearer boxes first. Within core.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

namespace oro {

// From node 0 on. begin_m(node): where the line meets its box, infinite where it does not. below(node): the
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

}  // namespace oro
