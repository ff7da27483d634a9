#include "apps/window/viewer.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <system_error>
#include <utility>

#include "apps/eye/standpoint.h"
#include "apps/report/progress_bar.h"
#include "core/made_pages/made_pages.h"
#include "geo/posts/source_at.h"

namespace oro {
namespace {

bool traces() {
    static const bool asked = std::getenv("OROGRAPH_TRACE_WINDOW") != nullptr;
    return asked;
}

}  // namespace

void Panels::open(bool Panels::*panel) {
    // Sides of fewer panels end in nulls.
    constexpr std::array<std::array<bool Panels::*, 5>, 3> sides{
        {{&Panels::layers, &Panels::measure, &Panels::messages, &Panels::film, &Panels::two_views},
         {&Panels::sun, &Panels::statistics, &Panels::place, &Panels::viewshed, &Panels::panorama},
         {&Panels::keys, &Panels::files, &Panels::picture, &Panels::project}}};
    for (const auto& side : sides) {
        if (std::ranges::find(side, panel) == side.end()) continue;
        for (bool Panels::*const other : side)
            if (other != nullptr) this->*other = false;
    }
    this->*panel = true;
}

void Panels::toggle(bool Panels::*panel) {
    if (this->*panel)
        this->*panel = false;
    else
        open(panel);
}

const HeightField& field_below(const Viewer& viewer) {
    const Geodetic& eye = viewer.view.camera.eye;
    return grid_at(viewer.region, eye.lat_deg, eye.lon_deg).field;
}

Result<const RegionGround*> ground_of(Viewer& viewer) {
    if (!viewer.ground && viewer.ground_work) {
        ORO_TRY(viewer.ground, std::exchange(viewer.ground_work, nullptr)->take());
    }
    if (!viewer.ground) {
        ORO_TRY(viewer.ground, RegionGround::of(viewer.region, viewer.cuts, viewer.view.exaggeration));
    }
    return viewer.ground.get();
}

Result<const RegionGround*> ground_so_far(Viewer& viewer) {
    if (viewer.ground) return viewer.ground.get();
    if (!viewer.ground_work)
        viewer.ground_work = std::make_unique<BackgroundWork<std::unique_ptr<const RegionGround>>>(
            [&region = std::as_const(viewer.region), &cuts = std::as_const(viewer.cuts),
             exaggeration = viewer.view.exaggeration](const auto&, const std::stop_token&) {
                return RegionGround::of(region, cuts, exaggeration);
            });
    if (!viewer.ground_work->ready()) return static_cast<const RegionGround*>(nullptr);
    return ground_of(viewer);
}

void forget_ground(Viewer& viewer) {
    viewer.ground_work.reset();
    viewer.ground.reset();
    viewer.lines_in_motion.forget();
    viewer.lines.clear();
}

Result<std::optional<SeenPlace>> seen_at(Viewer& viewer, glm::dvec2 point_px) {
    ORO_TRY(const RegionGround* const ground, ground_of(viewer));
    return place_seen(viewer.view, *ground, point_px);
}

Result<PickedPlace> picked_at(Viewer& viewer, glm::dvec2 point_px) {
    PickedPlace picked;
    picked.point_px = point_px;
    ORO_TRY(picked.seen, seen_at(viewer, point_px));
    if (!picked.seen) return picked;
    ORO_TRY(const RegionGround* const ground, ground_of(viewer));
    const SeenPlace& seen = *picked.seen;
    const auto number = ground->ground().grid_at(seen.lat_deg, seen.lon_deg);
    if (!number) return picked;
    const RegionGrid& grid = ground->grid(*number);
    picked.geoid = grid.geoid;
    if (const SourceReport* const source = source_at(grid, seen.lat_deg, seen.lon_deg)) {
        picked.source_crs = source->crs;
        if (source->spacing_m > 0.0) picked.source_spacing_m = source->spacing_m;
    }
    if (!is_coarse(viewer) && viewer.scene) {
        ORO_TRY(picked.certificate,
                viewer.certificates.at(*viewer.scene, *number, seen.lat_deg, seen.lon_deg, viewer.view));
    }
    const auto [row, column] = grid.field.grid.post_at(seen.lat_deg, seen.lon_deg);
    const auto slope = ground->ground().surface(*number).slope_at(row, column);
    if (!slope) return picked;
    picked.slope_deg = deg_from_radians(Radians{std::atan(slope->steepness() / viewer.view.exaggeration)});
    if (slope->steepness() > 0.0)
        picked.aspect_deg =
            std::fmod(deg_from_radians(Radians{std::atan2(-slope->east, -slope->north)}) + 360.0, 360.0);
    return picked;
}

const std::optional<HomeArrow>& way_home(Viewer& viewer, double inset_px) {
    WayHome& way = viewer.way_home;
    const Camera& camera = viewer.view.camera;
    const bool is_known = way.ground && is_same_view(camera, way.of) && camera.width_px == way.of.width_px &&
                          camera.height_px == way.of.height_px;
    if (is_known) return way.arrow;
    // Finding where the ground is takes a moment: not until the eye has rested where the middle shows none.
    if (!way.ground && (!viewer.in_middle || viewer.in_middle->seen)) return way.arrow;
    if (!way.ground) way.ground = ground_box(ground_points(viewer.region, viewer.view.exaggeration));
    way.of = camera;
    way.arrow = way.ground ? home_arrow(camera, *way.ground, inset_px) : std::nullopt;
    return way.arrow;
}

bool is_moving(const Viewer& viewer) {
    constexpr double settle_s = 0.15;
    return viewer.follows_eye && seconds_since(viewer.moved) < settle_s;
}

bool is_coarse(const Viewer& viewer) {
    return viewer.finer || viewer.coming || viewer.world.shows_bounds();
}

std::string progress_words(const Viewer& viewer) {
    if (viewer.waits_for_ground) return "loading";
    // Done is what is shown, not what is measured: 100 % is never said.
    if (viewer.finer && viewer.finer->share() < 0.99) {
        char text[60];
        std::snprintf(text, sizeof text, "preparing full detail, %.0f %%",
                      std::floor(100.0 * viewer.finer->share()));
        return text;
    }
    if (viewer.world.shows_bounds() && viewer.is_missing) return "loading";
    if (viewer.world.shows_bounds()) {
        char text[80];
        std::snprintf(text, sizeof text, "loading full detail, within %.3g px so far",
                      viewer.world.tau_factor() * viewer.view.tau_px);
        return text;
    }
    if (is_coarse(viewer)) return "loading full detail";
    if (viewer.two.work) return "preparing the second view";
    const bool lacks_second = viewer.two.second && viewer.two.second->is_missing;
    if (viewer.is_missing || lacks_second) return "loading";
    const bool is_coarser = viewer.lacks_memory && !viewer.shows_all;
    const bool is_second_coarser =
        viewer.two.second && viewer.two.second->lacks_memory && !viewer.two.second->shows_all;
    if (is_coarser || is_second_coarser) return "GPU memory is full: coarser than asked for";
    return viewer.is_outdated ? "drawing" : "";
}

void tell(Viewer& viewer, const std::string& text, bool is_error) {
    constexpr std::size_t most = 500;
    viewer.message = text;
    if (text.empty()) return;
    viewer.log.push_back({text, Clock::now(), is_error});
    if (viewer.log.size() > most) viewer.log.pop_front();
}

void tell(Viewer& viewer, const Error& why) {
    tell(viewer, why.line(), true);
    say(false, viewer.message);
}

std::string written_words(const std::string& file) {
    std::error_code fault;
    const std::filesystem::path folder = std::filesystem::current_path(fault);
    if (fault || std::filesystem::path(file).is_absolute()) return "wrote " + file;
    return "wrote " + file + " into " + folder.string();
}

void tell_written(Viewer& viewer, const std::string& file, const Result<void>& written) {
    tell(viewer, written.ok() ? written_words(file) : written.error().line(), !written.ok());
}

void trace_state(Viewer& viewer) {
    if (!traces()) return;
    const Camera& camera = viewer.view.camera;
    const double N_m = field_below(viewer).undulation.at_m(camera.eye.lat_deg, camera.eye.lon_deg);
    char eye[160];
    std::snprintf(eye, sizeof eye, "%.6f° %.6f°  %.1f m above sea level  heading %.1f°", camera.eye.lat_deg,
                  camera.eye.lon_deg, camera.eye.h_m - N_m, camera.attitude.heading_deg);
    const auto part = [](const std::string& text) { return text.empty() ? "" : text + "  |  "; };
    const std::string moving =
        viewer.flies || viewer.playing || (viewer.gestures && viewer.gestures->is_moving()) ? "moving" : "";
    std::string line = viewer.search.is_open
                           ? "Go to: " + viewer.search.text + "_"
                           : part(progress_words(viewer)) + part(moving) + part(viewer.message) + eye;
    if (viewer.search.is_open && !viewer.search.error.empty()) line += "  |  " + viewer.search.error;
    if (!viewer.is_settled) line += "  |  drawing";
    if (line == viewer.traced) return;
    std::fprintf(stderr, "state: %s\n", one_line(line).c_str());
    viewer.traced = line;
}

void trace_frame(const SubmittedFrame& frame) {
    if (!traces()) return;
    const auto at_s = [](Clock::time_point at) {
        return std::chrono::duration<double>(at.time_since_epoch()).count();
    };
    const FrameTimes& times = frame.times;
    const char* const eye = !frame.is_of_moving_eye  ? "at rest"
                            : frame.is_chosen_by_gpu ? "moving, pages chosen by the GPU"
                                                     : "moving";
    std::fprintf(stderr,
                 "frame: input %.4f begun %.4f planned %.4f drawn %.4f shown %.4f scale %.2f tau %.1f %s\n",
                 at_s(times.input), at_s(times.begun), at_s(times.planned), at_s(times.drawn),
                 at_s(Clock::now()), frame.step.scale, frame.step.tau_factor, eye);
    if (const std::uint64_t blocks = blocks_measured_here(); blocks > 0)
        std::fprintf(stderr, "levels: %llu blocks measured by the thread that draws\n",
                     static_cast<unsigned long long>(blocks));
}

}  // namespace oro
