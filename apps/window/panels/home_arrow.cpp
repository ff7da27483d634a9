#include <algorithm>
#include <cmath>

#include "apps/report/figures.h"
#include "apps/window/motion.h"
#include "apps/window/panels/panel_parts.h"
#include "apps/window/panels/panels.h"
#include "apps/window/unit_words.h"
#include "core/earth/ellipsoid.h"

namespace oro {
// At the picture's border, towards a region that is not in the picture: a click flies there, as Home does.
void build_home_arrow(Viewer& viewer) {
    const auto& arrow = way_home(viewer, static_cast<double>(scaled_px(64.0F)));
    if (!arrow) return;
    const float radius = scaled_px(20.0F);
    const ImVec2 middle(static_cast<float>(arrow->point_px.x), static_cast<float>(arrow->point_px.y));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.0F, 0.0F});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0.0F);
    begin_area("##home", middle, {0.5F, 0.5F}, false);
    ImGui::PopStyleVar(2);
    const std::string words = distance_in_units(arrow->distance_m, viewer.settings.units);
    const float width = std::max(2.0F * radius, ImGui::CalcTextSize(words.c_str()).x + scaled_px(12.0F));
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    if (ImGui::InvisibleButton("##fly", {width, 2.0F * radius + ImGui::GetTextLineHeightWithSpacing()}))
        press_key(viewer, ViewKey::home);
    const bool hovered = ImGui::IsItemHovered();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 hub(corner.x + 0.5F * width, corner.y + radius);
    list.AddCircleFilled(hub, radius, interface_colour::paper, 48);
    list.AddCircle(hub, radius - 0.5F, hovered ? interface_colour::accent : interface_colour::line, 48,
                   scaled_px(1.0F));
    const auto at = [&](double turn_deg, double share) {
        const double angle = radians_from_deg(arrow->clockwise_deg + turn_deg).rad;
        return ImVec2(hub.x + static_cast<float>(share * static_cast<double>(radius) * std::sin(angle)),
                      hub.y - static_cast<float>(share * static_cast<double>(radius) * std::cos(angle)));
    };
    list.AddTriangleFilled(at(0.0, 0.75), at(140.0, 0.6), at(-140.0, 0.6), interface_colour::accent);
    const ImVec2 below(hub.x - 0.5F * ImGui::CalcTextSize(words.c_str()).x, corner.y + 2.0F * radius);
    list.AddText({below.x + 1.0F, below.y + 1.0F}, interface_colour::shadow, words.c_str());
    list.AddText(below, interface_colour::ink, words.c_str());
    if (hovered) {
        ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
        ImGui::SetTooltip(
            "Nothing of the data is in the picture. They are %s away, to the %s.\nA click flies there "
            "(Home).",
            words.c_str(), compass_point(static_cast<int>(std::lround(arrow->bearing_deg / 22.5)) % 16));
    }
    ImGui::End();
}

}  // namespace oro
