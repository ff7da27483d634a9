#include <imgui_stdlib.h>

#include <algorithm>

#include "apps/window/panels/panel_parts.h"
#include "apps/window/panels/panels.h"
#include "apps/window/places.h"

namespace oro {

void build_search_field(Viewer& viewer) {
    SearchField& field = viewer.search;
    const float gap = scaled_px(10.0F);
    const float width = std::min(scaled_px(270.0F), ImGui::GetIO().DisplaySize.x - 4.0F * gap);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {scaled_px(6.0F), scaled_px(6.0F)});
    begin_area("##search", {gap, gap}, {0.0F, 0.0F});
    ImGui::PopStyleVar();
    ImGui::SetNextItemWidth(width);
    if (std::exchange(field.takes_focus, false)) ImGui::SetKeyboardFocusHere();
    const bool entered = ImGui::InputTextWithHint("##place", "Go to a place   (G)", &field.text,
                                                  ImGuiInputTextFlags_EnterReturnsTrue);
    if (ImGui::IsItemActivated()) field.is_open = true;
    if (ImGui::IsItemEdited()) field.error.clear();
    // Whoever clicks elsewhere has done with it; what was typed stays.
    if (ImGui::IsItemDeactivated() && !entered) field.is_open = false;
    if (!field.is_open)
        tip("Latitude and longitude, UTM, MGRS, a geohash, or a tile like N46E008. Enter goes there.");
    if (entered) search(viewer);
    if (!field.error.empty()) {
        ImGui::PushStyleColor(ImGuiCol_Text, interface_colour::error);
        ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + width);
        ImGui::TextUnformatted(field.error.c_str());
        ImGui::PopTextWrapPos();
        ImGui::PopStyleColor();
    }
    ImGui::End();
}

}  // namespace oro
