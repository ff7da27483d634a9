#include <algorithm>

#include "apps/window/begun_command.h"
#include "apps/window/panels/panel_parts.h"
#include "apps/window/panels/panels.h"

namespace oro {

// In the middle above the status bar, while a film or a map is drawn.
void build_command_bar(Viewer& viewer) {
    const BegunCommand& begun = viewer.begun;
    if (!begun.work) return;
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    begin_area("##command", {0.5F * display.x, display.y - scaled_px(40.0F)}, {0.5F, 1.0F});
    ImGui::TextUnformatted(command_progress(viewer).c_str());
    ImGui::SameLine();
    if (ImGui::SmallButton("Stop")) stop_command(viewer);
    tip("What is drawn already is kept: the same command goes on from there");
    const float width = std::max(ImGui::CalcTextSize(begun.out.c_str()).x, scaled_px(240.0F));
    ImGui::PushStyleColor(ImGuiCol_PlotHistogram, interface_colour::accent);
    if (begun.has_share)
        ImGui::ProgressBar(static_cast<float>(begun.work->share()), {width, scaled_px(4.0F)}, "");
    ImGui::PopStyleColor();
    ImGui::TextDisabled("%s", begun.out.c_str());
    ImGui::End();
}

}  // namespace oro
