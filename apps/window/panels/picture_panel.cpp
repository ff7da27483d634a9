#include <imgui_stdlib.h>

#include <algorithm>
#include <array>

#include "apps/window/maps.h"
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

// The files beside it that tell other programs where it was taken from.
void poses_choice(PoseChoice& poses) {
    ImGui::Checkbox("KML", &poses.kml);
    tip("Beside the picture, for Google Earth: the picture where it was taken");
    ImGui::SameLine();
    ImGui::Checkbox("GeoPose", &poses.geopose);
    tip("Beside the picture: the eye's place and its direction, as the Open Geospatial Consortium has them");
    ImGui::SameLine();
    ImGui::Checkbox("STAC", &poses.stac);
    tip("Beside the picture: an entry for a catalogue of pictures (SpatioTemporal Asset Catalog)");
}

// A map of what is seen, drawn beside the window.
void map_choice(Viewer& viewer) {
    heading("A map of it");
    if (!viewer.map_choice) {
        // What is seen is looked for once, and again at a press of the button.
        viewer.map_choice = MapChoice{};
        viewer.wishes.push_back(propose_map);
    }
    MapChoice& choice = *viewer.map_choice;
    ImGui::SetNextItemWidth(scaled_px(230.0F));
    ImGui::InputText("##box", &choice.box);
    tip("West, south, east, north, in degrees: the ground that is seen, without what is very far");
    ImGui::SameLine();
    if (ImGui::Button("What is seen")) viewer.wishes.push_back(propose_map);
    tip("Finds the box of the ground that is in the picture now");
    ImGui::SetNextItemWidth(scaled_px(70.0F));
    if (ImGui::InputDouble("m a pixel", &choice.resolution_m, 0.0, 0.0, "%.4g"))
        choice.resolution_m = std::clamp(choice.resolution_m, 0.0, 1.0e5);
    tip("0 takes about the distance of the data's posts");
    ImGui::SameLine();
    ImGui::Checkbox("contour lines", &choice.contours);
    tip("In place of the colours of this picture");
    for (const char* const ending : {".tif", ".png"}) {
        if (ImGui::RadioButton(ending == std::string(".tif") ? "GeoTIFF" : "png", choice.ending == ending))
            choice.ending = ending;
        ImGui::SameLine();
    }
    ImGui::BeginDisabled(viewer.begun.work != nullptr || choice.box.empty());
    if (ImGui::Button("Draw the map"))
        viewer.wishes.push_back([choice](Viewer& v) {
            draw_map(v, choice);
            return Result<void>();
        });
    ImGui::EndDisabled();
    tip("From straight above, into the working folder, with its place for every GIS. The window goes on "
        "meanwhile");
}

}  // namespace

void build_picture_panel(Viewer& viewer) {
    bool& is_open = viewer.panels.picture;
    const Camera& camera = viewer.view.camera;
    if (!is_open) {
        viewer.picture_choice.reset();
        viewer.map_choice.reset();
        return;
    }
    if (!viewer.picture_choice)
        viewer.picture_choice = PictureChoice{camera.width_px, camera.height_px, viewer.view.samples, ".png",
                                              poses_asked(viewer.options)};
    PictureChoice& choice = *viewer.picture_choice;
    if (begin_panel("Picture", is_open, PanelCorner::middle, 380.0F)) {
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
        poses_choice(choice.poses);
        if (ImGui::Button("Write it"))
            viewer.wishes.push_back([choice](Viewer& v) { return take_picture(v, choice); });
        tip("Into the working folder, with its place and all of its view");
        ImGui::SameLine();
        copy_button(viewer, "Copy the command", command_line_of(viewer.view, choice));
        tip("The lines for a shell that draw this very picture, to the byte");
        map_choice(viewer);
    }
    ImGui::End();
}

}  // namespace oro
