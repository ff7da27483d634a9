#include "apps/window/second_view.h"

#include <algorithm>
#include <utility>

#include "apps/drawing/drape.h"
#include "apps/drawing/mesh_cut.h"
#include "apps/view/mesh_parts.h"
#include "apps/window/changes.h"
#include "apps/window/frames.h"
#include "apps/window/kept_view.h"
#include "apps/window/pictures.h"
#include "apps/window/window_start.h"
#include "apps/window/written_frame.h"
#include "core/lod/ground_means.h"

namespace oro {
namespace {

const Region& region_of(const Viewer& viewer, const OwnRegion* own) {
    return own != nullptr ? own->region : viewer.region;
}

const RegionCuts& cuts_of(const Viewer& viewer, const OwnRegion* own) {
    return own != nullptr ? own->cuts : viewer.cuts;
}

// The first view with what the choice has otherwise.
Result<View> view_beside(const Viewer& viewer, const SecondChoice& choice, const OwnRegion* own) {
    View view = viewer.view;
    if (own != nullptr && !choice.paths.empty()) {
        view = own->view;
        keep_choices(viewer.view, view);
        view.exaggeration = viewer.view.exaggeration;
        view.model.earth = viewer.view.model.earth;
        view.camera = viewer.view.camera;
    }
    ORO_TRY(view, differing_view(std::move(view), choice));
    ORO_CHECK(check_own_posts(view, region_of(viewer, own)));
    // Data in no projected CRS have the other graticule.
    if (!find_graticule_crs(view, region_of(viewer, own)).ok()) view.graticule = Graticule::geographic;
    return view;
}

// Whether two choices are of the same data.
bool have_same_data(const SecondChoice& one, const SecondChoice& other) {
    return one.paths == other.paths && one.leaves_geoid_out == other.leaves_geoid_out;
}

// From options and the shown region to pages: on a thread of its own.
Result<SecondGround> prepared(SecondGround ground, WindowOptions options, const Region& region,
                              const RegionCuts& cuts, const std::function<void(double)>& tell_share,
                              const std::stop_token& stop) {
    constexpr double reading = 0.4;  // of the whole work
    const SecondChoice& choice = ground.choice;
    if (!ground.own && (!choice.paths.empty() || choice.leaves_geoid_out)) {
        const auto own = std::make_shared<OwnRegion>();
        if (choice.paths.empty()) {
            own->region = region;
            own->cuts = cuts;
        } else {
            WindowOptions asked = options;
            ORO_CHECK(open_other_region(
                asked, [&](double share, const std::string&) { tell_share(reading * share); }, own->view,
                own->region));
            ORO_TRY(own->cuts, cut_regions(own->region));
        }
        const bool has_geoid = choice.paths.empty() || own->view.has_geoid;
        if (choice.leaves_geoid_out && has_geoid) leave_geoid_out(own->region);
        ground.own = own;
    }
    if (stop.stop_requested()) return Error{ErrorKind::failed, "", "stopped"};
    ORO_TRY(ground.pages, make_grid_pages(
                              ground.own ? ground.own->region : region, ground.own ? ground.own->cuts : cuts,
                              ground.exaggeration,
                              [&](double share) { tell_share(reading + (1.0 - reading) * share); }, stop));
    return ground;
}

// Begins to prepare what the choice asks for; its data are taken from the view that is there, where they are
// the same.
void prepare(Viewer& viewer, const SecondChoice& choice) {
    SecondGround ground;
    ground.choice = choice;
    ground.exaggeration = choice.exaggeration.value_or(viewer.view.exaggeration);
    const auto& second = viewer.two.second;
    if (second && have_same_data(second->choice, choice)) ground.own = second->own;
    WindowOptions options = options_for_other_region(viewer.options, viewer.view, choice.paths);
    options.quiet = true;
    viewer.two.work = std::make_unique<BackgroundWork<SecondGround>>(
        [begun = std::make_shared<SecondGround>(std::move(ground)), options,
         &region = std::as_const(viewer.region),
         &cuts = std::as_const(viewer.cuts)](const auto& tell_share, const std::stop_token& stop) {
            return prepared(std::move(*begun), options, region, cuts, tell_share, stop);
        });
    viewer.wants_picture = true;
}

MemoryOptions half_of(MemoryOptions memory, const Gpu& gpu) {
    constexpr std::uint64_t mb = 1'000'000;
    constexpr int usual_main_mb = 64;
    const int gpu_mb = memory.gpu_memory_mb.value_or(static_cast<int>(gpu_bytes(gpu, 0) / mb));
    memory.gpu_memory_mb = std::max(1, gpu_mb / 2);
    memory.memory_mb = std::max(1, memory.memory_mb.value_or(usual_main_mb) / 2);
    return memory;
}

VkExtent2D extent_of_second(const Viewer& viewer, const VkExtent2D& window) {
    const TwoHalves halves = two_halves(viewer.two.layout, viewer.two.line, static_cast<int>(window.width));
    return {static_cast<std::uint32_t>(halves.second_px), window.height};
}

// The graphs of the first view's meshes, where the second view draws from them: they are those of its data
// and of one exaggeration.
std::shared_ptr<const MeshDetail> detail_beside(const Viewer& viewer, const OwnRegion* own,
                                                const View& view) {
    const bool fits = own == nullptr && view.exaggeration == viewer.view.exaggeration &&
                      view.model.earth == Earth::ellipsoid;
    return fits ? viewer.meshes.detail : nullptr;
}

// Whether the terrain of a second view is drawn by clusters.
Result<bool> clusters_beside(const Region& region, View& view,
                             const std::shared_ptr<const MeshDetail>& detail) {
    return detail ? Result<bool>(false) : draws_terrain_clusters(region, view);
}

// What was prepared as something that is drawn. Errors: those of its style and its scene.
Result<std::unique_ptr<SecondView>> second_of(Viewer& viewer, SecondGround ground) {
    const OwnRegion* const own = ground.own.get();
    const Region& region = region_of(viewer, own);
    ORO_TRY(View view, view_beside(viewer, ground.choice, own));
    // Of its levels, whatever the first view has come to meanwhile.
    view.exaggeration = ground.exaggeration;
    settle_mesh_parts(region, view);
    ORO_TRY(const Style style, load_style(view, region.grids.front().field));
    EyeMeshes meshes;
    meshes.detail = detail_beside(viewer, own, view);
    if (const auto chosen = choose_cut(meshes, view, half_of(viewer.options.memory, viewer.gpu), view.camera);
        !chosen)
        return chosen.error();
    ORO_TRY(const bool clusters, clusters_beside(region, view, meshes.detail));
    const bool means = asks_for_means(style.frame);
    ORO_TRY(Scene scene,
            scene_with_images(
                viewer.gpu, region, cuts_of(viewer, own), std::move(ground.pages), view,
                {half_of(viewer.options.memory, viewer.gpu), true, means, clusters, meshes.cut.meshes}));
    // Pages of a made world take long to be measured: by threads that load them, and the window goes on.
    scene.wait_for_records(false);
    ORO_TRY(FrameRenderer renderer, renderer_for(viewer.gpu, view, style, viewer.path,
                                                 extent_of_second(viewer, viewer.window.extent())));
    return std::unique_ptr<SecondView>(new SecondView{std::move(ground.choice),
                                                      std::move(ground.own),
                                                      std::move(view),
                                                      style,
                                                      means,
                                                      clusters,
                                                      {},
                                                      std::make_unique<Scene>(std::move(scene)),
                                                      std::move(renderer),
                                                      std::move(meshes)});
}

// Lets the second view that is there differ so. False where that needs other levels or data.
Result<bool> change_second(Viewer& viewer, const SecondChoice& choice) {
    SecondView& second = *viewer.two.second;
    if (!have_same_data(second.choice, choice)) return false;
    const Region& region = region_of(viewer, second.own.get());
    ORO_TRY(View view, view_beside(viewer, choice, second.own.get()));
    settle_mesh_parts(region, view);
    ORO_TRY(const Style style, load_style(view, region.grids.front().field));
    const auto detail = detail_beside(viewer, second.own.get(), view);
    ORO_TRY(const bool clusters, clusters_beside(region, view, detail));
    if (view.exaggeration != second.view.exaggeration || clusters != second.has_clusters ||
        detail != second.meshes.detail || (asks_for_means(style.frame) && !second.has_means))
        return false;
    ORO_CHECK(finish_frames(viewer));
    const bool other_renderer =
        style.frame.smooth_edges != second.style.frame.smooth_edges || view.show != second.view.show;
    if (other_renderer) {
        ORO_TRY(second.renderer,
                renderer_for(viewer.gpu, view, style, viewer.path, second.renderer.extent()));
        second.has_picture = false;
    }
    const bool other_images =
        view.drape != second.view.drape || view.drape_opacity != second.view.drape_opacity ||
        view.drape_values != second.view.drape_values || view.cover != second.view.cover;
    second.choice = choice;
    second.view = std::move(view);
    second.style = style;
    if (other_images) {
        Scene& scene = *second.scene;
        for (std::size_t grid = 0; grid < scene.grids().size(); ++grid) scene.set_drape(nullptr, grid);
        ORO_CHECK(
            lay_images(second.view, half_of(viewer.options.memory, viewer.gpu), viewer.gpu, scene, true));
    }
    viewer.wants_picture = true;
    return true;
}

// Of two views, the first one's scene gives back half of what its user allows.
Result<void> share_memory(Viewer& viewer) {
    if (viewer.two.shares_memory || !viewer.options.memory.gpu_memory_mb) return {};
    viewer.two.shares_memory = true;
    return renew_scene(viewer);
}

// What it would be drawn from now.
Result<FramePlan> plan_second(Viewer& viewer, const DetailStep& step) {
    SecondView& second = *viewer.two.second;
    const Geodetic& eye = viewer.view.camera.eye;
    const bool is_lower = second.choice.leaves_geoid_out && viewer.view.has_geoid;
    const double N_m = is_lower ? field_below(viewer).undulation.at_m(eye.lat_deg, eye.lon_deg) : 0.0;
    second.view.camera =
        second_camera(viewer.view.camera, static_cast<int>(second.renderer.extent().width), N_m);
    if (second.view.sun && second.view.sun->time) {
        aim_sun(second.view.sun, second.view.camera.eye);
        light_by(*second.view.sun, second.style.frame);
    }
    ORO_CHECK(fit_to_view(second.style, second.view, region_of(viewer, second.own.get()).grids.front().field,
                          viewer.follows_eye ? Eye::moves : Eye::rests));
    const Camera camera = scaled_camera(second.view.camera, step.scale);
    require_fields(*second.scene, second.style.frame, step);
    second.scene->set_fallback_to_blocks(!is_of_clusters(second.view.show));
    ORO_TRY(FramePlan plan, second.scene->plan({camera, whole_tile(camera),
                                                second.view.tau_px * step.tau_factor, second.view.model}));
    second.is_missing = lacks_what_may_come(plan, second.lacks_memory);
    second.shows_all = plan.shows_all();
    second.part = {static_cast<std::uint32_t>(camera.width_px), static_cast<std::uint32_t>(camera.height_px)};
    second.has_picture = true;
    return plan;
}

void take_second_report(SecondView& second, const FrameReport& report) {
    second.scene->apply_feedback(report.feedback);
    second.images_settled = report.images_settled;
}

// Of what is drawn of the first view's meshes.
Camera camera_of_second(const Viewer& viewer) {
    return second_camera(viewer.view.camera, static_cast<int>(viewer.two.second->renderer.extent().width),
                         0.0);
}

// As over the first view: where its frame is whole and the eye rests.
Result<void> write_over_second(Viewer& viewer) {
    SecondView& second = *viewer.two.second;
    if (viewer.follows_eye || second.is_missing || !second.images_settled ||
        !has_writing(second.view, second.style))
        return {};
    if (!second.ground) {
        ORO_TRY(second.ground, RegionGround::of(region_of(viewer, second.own.get()),
                                                cuts_of(viewer, second.own.get()), second.view.exaggeration));
    }
    return write_over_frame(viewer.gpu, *second.scene, second.view, second.ground->ground(), second.style,
                            viewer.path, second.renderer);
}

}  // namespace

Result<void> show_second(Viewer& viewer, const SecondChoice& choice) {
    TwoViews& two = viewer.two;
    two.choice = choice;
    // What is being prepared is shown first, and then changed.
    if (two.work && !two.work->is_stopped()) return {};
    if (two.second) {
        const Result<bool> changed = change_second(viewer, choice);
        if (!changed.ok()) {
            tell(viewer, changed.error());
            two.choice = two.second->choice;
            return viewer.region.health();
        }
        if (*changed) return {};
    }
    if (viewer.opening && !choice.paths.empty()) {
        tell(viewer, viewer.opening->name() + " is still being opened", true);
        return {};
    }
    prepare(viewer, choice);
    return {};
}

void stop_second(Viewer& viewer) {
    if (viewer.two.work) viewer.two.work->stop();
}

Result<void> close_second(Viewer& viewer) {
    stop_second(viewer);
    if (!viewer.two.second) return {};
    ORO_CHECK(finish_frames(viewer));
    viewer.two.second.reset();
    viewer.two.shares_memory = false;
    viewer.wants_picture = true;
    return forget_difference(viewer);
}

Result<void> choose_next_layout(Viewer& viewer) {
    TwoViews& two = viewer.two;
    const bool is_on = two.second || (two.work && !two.work->is_stopped());
    if (is_on && two.layout == TwoViewsLayout::swipe) return close_second(viewer);
    two.layout = is_on ? TwoViewsLayout::swipe : TwoViewsLayout::side_by_side;
    viewer.wants_picture = true;
    if (is_on) return {};
    // Of two views that are the same: here is what may differ.
    if (two.choice == SecondChoice()) viewer.panels.open(&Panels::two_views);
    return show_second(viewer, two.choice);
}

Result<void> take_second(Viewer& viewer) {
    TwoViews& two = viewer.two;
    const bool had_work = two.work != nullptr;
    auto ground = take_finished(two.work);
    if (had_work && !two.work) viewer.wants_picture = true;
    if (!ground) return {};
    const auto refuse = [&](const Error& why) {
        tell(viewer, why);
        if (two.second) two.choice = two.second->choice;
        return viewer.region.health();
    };
    if (!ground->ok()) return refuse(ground->error());
    Result<std::unique_ptr<SecondView>> made = second_of(viewer, std::move(**ground));
    if (!made.ok()) return refuse(made.error());
    ORO_CHECK(finish_frames(viewer));
    if (two.second && !have_same_data(two.second->choice, (*made)->choice))
        ORO_CHECK(forget_difference(viewer));
    two.second = std::move(*made);
    ORO_CHECK(share_memory(viewer));
    // The choice of now, and the first view as it is now.
    return show_second(viewer, two.choice);
}

Result<void> follow_first_view(Viewer& viewer) {
    return viewer.two.second ? show_second(viewer, viewer.two.choice) : Result<void>();
}

MemoryOptions memory_of_first(const Viewer& viewer) {
    return viewer.two.shares_memory ? half_of(viewer.options.memory, viewer.gpu) : viewer.options.memory;
}

VkExtent2D extent_of_first(const Viewer& viewer, const VkExtent2D& window) {
    if (!viewer.two.second) return window;
    const TwoHalves halves = two_halves(viewer.two.layout, viewer.two.line, static_cast<int>(window.width));
    return {static_cast<std::uint32_t>(halves.first_px), window.height};
}

View view_alone(const Viewer& viewer) {
    View view = viewer.view;
    const auto width_px = viewer.two.second ? static_cast<int>(viewer.window.extent().width) : 0;
    if (width_px > 0) view.camera.width_px = width_px;
    return view;
}

int pointer_border_px(const Viewer& viewer) {
    if (!viewer.two.second || viewer.two.layout == TwoViewsLayout::swipe) return 0;
    return two_halves(viewer.two.layout, viewer.two.line, static_cast<int>(viewer.window.extent().width))
        .begins_px;
}

DifferenceWords source_names(const Viewer& viewer) {
    const auto& second = viewer.two.second;
    const bool has_own = second && !second->choice.paths.empty();
    return {viewer.name, has_own ? name_of_paths(second->choice.paths) : viewer.name};
}

Result<void> take_second_size(Viewer& viewer, const VkExtent2D& window, bool& changed) {
    if (!viewer.two.second) return {};
    SecondView& second = *viewer.two.second;
    const VkExtent2D extent = extent_of_second(viewer, window), now = second.renderer.extent();
    if (extent.width == now.width && extent.height == now.height) return {};
    changed = true;
    ORO_CHECK(finish_frames(viewer));
    second.has_picture = false;
    return second.renderer.resize(extent);
}

Result<bool> advance_second(Viewer& viewer) {
    if (!viewer.two.second || !viewer.two.second->is_missing) return false;
    SecondView& second = *viewer.two.second;
    ORO_TRY(const bool better, second.scene->advance());
    return better || lacks_memory_now(*second.scene, second.lacks_memory);
}

Result<bool> follow_with_second_meshes(Viewer& viewer) {
    if (!viewer.two.second || !viewer.two.second->meshes.detail) return false;
    SecondView& second = *viewer.two.second;
    const Camera camera = camera_of_second(viewer);
    if (are_chosen_for(second.meshes, second.view, camera)) return false;
    const MemoryOptions memory = half_of(viewer.options.memory, viewer.gpu);
    ORO_TRY(const bool are_here,
            follow_with_meshes(second.meshes,
                               {viewer.region, viewer.cuts, second.view, memory, viewer.gpu, *second.scene},
                               camera, is_moving(viewer)));
    if (are_here) {
        ORO_CHECK(finish_frames(viewer));
        take_coming(second.meshes, *second.scene);
    }
    return are_here || are_chosen_for(second.meshes, second.view, camera);
}

bool lacks_second_meshes(const Viewer& viewer) {
    return viewer.two.second &&
           !are_chosen_for(viewer.two.second->meshes, viewer.two.second->view, camera_of_second(viewer));
}

bool second_changes_at_rest(const Viewer& viewer) {
    const auto& second = viewer.two.second;
    return second && (second->style.contours_by_view || has_writing(second->view, second->style));
}

Result<void> submit_second(Viewer& viewer, const DetailStep& step) {
    if (!viewer.two.second) return {};
    ORO_TRY(FramePlan plan, plan_second(viewer, step));
    SecondView& second = *viewer.two.second;
    return second.renderer.submit(std::move(plan), style_at(second.style.frame, step),
                                  second.scene->drapes());
}

Result<void> draw_second_at_rest(Viewer& viewer, const DetailStep& step) {
    if (!viewer.two.second) return {};
    ORO_CHECK(finish_second(viewer, 0));
    ORO_TRY(FramePlan plan, plan_second(viewer, step));
    SecondView& second = *viewer.two.second;
    ORO_TRY(const FrameReport report,
            second.renderer.draw(std::move(plan), style_at(second.style.frame, step), 0, 1,
                                 second.scene->drapes()));
    take_second_report(second, report);
    return step.scale < 1.0 ? Result<void>() : write_over_second(viewer);
}

Result<void> finish_second(Viewer& viewer, std::size_t left) {
    if (!viewer.two.second) return {};
    SecondView& second = *viewer.two.second;
    while (second.renderer.under_way() > left) {
        ORO_TRY(const FrameReport report, second.renderer.finish());
        take_second_report(second, report);
        if (!second.images_settled) viewer.wants_picture = true;
    }
    return {};
}

std::optional<PictureBeside> second_to_show(const Viewer& viewer) {
    if (!viewer.two.second || !viewer.two.second->has_picture) return std::nullopt;
    const SecondView& second = *viewer.two.second;
    const TwoHalves halves =
        two_halves(viewer.two.layout, viewer.two.line, static_cast<int>(viewer.window.extent().width));
    return PictureBeside{second.renderer.picture(), second.part, static_cast<std::uint32_t>(halves.begins_px),
                         viewer.two.layout == TwoViewsLayout::swipe};
}

}  // namespace oro
