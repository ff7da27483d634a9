#include "apps/window/panels/panel_parts.h"

#include <imgui_internal.h>

#include <algorithm>

namespace oro {

bool begin_panel(const char* title, bool& is_open, PanelCorner corner, float width_px) {
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const float gap = scaled_px(10.0F), top = scaled_px(52.0F), bottom = scaled_px(40.0F);
    const float width = std::min(scaled_px(width_px), std::max(display.x - 2.0F * gap, 1.0F));
    ImVec2 at(gap, top), pivot(0.0F, 0.0F);
    if (corner == PanelCorner::upper_right) {
        at.x = display.x - gap;
        at.y = scaled_px(96.0F);
        pivot.x = 1.0F;
    } else if (corner == PanelCorner::middle) {
        at = {0.5F * display.x, 0.5F * display.y};
        pivot = {0.5F, 0.5F};
    }
    ImGui::SetNextWindowPos(at, ImGuiCond_Appearing, pivot);
    const float above = corner == PanelCorner::middle ? top : at.y;
    ImGui::SetNextWindowSizeConstraints({width, 0.0F},
                                        {width, std::max(display.y - above - bottom, scaled_px(60.0F))});
    return ImGui::Begin(title, &is_open,
                        ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_AlwaysAutoResize |
                            ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing);
}

bool begin_area(const char* name, ImVec2 at_px, ImVec2 pivot, bool with_paper) {
    ImGui::SetNextWindowPos(at_px, ImGuiCond_Always, pivot);
    ImGuiWindowFlags flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize |
                             ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                             ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav;
    if (!with_paper) flags |= ImGuiWindowFlags_NoBackground;
    return ImGui::Begin(name, nullptr, flags);
}

void value_line(const char* name, const std::string& value, const char* tip_text) {
    ImGui::PushID(name);
    ImGui::TextDisabled("%s", name);
    if (*tip_text != '\0') tip(tip_text);
    ImGui::SameLine(scaled_px(120.0F));
    const ImVec2 size(ImGui::CalcTextSize(value.c_str()).x + 1.0F, 0.0F);
    if (ImGui::Selectable(value.c_str(), false, ImGuiSelectableFlags_None, size))
        ImGui::SetClipboardText(value.c_str());
    if (ImGui::IsItemHovered()) {
        ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
        tip((std::string(tip_text) + (*tip_text == '\0' ? "" : "\n") + "A click copies it.").c_str());
    }
    ImGui::PopID();
}

void tip_below(const char* text) {
    if (!ImGui::IsItemHovered()) return;
    ImGui::SetNextWindowPos({ImGui::GetItemRectMin().x, ImGui::GetItemRectMax().y + scaled_px(10.0F)});
    tip(text);
}

void tip(const char* text) {
    if (!ImGui::IsItemHovered() || ImGui::IsAnyItemActive()) return;
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(scaled_px(340.0F));
    ImGui::TextUnformatted(text);
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

void heading(const char* text) {
    ImGui::Spacing();
    ImGui::PushStyleColor(ImGuiCol_Text, interface_colour::accent);
    ImGui::TextUnformatted(text);
    ImGui::PopStyleColor();
}

void quiet_text(const char* text) {
    ImGui::PushStyleColor(ImGuiCol_Text, interface_colour::quiet);
    ImGui::TextWrapped("%s", text);
    ImGui::PopStyleColor();
}

void copy_button(Viewer& viewer, const char* words, const std::string& text) {
    if (!ImGui::Button(words)) return;
    ImGui::SetClipboardText(text.c_str());
    tell(viewer, "copied");
}

void raise_above_panels() {
    ImGui::BringWindowToDisplayFront(ImGui::GetCurrentWindow());
}

}  // namespace oro
