#include "apps/window/places.h"

#include <cstdio>

#include "apps/report/progress_bar.h"
#include "apps/report/summit_words.h"
#include "apps/window/motion.h"
#include "geo/places/place.h"

namespace oro {
namespace {

// A place with a height in the ground: the eye is over it.
std::string message_of_jump(const Place& place, const Camera& there) {
    if (!place.height_m) return "Enter stands on it, Backspace goes back";
    const double lifted_m = there.eye.h_m - *place.height_m;
    if (!(lifted_m > 0.0)) return "Backspace goes back";
    char text[100];
    std::snprintf(text, sizeof text, "the ground there is higher: the eye is lifted by %.1f m, ", lifted_m);
    return text + std::string("Backspace goes back");
}

// The text stays, to be mended.
void refuse(Viewer& viewer, const Error& why) {
    viewer.search.error = why.line();
    viewer.search.takes_focus = true;
    viewer.message = why.line();
    say(false, viewer.message);
}

}  // namespace

void stand(Viewer& viewer) {
    const auto there = viewer.jumps.stand(viewer.view.camera, viewer.region, viewer.view.exaggeration);
    if (!there.ok()) return tell(viewer, there.error());
    if (!*there) return;
    std::string message = "Backspace goes back";
    if (const auto& higher = viewer.jumps.higher())
        message += ", Enter stands on the highest post near: " + wall_words(*higher);
    fly_to(viewer, **there, message);
}

void search(Viewer& viewer) {
    SearchField& field = viewer.search;
    field.error.clear();
    if (field.text.find_first_not_of(" \t") == std::string::npos) {
        field.is_open = false;
        return;
    }
    viewer.jumps.stay();
    const auto place = parse_place(field.text);
    if (!place.ok()) return refuse(viewer, place.error());
    const auto there =
        viewer.jumps.to(viewer.view.camera, *place, viewer.region, viewer.view.exaggeration, field.text);
    if (!there.ok()) return refuse(viewer, there.error());
    field.is_open = false;
    field.text.clear();
    fly_to(viewer, *there, message_of_jump(*place, *there));
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
