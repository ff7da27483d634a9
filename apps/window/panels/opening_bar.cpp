#include <algorithm>

#include "apps/window/panels/panel_parts.h"
#include "apps/window/panels/panels.h"

namespace oro {

// In the middle above the status bar, while the window goes on.
void build_opening_bar(const RegionOpening& opening) {
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    begin_area("##opening", {0.5F * display.x, display.y - scaled_px(40.0F)}, {0.5F, 1.0F});
    const std::string words = "opening " + opening.name();
    ImGui::TextUnformatted(words.c_str());
    const float width = std::clamp(ImGui::CalcTextSize(words.c_str()).x, scaled_px(240.0F),
                                   std::max(display.x - scaled_px(60.0F), scaled_px(240.0F)));
    ImGui::PushStyleColor(ImGuiCol_PlotHistogram, interface_colour::accent);
    ImGui::ProgressBar(static_cast<float>(opening.share()), {width, scaled_px(4.0F)}, "");
    ImGui::PopStyleColor();
    quiet_text(opening.step().c_str());
    raise_above_panels();
    ImGui::End();
}

}  // namespace oro
