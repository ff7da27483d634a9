#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cstdio>
#include <utility>

#include "apps/window/panels/panel_parts.h"
#include "apps/window/panels/panels.h"
#include "apps/window/panels/top_row.h"
#include "apps/window/search.h"

namespace oro {
namespace {

// The arrows choose among the matches.
int on_arrow(ImGuiInputTextCallbackData* data) {
    SearchField& field = *static_cast<SearchField*>(data->UserData);
    const std::size_t count = field.matches.size();
    if (count == 0) return 0;
    if (data->EventKey == ImGuiKey_DownArrow)
        field.chosen = field.chosen ? std::min(*field.chosen + 1, count - 1) : 0;
    else if (field.chosen && *field.chosen > 0)
        --*field.chosen;
    else
        field.chosen.reset();
    return 0;
}

// Names that hold what is typed, the best first; a click goes there.
void list_matches(Viewer& viewer, float width) {
    SearchField& field = viewer.search;
    std::optional<SearchTarget> clicked;
    for (std::size_t i = 0; i < field.matches.size(); ++i) {
        const SearchPlace& place = field.matches[i].place;
        ImGui::PushID(static_cast<int>(i));
        const ImVec2 at = ImGui::GetCursorPos();
        if (ImGui::Selectable(place.name.c_str(), field.chosen == i, 0, {width, 0.0F}))
            clicked = target_of(field.matches[i]);
        if (place.H_m) {
            char height[30];
            std::snprintf(height, sizeof height, "%.0f m", *place.H_m);
            ImGui::SameLine(at.x + width - ImGui::CalcTextSize(height).x);
            ImGui::TextDisabled("%s", height);
        }
        ImGui::PopID();
    }
    if (clicked) go_to(viewer, *clicked);
}

// What the user has kept, each with a button that removes it, and a field to keep the view that is shown.
void list_bookmarks(Viewer& viewer, float width) {
    constexpr std::size_t most = 12;
    const float button = ImGui::GetFrameHeight();
    std::optional<Bookmark> chosen;
    std::string dropped;
    for (std::size_t i = 0; i < std::min(most, viewer.bookmarks.size()); ++i) {
        const Bookmark& bookmark = viewer.bookmarks[viewer.bookmarks.size() - 1 - i];
        ImGui::PushID(static_cast<int>(i));
        if (ImGui::Selectable(bookmark.name.c_str(), false, 0, {width - button, 0.0F})) chosen = bookmark;
        tip(bookmark.eye ? "A view that you have kept" : "A place that you have kept");
        ImGui::SameLine(width - 0.5F * button);
        if (ImGui::SmallButton("x")) dropped = bookmark.name;
        tip("Removes it from what you have kept");
        ImGui::PopID();
    }
    ImGui::SetNextItemWidth(width - scaled_px(64.0F));
    const bool entered = ImGui::InputTextWithHint("##keep", "Name of this view", &viewer.bookmark_name,
                                                  ImGuiInputTextFlags_EnterReturnsTrue);
    ImGui::SameLine();
    if (ImGui::Button("Keep") || entered) keep_bookmark(viewer);
    tip("Keeps the view that is shown by this name: the field above then finds it");
    if (!dropped.empty()) drop_bookmark(viewer, dropped);
    if (chosen) go_to_bookmark(viewer, *chosen);
}

}  // namespace

void build_search_field(Viewer& viewer) {
    SearchField& field = viewer.search;
    const float gap = scaled_px(10.0F);
    const float width = scaled_px(top_row(ImGui::GetIO().DisplaySize.x / scaled_px(1.0F)).field_width);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {scaled_px(6.0F), scaled_px(6.0F)});
    begin_area("##search", {gap, gap}, {0.0F, 0.0F});
    ImGui::PopStyleVar();
    ImGui::SetNextItemWidth(width);
    if (std::exchange(field.takes_focus, false)) ImGui::SetKeyboardFocusHere();
    const bool entered =
        ImGui::InputTextWithHint("##place", "Go to a place   (G)", &field.text,
                                 ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_CallbackHistory |
                                     ImGuiInputTextFlags_AutoSelectAll,
                                 on_arrow, &field);
    if (ImGui::IsItemActivated()) field.is_open = true;
    if (ImGui::IsItemEdited()) {
        field.error.clear();
        find_matches(viewer);
    }
    // Whoever clicks elsewhere has done with it; what was typed stays.
    const bool left = ImGui::IsItemDeactivated() && !entered;
    if (!field.is_open)
        tip("A name, latitude and longitude, UTM, MGRS, a geohash, eastings and northings, or a tile like "
            "N46E008. Enter goes there.");
    if (entered) search(viewer);
    if (field.is_open && !field.text.empty() && field.error.empty()) list_matches(viewer, width);
    if (field.is_open && field.text.empty()) list_bookmarks(viewer, width);
    if (field.is_open && viewer.gazetteers) quiet_text("Names of places are being read ...");
    const bool escaped = ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false);
    if (left && (escaped || !ImGui::IsWindowHovered())) field.is_open = false;
    if (!field.error.empty()) {
        ImGui::PushStyleColor(ImGuiCol_Text, interface_colour::error);
        ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + width);
        ImGui::TextUnformatted(field.error.c_str());
        ImGui::PopTextWrapPos();
        ImGui::PopStyleColor();
    }
    ImGui::End();
}

}  // namespace oro
