#include <algorithm>

#include "apps/window/panels/panel_parts.h"
#include "apps/window/panels/panels.h"

namespace oro {
namespace {

constexpr double toast_s = 6.0, error_toast_s = 15.0;

bool is_fresh(const Message& message) {
    return message.is_toast && seconds_since(message.since) < (message.is_error ? error_toast_s : toast_s);
}

}  // namespace

bool has_toasts(const Viewer& viewer) {
    return std::ranges::any_of(viewer.log, is_fresh);
}

void build_toasts(Viewer& viewer) {
    constexpr int most = 3;
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    float bottom = display.y - scaled_px(40.0F);
    int shown = 0;
    for (auto message = viewer.log.rbegin(); message != viewer.log.rend() && shown < most; ++message) {
        if (!is_fresh(*message)) continue;
        const std::string name = "##toast" + std::to_string(shown++);
        const float width = std::min(scaled_px(520.0F), display.x - scaled_px(50.0F));
        begin_area(name.c_str(), {scaled_px(10.0F), bottom}, {0.0F, 1.0F});
        ImGui::PushStyleColor(ImGuiCol_Text,
                              message->is_error ? interface_colour::error : interface_colour::ink);
        ImGui::PushTextWrapPos(
            std::min(width, ImGui::CalcTextSize(message->text.c_str()).x + scaled_px(14.0F)));
        ImGui::TextUnformatted(message->text.c_str());
        ImGui::PopTextWrapPos();
        ImGui::PopStyleColor();
        if (ImGui::IsWindowHovered() && ImGui::IsMouseClicked(ImGuiMouseButton_Left))
            message->is_toast = false;
        raise_above_panels();
        bottom -= ImGui::GetWindowHeight() + scaled_px(6.0F);
        ImGui::End();
    }
}

void build_messages_panel(Viewer& viewer) {
    bool& is_open = viewer.panels.messages;
    if (!is_open) return;
    if (begin_panel("Log", is_open, PanelCorner::upper_left, 520.0F)) {
        if (viewer.log.empty()) quiet_text("Nothing was said yet.");
        for (const Message& message : viewer.log) {
            ImGui::PushStyleColor(ImGuiCol_Text,
                                  message.is_error ? interface_colour::error : interface_colour::ink);
            ImGui::TextWrapped("%s", message.text.c_str());
            ImGui::PopStyleColor();
        }
        if (!viewer.log.empty() && ImGui::Button("Copy all")) {
            std::string all;
            for (const Message& message : viewer.log) all += message.text + "\n";
            ImGui::SetClipboardText(all.c_str());
        }
        // Whoever has not gone back to older lines sees the newest.
        if (ImGui::IsWindowAppearing() || ImGui::GetScrollY() >= ImGui::GetScrollMaxY())
            ImGui::SetScrollHereY(1.0F);
    }
    ImGui::End();
}

}  // namespace oro
