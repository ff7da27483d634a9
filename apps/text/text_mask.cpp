#include "apps/text/text_face.h"

#include <algorithm>
#include <cstddef>

namespace oro {

void merge(const TextMask& from, int right_px, int down_px, TextMask& to) {
    const int x_px = from.x_px + right_px, y_px = from.y_px + down_px;
    const int left = std::max(x_px, to.x_px), right = std::min(x_px + from.width_px, to.x_px + to.width_px);
    if (left >= right) return;
    const auto count = static_cast<std::size_t>(right - left);
    for (int y = std::max(y_px, to.y_px); y < std::min(y_px + from.height_px, to.y_px + to.height_px); ++y) {
        const auto source = static_cast<std::size_t>(y - y_px) * static_cast<std::size_t>(from.width_px) +
                            static_cast<std::size_t>(left - x_px),
                   target = static_cast<std::size_t>(y - to.y_px) * static_cast<std::size_t>(to.width_px) +
                            static_cast<std::size_t>(left - to.x_px);
        for (const auto which : {&TextMask::ink, &TextMask::halo}) {
            const std::uint8_t* const added = (from.*which).data() + source;
            std::uint8_t* const covered = (to.*which).data() + target;
            for (std::size_t x = 0; x < count; ++x) covered[x] = std::max(covered[x], added[x]);
        }
    }
}

}  // namespace oro
