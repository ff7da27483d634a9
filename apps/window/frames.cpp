#include "apps/window/frames.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <utility>

#include "apps/accuracy/beyond_data.h"
#include "apps/report/progress_bar.h"
#include "apps/window/coming_scene.h"
#include "apps/window/loading_picture.h"
#include "apps/window/pictures.h"
#include "apps/window/written_frame.h"

namespace oro {
namespace {

// How long the user has waited for it.
void say_waited(const Viewer& viewer, const char* what) {
    char text[100];
    std::snprintf(text, sizeof text, "%s after %.2f s", what, seconds_since(viewer.started));
    say(viewer.options.quiet, text);
}

// What a coarse picture needs of the scene that comes: with that it takes the place of the one that is shown,
// and the eye stays. Until then the window goes on. True once it has.
Result<bool> swap_in_full_pyramid(Viewer& viewer) {
    constexpr double first_tau_px = 4.0;
    Scene& scene = *viewer.coming;
    const Camera& camera = viewer.view.camera;
    scene.require_fields(viewer.style.frame);
    ORO_TRY(const FramePlan plan,
            scene.plan(
                {camera, whole_tile(camera), std::max(first_tau_px, viewer.view.tau_px), viewer.view.model}));
    ORO_TRY(const bool is_ready, has_what_fits(scene, plan, viewer.coming_since));
    if (!is_ready) return false;
    ORO_CHECK(finish_frames(viewer));
    show_finer_scene(viewer);
    return true;
}

// Some time after the eye has moved it rests: contour lines, which stayed, are then those of its view, what
// is written over pictures is there again, and all detail.
bool comes_to_rest(Viewer& viewer) {
    constexpr double rest_s = 0.4, settle_s = 0.15;
    const double since_s = seconds_since(viewer.moved);
    if (!viewer.follows_eye) return false;
    if (since_s < rest_s) return since_s > settle_s && !viewer.drawn_at.is_whole();
    viewer.follows_eye = false;
    return viewer.style.contours_by_view || has_writing(viewer.view, viewer.style) ||
           second_changes_at_rest(viewer) || !viewer.drawn_at.is_whole();
}

// Over a frame that is whole, of an eye that rests. Finding it takes too long for an eye that moves.
Result<void> write_over(Viewer& viewer, const FrameReport& drawn) {
    const bool whole = !viewer.is_missing && drawn.images_settled && !is_coarse(viewer);
    if (viewer.follows_eye || !whole || !has_writing(viewer.view, viewer.style)) return {};
    ORO_TRY(const RegionGround* const ground, ground_so_far(viewer));
    if (ground == nullptr) {
        viewer.waits_for_writing = true;
        return {};
    }
    return write_over_frame(viewer.gpu, *viewer.scene, viewer.view, ground->ground(), viewer.style,
                            viewer.path, viewer.renderer);
}

bool has_ground(const FramePlan& plan) {
    return std::ranges::any_of(plan.grids, [](const GridPlan& grid) { return grid.page_room() > 0; });
}

// Whether ground is in view of which nothing is there yet. A grid beside others that have some is waited for
// a little while: nothing says then that its ground is not void. Where the GPU chooses pages there is some.
bool lacks_ground(Viewer& viewer, const FramePlan& plan) {
    constexpr double longest_s = 2.0;
    const auto lacks = [](const GridPlan& grid) { return grid.pages_wanted > 0 && grid.page_room() == 0; };
    const bool is_first_too_coarse = !viewer.is_shown && is_too_coarse(viewer, plan);
    if (std::ranges::none_of(plan.grids, lacks) && !is_first_too_coarse) return false;
    if (!viewer.waits_for_ground) viewer.waiting_since = Clock::now();
    return !has_ground(plan) || seconds_since(viewer.waiting_since) < longest_s;
}

// A window's size is its camera's and its renderer's, that of a half where there are two. The picture from
// before stays until another is drawn.
Result<void> take_size(Viewer& viewer, const VkExtent2D& window, bool& changed) {
    ORO_CHECK(take_second_size(viewer, window, changed));
    const VkExtent2D extent = extent_of_first(viewer, window);
    viewer.view.camera.width_px = static_cast<int>(extent.width);
    viewer.view.camera.height_px = static_cast<int>(extent.height);
    if (extent.width == viewer.renderer.extent().width && extent.height == viewer.renderer.extent().height)
        return {};
    changed = true;
    ORO_CHECK(finish_frames(viewer));
    if (viewer.has_picture) viewer.kept = viewer.renderer.release_picture();
    viewer.has_picture = false;
    return viewer.renderer.resize(extent);
}

// Whether the first picture would be long in coming: where a processor draws one that is large.
bool begins_coarse(const Viewer& viewer) {
    constexpr int large_px = 200'000;
    const Camera& camera = viewer.view.camera;
    return !viewer.is_shown && !viewer.view.show && viewer.gpu.report().kind == VK_PHYSICAL_DEVICE_TYPE_CPU &&
           camera.width_px * camera.height_px > large_px;
}

// How much detail the next frame has.
DetailStep step_now(const Viewer& viewer) {
    if (begins_coarse(viewer)) return detail_steps.back();
    return is_moving(viewer) ? viewer.detail.now() : DetailStep();
}

// Whether the GPU shall choose pages. Where it has more to do than the processor frames are longer by what
// that takes.
bool wants_gpu_pages(const Viewer& viewer) {
    return viewer.options.gpu_pages.value_or(false);
}

// What the first frame whose pages the GPU chooses would wait for: made while there is nothing to do.
Result<void> prepare_gpu_pages(Viewer& viewer) {
    if (!wants_gpu_pages(viewer) || !viewer.is_settled || is_moving(viewer) || !viewer.under_way.empty() ||
        !viewer.scene->may_leave_choice())
        return {};
    constexpr std::uint64_t most_bytes = 8'000'000;  // of records, of each grid
    constexpr double a_turn_s = 0.003;
    Scene& scene = *viewer.scene;
    if (std::exchange(viewer.records_of, &scene) != &scene) viewer.records_read = 0;
    ORO_TRY(const bool are_read, scene.read_records(viewer.records_read, a_turn_s, most_bytes));
    if (!are_read) return {};
    ORO_TRY(const bool can, scene.choose_on_device(viewer.gpu, most_bytes));
    scene.leave_choice(false);
    if (!can) return {};
    ORO_CHECK(scene.load_coarsest_pages());
    return viewer.renderer.prepare_choice();
}

// What a frame would be drawn from now, and what of it is missing. The GPU may choose pages for an eye that
// moves over ground that is there: what is missing is then what a frame before has told of. All other plans
// are the processor's.
Result<FramePlan> plan_now(Viewer& viewer, const Camera& camera, const SubmittedFrame& frame) {
    Scene& scene = *viewer.scene;
    require_fields(scene, viewer.style.frame, frame.step);
    scene.set_fallback_to_blocks(!is_of_clusters(viewer.view.show));
    const double tau_px = viewer.view.tau_px * frame.step.tau_factor * viewer.world.tau_factor();
    scene.leave_choice(frame.is_of_moving_eye && viewer.is_shown && wants_gpu_pages(viewer) &&
                       scene.has_coarsest_pages());
    ORO_TRY(FramePlan plan, scene.plan({camera, whole_tile(camera), tau_px, viewer.view.model}));
    scene.leave_choice(false);
    viewer.is_missing = lacks_what_may_come(plan, viewer.lacks_memory);
    viewer.shows_all = plan.shows_all();
    viewer.waits_for_ground = lacks_ground(viewer, plan);
    if (viewer.is_shown || plan.wants_pages()) return plan;
    // A view of another place: told where messages are.
    const auto nothing = nothing_in_view(viewer.view, viewer.region, viewer.options.view_file);
    tell(viewer, nothing.ok() ? *nothing : nothing.error().what);
    say(viewer.options.quiet, "note: " + viewer.message);
    return plan;
}

// The overlay's lines over the next frame, unless they come to be written into it. Of one view alone.
std::vector<StrokedLine> lines_over_next(Viewer& viewer) {
    if (!viewer.follows_eye) viewer.lines_in_motion.rest();
    if (!viewer.follows_eye || !viewer.ground || viewer.two.second || viewer.view.show) return {};
    const double longest_s = std::clamp(0.25 * viewer.frame_s, 0.003, 0.015);
    return viewer.lines_in_motion.find(viewer.view, viewer.ground->ground(), longest_s);
}

// What a frame that is done tells. Where several are under way, a frame takes the time since the one before
// it.
void take_report(Viewer& viewer, SubmittedFrame frame, FrameReport report) {
    frame.times.drawn = Clock::now();
    const auto since = std::max(frame.times.begun, std::exchange(viewer.drawn, frame.times.drawn));
    viewer.frame_s = std::chrono::duration<double>(frame.times.drawn - since).count();
    // Of an eye that rests, too: what it takes says how an eye that begins to move is followed at once.
    viewer.detail.took(frame.step, viewer.frame_s);
    viewer.report = std::move(report);
    viewer.scene->apply_feedback(viewer.report.feedback);
    if (frame.is_chosen_by_gpu) {
        const auto lacks = [](const FrameFeedback& grid) {
            return grid.choice && grid.choice->counts.missing > 0;
        };
        frame.is_settled = std::ranges::none_of(viewer.report.feedback, lacks);
        viewer.is_missing = viewer.scene->lacks_pages();
    }
    viewer.is_settled =
        frame.is_settled && viewer.report.images_settled && !is_coarse(viewer) && frame.step.is_whole();
    viewer.lines = std::exchange(frame.lines, {});
    viewer.to_trace = std::move(frame);
}

// Of an eye that rests: waits for it.
Result<void> draw_at_rest(Viewer& viewer, FramePlan plan, const SubmittedFrame& frame) {
    ORO_CHECK(viewer.window.present());
    ORO_CHECK(take_reports(viewer, 0));
    ORO_TRY(FrameReport drawn, viewer.renderer.draw(std::move(plan), style_at(viewer.style.frame, frame.step),
                                                    0, 1, viewer.scene->drapes()));
    take_report(viewer, frame, std::move(drawn));
    return frame.step.scale < 1.0 ? Result<void>() : write_over(viewer, viewer.report);
}

Result<void> draw_planned(Viewer& viewer, FramePlan plan, const SubmittedFrame& frame) {
    ORO_CHECK(fit_to_view(viewer.style, viewer.view, viewer.region.grids.front().field,
                          viewer.follows_eye ? Eye::moves : Eye::rests));
    if (frame.is_of_moving_eye) {
        // Before the first view's, whose time then holds both.
        ORO_CHECK(submit_second(viewer, frame.step));
        ORO_CHECK(viewer.renderer.submit(std::move(plan), style_at(viewer.style.frame, frame.step),
                                         viewer.scene->drapes()));
        viewer.under_way.push_back(frame);
    } else {
        ORO_CHECK(draw_at_rest(viewer, std::move(plan), frame));
        ORO_CHECK(draw_second_at_rest(viewer, frame.step));
    }
    if (frame.step.scale < 1.0) return {};
    const int every =
        is_coarse(viewer) && !viewer.world.on ? coarse_step(viewer.region.grids.front().field) : 1;
    if (viewer.view.show) viewer.legend = colour_key(viewer.view, viewer.region, viewer.style, every);
    return {};
}

void forget_lack_of_memory(Viewer& viewer) {
    viewer.lacks_memory = false;
    if (viewer.two.second) viewer.two.second->lacks_memory = false;
}

}  // namespace

Tile whole_tile(const Camera& camera) {
    return {0, 0, camera.width_px, camera.height_px, {0.5, 0.5}};
}

gpu::FrameStyle style_at(gpu::FrameStyle style, const DetailStep& step) {
    if (!step.shadows) {
        style.shadows = 0;
        style.materials.on &= ~(gpu::materials_with_trees | gpu::materials_with_grass);
    }
    if (!step.means) {
        style.footprint = gpu::footprint_point;
        style.sky_openness = 0;
    }
    return style;
}

void require_fields(Scene& scene, const gpu::FrameStyle& style, const DetailStep& step) {
    const gpu::FrameStyle at_step = style_at(style, step);
    scene.require_fields(at_step);
}

Camera scaled_camera(const Camera& camera, double scale) {
    Camera smaller = camera;
    const auto side = [&](int px) { return std::max(1, static_cast<int>(std::lround(px * scale))); };
    smaller.width_px = side(camera.width_px);
    smaller.height_px = side(camera.height_px);
    return smaller;
}

Result<void> refine(Viewer& viewer, bool& changed) {
    if (viewer.finer && viewer.finer->ready()) ORO_CHECK(begin_finer_scene(viewer));
    if (!viewer.coming || viewer.waits_for_ground) return {};
    ORO_TRY(const bool is_here, swap_in_full_pyramid(viewer));
    changed = changed || is_here;
    return {};
}

bool lacks_what_may_come(const FramePlan& plan, bool lacks_memory) {
    return lacks_memory ? lacks_clusters(plan) : !plan.is_settled();
}

bool lacks_memory_now(const Scene& scene, bool& known) {
    return scene.lacks_memory() && !std::exchange(known, true);
}

Result<bool> draw_frame(Viewer& viewer, bool& changed) {
    if (changed) forget_lack_of_memory(viewer);
    const VkExtent2D extent = viewer.window.extent();
    if (extent.width == 0 || extent.height == 0) return false;
    ORO_CHECK(take_size(viewer, extent, changed));
    ORO_CHECK(take_reports(viewer, frames_in_flight - 1));
    if (viewer.is_missing) {
        ORO_TRY(const bool better, viewer.scene->advance(changed ? NextPlan::anyway : NextPlan::if_better));
        changed = changed || better || lacks_memory_now(*viewer.scene, viewer.lacks_memory);
    }
    ORO_TRY(const bool better_second, advance_second(viewer));
    changed = changed || better_second;
    changed = comes_to_rest(viewer) || changed;
    ORO_TRY(const bool other_meshes, follow_with_meshes(viewer));
    ORO_TRY(const bool other_second, follow_with_second_meshes(viewer));
    changed = changed || other_meshes || other_second;
    ORO_CHECK(follow_with_levels(viewer, changed));
    if (!changed) {
        ORO_CHECK(prepare_gpu_pages(viewer));
        return false;
    }
    SubmittedFrame frame;
    frame.times.input = viewer.polled;
    frame.times.begun = Clock::now();
    frame.is_of_moving_eye = is_moving(viewer);
    follow_sun(viewer);
    frame.lines = lines_over_next(viewer);
    frame.step = step_now(viewer);
    // Light asks for casters that are more exact than bounds.
    if (viewer.world.shows_bounds()) frame.step.shadows = frame.step.means = false;
    const Camera camera = scaled_camera(viewer.view.camera, frame.step.scale);
    ORO_TRY(FramePlan plan, plan_now(viewer, camera, frame));
    if (viewer.waits_for_ground) {
        // Asked again with the next page, or soon where some ground is there.
        changed = has_ground(plan) && !viewer.world.shows_bounds();
        return false;
    }
    frame.is_settled = (plan.is_settled() || (viewer.lacks_memory && viewer.shows_all)) &&
                       are_chosen_for(viewer.meshes, viewer.view, viewer.view.camera);
    frame.is_chosen_by_gpu = plan.grids.front().device.chooses;
    frame.times.planned = Clock::now();
    viewer.is_settled = false;
    ORO_CHECK(draw_planned(viewer, std::move(plan), frame));
    viewer.has_picture = true;
    viewer.is_outdated = false;
    if (viewer.kept.handle) ORO_CHECK(finish_frames(viewer));
    viewer.kept = {};
    viewer.part = {static_cast<std::uint32_t>(camera.width_px), static_cast<std::uint32_t>(camera.height_px)};
    viewer.drawn_at = frame.step;
    const bool lacks_images =
        !viewer.report.images_settled || (viewer.two.second && !viewer.two.second->images_settled);
    changed = !frame.is_of_moving_eye && (lacks_images || !frame.step.is_whole());
    return true;
}

Result<void> take_reports(Viewer& viewer, std::size_t left) {
    while (viewer.under_way.size() > left) {
        const SubmittedFrame frame = viewer.under_way.front();
        viewer.under_way.pop_front();
        ORO_TRY(FrameReport report, viewer.renderer.finish());
        take_report(viewer, frame, std::move(report));
        trace_frame(*std::exchange(viewer.to_trace, std::nullopt));
        if (!viewer.report.images_settled) viewer.wants_picture = true;
    }
    return finish_second(viewer, left);
}

Result<void> finish_frames(Viewer& viewer) {
    ORO_CHECK(take_reports(viewer, 0));
    viewer.gpu.wait_idle();
    return {};
}

Result<std::optional<WindowPicture>> picture_to_show(Viewer& viewer) {
    using Shown = std::optional<WindowPicture>;
    const VkExtent2D extent = viewer.window.extent();
    if (extent.width == 0 || extent.height == 0) return Shown();
    if (shows_panorama(viewer)) return panorama_to_show(viewer);
    if (viewer.has_picture)
        return Shown(WindowPicture{viewer.renderer.picture(), viewer.part, nullptr, second_to_show(viewer)});
    if (viewer.kept.handle) return Shown(WindowPicture{viewer.kept, viewer.part});
    ORO_TRY(const std::vector<std::uint8_t> pixels,
            loading_picture(static_cast<int>(extent.width), static_cast<int>(extent.height)));
    ORO_TRY(const Image* const sheet, viewer.window.picture_of(pixels, extent));
    return Shown(WindowPicture{*sheet, extent});
}

void say_what_is_shown(Viewer& viewer) {
    if (!viewer.has_picture) return;
    if (viewer.to_trace) trace_frame(*std::exchange(viewer.to_trace, std::nullopt));
    const bool whole = viewer.is_settled;
    if (!viewer.is_shown) say_waited(viewer, whole ? "first picture" : "first picture, coarse,");
    if (viewer.is_shown && whole && !viewer.is_whole) say_waited(viewer, "full detail");
    viewer.is_shown = true;
    viewer.is_whole = viewer.is_whole || whole;
}

Result<FrameRenderer> renderer_for(const Gpu& gpu, const View& view, const Style& style, RasterPath path,
                                   VkExtent2D extent) {
    FrameRendererOptions options;
    options.extent = extent;
    options.path = path;
    options.waits_for_images = false;
    options.smooth_edges = style.frame.smooth_edges != 0;
    if (view.show && !view.shows_mesh_parts) options.show = shown_by(*view.show);
    if (options.extent.width == 0 || options.extent.height == 0) options.extent = {64, 64};
    return FrameRenderer::create(gpu, options);
}

}  // namespace oro
