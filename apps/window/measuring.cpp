#include "apps/window/measuring.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "apps/report/json_text.h"
#include "apps/report/progress_bar.h"
#include "apps/window/window_start.h"
#include "geo/files/whole_file.h"

namespace oro {
namespace {

// Takes what was measured, and finds where its picture goes: on the ground that is shown.
void take_measurement(Viewer& viewer, Measurement found, const TrueGround& ground) {
    constexpr std::size_t most_points = 400, most_corners = 50;
    Measuring& measuring = viewer.measuring;
    measuring.found = std::move(found);
    measuring.line_ecef.clear();
    measuring.corners_ecef.clear();
    const auto on_ground = [&](double lat_deg, double lon_deg) {
        return ecef_from_geodetic({lat_deg, lon_deg, ground.h_m(lat_deg, lon_deg).value_or(0.0)});
    };
    const std::vector<LatLon>& places = measuring.found.places;
    for (std::size_t i = 0; i < places.size(); ++i)
        if (places.size() <= most_corners || i == 0 || i + 1 == places.size())
            measuring.corners_ecef.push_back(on_ground(places[i].lat_deg, places[i].lon_deg));
    if (!measuring.found.profile) return;
    const auto& points = measuring.found.profile->points;
    const std::size_t every = std::max<std::size_t>(1, points.size() / most_points);
    for (std::size_t i = 0; i < points.size(); i += every)
        measuring.line_ecef.push_back(on_ground(points[i].lat_deg, points[i].lon_deg));
    measuring.line_ecef.push_back(measuring.corners_ecef.back());
}

// Measures by one of the functions of measure.h. Figures are those of heights as they are; what is drawn lies
// on those that are shown. What cannot be measured, such as a place twice, is said.
template <class Measure>
Result<void> measure(Viewer& viewer, const Measure& find) {
    ORO_TRY(const RegionGround* const ground, ground_of(viewer));
    std::unique_ptr<const RegionGround> as_it_is;
    if (viewer.view.exaggeration != 1.0) {
        ORO_TRY(as_it_is, RegionGround::of(viewer.region, viewer.cuts, 1.0));
    }
    Result<Measurement> found = find(viewer.view.model.air, (as_it_is ? *as_it_is : *ground).ground());
    if (!found.ok()) {
        tell(viewer, found.error());
        return ground->ground().health();
    }
    take_measurement(viewer, std::move(*found), ground->ground());
    return {};
}

// The places of a line that was drawn; those of a file stay as they are there.
std::vector<LatLon> drawn_places(const Viewer& viewer) {
    const Measurement& found = viewer.measuring.found;
    if (found.profile && !found.profile->line.file.empty()) return {};
    return found.places;
}

}  // namespace

Result<void> add_place(Viewer& viewer, glm::dvec2 point_px) {
    ORO_TRY(const auto seen, seen_at(viewer, point_px));
    if (!seen) {
        tell(viewer, line_of(seen));
        return {};
    }
    std::vector<LatLon> places = drawn_places(viewer);
    places.push_back({seen->lat_deg, seen->lon_deg});
    return measure_places(viewer, places);
}

Result<void> take_back_place(Viewer& viewer) {
    std::vector<LatLon> places = drawn_places(viewer);
    if (!places.empty()) places.pop_back();
    return measure_places(viewer, places);
}

Result<void> measure_places(Viewer& viewer, const std::vector<LatLon>& places) {
    return measure(viewer,
                   [&](const Air& air, const TrueGround& ground) { return measured(places, air, ground); });
}

Result<void> clear_places(Viewer& viewer) {
    return measure_places(viewer, {});
}

bool has_loaded_lines(const View& view) {
    const auto is_line = [](const VectorShape& shape) { return shape.kind == VectorKind::line; };
    const auto has_lines = [&](const VectorFile& file) {
        return std::ranges::any_of(file.layers, [&](const VectorLayer& layer) {
            return std::ranges::any_of(layer.shapes, is_line);
        });
    };
    return view.vectors_read && (std::ranges::any_of(view.vectors_read->overlay, has_lines) ||
                                 std::ranges::any_of(view.vectors_read->names, has_lines));
}

std::vector<LoadedLine> loaded_lines(const View& view) {
    std::vector<LoadedLine> lines;
    if (!view.vectors_read) return lines;
    for (const std::vector<VectorFile>* const files :
         {&view.vectors_read->overlay, &view.vectors_read->names}) {
        for (const VectorFile& file : *files) {
            int number = 0;
            for (std::string& name : names_of_lines(file))
                lines.push_back({file.file, ++number, std::move(name)});
        }
    }
    return lines;
}

Result<void> measure_loaded(Viewer& viewer, const LoadedLine& line) {
    return measure(viewer, [&](const Air& air, const TrueGround& ground) {
        return measured_line(line.file, line.number, air, ground);
    });
}

Result<void> save_profile(Viewer& viewer, const std::string& ending) {
    if (!viewer.measuring.found.profile) return {};
    const std::string name = free_picture_name(time_now_s(), ending);
    const auto written =
        write_whole_file(name, profile_file_text(*viewer.measuring.found.profile, ending), false);
    if (!written.ok()) {
        tell(viewer, written.error());
        return {};
    }
    tell(viewer, written_words(name));
    say(viewer.options.quiet, viewer.message);
    return {};
}

}  // namespace oro
