#include "apps/window/comparing.h"

#include <cstdio>
#include <utility>

#include "apps/report/json_text.h"
#include "apps/window/viewer.h"
#include "apps/window/window_start.h"

namespace oro {

void compare_sources(Viewer& viewer) {
    const auto& second = viewer.two.second;
    if (!second || !second->own || second->choice.paths.empty()) return;
    const DifferenceWords names = source_names(viewer);
    viewer.comparing.work = std::make_unique<BackgroundWork<SourceDifference>>(
        [names, own = second->own, &region = std::as_const(viewer.region)](const auto& tell_share,
                                                                           const std::stop_token& stop) {
            return source_difference({region, names.first}, {own->region, names.second}, tell_share, stop);
        });
}

void stop_comparing(Viewer& viewer) {
    if (viewer.comparing.work) viewer.comparing.work->stop();
}

Result<void> take_difference(Viewer& viewer) {
    Comparing& comparing = viewer.comparing;
    auto found = take_finished(comparing.work);
    if (!found) return {};
    if (!found->ok()) {
        tell(viewer, found->error());
        return {};
    }
    comparing.found = std::move(**found);
    char text[100];
    std::snprintf(text, sizeof text, ": mean %.2f m, RMS %.2f m", comparing.found->found.mean_m,
                  comparing.found->found.rms_m);
    tell(viewer, comparing.found->title + text);
    return show_difference(viewer, true);
}

Result<void> show_difference(Viewer& viewer, bool is_shown) {
    viewer.comparing.is_shown = is_shown;
    viewer.wants_picture = true;
    return lay_over_ground(viewer);
}

Result<void> forget_difference(Viewer& viewer) {
    const bool was_found = viewer.comparing.found.has_value();
    viewer.comparing = {};
    return was_found ? show_difference(viewer, true) : Result<void>();
}

void save_difference(Viewer& viewer) {
    if (!viewer.comparing.found) return;
    const std::string file = free_picture_name(time_now_s(), "-difference.tif");
    const Result<void> written = write_post_raster(file, false, viewer.comparing.found->raster);
    tell_written(viewer, file, written);
}

}  // namespace oro
