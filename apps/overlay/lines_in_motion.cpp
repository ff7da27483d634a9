#include "apps/overlay/lines_in_motion.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <optional>
#include <utility>

#include "apps/options/view_limits.h"
#include "core/base/elapsed.h"
#include "core/earth/ellipsoid.h"

namespace oro {
namespace {

constexpr std::size_t most_places = 100'000;
constexpr double nearest_apart_px = 4.0, farthest_apart_px = 40.0;
constexpr double least_step_m = 10.0;  // from place to place of a line

// Without what is nearer to the place before than a step: a frame looks at each place.
void thin_out(GroundLine& line) {
    std::optional<Ecef> last;
    std::vector<std::optional<Geodetic>> kept;
    for (std::size_t i = 0; i < line.places.size(); ++i) {
        const auto& place = line.places[i];
        const bool ends = i + 1 == line.places.size() || !line.places[i + 1];
        if (place && last && !ends && glm::distance(ecef_from_geodetic(*place).m, last->m) < least_step_m)
            continue;
        kept.push_back(place);
        last = place ? std::optional(ecef_from_geodetic(*place)) : std::nullopt;
    }
    line.places = std::move(kept);
}

}  // namespace

std::vector<StrokedLine> LinesInMotion::find(const View& view, const TrueGround& ground, double longest_s) {
    if (is_slow_ || !view.vectors_read || view.vectors_read->overlay.empty()) return {};
    if (of_ != view.vectors_read) {
        OverlayShapes all = overlay_shapes(view);
        lines_ = ground_lines(all.shapes, ground, most_places).value_or(std::vector<GroundLine>());
        for (GroundLine& line : lines_) thin_out(line);
        strokes_ = std::move(all.strokes);
        of_ = view.vectors_read;
    }
    if (lines_.empty()) return {};
    const auto start = Clock::now();
    const PointsInView in_view(ground, view.camera, view.model);
    std::vector<StrokedLine> stroked;
    for (SeenLine& line :
         seen_lines(lines_, in_view, view.camera, view_limits::overlay_width_px.high, apart_px_))
        stroked.push_back({std::move(line.places_px), strokes_[line.shape]});
    const double took_s = seconds_since(start);
    if (took_s > longest_s) {
        is_slow_ = apart_px_ >= farthest_apart_px;
        apart_px_ = std::min(farthest_apart_px, 2.0 * apart_px_);
    } else if (took_s < 0.3 * longest_s) {
        apart_px_ = std::max(nearest_apart_px, 0.7 * apart_px_);
    }
    return stroked;
}

}  // namespace oro
