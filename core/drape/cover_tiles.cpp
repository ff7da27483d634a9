#include "core/drape/cover_tiles.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace oro {

std::uint32_t CoverTexels::pack(std::size_t column, const Shares& shares) {
    if (column == 0) right_ = {};
    Shares want{};
    for (std::size_t i = 0; i < want.size(); ++i)
        want[i] = static_cast<float>(cover_units) * shares[i] + right_[i] + below_[column][i];
    std::array<std::size_t, unknown_ground + 1> order{};
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return want[a] > want[b]; });
    std::array<int, cover_pairs> units{};
    int left = static_cast<int>(cover_units);
    for (std::size_t k = 0; k < cover_pairs; ++k) {
        units[k] = std::clamp(static_cast<int>(std::floor(want[order[k]])), 0, left);
        left -= units[k];
    }
    for (; left > 0; --left) {
        std::size_t most = 0;
        for (std::size_t k = 1; k < cover_pairs; ++k)
            if (want[order[k]] - static_cast<float>(units[k]) >
                want[order[most]] - static_cast<float>(units[most]))
                most = k;
        ++units[most];
    }
    std::uint32_t texel = 0;
    for (std::size_t k = 0; k < cover_pairs; ++k) {
        want[order[k]] -= static_cast<float>(units[k]);
        if (units[k] > 0)
            texel |= (static_cast<std::uint32_t>(order[k]) | static_cast<std::uint32_t>(units[k]) << 4U)
                     << (8U * k);
    }
    constexpr float most_carried = 8.0F;
    for (std::size_t i = 0; i < want.size(); ++i)
        right_[i] = below_[column][i] = 0.5F * std::clamp(want[i], -most_carried, most_carried);
    return texel;
}

}  // namespace oro
