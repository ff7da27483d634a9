#include <algorithm>

#include "apps/window/looking_around.h"
#include "apps/window/panels/panel_parts.h"
#include "apps/window/panels/panels.h"

namespace oro {
namespace {

void number_choice(const char* words, double low, double high, const char* tip_text, double& value) {
    ImGui::SetNextItemWidth(scaled_px(110.0F));
    if (ImGui::InputDouble(words, &value, 0.0, 0.0, "%.7g")) value = std::clamp(value, low, high);
    tip(tip_text);
}

void choose_looking(Viewer& viewer) {
    SeenAroundChoice& choice = *viewer.looking.choice;
    value_line("From", at_text(choice.place), "Latitude, longitude, WGS 84");
    number_choice("m, the eye's height", 0.0, 1.0e5, "Over the ground", choice.above_m);
    number_choice("m, the target's height", 0.0, 1.0e5, "Over the ground: 0 asks for the ground itself",
                  choice.target_m);
    number_choice("km around", least_radius_km, most_radius_km,
                  "Beyond that nothing is asked. Twice as far takes four times as long", choice.radius_km);
    if (viewer.view.model.air.k == 0.0) {
        ImGui::Checkbox("Light bends as in standard air", &choice.bends);
        tip("As the command viewshed has it where nothing is said. Without it light goes straight, as in "
            "this picture");
    }
}

void tell_found(Viewer& viewer) {
    const SeenAround& found = *viewer.looking.found;
    ImGui::Separator();
    ImGui::TextWrapped("%s", found.seen.c_str());
    quiet_text(("From: " + found.from).c_str());
    quiet_text(("Light: " + found.light).c_str());
    bool is_shown = viewer.looking.is_shown;
    if (ImGui::Checkbox("Over the ground", &is_shown))
        viewer.wishes.push_back([is_shown](Viewer& v) { return show_seen_around(v, is_shown); });
    tip("Bright is what is seen, dark is what is hidden. Pictures by P leave it out: their files hold what "
        "draws them again");
    ImGui::SameLine();
    if (ImGui::Button("Save as GeoTIFF"))
        viewer.wishes.push_back([](Viewer& v) {
            save_seen_around(v);
            return Result<void>();
        });
    tip("The file that orograph viewshed writes: seen or hidden, and by how much it is missed");
    ImGui::SameLine();
    if (ImGui::Button("Remove")) viewer.wishes.push_back(forget_seen_around);
}

}  // namespace

void build_viewshed_panel(Viewer& viewer) {
    bool& is_open = viewer.panels.viewshed;
    if (!is_open || !viewer.looking.choice) return;
    if (begin_panel("What can be seen", is_open, PanelCorner::upper_right, 380.0F)) {
        choose_looking(viewer);
        const auto& work = viewer.looking.work;
        if (work) {
            ImGui::ProgressBar(static_cast<float>(work->share()), {scaled_px(220.0F), scaled_px(10.0F)}, "");
            ImGui::SameLine();
            if (ImGui::Button("Stop")) stop_looking_around(viewer);
        } else if (ImGui::Button("Look around")) {
            look_around(viewer);
        }
        if (viewer.looking.found) tell_found(viewer);
    }
    ImGui::End();
}

}  // namespace oro
