#include "apps/window/panoramas.h"

#include <algorithm>
#include <utility>

#include "apps/report/json_text.h"
#include "apps/window/viewer.h"
#include "apps/window/window_start.h"

namespace oro {

void draw_panorama_around(Viewer& viewer) {
    PanoramaAround& around = viewer.panorama;
    if (!around.choice) return;
    Result<View> view = panorama_view(viewer.view, *around.choice, viewer.region);
    if (!view.ok()) return tell(viewer, view.error());
    AskedFrame asked;
    asked.width_px = around.choice->width_px;
    around.work = std::make_unique<BackgroundWork<DrawnPanorama>>(
        [view = std::move(*view), asked, memory = viewer.options.memory,
         &region = std::as_const(viewer.region),
         &cuts = std::as_const(viewer.cuts)](const auto& tell_share, const std::stop_token& stop) {
            // Measuring levels takes about as long as drawing.
            const auto progress = [&](double share, const std::string& what) {
                tell_share(what == "drawing" ? 0.5 + 0.5 * share : 0.5 * share);
            };
            return drawn_panorama(view, asked, region, cuts, {memory, true, stop}, progress);
        });
}

void stop_panorama(Viewer& viewer) {
    if (viewer.panorama.work) viewer.panorama.work->stop();
}

void take_panorama(Viewer& viewer) {
    PanoramaAround& around = viewer.panorama;
    auto drawn = take_finished(around.work);
    if (!drawn) return;
    if (!drawn->ok()) return tell(viewer, drawn->error());
    around.drawn = std::move(**drawn);
    around.is_shown = true;
    around.picture = nullptr;
    around.zoom = 1.0;
    around.middle_x = around.middle_y = 0.5;
    tell(viewer, around.drawn->leaves_out_near
                     ? "ground beside the eye stands higher than is shown: raise the eye to look over it"
                     : "the panorama is drawn");
}

void save_panorama(Viewer& viewer, const std::string& ending) {
    if (!viewer.panorama.drawn) return;
    const std::string file = free_picture_name(time_now_s(), "-panorama" + ending);
    const Result<void> written = write_drawn_panorama(file, *viewer.panorama.drawn, viewer.region);
    tell_written(viewer, file, written);
}

bool shows_panorama(const Viewer& viewer) {
    return viewer.panels.panorama && !viewer.panels.hidden && viewer.panorama.drawn &&
           viewer.panorama.is_shown;
}

double panorama_scale(const Viewer& viewer) {
    if (!viewer.panorama.drawn) return 1.0;
    const double fits = static_cast<double>(viewer.window.extent().height) /
                        std::max(1, viewer.panorama.drawn->laid.sheet.height_px);
    return std::min(1.0, fits) * viewer.panorama.zoom;
}

Result<std::optional<WindowPicture>> panorama_to_show(Viewer& viewer) {
    using Shown = std::optional<WindowPicture>;
    PanoramaAround& around = viewer.panorama;
    const VkExtent2D extent = viewer.window.extent();
    const Sheet& sheet = around.drawn->laid.sheet;
    SheetPart part;
    part.scale = panorama_scale(viewer);
    part.width_px = static_cast<int>(extent.width);
    part.height_px = static_cast<int>(extent.height);
    // In the middle where there is more room than sheet; else no farther than its border.
    const auto first_px = [&](int of_window_px, int of_sheet_px, double& middle) {
        const double shown_px = of_window_px / part.scale;
        if (shown_px >= of_sheet_px) return 0.5 * (of_sheet_px - shown_px);
        const double half = 0.5 * shown_px / of_sheet_px;
        middle = std::clamp(middle, half, 1.0 - half);
        return middle * of_sheet_px - 0.5 * shown_px;
    };
    part.left_px = first_px(part.width_px, sheet.width_px, around.middle_x);
    part.top_px = first_px(part.height_px, sheet.height_px, around.middle_y);
    if (around.picture == nullptr || !(part == around.part)) {
        ORO_TRY(around.picture,
                viewer.window.picture_of(pixels_of(part, around.drawn->rgb, sheet.width_px, sheet.height_px),
                                         extent));
        around.part = part;
    }
    return Shown(WindowPicture{*around.picture, extent});
}

}  // namespace oro
