#include "apps/labels/seen_heights.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/measure/shown_place.h"
#include "render/frame/shown_ground.h"

namespace oro {
namespace {

constexpr double most_nodes = 16e6;  // 128 MB
constexpr double steepest_tangent = 5.0;

}  // namespace

bool SeenHeights::joined(std::size_t one, std::size_t other) const {
    const double near_m = std::min(far_m[one], far_m[other]), beyond_m = std::max(far_m[one], far_m[other]);
    return near_m > 0.0 && beyond_m - near_m <= steepest * near_m;
}

std::optional<double> SeenHeights::H_at(glm::dvec2 at_px) const {
    const glm::dvec2 in_nodes = (at_px - 0.5) / static_cast<double>(step_px);
    const int column = static_cast<int>(std::floor(in_nodes.x)),
              row = static_cast<int>(std::floor(in_nodes.y));
    if (column < 0 || row < 0 || column + 1 >= columns || row + 1 >= rows) return std::nullopt;
    const std::size_t a = at(column, row), b = at(column + 1, row), c = at(column, row + 1),
                      d = at(column + 1, row + 1);
    if (!joined(a, b) || !joined(a, c) || !joined(b, d) || !joined(c, d)) return std::nullopt;
    const double x = in_nodes.x - column, y = in_nodes.y - row;
    const auto H = [&](std::size_t node) { return static_cast<double>(H_m[node]); };
    return (1.0 - y) * ((1.0 - x) * H(a) + x * H(b)) + y * ((1.0 - x) * H(c) + x * H(d));
}

SeenHeights no_heights(const Camera& camera) {
    SeenHeights seen;
    const double pixels = static_cast<double>(camera.width_px) * camera.height_px;
    seen.step_px = std::max(1, static_cast<int>(std::ceil(std::sqrt(pixels / most_nodes))));
    seen.columns = (camera.width_px + seen.step_px - 1) / seen.step_px;
    seen.rows = (camera.height_px + seen.step_px - 1) / seen.step_px;
    seen.steepest = steepest_tangent * 2.0 * camera.half_fov_tangent().y / camera.height_px * seen.step_px;
    const std::size_t nodes = static_cast<std::size_t>(seen.columns) * static_cast<std::size_t>(seen.rows);
    seen.H_m.resize(nodes);
    seen.far_m.resize(nodes);
    return seen;
}

void smooth(SeenHeights& seen) {
    constexpr double weights[3] = {0.25, 0.5, 0.25};
    std::vector<float> smooth = seen.H_m;
    for (int row = 1; row + 1 < seen.rows; ++row) {
        for (int column = 1; column + 1 < seen.columns; ++column) {
            const std::size_t here = seen.at(column, row);
            if (seen.far_m[here] <= 0.0F) continue;
            double sum = 0.0, whole = 0.0;
            for (int down = -1; down <= 1; ++down) {
                for (int right = -1; right <= 1; ++right) {
                    // Opposite nodes together, or neither: a slope stays where it is.
                    const std::size_t one = seen.at(column + right, row + down),
                                      opposite = seen.at(column - right, row - down);
                    if (!seen.joined(here, one) || !seen.joined(here, opposite)) continue;
                    const double weight = weights[down + 1] * weights[right + 1];
                    sum += weight * static_cast<double>(seen.H_m[one]);
                    whole += weight;
                }
            }
            smooth[here] = static_cast<float>(sum / whole);
        }
    }
    seen.H_m = std::move(smooth);
}

Result<SeenHeights> seen_heights(const Gpu& gpu, Scene& scene, const Camera& camera,
                                 const PictureOptions& options, const TrueGround& ground) {
    SeenHeights seen = no_heights(camera);
    const Sight sight = sight_of(options.model, camera.eye);
    const auto take = [&](int x, int y, const DrawnPoint& point) {
        if (point.background()) return;
        const auto [lat_deg, lon_deg] = place_of(point, ground, sight, camera, {x + 0.5, y + 0.5});
        const std::size_t node = seen.at(x / seen.step_px, y / seen.step_px);
        seen.H_m[node] =
            static_cast<float>((point.h_m - ground.N_m(lat_deg, lon_deg)) / ground.exaggeration());
        seen.far_m[node] = static_cast<float>(point.z_m);
    };
    ORO_CHECK(shown_ground(gpu, scene, camera, options, seen.step_px, take));
    if (seen.step_px == 1) smooth(seen);
    return seen;
}

}  // namespace oro
