#include "apps/legend/key_names.h"
#include "apps/window/panels/panel_parts.h"
#include "apps/window/panels/panels.h"

namespace oro {
namespace {

ImU32 colour_of(const StripColour& colour) {
    return IM_COL32(colour[0], colour[1], colour[2], 255);
}

// What lies over the ground by probability, where it does and the panel with its scale is closed.
void build_probability_legend(const Viewer& viewer) {
    const auto& found = viewer.looking.found;
    const bool is_shown = found && !found->probable.empty() && viewer.looking.is_shown &&
                          !viewer.leaves_tints_out && !(viewer.comparing.found && viewer.comparing.is_shown);
    if (!is_shown || viewer.view.show || viewer.panels.viewshed) return;
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    begin_area("##probability", {display.x - scaled_px(10.0F), display.y - scaled_px(40.0F)}, {1.0F, 1.0F});
    ImGui::TextUnformatted("Probability of being seen");
    const float side = scaled_px(13.0F);
    for (const double share : {1.0, 0.75, 0.5, 0.25, 0.0}) {
        const ImVec2 at = ImGui::GetCursorScreenPos();
        const auto [rgb, alpha] = colour_of_probability(share);
        ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + side, at.y + side},
                                                  IM_COL32(rgb[0], rgb[1], rgb[2], 255));
        ImGui::Dummy({side, side});
        ImGui::SameLine();
        ImGui::Text("%g", share);
    }
    ImGui::End();
}

}  // namespace

// On the paper of the legends of pictures: its colours mean what they are only beside the same paper.
void build_legend(Viewer& viewer) {
    build_probability_legend(viewer);
    if (!viewer.view.show || viewer.legend.names.empty()) return;
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    ImGui::PushStyleColor(ImGuiCol_WindowBg, colour_of(legend_paper));
    begin_area("##legend", {display.x - scaled_px(10.0F), display.y - scaled_px(40.0F)}, {1.0F, 1.0F});
    ImGui::PushStyleColor(ImGuiCol_Text, colour_of(legend_ink));
    ImGui::TextUnformatted(viewer.legend.title.c_str());
    const float side = scaled_px(13.0F);
    for (const ColourKey::Named& named : viewer.legend.names) {
        const ImVec2 at = ImGui::GetCursorScreenPos();
        ImDrawList& list = *ImGui::GetWindowDrawList();
        list.AddRectFilled(at, {at.x + side, at.y + side}, colour_of(named.colour));
        ImGui::Dummy({side, side});
        ImGui::SameLine();
        ImGui::TextUnformatted(named.name.c_str());
    }
    ImGui::PopStyleColor(2);
    ImGui::End();
}

}  // namespace oro
