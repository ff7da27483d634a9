#include <cmath>
#include <cstdio>

#include "apps/report/figures.h"
#include "apps/window/motion.h"
#include "apps/window/panels/panel_parts.h"
#include "apps/window/panels/panels.h"
#include "core/earth/ellipsoid.h"

namespace oro {

void build_compass(Viewer& viewer) {
    const float radius = scaled_px(26.0F), gap = scaled_px(10.0F);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.0F, 0.0F});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0.0F);
    begin_area("##compass", {ImGui::GetIO().DisplaySize.x - gap, gap}, {1.0F, 0.0F}, false);
    ImGui::PopStyleVar(2);
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const ImVec2 middle(corner.x + radius, corner.y + radius);
    if (ImGui::InvisibleButton("##north", {2.0F * radius, 2.0F * radius})) press_key(viewer, ViewKey::n);
    const bool hovered = ImGui::IsItemHovered();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddCircleFilled(middle, radius, interface_colour::paper, 48);
    list.AddCircle(middle, radius - 0.5F, hovered ? interface_colour::accent : interface_colour::line, 48,
                   scaled_px(1.0F));
    const double heading_deg = viewer.view.camera.attitude.heading_deg;
    const auto at = [&](double azimuth_deg, double share) {
        const double angle = radians_from_deg(azimuth_deg - heading_deg).rad;
        return ImVec2(middle.x + static_cast<float>(share * radius * std::sin(angle)),
                      middle.y - static_cast<float>(share * radius * std::cos(angle)));
    };
    for (int i = 0; i < 12; ++i)
        list.AddLine(at(30.0 * i, i % 3 == 0 ? 0.78 : 0.84), at(30.0 * i, 0.92), interface_colour::quiet,
                     std::max(1.0F, scaled_px(1.0F)));
    list.AddTriangleFilled(at(0.0, 0.72), at(100.0, 0.16), at(-100.0, 0.16), IM_COL32(240, 92, 76, 255));
    list.AddTriangleFilled(at(180.0, 0.72), at(-80.0, 0.16), at(80.0, 0.16), IM_COL32(235, 238, 240, 200));
    if (hovered) {
        ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
        ImGui::SetTooltip("You look to %s, heading %.1f° from true north.\nA click turns north up.",
                          compass_point(static_cast<int>(std::lround(heading_deg / 22.5)) % 16), heading_deg);
    }
    ImGui::End();
}

}  // namespace oro
