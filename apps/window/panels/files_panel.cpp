#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "apps/window/opening.h"
#include "apps/window/panels/panel_parts.h"
#include "apps/window/panels/panels.h"
#include "apps/window/window_start.h"

namespace oro {
namespace {
namespace fs = std::filesystem;

// What a folder holds, folders first, by name; hidden ones left out.
struct Listing {
    std::string folder;
    std::vector<std::string> folders, files;
    std::string error;
};

Listing listing_of(const std::string& folder) {
    constexpr std::size_t most = 2000;
    Listing listing;
    listing.folder = folder;
    std::error_code failed;
    fs::directory_iterator entry(folder, failed);
    for (; !failed && entry != fs::directory_iterator(); entry.increment(failed)) {
        const std::string name = entry->path().filename().string();
        std::error_code ignored;
        auto& names = entry->is_directory(ignored) ? listing.folders : listing.files;
        if (!name.starts_with('.') && names.size() < most) names.push_back(name);
    }
    if (failed) listing.error = failed.message();
    std::ranges::sort(listing.folders);
    std::ranges::sort(listing.files);
    return listing;
}

// The panel has done what it is for.
void open_now(Viewer& viewer, const std::vector<std::string>& paths) {
    viewer.panels.files = false;
    viewer.wishes.push_back([paths](Viewer& v) { return open_paths(v, paths); });
}

void list_recent(Viewer& viewer) {
    constexpr std::size_t most = 5;
    if (viewer.recent.empty()) return;
    heading("Opened last");
    for (std::size_t i = 0; i < std::min(most, viewer.recent.size()); ++i) {
        const std::vector<std::string> paths = viewer.recent[i];
        ImGui::PushID(static_cast<int>(i));
        if (ImGui::Selectable(name_of_paths(paths).c_str())) open_now(viewer, paths);
        tip(paths.front().c_str());
        ImGui::PopID();
    }
}

void list_folder(Viewer& viewer, const Listing& listing) {
    if (ImGui::Selectable("..")) viewer.folder = fs::path(viewer.folder).parent_path().string();
    for (const std::string& name : listing.folders)
        if (ImGui::Selectable((name + "/").c_str()))
            viewer.folder = (fs::path(viewer.folder) / name).string();
    for (const std::string& name : listing.files)
        if (ImGui::Selectable(name.c_str())) open_now(viewer, {(fs::path(viewer.folder) / name).string()});
}

}  // namespace

void build_files_panel(Viewer& viewer) {
    static Listing listing;
    bool& is_open = viewer.panels.files;
    if (!is_open) {
        listing = {};
        return;
    }
    std::error_code ignored;
    if (viewer.folder.empty()) viewer.folder = fs::current_path(ignored).string();
    // Of the file that was opened last, its folder.
    if (listing.folder.empty() && !fs::is_directory(viewer.folder, ignored) &&
        fs::is_directory(fs::path(viewer.folder).parent_path(), ignored))
        viewer.folder = fs::path(viewer.folder).parent_path().string();
    if (begin_panel("Open", is_open, PanelCorner::middle, 480.0F)) {
        ImGui::SetNextItemWidth(-scaled_px(90.0F));
        if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
        const bool entered = ImGui::InputText("##path", &viewer.folder, ImGuiInputTextFlags_EnterReturnsTrue);
        const bool is_folder = fs::is_directory(viewer.folder, ignored);
        ImGui::SameLine();
        if (ImGui::Button(is_folder ? "Open all" : "Open") || (entered && !is_folder))
            open_now(viewer, {viewer.folder});
        tip(is_folder ? "All elevation of this folder, as one region" : "This file");
        quiet_text(
            "Elevation takes the place of what is shown. Images, tracks and places (GPX, KML, GeoJSON, CSV, "
            "shapefiles) lie over it. A picture of this program moves the eye to where it was taken. Files "
            "may be dropped, too.");
        if (is_folder && listing.folder != viewer.folder) listing = listing_of(viewer.folder);
        ImGui::BeginChild("##list", {0.0F, scaled_px(210.0F)}, true);
        if (!listing.error.empty()) quiet_text(listing.error.c_str());
        list_folder(viewer, listing);
        ImGui::EndChild();
        list_recent(viewer);
        if (ImGui::Button("Save as a project")) viewer.panels.open(&Panels::project);
        tip("This view, its layers and its film, to be opened again (Ctrl-S)");
    }
    ImGui::End();
}

}  // namespace oro
