#include "apps/legend/key_names.h"
#include "apps/window/panels/panel_parts.h"
#include "apps/window/panels/panels.h"

namespace oro {
namespace {

ImU32 colour_of(const StripColour& colour) {
    return IM_COL32(colour[0], colour[1], colour[2], 255);
}

}  // namespace

// On the paper of the legends of pictures: its colours mean what they are only beside the same paper.
void build_legend(Viewer& viewer) {
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
