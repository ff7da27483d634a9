// orograph view: a window to fly over a region.
#include <algorithm>
#include <filesystem>
#include <utility>

#include "apps/command_line/refusals.h"
#include "apps/eye/asked_summit.h"
#include "apps/eye/standpoint.h"
#include "apps/report/json_text.h"
#include "apps/report/progress_bar.h"
#include "apps/report/region_json.h"
#include "apps/report/summit_words.h"
#include "apps/view/view_changes.h"
#include "apps/window/frames.h"
#include "apps/window/kept_settings.h"
#include "apps/window/loading_picture.h"
#include "apps/window/motion.h"
#include "apps/window/opening.h"
#include "apps/window/projects.h"
#include "apps/window/search.h"
#include "apps/window/session/turn.h"
#include "apps/window/window_start.h"
#include "core/lod/ground_means.h"

namespace oro {
namespace {

Result<void> run_loop(Viewer& viewer, Interface& interface) {
    Session session{viewer, interface};
    for (;;) {
        if (!viewer.gpu.validation_messages().empty())
            return Error{ErrorKind::failed, "Vulkan validation", viewer.gpu.validation_messages().front()};
        ORO_TRY(const bool stays, turn(session));
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

// Shows that something comes while the first frame is being made.
Result<std::unique_ptr<Window>> open_window(const Gpu& gpu, const Camera& camera, const std::string& name) {
    ORO_TRY(std::unique_ptr<Window> window,
            Window::create(gpu, camera.width_px, camera.height_px, one_line("Orograph - " + name)));
    const VkExtent2D extent = window->extent();
    if (extent.width == 0 || extent.height == 0) return window;
    ORO_TRY(const std::vector<std::uint8_t> pixels,
            loading_picture(static_cast<int>(extent.width), static_cast<int>(extent.height)));
    ORO_TRY(const Image* const sheet, window->picture_of(pixels, extent));
    if (const auto shown = window->show({*sheet, extent}); !shown.ok()) return shown.error();
    return window;
}

}  // namespace

Result<void> run_view(const WindowOptions& asked) {
    if (asked.view.tolerance)
        return refused("--tolerance", "", "is for single pictures: give --accuracy or --tau to a window");
    const Clock::time_point started = Clock::now();
    std::vector<std::string> notes_of_settings;
    const WindowSettings settings = settings_of_user(notes_of_settings);
    WindowOptions options = with_kept_size(asked, settings);
    ORO_TRY(const std::vector<const char*> extensions, Window::required_extensions());
    ORO_TRY(const std::optional<Project> project, project_named_by(options));
    ProgressBar bar(options.quiet);
    View view = project ? project->view : View();
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
    const bool keeps_means = asks_for_means(style.frame);
    ORO_TRY(OpenedScene opened,
            open_scene(*gpu, region, cuts, view, {options.memory, options.quiet, keeps_means},
                       [&](double share) { bar.show(share, "measuring levels"); }));
    bar.clear();
    ORO_CHECK(
        say_notes_of(options, view, region, note_of_missing_footprints(style.frame, opened.scene.pages())));
    ORO_TRY(const std::unique_ptr<Window> window, open_window(*gpu, view.camera, name_of_region(options)));
    ORO_TRY(const std::unique_ptr<Interface> interface, Interface::create(*window));
    ORO_TRY(const RasterPath path, choose_path(view.pipeline, *gpu));
    ORO_TRY(FrameRenderer renderer, renderer_for(*gpu, view, style, path, window->extent()));
    Viewer viewer{options, std::move(view), std::move(region), std::move(cuts), style,
                  *gpu,    nullptr,         *window,           renderer,        path};
    take_scene(viewer, std::move(opened));
    viewer.started = started;
    viewer.keeps_means = keeps_means;
    viewer.name = name_of_region(options);
    viewer.settings = settings;
    viewer.keeps_size = !asked.view.size && asked.view_file.empty();
    viewer.panels = panels_of_names(settings.panels);
    note_in_log(viewer);
    for (const std::string& note : notes_of_settings) tell(viewer, note);
    viewer.gestures.emplace(navigation_of(viewer));
    fill_search(viewer);
    if (!options.region.paths.empty()) remember_opened(viewer, options.region.paths);
    viewer.jumps = Jumps(users_roll_deg(viewer.view.camera, options.view.roll_deg));
    if (project) {
        remember_opened(viewer, {options.view_file});
        ORO_CHECK(take_project(viewer, *project, options.view_file));
    }
    const Result<void> left = run_loop(viewer, *interface);
    if (left.ok()) keep_settings(viewer);
    return left;
}

}  // namespace oro
