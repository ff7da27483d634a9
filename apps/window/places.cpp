#include "apps/window/places.h"

#include <cstdio>

#include "apps/report/summit_words.h"
#include "apps/window/motion.h"

namespace oro {

void stand(Viewer& viewer) {
    const auto there = viewer.jumps.stand(viewer.view.camera, viewer.region, viewer.view.exaggeration);
    if (!there.ok()) return tell(viewer, there.error());
    if (!*there) return;
    std::string message = "Backspace goes back";
    if (const auto& higher = viewer.jumps.higher())
        message += ", Enter stands on the highest post near: " + wall_words(*higher);
    fly_to(viewer, **there, message);
}

Result<void> pick(Viewer& viewer, glm::dvec2 point_px) {
    ORO_TRY(viewer.picked, picked_at(viewer, point_px));
    viewer.panels.open(&Panels::place);
    viewer.message = line_of(viewer.picked->seen);
    std::printf("%s\n", viewer.message.c_str());
    std::fflush(stdout);  // whoever reads along has it now
    return {};
}

}  // namespace oro
