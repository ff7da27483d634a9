#include "apps/window/looking_around.h"
#include "apps/window/frames.h"

#include <utility>

#include "apps/drawing/drape.h"
#include "apps/report/json_text.h"
#include "apps/window/viewer.h"
#include "apps/window/window_start.h"

namespace oro {
namespace {

// The colours that lie over the ground; null: none.
std::shared_ptr<const PostColours> shown_tint(const Viewer& viewer) {
    if (viewer.leaves_tints_out) return nullptr;
    if (viewer.comparing.found && viewer.comparing.is_shown) return viewer.comparing.found->colours;
    if (viewer.looking.found && viewer.looking.is_shown) return viewer.looking.found->colours;
    return nullptr;
}

}  // namespace

void look_around(Viewer& viewer) {
    LookingAround& looking = viewer.looking;
    if (!looking.choice) return;
    const SeenAroundChoice choice = *looking.choice;
    const Air air = air_around(choice, viewer.view.model.air);
    looking.work = std::make_unique<BackgroundWork<SeenAround>>(
        [choice, air,
         cover = SightCover{viewer.view.cover, viewer.view.canopy, viewer.view.canopy_choice.held},
         &region = std::as_const(viewer.region),
         &cuts = std::as_const(viewer.cuts)](const auto& tell_share, const std::stop_token& stop) {
            return seen_around(choice, air, region, cuts, cover, tell_share, stop);
        });
}

void stop_looking_around(Viewer& viewer) {
    if (viewer.looking.work) viewer.looking.work->stop();
}

Result<void> take_seen_around(Viewer& viewer) {
    LookingAround& looking = viewer.looking;
    auto around = take_finished(looking.work);
    if (!around) return {};
    if (!around->ok()) {
        tell(viewer, around->error());
        return {};
    }
    looking.found = std::move(**around);
    tell(viewer, looking.found->seen);
    return show_seen_around(viewer, true);
}

Result<void> show_seen_around(Viewer& viewer, bool is_shown) {
    viewer.looking.is_shown = is_shown;
    viewer.wants_picture = true;
    return lay_over_ground(viewer);
}

Result<void> forget_seen_around(Viewer& viewer) {
    viewer.looking.found.reset();
    return show_seen_around(viewer, true);
}

void save_seen_around(Viewer& viewer) {
    if (!viewer.looking.found) return;
    const std::string file = free_picture_name(time_now_s(), "-viewshed.tif");
    const Result<void> written = write_post_raster(file, false, viewer.looking.found->raster);
    tell_written(viewer, file, written);
}

bool is_tinted(const Viewer& viewer) {
    return shown_tint(viewer) != nullptr;
}

Result<void> leave_tints_out(Viewer& viewer, bool left_out) {
    viewer.leaves_tints_out = left_out;
    viewer.wants_picture = true;
    return lay_over_ground(viewer);
}

Result<void> lay_over_ground(Viewer& viewer, Scene& scene) {
    for (std::size_t grid = 0; grid < scene.grids().size(); ++grid) scene.set_drape(nullptr, grid);
    return lay_images(viewer.view, memory_of_first(viewer), viewer.gpu, scene, true, shown_tint(viewer));
}

Result<void> lay_over_ground(Viewer& viewer) {
    ORO_CHECK(finish_frames(viewer));
    for (Scene* const scene :
         {viewer.scene.get(), viewer.coming.get(), viewer.world.measured.get(), viewer.world.by_bounds.get()})
        if (scene != nullptr) ORO_CHECK(lay_over_ground(viewer, *scene));
    return {};
}

}  // namespace oro
