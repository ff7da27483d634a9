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

void choose_probability(Viewer& viewer) {
    SeenAroundChoice& choice = *viewer.looking.choice;
    ImGui::Checkbox("How probable, as heights have errors", &choice.is_probable);
    tip("Looks around in simulated grounds that fit the data and their errors, and tints by the share in "
        "which a "
        "post is seen. As orograph viewshed --realisations");
    if (!choice.is_probable) return;
    ImGui::SetNextItemWidth(scaled_px(110.0F));
    if (ImGui::InputInt("realisations", &choice.realisations, 0, 0))
        choice.realisations = std::clamp(choice.realisations, 2, most_realisations);
    tip("How many simulated grounds: each takes as long as looking around once");
    number_choice(
        "m, error of 90 %", 0.0, 1000.0,
        "90 of 100 heights are off by no more. 0: what the makers of the data promise, which is known of "
        "SRTM alone",
        choice.le90_m);
}

// The colours of probabilities, from 0 to 1.
void draw_scale() {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float wide = scaled_px(220.0F), high = scaled_px(12.0F);
    constexpr int pieces = 44;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    for (int piece = 0; piece < pieces; ++piece) {
        const auto [rgb, alpha] = colour_of_probability((piece + 0.5) / pieces);
        list.AddRectFilled({at.x + wide * static_cast<float>(piece) / pieces, at.y},
                           {at.x + wide * static_cast<float>(piece + 1) / pieces, at.y + high},
                           IM_COL32(rgb[0], rgb[1], rgb[2], 255));
    }
    ImGui::Dummy({wide, high});
    quiet_text("0: hidden   0.5: as likely as not   1: seen");
}

void tell_found(Viewer& viewer) {
    const SeenAround& found = *viewer.looking.found;
    ImGui::Separator();
    ImGui::TextWrapped("%s", found.seen.c_str());
    if (!found.probable.empty()) {
        ImGui::TextWrapped("%s", found.probable.c_str());
        draw_scale();
    }
    quiet_text(("From: " + found.from).c_str());
    quiet_text(("Light: " + found.light).c_str());
    bool is_shown = viewer.looking.is_shown;
    if (ImGui::Checkbox("Over the ground", &is_shown))
        viewer.wishes.push_back([is_shown](Viewer& v) { return show_seen_around(v, is_shown); });
    tip("Bright is what is seen, dark is what is hidden, and between them what is probable. Pictures by P "
        "leave it out: their files hold what "
        "draws them again");
    ImGui::SameLine();
    if (ImGui::Button("Save as GeoTIFF"))
        viewer.wishes.push_back([](Viewer& v) {
            save_seen_around(v);
            return Result<void>();
        });
    tip("The file that orograph viewshed writes: seen or hidden, by how much it is missed, and how probable "
        "that is");
    ImGui::SameLine();
    if (ImGui::Button("Remove")) viewer.wishes.push_back(forget_seen_around);
}

}  // namespace

void build_viewshed_panel(Viewer& viewer) {
    bool& is_open = viewer.panels.viewshed;
    if (!is_open || !viewer.looking.choice) return;
    if (begin_panel("What can be seen", is_open, PanelCorner::upper_right, 380.0F)) {
        choose_looking(viewer);
        choose_probability(viewer);
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
