#include <imgui.h>

#include "apps/window/panels/panels.h"
#include "apps/window/viewer.h"

namespace oro {

// Lines over the ground while the eye moves: below all panels.
void build_moving_lines(Viewer& viewer) {
    if (viewer.lines.empty() || shows_panorama(viewer)) return;
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    std::vector<ImVec2> points;
    for (const StrokedLine& line : viewer.lines) {
        points.clear();
        for (const glm::dvec2& at_px : line.places_px)
            points.emplace_back(static_cast<float>(at_px.x), static_cast<float>(at_px.y));
        const auto& [red, green, blue] = line.stroke.colour;
        list.AddPolyline(points.data(), static_cast<int>(points.size()), IM_COL32(red, green, blue, 255), 0,
                         static_cast<float>(line.stroke.width_px));
    }
}

}  // namespace oro
