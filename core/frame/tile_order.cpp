#include "core/frame/tile_order.h"

#include <algorithm>
#include <cassert>
#include <cstdlib>
#include <tuple>

namespace oro {

std::vector<int> columns_by_uprights(const Camera& camera, int tile_width_px) {
    assert(tile_width_px > 0);
    const glm::dvec3 up = camera.view_from_ecef() * ecef_from_enu(camera.eye.lat_deg, camera.eye.lon_deg)[2];
    const double tangent = camera.half_fov_tangent().x;
    // Which way a line that goes up goes in the picture where it is so far to the right: v + t up is seen at
    // (v.x + t up.x) / (1 - t up.z), v.z being -1.
    const auto turns_right = [&](double x_px) {
        return up.x + tangent * (2.0 * x_px / camera.width_px - 1.0) * up.z;
    };
    std::vector<std::tuple<int, int>> order;  // of those that do not see each other any
    for (int x = 0; x < camera.width_px; x += tile_width_px) {
        const double left = turns_right(x), right = turns_right(std::min(x + tile_width_px, camera.width_px));
        if (left < 0.0 && right < 0.0)
            order.emplace_back(1, x);
        else if (left > 0.0 && right > 0.0)
            order.emplace_back(1, -x);
        else  // lines part here, or meet
            order.emplace_back(up.z > 0.0 ? 2 : 0, x);
    }
    std::ranges::sort(order);
    std::vector<int> columns;
    for (const auto& [group, x] : order) columns.push_back(std::abs(x));
    return columns;
}

}  // namespace oro
