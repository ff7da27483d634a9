#include <algorithm>
#include <cmath>

#include "apps/options/view_limits.h"
#include "apps/window/panels/panel_parts.h"
#include "apps/window/panels/panels.h"
#include "apps/window/panoramas.h"

namespace oro {
namespace {

// Takes the mouse where the sheet is: a drag moves it, the wheel makes it larger and smaller.
void take_hold_of_sheet(Viewer& viewer) {
    PanoramaAround& around = viewer.panorama;
    const ImGuiIO& io = ImGui::GetIO();
    ImGui::SetNextWindowPos({0.0F, 0.0F});
    ImGui::SetNextWindowSize(io.DisplaySize);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.0F, 0.0F});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0.0F);
    ImGui::Begin("##sheet", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoFocusOnAppearing |
                     ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoBringToFrontOnFocus);
    ImGui::PopStyleVar(2);
    ImGui::InvisibleButton("##hold", io.DisplaySize);
    const Sheet& sheet = around.drawn->laid.sheet;
    const double scale = panorama_scale(viewer);
    if (ImGui::IsItemActive()) {
        around.middle_x -= static_cast<double>(io.MouseDelta.x) / scale / sheet.width_px;
        around.middle_y -= static_cast<double>(io.MouseDelta.y) / scale / sheet.height_px;
    }
    if (ImGui::IsItemHovered() && io.MouseWheel != 0.0F) {
        const double before = around.zoom;
        around.zoom = std::clamp(before * std::pow(1.25, static_cast<double>(io.MouseWheel)), 1.0, 8.0);
        // What is under the pointer stays there.
        const double grown = 1.0 - before / around.zoom;
        around.middle_x +=
            static_cast<double>(io.MousePos.x - 0.5F * io.DisplaySize.x) / scale / sheet.width_px * grown;
        around.middle_y +=
            static_cast<double>(io.MousePos.y - 0.5F * io.DisplaySize.y) / scale / sheet.height_px * grown;
    }
    ImGui::End();
}

void choose_panorama(PanoramaChoice& choice, bool is_straight) {
    value_line("From", at_text(choice.place), "Latitude, longitude, WGS 84");
    ImGui::SetNextItemWidth(scaled_px(110.0F));
    if (ImGui::InputDouble("m, the eye's height", &choice.above_m, 0.0, 0.0, "%.7g"))
        choice.above_m = std::clamp(choice.above_m, 0.0, 1.0e5);
    tip("Over the ground");
    ImGui::SetNextItemWidth(scaled_px(110.0F));
    if (ImGui::InputInt("pixels wide", &choice.width_px, 0))
        choice.width_px = std::clamp(choice.width_px, static_cast<int>(view_limits::panorama_width_px.low),
                                     static_cast<int>(view_limits::panorama_width_px.high));
    tip("All around. More have room for more names, and take longer");
    if (!is_straight) return;
    ImGui::Checkbox("Light bends as in standard air", &choice.bends);
    tip("As the command panorama has it where nothing is said");
}

void keep_drawn(Viewer& viewer) {
    ImGui::Separator();
    ImGui::Checkbox("In the window", &viewer.panorama.is_shown);
    tip("In the place of the ground. A drag moves it, the wheel makes it larger");
    for (const char* const ending : {".png", ".svg"}) {
        ImGui::SameLine();
        const std::string words = std::string("Save as ") + (ending + 1);
        if (ImGui::Button(words.c_str()))
            viewer.wishes.push_back([ending](Viewer& v) {
                save_panorama(v, ending);
                return Result<void>();
            });
        tip("The file that orograph panorama writes, into the working folder");
    }
}

}  // namespace

void build_panorama_panel(Viewer& viewer) {
    bool& is_open = viewer.panels.panorama;
    PanoramaAround& around = viewer.panorama;
    if (!is_open || !around.choice) return;
    if (shows_panorama(viewer)) take_hold_of_sheet(viewer);
    if (begin_panel("Panorama", is_open, PanelCorner::upper_right, 380.0F)) {
        choose_panorama(*around.choice, viewer.view.model.air.k == 0.0);
        if (around.work) {
            ImGui::ProgressBar(static_cast<float>(around.work->share()), {scaled_px(220.0F), scaled_px(10.0F)}, "");
            ImGui::SameLine();
            if (ImGui::Button("Stop")) stop_panorama(viewer);
        } else if (ImGui::Button("Draw")) {
            draw_panorama_around(viewer);
        }
        if (around.drawn) keep_drawn(viewer);
    }
    ImGui::End();
}

}  // namespace oro
