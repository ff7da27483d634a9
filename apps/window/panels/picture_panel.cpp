#include <algorithm>
#include <array>

#include "apps/window/panels/panel_parts.h"
#include "apps/window/panels/panels.h"
#include "apps/window/pictures.h"

namespace oro {
namespace {

constexpr std::array<const char*, 3> picture_endings{".png", ".jpg", ".tif"};
constexpr int most_side_px = 16384;

void ending_choice(PictureChoice& choice) {
    for (const char* const ending : picture_endings) {
        if (ending != picture_endings.front()) ImGui::SameLine();
        if (ImGui::RadioButton(ending + 1, choice.ending == ending)) choice.ending = ending;
    }
}

void samples_choice(PictureChoice& choice) {
    for (const int samples : {1, 4, 16}) {
        if (samples > 1) ImGui::SameLine();
        const std::string words = std::to_string(samples);
        if (ImGui::RadioButton(words.c_str(), choice.samples == samples)) choice.samples = samples;
    }
    ImGui::SameLine();
    ImGui::TextUnformatted("samples");
    tip("Of a pixel: more are smoother, and take as many times as long");
}

}  // namespace

void build_picture_panel(Viewer& viewer) {
    bool& is_open = viewer.panels.picture;
    const Camera& camera = viewer.view.camera;
    if (!is_open) {
        viewer.picture_choice.reset();
        return;
    }
    if (!viewer.picture_choice)
        viewer.picture_choice = PictureChoice{camera.width_px, camera.height_px, viewer.view.samples, ".png"};
    PictureChoice& choice = *viewer.picture_choice;
    if (begin_panel("Picture", is_open, PanelCorner::middle, 340.0F)) {
        std::array<int, 2> size{choice.width_px, choice.height_px};
        ImGui::SetNextItemWidth(scaled_px(160.0F));
        if (ImGui::InputInt2("pixels", size.data())) {
            choice.width_px = std::clamp(size[0], 1, most_side_px);
            choice.height_px = std::clamp(size[1], 1, most_side_px);
        }
        for (const int factor : {1, 2, 4}) {
            if (factor > 1) ImGui::SameLine();
            const std::string words = factor == 1 ? "as shown" : "x " + std::to_string(factor);
            if (!ImGui::Button(words.c_str())) continue;
            choice.width_px = camera.width_px * factor;
            choice.height_px = camera.height_px * factor;
        }
        ending_choice(choice);
        samples_choice(choice);
        if (ImGui::Button("Write it"))
            viewer.wishes.push_back([choice](Viewer& v) { return take_picture(v, choice); });
        tip("Into the working folder, with its place and all of its view");
        ImGui::SameLine();
        copy_button(viewer, "Copy the command", command_line_of(viewer.view, choice));
        tip("The lines for a shell that draw this very picture, to the byte");
    }
    ImGui::End();
}

}  // namespace oro
