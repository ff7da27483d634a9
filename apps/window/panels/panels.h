// What lies over a window's picture: panels, and what is always there.
#pragma once

#include "apps/window/viewer.h"

namespace oro {

// Builds all that lies over the picture now, between ImGui::NewFrame() and ImGui::Render(). What its user
// asks for there and takes longer, or may fail, goes to viewer.wishes.
void build_panels(Viewer& viewer);

// One file for each.
void build_status_bar(Viewer& viewer);         // place, height, scale, certificate, along the lower border
void build_search_field(Viewer& viewer);       // in the upper left corner
void build_buttons(Viewer& viewer);            // of panels, beside it
void build_compass(Viewer& viewer);            // in the upper right corner: a click turns north up
void build_home_arrow(Viewer& viewer);         // to a region that is out of the picture
void build_moving_lines(Viewer& viewer);       // over the ground, while the eye moves
void build_place_marks(const Viewer& viewer);  // where the last jump went, and what was clicked at
void build_legend(Viewer& viewer);             // what the colours of --show stand for
void build_toasts(Viewer& viewer);             // what was said just now
bool has_toasts(const Viewer& viewer);
void build_opening_bar(const RegionOpening& opening);  // how far a region is read
void build_command_bar(Viewer& viewer);                // ... and how far a film or a map is drawn
void build_messages_panel(Viewer& viewer);
void build_keys_panel(Viewer& viewer);
void build_layers_panel(Viewer& viewer);      // style, heights, names, lines, images, how frames are made
void build_sun_panel(Viewer& viewer);         // by date and time
void build_statistics_panel(Viewer& viewer);  // of the last frame
void build_place_panel(Viewer& viewer);       // all about what was clicked at
void build_viewshed_panel(Viewer& viewer);    // what is seen from there
void build_panorama_panel(Viewer& viewer);    // all around from there
void build_film_panel(Viewer& viewer);        // keys of a camera's path, and lines to follow
void build_measure_panel(Viewer& viewer);     // and the line over the picture
void build_files_panel(Viewer& viewer);       // to open some
void build_project_panel(Viewer& viewer);     // where all this is saved to
void build_two_views(Viewer& viewer);         // the line between them, what differs, a tint's legend
void build_two_views_panel(Viewer& viewer);   // what the second view has otherwise
void build_picture_panel(Viewer& viewer);     // a picture of another size, and the command that draws it

}  // namespace oro
