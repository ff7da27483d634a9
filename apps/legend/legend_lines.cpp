// The words of a legend.
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <glm/geometric.hpp>

#include "apps/cover/canopy_words.h"
#include "apps/detail/detail_words.h"
#include "apps/eye/standpoint.h"
#include "apps/legend/legend.h"
#include "apps/report/figures.h"
#include "apps/report/region_json.h"
#include "apps/view/trees_of_view.h"
#include "core/growth/near_trees.h"
#include "core/growth/tree_reach.h"
#include "core/terrain/ground.h"
#include "geo/canopy/raised_region.h"
#include "geo/refined/refined_region.h"
#include "shaders/shared_growth.h"
#include "shaders/shared_meadow.h"

namespace oro {
namespace {

constexpr double highest_grass_m = 1.5;

template <class... Values>
std::string text_of(const char* format, Values... values) {
    char text[240];
    std::snprintf(text, sizeof text, format, values...);
    return text;
}

const char* wind_of(double azimuth_deg) {
    static constexpr std::array names{"north", "north-east", "east", "south-east",
                                      "south", "south-west", "west", "north-west"};
    const double turned = azimuth_deg - 360.0 * std::floor(azimuth_deg / 360.0);
    return names[static_cast<std::size_t>(std::lround(turned / 45.0)) % names.size()];
}

std::string place_text(double lat_deg, double lon_deg) {
    return text_of("%.5f° %s, %.5f° %s", std::abs(lat_deg), lat_deg < 0.0 ? "S" : "N", std::abs(lon_deg),
                   lon_deg < 0.0 ? "W" : "E");
}

// Whole metres below 100 km.
std::string height_text(double H_m) {
    if (std::abs(H_m) >= 1.0e5) return figure(H_m / 1000.0) + " km";
    const long whole = std::lround(H_m);
    return (whole < 0 ? "−" : "") + grouped(static_cast<std::uint64_t>(std::abs(whole))) + " m";
}

std::string eye_line(const View& view, const Region& region) {
    const Camera& camera = view.camera;
    const Geodetic& eye = camera.eye;
    const double H_m = eye.h_m - region.grids.front().field.undulation.at_m(eye.lat_deg, eye.lon_deg);
    std::string line =
        "Eye: " + place_text(eye.lat_deg, eye.lon_deg) + ", " + height_text(H_m) + " above sea level";
    const auto ground_m = ground_h_m(grid_at(region, eye.lat_deg, eye.lon_deg).field, eye.lat_deg,
                                     eye.lon_deg, view.exaggeration);
    const double canopy_m =
        canopy_over_ground_m(region.grids.front(), eye.lat_deg, eye.lon_deg).value_or(0.0);
    if (ground_m && eye.h_m >= *ground_m)
        line += ", " + height_text(eye.h_m - *ground_m + view.exaggeration * canopy_m) + " above the ground";
    const Attitude& attitude = camera.attitude;
    line += text_of("; looking %s (%.0f°)", wind_of(attitude.heading_deg), attitude.heading_deg);
    if (std::abs(attitude.pitch_deg) >= 0.05)
        line += text_of(", %.3g° %s", std::abs(attitude.pitch_deg), attitude.pitch_deg < 0.0 ? "down" : "up");
    line += text_of("; angle of view %.3g°", camera.vertical_fov_deg);
    if (view.exaggeration != 1.0) line += "; heights exaggerated " + figure(view.exaggeration) + " times";
    return line;
}

std::string map_line(const View& view) {
    const MapFrame& map = *view.map;
    const std::string unit = map_unit(map.crs);
    std::string line = "Map: " + map_crs_name(map.crs) +
                       text_of("; a pixel is %.6g ", map.crs_from_pixel[1]) + (unit == "metre" ? "m" : unit) +
                       " wide";
    const double off_deg = std::remainder(view.camera.attitude.heading_deg, 360.0);
    if (std::abs(off_deg) >= 0.05)
        line += text_of("; up on the map is %.1f° %s of true north", std::abs(off_deg),
                        off_deg > 0.0 ? "east" : "west");
    if (view.exaggeration != 1.0) line += "; heights exaggerated " + figure(view.exaggeration) + " times";
    return line;
}

std::string sun_line(const Style& style) {
    const SunDirection& sun = style.sun;
    std::string line = text_of("Sun: from the %s (%.0f°), %.3g° %s the horizon", wind_of(sun.azimuth_deg),
                               sun.azimuth_deg - 360.0 * std::floor(sun.azimuth_deg / 360.0),
                               std::abs(sun.elevation_deg), sun.elevation_deg < 0.0 ? "below" : "above");
    if (sun.time) line += ", " + sun.time->text;
    if (sun.is_usual) line += " (ten by the sun there; no time was asked for)";
    return line;
}

// What the sources ask to be said; of others their names.
std::string data_line(const View& view, const Region& region) {
    if (const std::string asked = attribution_of(region); !asked.empty())
        return "Heights: " + one_line(asked);
    std::vector<const SourceReport*> sources;
    for (const RegionGrid& grid : region.grids) {
        if (grid.detail) continue;
        for (const SourceReport& source : grid.sources) sources.push_back(&source);
    }
    std::string names;
    constexpr std::size_t most = 4;
    for (std::size_t i = 0; i < sources.size() && view.tells_paths; ++i) {
        if (i == most) {
            names += " and " + counted(sources.size() - most, "file more", "files more");
            break;
        }
        names += (i == 0 ? "" : ", ") + one_line(std::filesystem::path(sources[i]->path).filename().string());
    }
    return "Heights: " + (names.empty() ? counted(sources.size(), "file", "files") : names);
}

std::string cover_line(const View& view) {
    std::string line = "Land cover: classes of " + one_line(view.cover->table().title);
    if (!view.tells_paths) return line;
    for (const std::string& file : view.cover_choice.files)
        line += ", " + one_line(std::filesystem::path(file).filename().string());
    return line;
}

// Whether a picture may show something that is drawn within so much of the eye and is so high at most: on a
// map nothing of the kind is drawn.
bool may_show_within(double reach_m, double tall_m, const View& view, const ShownGround* shown) {
    if (view.map) return false;
    return !shown || shown->nearest_m <= reach_m || shown->eye_over_ground_m <= tall_m * view.exaggeration;
}

// What covers the ground and is not in the data.
void add_invented_ground(const View& view, const Style& style, const ShownGround* shown,
                         std::vector<std::string>& lines) {
    const gpu::uint on = style.frame.materials.on;
    const bool hidden = shown && shown->under_images;
    if (style.frame.colour_by == gpu::colour_by_cover && !hidden)
        lines.emplace_back(view.cover ? "Ground cover: of " + view.cover->table().title +
                                            "; where that holds nothing invented, by a rule"
                                      : "Ground cover: invented, by a rule of height, slope and latitude");
    if (on != 0 && !hidden)
        lines.emplace_back(view.cover ? "Colours within a class, and clefts of rock: invented, by a rule"
                                      : "Fields with hedges, and clefts of rock: invented, by a rule");
    if ((on & gpu::materials_with_trees) != 0) {
        if (may_show_within(reach_of_trees_m(view.camera, view.tau_px), highest_tree_m, view, shown))
            lines.emplace_back("Trees: invented, by a rule, where the ground cover is forest");
    } else if (const std::string why = why_without_trees(view); !why.empty() && on != 0) {
        lines.emplace_back("Trees: " + why);
    }
    const auto meadow_m = static_cast<double>(gpu::meadow_reach_m);
    if ((on & gpu::materials_with_grass) != 0 && !hidden &&
        may_show_within(meadow_m, highest_grass_m, view, shown))
        lines.emplace_back("Grass within 60 m: invented, by a rule, where the ground cover is meadow");
}

}  // namespace

std::vector<std::string> legend_lines(const View& view, const Region& region, const Style& style,
                                      const ShownGround* shown) {
    std::vector<std::string> lines{view.map ? map_line(view) : eye_line(view, region)};
    if (style.frame.light != gpu::light_none) lines.push_back(sun_line(style));
    add_invented_ground(view, style, shown, lines);
    if (style.frame.contours.interval_m > 0.0F)
        lines.push_back(text_of("Contour lines: every %.6g m, every fifth thicker",
                                static_cast<double>(style.frame.contours.interval_m)));
    lines.push_back(data_line(view, region));
    if (view.cover && style.frame.colour_by == gpu::colour_by_cover) lines.push_back(cover_line(view));
    if (view.canopy) lines.push_back(canopy_words(*view.canopy, region, view.tells_paths));
    if (const RegionGrid* const detail = detail_of(region)) lines.push_back(detail_words(*detail->detail));
    std::string images;
    for (const std::string& file : view.drape)
        if (view.tells_paths)
            images +=
                (images.empty() ? "" : ", ") + one_line(std::filesystem::path(file).filename().string());
    if (!images.empty()) lines.push_back("Images: " + images);
    const std::string detail = view.mesh_level ? "; clusters of level " + std::to_string(*view.mesh_level)
                                               : "; detail that is left out moves nothing by more than " +
                                                     text_of("%.3g px", view.tau_px);
    lines.push_back("Drawn by Orograph " OROGRAPH_VERSION + detail);
    return lines;
}

std::optional<double> metres_a_pixel(const View& view, const std::optional<SeenPlace>& middle) {
    const double per_m = 2.0 * view.camera.half_fov_tangent().y / view.camera.height_px;
    if (view.map) return view.camera.eye.h_m * per_m;
    if (!middle) return std::nullopt;
    return middle->seen_distance_m * per_m;
}

double north_in_picture_deg(const View& view, const std::optional<SeenPlace>& middle) {
    const Camera& camera = view.camera;
    // A compass before the viewer is level, and leans as the horizon does.
    double north_deg = -camera.attitude.heading_deg - (view.map ? 0.0 : camera.attitude.roll_deg);
    if (!view.map && middle) {
        const glm::dmat3 view_from_enu =
            camera.view_from_ecef() * ecef_from_enu(middle->lat_deg, middle->lon_deg);
        const glm::dvec3 &north = view_from_enu[1], &up = view_from_enu[2];
        // The eye looks along -z: that is how far above the level plane it stands, as a sine.
        if (up.z >= std::sin(radians_from_deg(least_seen_level_deg).rad))
            north_deg = deg_from_radians(Radians{std::atan2(north.x, north.y)});
    }
    return north_deg - 360.0 * std::floor(north_deg / 360.0);
}

double round_length(double most) {
    const double ten = std::pow(10.0, std::floor(std::log10(most)));
    for (const double times : {5.0, 2.0})
        if (times * ten <= most * (1.0 + 1.0e-9)) return times * ten;
    return ten;
}

}  // namespace oro
