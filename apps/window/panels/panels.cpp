#include "apps/window/panels/panels.h"

namespace oro {

namespace {

void build_panels_of_start(Viewer& viewer) {
    build_search_field(viewer);
    build_status_bar(viewer);
    build_buttons(viewer);
    build_toasts(viewer);
    if (viewer.opening) build_opening_bar(*viewer.opening);
    build_messages_panel(viewer);
    build_files_panel(viewer);
    build_keys_panel(viewer);
}

}  // namespace

void build_panels(Viewer& viewer) {
    // Until there is ground a sheet says that it comes: what can be asked for before is there at once.
    if (!viewer.has_picture && !viewer.is_shown) return build_panels_of_start(viewer);
    build_moving_lines(viewer);
    if (viewer.panels.hidden && !viewer.search.is_open) return build_toasts(viewer);
    build_search_field(viewer);
    if (viewer.panels.hidden) return;
    build_place_marks(viewer);
    build_two_views(viewer);
    build_panorama_panel(viewer);
    build_status_bar(viewer);
    build_buttons(viewer);
    build_compass(viewer);
    build_home_arrow(viewer);
    build_legend(viewer);
    build_toasts(viewer);
    if (viewer.opening)
        build_opening_bar(*viewer.opening);
    else
        build_command_bar(viewer);
    build_messages_panel(viewer);
    build_layers_panel(viewer);
    build_sun_panel(viewer);
    build_statistics_panel(viewer);
    build_place_panel(viewer);
    build_viewshed_panel(viewer);
    build_film_panel(viewer);
    build_measure_panel(viewer);
    build_two_views_panel(viewer);
    build_files_panel(viewer);
    build_project_panel(viewer);
    build_picture_panel(viewer);
    build_keys_panel(viewer);
}

}  // namespace oro
