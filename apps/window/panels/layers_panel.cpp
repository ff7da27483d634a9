#include <algorithm>
#include <filesystem>

#include "apps/view/model_names.h"
#include "apps/view/style.h"
#include "apps/window/changes.h"
#include "apps/window/layer_order.h"
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
            if (!is_of_clusters(value) || viewer.region.meshes) choice(value);
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

// One place up, one down: of a file that is on.
bool order_buttons(std::vector<std::string>& on, const std::string& file) {
    bool changed = false;
    for (const bool up : {true, false}) {
        ImGui::SameLine(up ? scaled_px(232.0F) : scaled_px(256.0F));
        if (ImGui::ArrowButton(up ? "##up" : "##down", up ? ImGuiDir_Up : ImGuiDir_Down))
            changed = move_layer(on, file, up) || changed;
        tip(up ? "Over the one above it" : "Below the one under it");
    }
    return changed;
}

// A switch for each file that is known, the topmost first.
bool file_switches(const std::vector<std::string>& known, std::vector<std::string>& on, bool has_order) {
    bool changed = false;
    for (const std::string& file : layers_from_the_top(known, on)) {
        bool is_on = std::ranges::find(on, file) != on.end();
        const bool moves = has_order && is_on && on.size() > 1;
        ImGui::PushID(file.c_str());
        const std::string name = file_name(file);
        if (ImGui::Checkbox("##on", &is_on)) {
            if (is_on)
                on.push_back(file);
            else
                std::erase(on, file);
            changed = true;
        }
        tip(file.c_str());
        ImGui::SameLine();
        const float room = scaled_px(moves ? 190.0F : 250.0F);
        std::string shown = name;
        const auto is_in_letter = [&] { return (static_cast<unsigned char>(shown.back()) & 0xC0U) == 0x80U; };
        while (shown.size() > 4 && ImGui::CalcTextSize(shown.c_str()).x > room) {
            while (is_in_letter()) shown.pop_back();
            shown.pop_back();
        }
        ImGui::TextUnformatted((shown == name ? name : shown + "…").c_str());
        tip(file.c_str());
        if (moves) changed = order_buttons(on, file) || changed;
        ImGui::PopID();
    }
    return changed;
}

// A slider of a share; true once it is let go with another value.
bool share_slider(const char* name, float& kept, double shown, const char* words) {
    if (!ImGui::IsAnyItemActive()) kept = static_cast<float>(shown);
    ImGui::SetNextItemWidth(scaled_px(180.0F));
    ImGui::SliderFloat(name, &kept, 0.0F, 1.0F, "%.2f", ImGuiSliderFlags_AlwaysClamp);
    const bool changed = ImGui::IsItemDeactivatedAfterEdit();
    tip(words);
    return changed;
}

void graticule_choice(Viewer& viewer) {
    const auto words = [](const std::optional<Graticule>& graticule) {
        if (!graticule) return "none";
        return graticule == Graticule::geographic ? "latitude, longitude" : "easting, northing";
    };
    ImGui::SetNextItemWidth(scaled_px(180.0F));
    const bool is_open = ImGui::BeginCombo("Graticule", words(viewer.view.graticule));
    tip("Lines over the ground, with their values at the picture's border, while the eye rests");
    if (!is_open) return;
    const auto choice = [&](const std::optional<Graticule>& graticule) {
        if (ImGui::Selectable(words(graticule), graticule == viewer.view.graticule))
            viewer.wishes.push_back([graticule](Viewer& v) { return choose_graticule(v, graticule); });
    };
    choice(std::nullopt);
    choice(Graticule::geographic);
    const auto& crs = viewer.index.crs();
    if (viewer.view.graticule == Graticule::projected || (crs && crs->is_projected()))
        choice(Graticule::projected);
    ImGui::EndCombo();
}

void vector_choice(Viewer& viewer) {
    if (!viewer.vectors_known) viewer.vectors_known = viewer.view.vectors;
    VectorChoices chosen = viewer.view.vectors;
    bool changed = false;
    if (!viewer.vectors_known->names.empty()) {
        heading("Names");
        changed = file_switches(viewer.vectors_known->names, chosen.names, false) || changed;
    }
    if (!viewer.vectors_known->overlay.empty()) {
        heading("Lines and areas");
        changed = file_switches(viewer.vectors_known->overlay, chosen.overlay, true) || changed;
        static float fill = 0.2F;
        if (share_slider("Areas", fill, viewer.view.vectors.overlay_fill,
                         "How much of the ground the areas of polygons hide")) {
            chosen.overlay_fill = static_cast<double>(fill);
            changed = true;
        }
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
    bool changed = file_switches(viewer.images_known, chosen, true);
    static float opacity = 1.0F;
    changed = share_slider("Opacity", opacity, viewer.view.drape_opacity,
                           "How much images hide of the style's colours") ||
              changed;
    if (changed)
        viewer.wishes.push_back([chosen, share = static_cast<double>(opacity)](Viewer& v) {
            return choose_drape(v, chosen, share);
        });
}

void cover_choice(Viewer& viewer) {
    const std::vector<std::string>& shown = viewer.view.cover_choice.files;
    for (const std::string& file : shown)
        if (std::ranges::find(viewer.cover_known, file) == viewer.cover_known.end())
            viewer.cover_known.push_back(file);
    if (viewer.cover_known.empty()) return;
    heading("Land cover");
    tip("Colours the ground in styles that go by cover: natural");
    std::vector<std::string> chosen = shown;
    if (file_switches(viewer.cover_known, chosen, true))
        viewer.wishes.push_back([chosen](Viewer& v) { return choose_cover(v, chosen); });
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
        graticule_choice(viewer);
        vector_choice(viewer);
        image_choice(viewer);
        cover_choice(viewer);
        ImGui::Separator();
        show_choice(viewer);
        bool imperial = viewer.settings.units == UnitSystem::imperial;
        if (ImGui::Checkbox("Feet and miles", &imperial))
            viewer.settings.units = imperial ? UnitSystem::imperial : UnitSystem::metric;
        tip("In the lower border. The panels of places and measures, and what is copied, stay metric.");
        if (ImGui::Button("Two views")) viewer.panels.open(&Panels::two_views);
        tip("Beside this one: with another tau, Earth, light, style, sun or source (2)");
    }
    ImGui::End();
}

}  // namespace oro
