#include "apps/window/maps.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "apps/report/figures.h"
#include "apps/report/json_text.h"
#include "apps/view/view_words.h"
#include "apps/window/begun_command.h"
#include "apps/window/viewer.h"
#include "apps/window/window_start.h"
#include "core/earth/ellipsoid.h"

namespace oro {
namespace {

std::string box_text(const BoundingBox& box) {
    char text[120];
    std::snprintf(text, sizeof text, "%.4f,%.4f,%.4f,%.4f", box.west_deg, box.south_deg, box.east_deg,
                  box.north_deg);
    return text;
}

// What maps take of a view's looks.
ViewOptions map_looks(const View& view, bool contours) {
    const ViewOptions all = look_options_of(view);
    ViewOptions options;
    options.style = contours ? "contours" : all.style;
    options.exaggeration = all.exaggeration;
    options.drape = all.drape;
    options.drape_opacity = all.drape_opacity;
    options.drape_values = all.drape_values;
    options.landcover = all.landcover;
    options.sun = all.sun;
    options.sun_time = all.sun_time;
    options.shadows = all.shadows;
    options.sky_openness = all.sky_openness;
    options.trees = all.trees;
    return options;
}

}  // namespace

std::optional<BoundingBox> box_of_places(std::vector<SeenFromEye> places) {
    if (places.empty()) return std::nullopt;
    const auto middle = places.begin() + static_cast<std::ptrdiff_t>(places.size() / 2);
    std::ranges::nth_element(places, middle, {}, &SeenFromEye::distance_m);
    const SeenFromEye half = *middle;
    constexpr double least_side_deg = 0.002;
    double south = half.lat_deg, north = half.lat_deg, west = 0.0, east = 0.0;
    for (const SeenFromEye& place : places) {
        if (place.distance_m > 3.0 * half.distance_m) continue;
        south = std::min(south, place.lat_deg);
        north = std::max(north, place.lat_deg);
        const double east_of_half = std::remainder(place.lon_deg - half.lon_deg, 360.0);
        west = std::min(west, east_of_half);
        east = std::max(east, east_of_half);
    }
    const double grow_lat = std::max(0.0, 0.5 * (least_side_deg - (north - south)));
    const double grow_lon = std::max(0.0, 0.5 * (least_side_deg - (east - west)));
    return BoundingBox{normalised_lon_deg(half.lon_deg + west - grow_lon), std::max(-90.0, south - grow_lat),
                       normalised_lon_deg(half.lon_deg + east + grow_lon), std::min(90.0, north + grow_lat)};
}

std::vector<std::string> map_words(const View& view, const MapChoice& choice, const std::string& out) {
    RegionOptions region = region_options_of(view);
    region.bbox = choice.box;
    std::vector<std::string> words{"shot"};
    const auto add = [&](const std::vector<std::string>& more) {
        words.insert(words.end(), more.begin(), more.end());
    };
    add(words_of(region));
    add(words_of(map_looks(view, choice.contours)));
    add({"--ortho"});
    if (choice.resolution_m > 0.0) add({"--resolution", all_digits(choice.resolution_m)});
    add({"--out", out});
    return words;
}

Result<MapChoice> proposed_map(Viewer& viewer) {
    constexpr int across = 15;
    std::vector<SeenFromEye> places;
    const Camera& camera = viewer.view.camera;
    for (int i = 0; i < across * across; ++i) {
        const glm::dvec2 share((i % across + 0.5) / across, (i / across + 0.5) / across);
        ORO_TRY(const auto seen, seen_at(viewer, share * glm::dvec2(camera.width_px, camera.height_px)));
        if (seen) places.push_back({seen->lat_deg, seen->lon_deg, seen->seen_distance_m});
    }
    MapChoice choice;
    if (const auto box = box_of_places(std::move(places))) choice.box = box_text(*box);
    return choice;
}

Result<void> propose_map(Viewer& viewer) {
    ORO_TRY(const MapChoice proposed, proposed_map(viewer));
    if (proposed.box.empty()) tell(viewer, "no ground is seen of which a map could be drawn", true);
    if (viewer.map_choice) viewer.map_choice->box = proposed.box;
    return {};
}

void draw_map(Viewer& viewer, const MapChoice& choice) {
    const auto box = parse_bounding_box(choice.box);
    if (!box.ok()) return tell(viewer, box.error());
    CommandToBegin command;
    command.what = "the map";
    command.out = free_picture_name(time_now_s(), "-map" + choice.ending);
    command.words = map_words(viewer.view, choice, command.out);
    command.words.emplace_back("--quiet");
    begin_command(viewer, std::move(command));
}

}  // namespace oro
