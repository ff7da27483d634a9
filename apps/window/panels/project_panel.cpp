#include <imgui.h>
#include <imgui_stdlib.h>

#include "apps/window/panels/panel_parts.h"
#include "apps/window/panels/panels.h"
#include "apps/window/projects.h"

namespace oro {

void build_project_panel(Viewer& viewer) {
    bool& is_open = viewer.panels.project;
    if (!is_open) return;
    if (begin_panel("Save as a project", is_open, PanelCorner::middle, 400.0F)) {
        ImGui::SetNextItemWidth(-scaled_px(70.0F));
        if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
        const bool entered =
            ImGui::InputText("##project", &viewer.project_file, ImGuiInputTextFlags_EnterReturnsTrue);
        ImGui::SameLine();
        if (ImGui::Button("Save") || entered)
            viewer.wishes.push_back([](Viewer& v) {
                save_project(v);
                return Result<void>();
            });
        quiet_text(
            "One file with this view, its style and light, what is loaded and shown, the film, the measured "
            "line, and the bookmarks in the region. Elevation, images and tracks stay where they are: the "
            "file tells the way to them from its own folder. Open it like any other file.");
    }
    ImGui::End();
}

}  // namespace oro
