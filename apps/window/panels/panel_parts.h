// What panels are made of.
#pragma once

#include <imgui.h>

#include <string>

#include "apps/window/interface.h"
#include "apps/window/viewer.h"

namespace oro {

// Where a panel is first shown.
enum class PanelCorner { upper_left, upper_right, middle };

// Begins a panel that its user may move and close; ImGui::End() ends it, whatever this returns. Not wider or
// higher than the window.
bool begin_panel(const char* title, bool& is_open, PanelCorner corner, float width_px);
// Begins an area without a frame at a place of the window, by the corner of itself that `pivot` names.
bool begin_area(const char* name, ImVec2 at_px, ImVec2 pivot, bool with_paper = true);

// A line of two columns, whose value is copied by a click; tip: what the value means, "" for none. Both
// columns say it.
void value_line(const char* name, const std::string& value, const char* tip = "");
// Lets what was built last have a tooltip, but not while something is typed or held.
void tip(const char* text);
// The same below it, where its neighbours are beside it.
void tip_below(const char* text);
// A button that copies a text, and says so.
void copy_button(Viewer& viewer, const char* words, const std::string& text);
// The area that is being built is above all panels.
void raise_above_panels();
// A line over a group of what belongs together.
void heading(const char* text);
// Text on several lines, in the quiet colour.
void quiet_text(const char* text);

}  // namespace oro
