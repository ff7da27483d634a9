#include <algorithm>
#include <filesystem>

#include "apps/view/model_names.h"
#include "apps/view/style.h"
#include "apps/window/changes.h"
#include "apps/window/panels/panel_parts.h"
#include "apps/window/panels/panels.h"

namespace oro {
namespace {

std::string file_name(const std::string& path) {
    return std::filesystem::path(path).filename().string();
}

void style_choice(Viewer& viewer) {
    static const std::vector<std::string> names = style_names();
    ImGui::SetNextItemWidth(scaled_px(180.0F));
    if (ImGui::BeginCombo("Style", viewer.view.style.c_str(), ImGuiComboFlags_HeightLarge)) {
        for (const std::string& name : names)
            if (ImGui::Selectable(name.c_str(), name == viewer.view.style))
                viewer.wishes.push_back([name](Viewer& v) { return choose_style(v, name); });
        ImGui::EndCombo();
    }
    tip("How the ground becomes colours");
}

void show_choice(Viewer& viewer) {
    const auto words = [](const std::optional<Show>& show) {
        if (!show) return "the ground";
        for (const auto& [name, value] : show_names)
            if (value == *show) return name;
        return "";
    };
    ImGui::SetNextItemWidth(scaled_px(180.0F));
    if (ImGui::BeginCombo("Shows", words(viewer.view.show))) {
        const auto choice = [&](const std::optional<Show>& show) {
            if (ImGui::Selectable(words(show), show == viewer.view.show))
                viewer.wishes.push_back([show](Viewer& v) { return choose_show(v, show); });
        };
        choice(std::nullopt);
        for (const auto& [name, value] : show_names)
            if (value != Show::clusters && value != Show::groups) choice(value);
        ImGui::EndCombo();
    }
    tip("The ground, or how a frame of it is made: levels, meshlets, triangles, how often pixels are drawn");
}

void height_choice(Viewer& viewer) {
    static float factor = 1.0F;
    if (!ImGui::IsAnyItemActive()) factor = static_cast<float>(viewer.view.exaggeration);
    ImGui::SetNextItemWidth(scaled_px(180.0F));
    ImGui::SliderFloat("Heights", &factor, 0.5F, 5.0F, "x %.2f",
                       ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
    tip("How high heights are drawn. 1: as they are. What is read of places stays what it is.");
    if (ImGui::IsItemDeactivatedAfterEdit())
        viewer.wishes.push_back(
            [chosen = static_cast<double>(factor)](Viewer& v) { return choose_exaggeration(v, chosen); });
}

// A switch for each file that is known; what is on stays in its order.
bool file_switches(const std::vector<std::string>& known, std::vector<std::string>& on) {
    bool changed = false;
    for (const std::string& file : known) {
        bool is_on = std::ranges::find(on, file) != on.end();
        ImGui::PushID(file.c_str());
        if (ImGui::Checkbox(file_name(file).c_str(), &is_on)) {
            if (is_on)
                on.push_back(file);
            else
                std::erase(on, file);
            changed = true;
        }
        tip(file.c_str());
        ImGui::PopID();
    }
    return changed;
}

void vector_choice(Viewer& viewer) {
    if (!viewer.vectors_known) viewer.vectors_known = viewer.view.vectors;
    VectorChoices chosen = viewer.view.vectors;
    bool changed = false;
    if (!viewer.vectors_known->names.empty()) {
        heading("Names");
        changed = file_switches(viewer.vectors_known->names, chosen.names) || changed;
    }
    if (!viewer.vectors_known->overlay.empty()) {
        heading("Lines and areas");
        changed = file_switches(viewer.vectors_known->overlay, chosen.overlay) || changed;
    }
    if (!changed) return;
    viewer.wishes.push_back([chosen](Viewer& v) -> Result<void> {
        ORO_TRY([[maybe_unused]] const bool taken, choose_vectors(v, chosen));
        return {};
    });
}

void image_choice(Viewer& viewer) {
    for (const std::string& file : viewer.view.drape)
        if (std::ranges::find(viewer.images_known, file) == viewer.images_known.end())
            viewer.images_known.push_back(file);
    if (viewer.images_known.empty()) return;
    heading("Images over the ground");
    std::vector<std::string> chosen = viewer.view.drape;
    bool changed = file_switches(viewer.images_known, chosen);
    static float opacity = 1.0F;
    if (!ImGui::IsAnyItemActive()) opacity = static_cast<float>(viewer.view.drape_opacity);
    ImGui::SetNextItemWidth(scaled_px(180.0F));
    ImGui::SliderFloat("Opacity", &opacity, 0.0F, 1.0F, "%.2f", ImGuiSliderFlags_AlwaysClamp);
    changed = ImGui::IsItemDeactivatedAfterEdit() || changed;
    if (changed)
        viewer.wishes.push_back([chosen, share = static_cast<double>(opacity)](Viewer& v) {
            return choose_drape(v, chosen, share);
        });
}

}  // namespace

void build_layers_panel(Viewer& viewer) {
    bool& is_open = viewer.panels.layers;
    if (!is_open) return;
    if (begin_panel("Layers", is_open, PanelCorner::upper_left, 300.0F)) {
        style_choice(viewer);
        height_choice(viewer);
        bool shadows = viewer.style.frame.shadows != 0;
        if (ImGui::Checkbox("Shadows", &shadows))
            viewer.wishes.push_back(
                [shadows](Viewer& v) { return choose_light(v, shadows, v.view.sky_openness); });
        tip("Terrain casts shadows");
        ImGui::SameLine();
        bool openness = viewer.style.frame.sky_openness != 0;
        if (ImGui::Checkbox("Open sky", &openness))
            viewer.wishes.push_back(
                [openness](Viewer& v) { return choose_light(v, v.view.shadows, openness); });
        tip("Valleys are darker, as less of the sky lights them");
        vector_choice(viewer);
        image_choice(viewer);
        ImGui::Separator();
        show_choice(viewer);
    }
    ImGui::End();
}

}  // namespace oro
