#include "apps/text/text_mask.h"

#include <algorithm>
#include <cstddef>

namespace oro {

void merge(const TextMask& from, int right_px, int down_px, TextMask& to) {
    const int x_px = from.x_px + right_px, y_px = from.y_px + down_px;
    const int left = std::max(x_px, to.x_px), right = std::min(x_px + from.width_px, to.x_px + to.width_px);
    for (int y = std::max(y_px, to.y_px); y < std::min(y_px + from.height_px, to.y_px + to.height_px); ++y) {
        for (int x = left; x < right; ++x) {
            const auto source = static_cast<std::size_t>(y - y_px) * static_cast<std::size_t>(from.width_px) +
                                static_cast<std::size_t>(x - x_px),
                       target =
                           static_cast<std::size_t>(y - to.y_px) * static_cast<std::size_t>(to.width_px) +
                           static_cast<std::size_t>(x - to.x_px);
            to.ink[target] = std::max(to.ink[target], from.ink[source]);
            to.halo[target] = std::max(to.halo[target], from.halo[source]);
        }
    }
}

}  // namespace oro
