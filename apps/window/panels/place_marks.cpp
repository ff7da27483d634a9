#include "apps/navigation/grab.h"
#include "apps/window/panels/panel_parts.h"
#include "apps/window/panels/panels.h"
#include "core/earth/ellipsoid.h"

namespace oro {
namespace {

// A pin that stands on a place, whatever ground lies before it.
void draw_pin(const Viewer& viewer, const Ecef& place, ImU32 colour) {
    const Camera& camera = viewer.view.camera;
    const auto at = pixel_of(camera, place, viewer.view.model.air);
    if (!at || at->x < 0.0 || at->y < 0.0 || at->x > camera.width_px || at->y > camera.height_px) return;
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const ImVec2 foot(static_cast<float>(at->x), static_cast<float>(at->y));
    const ImVec2 head(foot.x, foot.y - scaled_px(18.0F));
    list.AddLine(foot, head, interface_colour::shadow, scaled_px(4.0F));
    list.AddLine(foot, head, colour, scaled_px(2.0F));
    list.AddCircleFilled(head, scaled_px(6.0F), interface_colour::shadow);
    list.AddCircleFilled(head, scaled_px(4.5F), colour);
}

}  // namespace

void build_place_marks(const Viewer& viewer) {
    // Of two views side by side in the first.
    ImGui::GetBackgroundDrawList()->PushClipRect(
        {0.0F, 0.0F},
        {static_cast<float>(viewer.view.camera.width_px), static_cast<float>(viewer.view.camera.height_px)});
    if (viewer.jumped_to) draw_pin(viewer, *viewer.jumped_to, interface_colour::accent);
    if (viewer.panels.place && viewer.picked && viewer.picked->seen) {
        const SeenPlace& seen = *viewer.picked->seen;
        const double h_m = seen.h_m - seen.H_m + viewer.view.exaggeration * seen.H_m;
        draw_pin(viewer, ecef_from_geodetic({seen.lat_deg, seen.lon_deg, h_m}), interface_colour::ink);
    }
    ImGui::GetBackgroundDrawList()->PopClipRect();
}

}  // namespace oro
