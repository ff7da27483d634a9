#include "apps/window/world_levels.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "apps/drawing/known_pictures.h"
#include "apps/navigation/view_history.h"
#include "apps/window/coming_scene.h"
#include "apps/window/frames.h"
#include "apps/window/looking_around.h"
#include "apps/window/viewer.h"
#include "core/frame/records_ahead.h"
#include "core/made_pages/made_pages.h"

namespace oro {
namespace {

bool are_same_pictures(const KnownPictures& a, const KnownPictures& b) {
    const auto is_same = [](const FrameView& one, const FrameView& other) {
        return is_same_view(one.camera, other.camera) && one.camera.width_px == other.camera.width_px &&
               one.camera.height_px == other.camera.height_px && one.tau_px == other.tau_px &&
               one.model.earth == other.model.earth && one.model.air == other.model.air &&
               one.model.precision == other.model.precision;
    };
    return a.light.sun_enu == b.light.sun_enu && a.light.sky_openness == b.light.sky_openness &&
           std::ranges::equal(a.views, b.views, is_same);
}

KnownPictures pictures_of(const View& view, const Style& style) {
    return known_pictures(view, style, std::span(&view.camera, 1));
}

// Pages with all that the pictures ask for measured, as far as nobody asked to stop.
Result<std::unique_ptr<RegionPages>> measured_pages(const HeightField& field, const KnownPictures& pictures,
                                                    const std::stop_token& stop) {
    std::unique_ptr<RegionPages> pages = made_posts_of(field)->pages(field, pictures);
    for (const FrameView& view : pictures.views)
        ORO_CHECK(make_records_ahead(*pages, view, pictures.light, stop));
    return pages;
}

Result<Scene> scene_of(const Viewer& viewer, std::unique_ptr<RegionPages> pages) {
    GridPages of_grid;
    of_grid.push_back(std::move(pages));
    ORO_TRY(Scene scene, scene_with_images(viewer.gpu, viewer.region, viewer.cuts, std::move(of_grid),
                                           viewer.view, {memory_of_first(viewer), true}));
    scene.wait_for_records(false);
    return scene;
}

// What is shown of another view goes, and so does what is measured for it.
Result<void> forget_measured(Viewer& viewer, bool& changed) {
    WorldLevels& world = viewer.world;
    world.is_begun = false;
    world.measured.reset();
    if (world.work) {
        world.work->stop();
        world.stopped.push_back(std::move(world.work));
    }
    if (!world.by_bounds) return {};
    ORO_CHECK(finish_frames(viewer));
    viewer.scene = std::move(world.by_bounds);
    viewer.certificates.forget();
    changed = true;
    return {};
}

void begin_measuring(Viewer& viewer, KnownPictures pictures) {
    WorldLevels& world = viewer.world;
    const HeightField& field = viewer.region.grids.front().field;
    world.of = pictures;
    world.is_begun = true;
    world.work = std::make_unique<WorldLevels::Work>(
        [&field, pictures = std::move(pictures)](const auto&, const std::stop_token& stop) {
            return measured_pages(field, pictures, stop);
        });
}

Result<void> take_measured(Viewer& viewer) {
    WorldLevels& world = viewer.world;
    auto pages = take_finished(world.work);
    if (!pages) return {};
    if (!pages->ok()) return pages->error();
    ORO_TRY(Scene scene, scene_of(viewer, std::move(*pages).value()));
    if (is_tinted(viewer)) ORO_CHECK(lay_over_ground(viewer, scene));
    world.measured = std::make_unique<Scene>(std::move(scene));
    world.measured_since = Clock::now();
    return {};
}

// Once all of it is there, or all that the GPU has room for.
Result<void> show_measured(Viewer& viewer, bool& changed) {
    WorldLevels& world = viewer.world;
    Scene& scene = *world.measured;
    const Camera& camera = viewer.view.camera;
    scene.require_fields(viewer.style.frame);
    ORO_TRY(const FramePlan plan,
            scene.plan({camera, whole_tile(camera), viewer.view.tau_px, viewer.view.model}));
    ORO_TRY(const bool is_ready, has_what_fits(scene, plan, world.measured_since));
    if (!is_ready) return {};
    ORO_CHECK(finish_frames(viewer));
    world.by_bounds = std::exchange(viewer.scene, std::move(world.measured));
    viewer.certificates.forget();
    viewer.is_missing = false;
    changed = true;
    return {};
}

}  // namespace

bool is_drawn_by_bounds(const Region& region, const View& view) {
    return region.grids.size() == 1 && !region.meshes && view.exaggeration == 1.0 &&
           made_posts_of(region.grids.front().field) != nullptr;
}

bool is_too_coarse(const Viewer& viewer, const FramePlan& plan) {
    constexpr double widest_m = 400.0;
    if (!viewer.world.shows_bounds()) return false;
    const PostGrid& grid = viewer.region.grids.front().field.grid;
    const double spacing_m = wgs84_a_m * grid.row_step_rad();
    return std::ranges::any_of(plan.grids.front().missing, [&](const PageIndex& page) {
        return std::ldexp(spacing_m, page.level) > widest_m;
    });
}

Result<void> follow_with_levels(Viewer& viewer, bool& changed) {
    WorldLevels& world = viewer.world;
    if (!world.on) return {};
    std::erase_if(world.stopped, [](const auto& work) { return work->ready(); });
    KnownPictures now = pictures_of(viewer.view, viewer.style);
    if (world.is_begun && !are_same_pictures(world.of, now)) ORO_CHECK(forget_measured(viewer, changed));
    if (world.by_bounds) return {};
    if (world.measured) return show_measured(viewer, changed);
    if (world.work) return take_measured(viewer);
    if (viewer.is_shown && !viewer.follows_eye && !viewer.is_missing && world.stopped.empty())
        begin_measuring(viewer, std::move(now));
    return {};
}

Result<std::unique_ptr<Scene>> scene_of_picture(Viewer& viewer, const View& view) {
    const KnownPictures pictures = pictures_of(view, viewer.style);
    if (!viewer.world.on || (viewer.world.by_bounds && are_same_pictures(viewer.world.of, pictures)))
        return std::unique_ptr<Scene>();
    ORO_TRY(std::unique_ptr<RegionPages> pages,
            measured_pages(viewer.region.grids.front().field, pictures, {}));
    ORO_TRY(Scene scene, scene_of(viewer, std::move(pages)));
    return std::make_unique<Scene>(std::move(scene));
}

}  // namespace oro
