#include "apps/window/panels/panel_parts.h"
#include "apps/window/panels/panels.h"

namespace oro {
namespace {

struct KeyWords {
    const char* keys;  // "": a heading
    const char* what;
};
constexpr KeyWords key_words[] = {{"", "Moving"},
                                  {"Left drag", "takes hold of the ground"},
                                  {"Wheel", "nearer to what is under the pointer, and farther"},
                                  {"+, -", "nearer to the picture's middle, and farther"},
                                  {"Right drag", "goes round the place that was held, and tilts"},
                                  {"Two clicks", "flies to a place"},
                                  {"W A S D, arrows", "forward, left, back, right; with Shift faster"},
                                  {"E, Q", "up, down (also Space, Page Up, Page Down)"},
                                  {"R F, Ctrl-arrows", "look up, down, left, right"},
                                  {"K", "walks over the ground; once more: flies"},
                                  {"N, compass", "north up"},
                                  {"Home", "all of the region"},
                                  {"U, Backspace", "the view from before; Shift-U: again"},
                                  {"", "Places"},
                                  {"G, Ctrl-L, /", "go to a place: 46.57,7.99  N46E008  32TMS2258"},
                                  {"Enter", "stands on it; once more: on the summit near"},
                                  {"Right click", "tells all about a place"},
                                  {"", "Pictures and panels"},
                                  {"P, Shift-P", "writes a picture into the working folder; asks what kind"},
                                  {"Ctrl-O, drop", "opens elevation, tracks (GPX, KML, GeoJSON), pictures"},
                                  {"Ctrl-S", "saves all this as a project"},
                                  {"?, H, F1", "these keys"},
                                  {"Tab", "hides and shows all that lies over the picture"},
                                  {"F11, 2", "full screen; two views, and with a line, and one"},
                                  {"Ctrl and +, -, 0", "larger, smaller and usual letters"},
                                  {"Esc", "closes what is open; it never quits"},
                                  {"Ctrl-Q", "quits"}};

}  // namespace

void build_keys_panel(Viewer& viewer) {
    bool& is_open = viewer.panels.keys;
    if (!is_open) return;
    if (begin_panel("Keys", is_open, PanelCorner::middle, 540.0F)) {
        ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {scaled_px(8.0F), scaled_px(1.0F)});
        for (const KeyWords& words : key_words) {
            if (*words.keys == '\0') {
                heading(words.what);
                continue;
            }
            ImGui::TextUnformatted(words.keys);
            ImGui::SameLine(scaled_px(140.0F));
            ImGui::PushStyleColor(ImGuiCol_Text, interface_colour::quiet);
            ImGui::TextWrapped("%s", words.what);
            ImGui::PopStyleColor();
        }
        ImGui::PopStyleVar();
    }
    ImGui::End();
}

}  // namespace oro
