#include <algorithm>
#include <array>

#include "apps/window/panels/panel_parts.h"
#include "apps/window/panels/panels.h"
#include "apps/window/panels/top_row.h"

namespace oro {
namespace {

struct PanelButton {
    const char* words;
    const char* tip;
    bool Panels::*is_open;
};
constexpr std::array<PanelButton, 9> panel_buttons{
    {{"Layers", "Colours, names, lines, images, heights", &Panels::layers},
     {"Sun", "The light of a date and a time", &Panels::sun},
     {"Measure", "Distance, area, profile, line of sight", &Panels::measure},
     {"Film", "A camera's path: recorded, or along a track", &Panels::film},
     {"Open", "Elevation, images over it, tracks, pictures (Ctrl-O)", &Panels::files},
     {"Picture", "A picture of any size (Shift-P); P takes one at once", &Panels::picture},
     {"Statistics", "How this picture was drawn, and how long it took", &Panels::statistics},
     {"Log", "What was said since the window opened", &Panels::messages},
     {"Keys", "All keys and buttons of the mouse (?)", &Panels::keys}}};

void panel_button(Viewer& viewer, const PanelButton& button) {
    const bool was_open = viewer.panels.*button.is_open;
    if (was_open) ImGui::PushStyleColor(ImGuiCol_Text, interface_colour::accent);
    if (ImGui::Button(button.words)) viewer.panels.toggle(button.is_open);
    if (was_open) ImGui::PopStyleColor();
    tip_below(button.tip);
}

}  // namespace

void build_buttons(Viewer& viewer) {
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const float gap = scaled_px(10.0F);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {scaled_px(6.0F), scaled_px(6.0F)});
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {scaled_px(4.0F), scaled_px(4.0F)});
    const float left = scaled_px(top_row(display.x / scaled_px(1.0F)).buttons_x);
    begin_area("##buttons", {left, gap}, {0.0F, 0.0F});
    // One beside the other where there is room for all of them.
    float width = 0.0F;
    for (const PanelButton& button : panel_buttons)
        width += ImGui::CalcTextSize(button.words).x + scaled_px(20.0F);
    if (left + width < display.x - scaled_px(80.0F)) {
        for (const PanelButton& button : panel_buttons) {
            if (&button != panel_buttons.data()) ImGui::SameLine();
            panel_button(viewer, button);
        }
    } else {
        if (ImGui::Button("≡")) ImGui::OpenPopup("##menu");
        tip("Panels");
        // It scrolls where the window is too low for it.
        ImGui::SetNextWindowSizeConstraints({0.0F, 0.0F},
                                            {display.x, std::max(display.y - 2.0F * gap, 1.0F)});
        if (ImGui::BeginPopup("##menu")) {
            for (const PanelButton& button : panel_buttons)
                if (ImGui::MenuItem(button.words, nullptr, viewer.panels.*button.is_open))
                    viewer.panels.toggle(button.is_open);
            ImGui::EndPopup();
        }
    }
    ImGui::End();
    ImGui::PopStyleVar(2);
}

}  // namespace oro
