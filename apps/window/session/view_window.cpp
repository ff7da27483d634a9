// orograph view: a window to fly over a region.
#include <algorithm>
#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/command_line/refusals.h"
#include "apps/eye/standpoint.h"
#include "apps/report/json_text.h"
#include "apps/report/progress_bar.h"
#include "apps/report/region_json.h"
#include "apps/report/summit_words.h"
#include "apps/view/view_changes.h"
#include "apps/window/frames.h"
#include "apps/window/kept_settings.h"
#include "apps/window/motion.h"
#include "apps/window/opening.h"
#include "apps/window/pictures.h"
#include "apps/window/projects.h"
#include "apps/window/search.h"
#include "apps/window/second_view.h"
#include "apps/window/session/first_window.h"
#include "apps/window/session/turn.h"
#include "apps/window/window_start.h"
#include "core/lod/ground_means.h"

namespace oro {
namespace {

// Nothing that frames use goes before they end.
struct FramesEnd {
    const Gpu& gpu;
    ~FramesEnd() { gpu.wait_idle(); }
};

Result<void> run_loop(Viewer& viewer, Interface& interface) {
    const FramesEnd end{viewer.gpu};
    Session session{viewer, interface};
    for (;;) {
        if (!viewer.gpu.validation_messages().empty())
            return Error{ErrorKind::failed, "Vulkan validation", viewer.gpu.validation_messages().front()};
        ORO_TRY(const bool stays, turn(session));
        if (!stays) return {};
    }
}

// What a window shows and what its user has done there: it outlives a device.
struct ViewerState {
    WindowOptions options;
    View view{};
    Region region{};
    RegionCuts cuts{};
    std::optional<GridPages> pages{};  // that were read with the region, until a scene takes them
    FirstWindow first{};               // that was opened while the region was read
    Style style{};
    std::string name{};  // of what is shown, in a word
    Clock::time_point started{};
    bool keeps_means{};
    bool is_lost{false};               // the device is: the window goes on with another
    bool is_first{true};               // no device was lost yet
    bool had_two_views{false};         // when it was lost
    std::optional<Project> project{};  // that was asked for, until it is shown
    std::vector<std::string> notes_of_settings{};
    // Of the viewer.
    WindowSettings settings{};
    bool keeps_size{};
    std::unique_ptr<RegionOpening> opening{};
    Film film{};
    std::string project_file{"project.json"}, own_project{};
    Panels panels{};
    std::deque<Message> log{};
    std::vector<std::vector<std::string>> recent{};
    std::optional<VectorChoices> vectors_known{};
    std::vector<std::string> images_known{}, cover_known{};
};

void say_notes_of(const WindowOptions& options, const View& view, const Region& region,
                  const std::string& note_of_style) {
    const bool quiet = options.quiet;
    say_changes(view, quiet);
    say_notes(region, quiet);
    say_summit(view.stood.summit, quiet);
    say_wall(view.stood.wall, quiet);
    if (const std::string note = note_of_year(view.sun); !note.empty()) say(quiet, note);
    if (!note_of_style.empty()) say(quiet, note_of_style);
}

// What is shown, in a word.
std::string name_of_region(const WindowOptions& options) {
    if (!options.region.paths.empty()) return name_of_paths(options.region.paths);
    return std::filesystem::path(options.view_file).filename().string();
}

// What is to be known of the data is in the log; it was printed already.
void note_in_log(Viewer& viewer) {
    for (const std::string& note : all_notes(viewer.region))
        viewer.log.push_back({one_line(note), Clock::now(), false, false});
}

// What a user has done in a window, from one that has it to another: a viewer and what outlives its device.
template <class From, class To>
void move_session(From& from, To& to) {
    to.name = from.name;
    to.keeps_means = from.keeps_means;
    to.settings = from.settings;
    to.keeps_size = from.keeps_size;
    to.opening = std::move(from.opening);
    to.film = std::move(from.film);
    to.project_file = from.project_file;
    to.own_project = from.own_project;
    to.panels = from.panels;
    to.log = std::move(from.log);
    to.recent = std::move(from.recent);
    to.vectors_known = std::move(from.vectors_known);
    to.images_known = std::move(from.images_known);
    to.cover_known = std::move(from.cover_known);
}

// What is known without a device, for another one.
void keep(Viewer& viewer, ViewerState& state) {
    viewer.view = view_alone(viewer);
    // What refers to the region goes first.
    viewer.looking = {};
    viewer.panorama = {};
    state.had_two_views = viewer.two.second != nullptr;
    viewer.two = {};
    viewer.comparing = {};
    viewer.coming.reset();
    viewer.finer.reset();
    viewer.world = {};
    viewer.scene.reset();
    forget_ground(viewer);
    state.options = viewer.options;
    state.view = std::move(viewer.view);
    state.region = std::move(viewer.region);
    state.cuts = std::move(viewer.cuts);
    state.style = std::move(viewer.style);
    move_session(viewer, state);
    state.is_lost = true;
    state.is_first = false;
}

// What a viewer begins with, or goes on with.
Result<void> set_out(Viewer& viewer, ViewerState& state) {
    viewer.started = state.started;
    move_session(state, viewer);
    viewer.gestures.emplace(navigation_of(viewer));
    viewer.jumps = Jumps(users_roll_deg(viewer.view.camera, viewer.options.view.roll_deg));
    fill_search(viewer);
    if (!state.is_first) {
        tell(viewer, "the GPU was lost: this is another start of it");
        say(viewer.options.quiet, "note: " + viewer.message);
        if (state.had_two_views) tell(viewer, "the second view was closed: 2 shows it again");
        return {};
    }
    note_in_log(viewer);
    for (const std::string& note : state.notes_of_settings) tell(viewer, note);
    if (!viewer.options.region.paths.empty()) remember_opened(viewer, viewer.options.region.paths);
    if (!state.project) return {};
    remember_opened(viewer, {viewer.options.view_file});
    return take_project(viewer, *state.project, viewer.options.view_file);
}

// The pages that were read with the region are used once; a scene on another device makes them again.
Result<OpenedScene> scene_of_state(ViewerState& state, const Gpu& gpu, bool quiet,
                                   const RenderProgress& progress) {
    const SceneChoice choice{state.options.memory, quiet, state.keeps_means};
    if (!state.pages) return open_scene(gpu, state.region, state.cuts, state.view, choice, progress);
    GridPages pages = std::move(*std::exchange(state.pages, std::nullopt));
    return first_scene(gpu, state.region, state.cuts, std::move(pages), state.view, choice);
}

// As long as the user stays, or the device lasts.
Result<void> fly(ViewerState& state, ProgressBar& bar) {
    state.is_lost = false;
    const WindowOptions& options = state.options;
    FirstWindow first = std::exchange(state.first, {});
    if (!first.gpu) {
        ORO_TRY(first.gpu, device_of_window());
    }
    const std::unique_ptr<Gpu>& gpu = first.gpu;
    ORO_CHECK(check_window_size(state.view.camera, gpu->report()));
    const bool quiet = options.quiet || !state.is_first;
    ORO_TRY(OpenedScene opened,
            scene_of_state(state, *gpu, quiet, [&](double share) { bar.show(share, "measuring levels"); }));
    bar.clear();
    if (state.is_first)
        say_notes_of(options, state.view, state.region,
                     note_of_missing_footprints(state.style.frame, opened.scene.pages()));
    if (!first.window) ORO_CHECK(show_sheet(first, state.view.camera, state.name));
    const std::unique_ptr<Window>& window = first.window;
    ORO_TRY(const RasterPath path, choose_path(state.view.pipeline, *gpu));
    ORO_TRY(FrameRenderer renderer, renderer_for(*gpu, state.view, state.style, path, window->extent()));
    Viewer viewer{options,
                  std::move(state.view),
                  std::move(state.region),
                  std::move(state.cuts),
                  std::move(state.style),
                  *gpu,
                  nullptr,
                  *window,
                  renderer,
                  path};
    take_scene(viewer, std::move(opened));
    if (gpu->report().kind == VK_PHYSICAL_DEVICE_TYPE_CPU) viewer.detail.begin_with_least();
    ORO_CHECK(set_out(viewer, state));
    Result<void> ended = run_loop(viewer, *first.interface);
    if (ended.ok()) {
        keep_settings(viewer);
        // Reading that is under way ends with its file.
        window->hide();
    }
    if (!ended.ok() && window->has_lost_device()) keep(viewer, state);
    return ended;
}

// How large a window of these options is, where that is known before anything is read.
std::optional<Camera> camera_of_window(const ViewerState& state) {
    if (state.project) return state.view.camera;
    if (!state.options.view.size) return std::nullopt;
    const Result<View> sized = view_without_eye(state.options.view, {});
    return sized.ok() ? std::optional(sized.value().camera) : std::nullopt;
}

// False where the user left while the region was read.
Result<bool> read_region(ViewerState& state, ProgressBar& bar) {
    RegionOpening opening(state.options, state.project);
    ORO_TRY(AwaitedRegion awaited,
            await_region(opening, camera_of_window(state), state.settings.ui_scale, bar));
    if (!awaited.region) return false;
    if (awaited.window) state.first = std::move(*awaited.window);
    state.view = std::move(awaited.region->view);
    state.region = std::move(awaited.region->region);
    state.cuts = std::move(awaited.region->cuts);
    state.pages = std::move(awaited.region->pages);
    return true;
}

}  // namespace

Result<void> run_view(const WindowOptions& asked) {
    if (asked.view.tolerance)
        return refused("--tolerance", "", "is for single pictures: give --accuracy or --tau to a window");
    ViewerState state{asked};
    state.started = Clock::now();
    state.settings = settings_of_user(state.notes_of_settings);
    state.keeps_size = !asked.view.size && asked.view_file.empty();
    state.panels = panels_of_names(state.settings.panels);
    state.options = with_kept_size(asked, state.settings);
    const WindowOptions& options = state.options;
    // Said before anything is read.
    ORO_CHECK(Window::required_extensions());
    ORO_TRY(state.project, project_named_by(state.options));
    if (state.project) state.view = state.project->view;
    ProgressBar bar(options.quiet);
    ORO_TRY(const bool stays, read_region(state, bar));
    if (!stays) return {};
    ORO_TRY(state.style, load_style(state.view, state.region.grids.front().field));
    state.keeps_means = asks_for_means(state.style.frame);
    state.name = name_of_region(options);
    // A device that is lost again so soon is of no use.
    constexpr double soon_s = 60.0;
    for (std::optional<Clock::time_point> lost;; lost = Clock::now()) {
        const Result<void> ended = fly(state, bar);
        if (ended.ok() || !state.is_lost || (lost && seconds_since(*lost) < soon_s)) return ended;
    }
}

}  // namespace oro
