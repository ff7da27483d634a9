#include "apps/overlay/lines_in_motion.h"

#include <utility>

#include "apps/options/view_limits.h"
#include "core/base/elapsed.h"

namespace oro {
namespace {

constexpr std::size_t most_places = 100'000;
constexpr double moving_apart_px = 6.0;
constexpr double longest_s = 0.015;

}  // namespace

std::vector<StrokedLine> LinesInMotion::find(const View& view, const TrueGround& ground) {
    if (is_slow_ || !view.vectors_read || view.vectors_read->overlay.empty()) return {};
    const OverlayShapes all = overlay_shapes(view);
    if (of_ != view.vectors_read) {
        lines_ = ground_lines(all.shapes, ground, most_places).value_or(std::vector<GroundLine>());
        of_ = view.vectors_read;
    }
    if (lines_.empty()) return {};
    const auto start = Clock::now();
    const PointsInView in_view(ground, view.camera, view.model);
    std::vector<StrokedLine> stroked;
    for (SeenLine& line :
         seen_lines(lines_, in_view, view.camera, view_limits::overlay_width_px.high, moving_apart_px))
        stroked.push_back({std::move(line.places_px), all.strokes[line.shape]});
    is_slow_ = seconds_since(start) > longest_s;
    return stroked;
}

}  // namespace oro
