// orograph view: a window to fly over a region.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "apps/accuracy/beyond_data.h"
#include "apps/command_line/refusals.h"
#include "apps/commands/commands.h"
#include "apps/drawing/background_pyramid_build.h"
#include "apps/drawing/drape.h"
#include "apps/drawing/mesh_choice.h"
#include "apps/drawing/picking.h"
#include "apps/drawing/pipeline_choice.h"
#include "apps/drawing/region_scene.h"
#include "apps/eye/asked_summit.h"
#include "apps/eye/standpoint.h"
#include "apps/legend/legend.h"
#include "apps/output/picture_file.h"
#include "apps/report/json_text.h"
#include "apps/report/progress_bar.h"
#include "apps/report/region_json.h"
#include "apps/report/summit_words.h"
#include "apps/view/style.h"
#include "apps/view/view_changes.h"
#include "apps/window/jump.h"
#include "apps/window/loading_picture.h"
#include "apps/window/show_legend.h"
#include "apps/window/steering.h"
#include "apps/window/window_start.h"
#include "apps/window/written_frame.h"
#include "core/base/elapsed.h"
#include "core/base/parallel.h"
#include "core/lod/ground_means.h"
#include "core/truth/true_surface.h"
#include "geo/places/place.h"

namespace oro {
namespace {

// Everything that lives while the window is open.
struct Viewer {
    const WindowOptions& options;
    View view;
    Region region;
    RegionCuts cuts;  // of all its grids
    Style style;
    const Gpu& gpu;
    std::unique_ptr<Scene> scene;  // of every n-th post while `finer` is being measured
    Window& window;
    FrameRenderer& renderer;
    RasterPath path;
    bool asking_place{false};
    std::string place_text{};
    std::string shown_title{};
    std::string message{};                         // shown in the title until the eye moves
    bool is_missing{};                             // something that the last frame should have had
    std::unique_ptr<const RegionGround> ground{};  // made when it is first asked, for all questions after
    std::unique_ptr<BackgroundPyramidBuild>
        finer{};                                   // the levels that the view asks for, until they are here
    std::unique_ptr<Scene> coming{};               // of them, until what a picture needs is on the GPU
    Clock::time_point coming_since{};
    Clock::time_point started{};
    bool is_shown{};          // once ground is, or a view that has none
    bool is_whole{};          // once all detail is
    bool is_exposed{};        // what the window shows was lost
    bool waits_for_ground{};  // what is in view is not on the GPU yet
    Clock::time_point waiting_since{};
    VkExtent2D loading_px{};  // of the sheet that is shown meanwhile
    bool has_picture{};       // the renderer's picture is of the window's size, and drawn
    Jumps jumps{};
    Clock::time_point moved{};  // when the eye last did
    bool follows_eye{};         // what is fitted to a view is that of an eye that moved, until it rests
    ShowLegend legend{};
};

// How long the user has waited for it.
void say_waited(const Viewer& viewer, const char* what) {
    char text[100];
    std::snprintf(text, sizeof text, "%s after %.2f s", what, seconds_since(viewer.started));
    say(viewer.options.quiet, text);
}

// The finest grid below the eye.
const HeightField& field_below(const Viewer& viewer) {
    const Geodetic& eye = viewer.view.camera.eye;
    return grid_at(viewer.region, eye.lat_deg, eye.lon_deg).field;
}

Result<const RegionGround*> ground_of(Viewer& viewer) {
    if (!viewer.ground) {
        ORO_TRY(viewer.ground, RegionGround::of(viewer.region, viewer.cuts, viewer.view.exaggeration));
    }
    return viewer.ground.get();
}

Result<std::optional<SeenPlace>> seen_at(Viewer& viewer, glm::dvec2 point_px) {
    ORO_TRY(const RegionGround* const ground, ground_of(viewer));
    return place_seen(viewer.view, *ground, point_px);
}

std::string title_of(const Viewer& viewer) {
    if (viewer.asking_place) return "Go to: " + viewer.place_text + "_";
    const Camera& camera = viewer.view.camera;
    const double N_m = field_below(viewer).undulation.at_m(camera.eye.lat_deg, camera.eye.lon_deg);
    char text[160];
    std::snprintf(text, sizeof text, "%.6f° %.6f°  %.1f m above sea level  heading %.1f°", camera.eye.lat_deg,
                  camera.eye.lon_deg, camera.eye.h_m - N_m, camera.attitude.heading_deg);
    // Done is what is shown, not what is measured: 100 % is never said.
    char coarse[60] = "";
    if (viewer.waits_for_ground)
        std::snprintf(coarse, sizeof coarse, "loading  |  ");
    else if (viewer.finer && viewer.finer->share() < 0.99)
        std::snprintf(coarse, sizeof coarse, "preparing full detail, %.0f %%  |  ",
                      std::floor(100.0 * viewer.finer->share()));
    else if (viewer.finer || viewer.coming)
        std::snprintf(coarse, sizeof coarse, "loading full detail  |  ");
    return coarse + (viewer.message.empty() ? "" : viewer.message + "  |  ") + text;
}

// The eye is elsewhere at once, and rests there.
void be_at(Viewer& viewer, const Camera& camera, const std::string& message) {
    viewer.view.camera = camera;
    viewer.follows_eye = false;
    viewer.message = message;
}

void stay(Viewer& viewer, const Error& why) {
    viewer.message = why.line();
    say(false, viewer.message);
}

// Enter, once more after a jump: on the place; then on what is higher near it.
void stand(Viewer& viewer) {
    const auto there = viewer.jumps.stand(viewer.view.camera, viewer.region, viewer.view.exaggeration);
    if (!there.ok()) return stay(viewer, there.error());
    if (!*there) return;
    std::string message = "Backspace goes back";
    if (const auto& higher = viewer.jumps.higher())
        message += ", Enter stands on the highest post near: " + wall_words(*higher);
    be_at(viewer, **there, message);
}

// A place with a height in the ground: the eye is over it.
std::string message_of_jump(const Place& place, const Camera& there) {
    if (!place.height_m) return "Enter stands on it, Backspace goes back";
    const double lifted_m = there.eye.h_m - *place.height_m;
    if (!(lifted_m > 0.0)) return "Backspace goes back";
    char text[100];
    std::snprintf(text, sizeof text, "the ground there is higher: the eye is lifted by %.1f m, ", lifted_m);
    return text + std::string("Backspace goes back");
}

void jump(Viewer& viewer) {
    viewer.asking_place = false;
    if (viewer.place_text.find_first_not_of(" \t") == std::string::npos) return;
    viewer.jumps.stay();
    const auto place = parse_place(viewer.place_text);
    if (!place.ok()) return stay(viewer, place.error());
    const auto there = viewer.jumps.to(viewer.view.camera, *place, viewer.region, viewer.view.exaggeration,
                                       viewer.place_text);
    if (!there.ok()) return stay(viewer, there.error());
    be_at(viewer, *there, message_of_jump(*place, *there));
}

void go_back(Viewer& viewer) {
    if (const auto there = viewer.jumps.back(viewer.view.camera)) be_at(viewer, *there, "");
}

// Typing a place: characters, backspace, enter, escape.
void ask_place(Viewer& viewer, const WindowInput& input) {
    viewer.place_text += input.typed;
    if (input.backspace && !viewer.place_text.empty()) {
        while (!viewer.place_text.empty() &&
               (static_cast<unsigned char>(viewer.place_text.back()) & 0xC0U) == 0x80U)
            viewer.place_text.pop_back();
        if (!viewer.place_text.empty()) viewer.place_text.pop_back();
    }
    if (input.escape) viewer.asking_place = false;
    if (input.enters > 0) jump(viewer);
    for (int enter = 1; enter < input.enters; ++enter) stand(viewer);
}

// Whether what is shown is of every n-th post.
bool is_coarse(const Viewer& viewer) {
    return viewer.finer || viewer.coming;
}

// The measured levels become a scene that is not shown yet; waits for them where they are not ready.
Result<void> begin_finer_scene(Viewer& viewer) {
    GridPages pages(1);
    ORO_TRY(pages.front(), viewer.finer->wait());
    viewer.finer.reset();
    const View& view = viewer.view;
    ORO_TRY(RegionScene whole,
            scene_of_region(viewer.gpu, viewer.region, viewer.cuts, std::move(pages),
                            {view.exaggeration, memory_of_pages(view, viewer.options.memory), view.heights,
                             asks_for_means(viewer.style.frame)}));
    ORO_CHECK(lay_images(view, viewer.options.memory, viewer.gpu, whole.scene, true));
    viewer.coming = std::make_unique<Scene>(std::move(whole.scene));
    viewer.coming_since = Clock::now();
    return {};
}

void show_finer_scene(Viewer& viewer) {
    viewer.scene = std::move(viewer.coming);
    viewer.is_missing = false;
}

// Whole pictures.
Tile whole_of(const Camera& camera) {
    return {0, 0, camera.width_px, camera.height_px, {0.5, 0.5}};
}

// What a coarse picture needs of the scene that comes: with that it takes the place of the one that is shown,
// and the eye stays. Until then the window goes on. True once it has.
Result<bool> swap_in_full_pyramid(Viewer& viewer) {
    constexpr double first_tau_px = 4.0, longest_s = 10.0;
    Scene& scene = *viewer.coming;
    const Camera& camera = viewer.view.camera;
    scene.require_fields(viewer.style.frame);
    ORO_TRY(const FramePlan plan,
            scene.plan(
                {camera, whole_of(camera), std::max(first_tau_px, viewer.view.tau_px), viewer.view.model}));
    // Where the GPU has no room for all of it, it never is whole.
    if (!plan.is_settled() && seconds_since(viewer.coming_since) < longest_s) {
        const Result<bool> advanced = scene.advance();
        return advanced.ok() ? Result<bool>(false) : advanced;
    }
    show_finer_scene(viewer);
    return true;
}

// All of that at once.
Result<void> wait_for_finer_scene(Viewer& viewer) {
    if (viewer.finer) ORO_CHECK(begin_finer_scene(viewer));
    if (viewer.coming) show_finer_scene(viewer);
    return {};
}

void show_title(Viewer& viewer) {
    const std::string title = title_of(viewer);
    if (title == viewer.shown_title) return;
    viewer.window.set_title(one_line(title));
    viewer.shown_title = title;
}

// A sun by time stands elsewhere over every place.
void follow_sun(Viewer& viewer) {
    std::optional<SunDirection>& sun = viewer.view.sun;
    if (!sun || !sun->time) return;
    aim_sun(sun, viewer.view.camera.eye);
    light_by(*sun, viewer.style.frame);
}

Result<void> take_picture(Viewer& viewer) {
    follow_sun(viewer);
    if (is_coarse(viewer)) {
        // A picture is what its view says, and nothing coarser.
        viewer.message = "the picture waits for finer detail";
        show_title(viewer);
        ORO_CHECK(wait_for_finer_scene(viewer));
    }
    viewer.view.time_utc_s = time_now_s();
    const PictureFiles files = picture_files(free_picture_name(viewer.view.time_utc_s));
    const Camera& camera = viewer.view.camera;
    ORO_TRY(const auto middle, seen_at(viewer, {0.5 * camera.width_px, 0.5 * camera.height_px}));
    ORO_CHECK(fit_to_view(viewer.style, viewer.view, viewer.region.grids.front().field));
    ORO_TRY(const RegionGround* const ground, ground_of(viewer));
    viewer.view.legend = has_own_legend(viewer.view);
    ORO_TRY(const auto strip, strip_of(viewer.view, viewer.region, viewer.style, middle));
    const auto written = write_picture(files, false, viewer.view, viewer.region, *ground, middle, viewer.gpu,
                                       *viewer.scene, viewer.style, strip, {});
    viewer.message = written.ok() ? "wrote " + files.picture : written.error().line();
    say(viewer.options.quiet && written.ok(), viewer.message);
    if (!written.ok() || viewer.options.quiet) return {};
    ORO_TRY(const UnseenGround unseen, unseen_in(viewer.view, viewer.region, usual_unseen_ceiling_m));
    if (const std::string note = unseen_sentence(unseen); !note.empty()) say(false, "note: " + note);
    return {};
}

// Tells what the picture that is shown has under the cursor.
Result<void> pick(Viewer& viewer, glm::dvec2 point_px) {
    ORO_TRY(const auto place, seen_at(viewer, point_px));
    viewer.message = line_of(place);
    std::printf("%s\n", viewer.message.c_str());
    std::fflush(stdout);  // whoever reads along has it now
    return {};
}

// One turn of the loop: input, then a frame where something has changed. False when the user leaves.
Result<bool> turn(Viewer& viewer, bool& changed) {
    const bool can_draw = viewer.window.extent().width > 0;  // not so while minimised
    const double wait_s = changed && can_draw ? 0.0 : viewer.is_missing || viewer.coming ? 0.005 : 0.05;
    const WindowInput input = viewer.window.poll(wait_s);
    if (input.closed) return false;
    viewer.is_exposed = viewer.is_exposed || input.exposed;
    if (viewer.asking_place) {
        ask_place(viewer, input);
        changed = changed || !viewer.asking_place;
    } else if (input.escape) {
        return false;
    } else if (input.go_to) {
        viewer.asking_place = true;
        viewer.place_text.clear();
        // While a slow frame is drawn, people type on: what follows the G belongs to the place.
        WindowInput after = input;
        const std::size_t g = input.typed.find_first_of("gG");
        after.typed = g == std::string::npos ? "" : input.typed.substr(g + 1);
        ask_place(viewer, after);
        changed = changed || !viewer.asking_place;
    } else if (input.backspace || input.enters > 0) {
        if (input.backspace) go_back(viewer);
        for (int enter = input.backspace ? 1 : 0; enter < input.enters; ++enter) stand(viewer);
        changed = true;
    } else {
        // What is clicked at is the picture that is shown, before the eye moves on.
        if (input.picked_px) ORO_CHECK(pick(viewer, *input.picked_px));
        const FlightStep step = step_of(input, viewer.view.camera);
        if (moves(step)) {
            viewer.view.camera =
                flown(viewer.view.camera, step, field_below(viewer), viewer.view.exaggeration);
            viewer.message.clear();
            viewer.jumps.moved();
            viewer.moved = Clock::now();
            viewer.follows_eye = changed = true;
        }
        if (input.take_picture) {
            ORO_CHECK(take_picture(viewer));
            changed = true;  // it may have brought finer detail
        }
    }
    // The eye stands on ground that was asked for: it ends as a page does that cannot be drawn.
    ORO_CHECK(viewer.region.health());
    show_title(viewer);
    return true;
}

// Some time after the eye has moved it rests: contour lines, which stayed, are then those of its view, and
// what is written over pictures is there again.
bool comes_to_rest(Viewer& viewer) {
    constexpr double rest_s = 0.4;
    if (!viewer.follows_eye || seconds_since(viewer.moved) < rest_s) return false;
    viewer.follows_eye = false;
    return viewer.style.contours_by_view || has_writing(viewer.view, viewer.style);
}

// Over a frame that is whole, of an eye that rests. Finding it takes too long for an eye that moves.
Result<void> write_over(Viewer& viewer, const FrameReport& drawn) {
    const bool whole = !viewer.is_missing && drawn.images_settled && !is_coarse(viewer);
    if (viewer.follows_eye || !whole || !has_writing(viewer.view, viewer.style)) return {};
    ORO_TRY(const RegionGround* const ground, ground_of(viewer));
    return write_over_frame(viewer.gpu, *viewer.scene, viewer.view, ground->ground(), viewer.style,
                            viewer.path, viewer.renderer);
}

bool has_ground(const FramePlan& plan) {
    return std::ranges::any_of(plan.grids, [](const GridPlan& grid) { return !grid.pages.empty(); });
}

// Whether ground is in view of which nothing is there yet. A grid beside others that have some is waited for
// a little while: nothing says then that its ground is not void.
bool lacks_ground(Viewer& viewer, const FramePlan& plan) {
    constexpr double longest_s = 2.0;
    const auto lacks = [](const GridPlan& grid) { return grid.pages_wanted > 0 && grid.pages.empty(); };
    if (std::ranges::none_of(plan.grids, lacks)) return false;
    if (!viewer.waits_for_ground) viewer.waiting_since = Clock::now();
    return !has_ground(plan) || seconds_since(viewer.waiting_since) < longest_s;
}

// A sheet that says so, where no picture of the window's size was drawn.
Result<void> show_loading(Viewer& viewer) {
    const VkExtent2D extent = viewer.window.extent();
    const bool is_there =
        extent.width == viewer.loading_px.width && extent.height == viewer.loading_px.height;
    if ((is_there && !viewer.is_exposed) || extent.width == 0) return {};
    ORO_TRY(const std::vector<std::uint8_t> pixels,
            loading_picture(static_cast<int>(extent.width), static_cast<int>(extent.height)));
    ORO_TRY(const bool shown, viewer.window.show_pixels(pixels, extent));
    if (shown) viewer.loading_px = extent;
    viewer.is_exposed = !shown;
    return {};
}

// The picture that was shown last, where a window over it has gone; the sheet where there is none of this
// size.
Result<void> show_again(Viewer& viewer) {
    if (!viewer.is_shown || !viewer.has_picture) return show_loading(viewer);
    if (!viewer.is_exposed) return {};
    ORO_TRY(const bool shown, viewer.window.show(viewer.renderer.picture()));
    viewer.is_exposed = !shown;
    return {};
}

// A window's size is its camera's and its renderer's.
Result<void> take_size(Viewer& viewer, const VkExtent2D& extent, bool& changed) {
    if (extent.width == viewer.renderer.extent().width && extent.height == viewer.renderer.extent().height)
        return {};
    changed = true;
    viewer.has_picture = false;
    return viewer.renderer.resize(extent);
}

void say_what_is_shown(Viewer& viewer, bool whole) {
    if (!viewer.is_shown) say_waited(viewer, whole ? "first picture" : "first picture, coarse,");
    if (viewer.is_shown && whole && !viewer.is_whole) say_waited(viewer, "full detail");
    viewer.is_shown = true;
    viewer.is_whole = viewer.is_whole || whole;
}

// What a frame would be drawn from now, and what of it is missing.
Result<FramePlan> plan_now(Viewer& viewer) {
    const Camera& camera = viewer.view.camera;
    viewer.scene->require_fields(viewer.style.frame);
    ORO_TRY(FramePlan plan,
            viewer.scene->plan({camera, whole_of(camera), viewer.view.tau_px, viewer.view.model}));
    viewer.is_missing = !plan.is_settled();
    viewer.waits_for_ground = lacks_ground(viewer, plan);
    if (viewer.is_shown || plan.wants_pages()) return plan;
    // A view of another place: told where the title is read, and where messages are.
    const auto nothing = nothing_in_view(viewer.view, viewer.region, viewer.options.view_file);
    viewer.message = nothing.ok() ? *nothing : nothing.error().what;
    say(viewer.options.quiet, "note: " + viewer.message);
    show_title(viewer);
    return plan;
}

// Draws with what is on the GPU; what is missing comes in the background and is drawn when it is there.
Result<void> draw_frame(Viewer& viewer, bool& changed) {
    const VkExtent2D extent = viewer.window.extent();
    if (extent.width == 0 || extent.height == 0) return {};
    ORO_CHECK(take_size(viewer, extent, changed));
    if (viewer.is_missing) {
        ORO_TRY(const bool better, viewer.scene->advance());
        changed = changed || better;
    }
    changed = comes_to_rest(viewer) || changed;
    if (!changed) return show_again(viewer);
    viewer.view.camera.width_px = static_cast<int>(extent.width);
    viewer.view.camera.height_px = static_cast<int>(extent.height);
    follow_sun(viewer);
    ORO_TRY(FramePlan plan, plan_now(viewer));
    if (viewer.waits_for_ground) {
        // Asked again with the next page, or soon where some ground is there.
        changed = has_ground(plan);
        return show_again(viewer);
    }
    const bool is_settled = plan.is_settled();
    ORO_CHECK(fit_to_view(viewer.style, viewer.view, viewer.region.grids.front().field,
                          viewer.follows_eye ? Eye::moves : Eye::rests));
    ORO_TRY(const FrameReport drawn,
            viewer.renderer.draw(std::move(plan), viewer.style.frame, 0, 1, viewer.scene->drapes()));
    viewer.scene->apply_feedback(drawn.feedback);
    ORO_CHECK(write_over(viewer, drawn));
    const int every = is_coarse(viewer) ? coarse_step(viewer.region.grids.front().field) : 1;
    ORO_CHECK(viewer.legend.lay_over(viewer.view, viewer.region, viewer.style, every, viewer.renderer));
    viewer.has_picture = true;
    viewer.loading_px = {};
    ORO_TRY(const bool shown, viewer.window.show(viewer.renderer.picture()));
    changed = !shown || !drawn.images_settled;
    viewer.is_exposed = viewer.is_exposed && !shown;
    if (shown) say_what_is_shown(viewer, is_settled && drawn.images_settled && !is_coarse(viewer));
    return {};
}

// Measured levels take the place of coarse ones once they are there.
Result<void> refine(Viewer& viewer, bool& changed) {
    if (viewer.finer && viewer.finer->ready()) ORO_CHECK(begin_finer_scene(viewer));
    if (!viewer.coming || viewer.waits_for_ground) return {};
    ORO_TRY(const bool is_here, swap_in_full_pyramid(viewer));
    changed = changed || is_here;
    return {};
}

Result<void> run_loop(Viewer& viewer) {
    bool changed = true;
    show_title(viewer);
    for (;;) {
        ORO_CHECK(refine(viewer, changed));
        ORO_CHECK(draw_frame(viewer, changed));
        if (!viewer.gpu.validation_messages().empty())
            return Error{ErrorKind::failed, "Vulkan validation", viewer.gpu.validation_messages().front()};
        ORO_TRY(const bool stays, turn(viewer, changed));
        if (!stays) return {};
    }
}

Result<void> say_notes_of(const WindowOptions& options, const View& view, const Region& region,
                          const std::string& note_of_style) {
    const bool quiet = options.quiet;
    say_changes(view, quiet);
    say_notes(region, quiet);
    ORO_TRY(const auto summit, asked_summit(options.view, region, view.exaggeration));
    say_summit(summit, quiet);
    ORO_TRY(const auto wall, wall_near(options.view, region, view.exaggeration));
    say_wall(wall, quiet);
    if (const std::string note = note_of_year(view.sun); !note.empty()) say(quiet, note);
    if (!note_of_style.empty()) say(quiet, note_of_style);
    return {};
}

// Shows that something comes while the first frame is being made.
Result<std::unique_ptr<Window>> open_window(const Gpu& gpu, const Camera& camera) {
    ORO_TRY(std::unique_ptr<Window> window,
            Window::create(gpu, camera.width_px, camera.height_px, "loading  |  Orograph"));
    const VkExtent2D extent = window->extent();
    if (extent.width == 0 || extent.height == 0) return window;
    ORO_TRY(const std::vector<std::uint8_t> pixels,
            loading_picture(static_cast<int>(extent.width), static_cast<int>(extent.height)));
    if (const auto shown = window->show_pixels(pixels, extent); !shown.ok()) return shown.error();
    return window;
}

}  // namespace

Result<void> run_view(const WindowOptions& options) {
    if (options.view.tolerance)
        return refused("--tolerance", "", "is for single pictures: give --accuracy or --tau to a window");
    const Clock::time_point started = Clock::now();
    ORO_TRY(const std::vector<const char*> extensions, Window::required_extensions());
    ProgressBar bar(options.quiet);
    View view;
    Region region;
    ORO_CHECK(open_flight(
        options, [&](double share, const std::string& what) { bar.show(share, "reading " + what); }, view,
        region));
    ORO_TRY(RegionCuts cuts, cut_regions(region));
    ORO_TRY(const Style style, load_style(view, region.grids.front().field));
    GpuOptions gpu_options = gpu_options_from_environment();
    gpu_options.instance_extensions = extensions;
    gpu_options.presents = true;
    ORO_TRY(const std::unique_ptr<Gpu> gpu, Gpu::create(gpu_options));
    ORO_CHECK(check_window_size(view.camera, gpu->report()));
    const bool coarse_first = measures_long(region);
    ORO_TRY(GridPages pages,
            first_pages(region, cuts, view, [&](double share) { bar.show(share, "measuring levels"); }));
    ORO_TRY(const bool clusters, draws_clusters(region, view));
    ORO_TRY(RegionScene whole,
            scene_of_region(*gpu, region, cuts, std::move(pages),
                            {view.exaggeration, memory_of_pages(view, options.memory), view.heights,
                             asks_for_means(style.frame), clusters, view.mesh_level}));
    Scene& scene = whole.scene;
    ORO_CHECK(lay_images(view, options.memory, *gpu, scene, options.quiet));
    bar.clear();
    ORO_CHECK(say_notes_of(options, view, region, note_of_missing_footprints(style.frame, scene.pages())));
    ORO_TRY(const std::unique_ptr<Window> window, open_window(*gpu, view.camera));
    FrameRendererOptions renderer_options;
    renderer_options.extent = window->extent();
    ORO_TRY(renderer_options.path, choose_path(view.pipeline, *gpu));
    renderer_options.waits_for_images = false;
    renderer_options.smooth_edges = style.frame.smooth_edges != 0;
    if (view.show) renderer_options.show = shown_by(*view.show);
    if (renderer_options.extent.width == 0) renderer_options.extent = {64, 64};
    ORO_TRY(FrameRenderer renderer, FrameRenderer::create(*gpu, renderer_options));
    Viewer viewer{options,
                  std::move(view),
                  std::move(region),
                  std::move(cuts),
                  style,
                  *gpu,
                  std::make_unique<Scene>(std::move(scene)),
                  *window,
                  renderer,
                  renderer_options.path};
    viewer.started = started;
    viewer.jumps = Jumps(users_roll_deg(viewer.view.camera, options.view.roll_deg));
    if (coarse_first)
        viewer.finer = std::make_unique<BackgroundPyramidBuild>(viewer.region, viewer.view.exaggeration);
    return run_loop(viewer);
}

}  // namespace oro
