#include "apps/output/ground_overlay.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <optional>

#include "apps/output/kml_element.h"
#include "apps/output/map_middle.h"
#include "apps/output/relative_reference.h"
#include "core/earth/ellipsoid.h"

namespace oro {
namespace {

// Longitude, going on past 180, and latitude, in degrees.
using Degrees = glm::dvec2;

// Counter-clockwise from the lower left corner.
using Corners = std::array<Degrees, 4>;

constexpr int steps_across = 16;
constexpr double box_slack_px = 1.0e-3;
// Of the map's shorter side: with more than that between them, corners do not hold a map.
constexpr double most_off_share = 0.25;
// Of twice the way from the middle to the farthest corner: seen whole by 37 degrees or more.
constexpr double range_share = 1.5;

Error no_overlay(const std::string& why) {
    return Error{ErrorKind::usage, "--kml",
                 "a GroundOverlay cannot show this map: " + why + "; choose another --crs, e.g. EPSG:4326"};
}

glm::dvec3 on_ellipsoid_m(const Degrees& place) {
    return ecef_from_geodetic({place.y, place.x, 0.0}).m;
}

// A place of the map, its longitude counted on from another's by steps of less than half a turn.
std::optional<Degrees> place_seen_from(MapPlaces& places, const glm::dvec2& from_px, const Degrees& from,
                                       const glm::dvec2& to_px) {
    constexpr int steps = 4;
    Degrees last = from;
    for (int step = 1; step <= steps; ++step) {
        const glm::dvec2 at_px = glm::mix(from_px, to_px, static_cast<double>(step) / steps);
        const auto place = places.at(at_px.x, at_px.y);
        if (!place) return std::nullopt;
        last = {last.x + normalised_lon_deg(place->lon_deg - last.x), place->lat_deg};
    }
    return last;
}

Result<Corners> corners_of(const MapFrame& file, const MapMiddle& middle, const glm::dvec2& middle_px,
                           MapPlaces& places) {
    const double right = file.width_px, bottom = file.height_px;
    const std::array<glm::dvec2, 4> at_px{{{0.0, bottom}, {right, bottom}, {right, 0.0}, {0.0, 0.0}}};
    Corners corners;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const auto place = place_seen_from(places, middle_px, {middle.lon_deg, middle.lat_deg}, at_px[i]);
        if (!place)
            return no_overlay(
                "a corner of the picture (with the strip of --legend, where it has one) has no place on the "
                "Earth");
        corners[i] = *place;
    }
    return corners;
}

bool is_convex(const Corners& corners) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Degrees along = corners[(i + 1) % 4] - corners[i],
                      next = corners[(i + 2) % 4] - corners[(i + 1) % 4];
        if (!(along.x * next.y - along.y * next.x > 0.0)) return false;
    }
    return true;
}

// Where a viewer lays a place of the picture, in shares of its width and of its height from the top.
Degrees laid(const Corners& corners, double right, double down) {
    const Degrees top = glm::mix(corners[3], corners[2], right),
                  bottom = glm::mix(corners[0], corners[1], right);
    return glm::mix(top, bottom, down);
}

double most_off_m(const MapFrame& file, const Corners& corners, MapPlaces& places) {
    double most = 0.0;
    for (int j = 0; j <= steps_across; ++j) {
        for (int i = 0; i <= steps_across; ++i) {
            const double right = static_cast<double>(i) / steps_across,
                         down = static_cast<double>(j) / steps_across;
            const auto place = places.at(right * file.width_px, down * file.height_px);
            if (!place) continue;
            most = std::max(most, glm::length(on_ellipsoid_m(laid(corners, right, down)) -
                                              on_ellipsoid_m({place->lon_deg, place->lat_deg})));
        }
    }
    return most;
}

// True where the corners are those of a box of meridians and parallels.
bool is_box(const MapFrame& file, const Corners& corners) {
    const Degrees size = corners[2] - corners[0];
    const double slack_lon = box_slack_px * size.x / file.width_px,
                 slack_lat = box_slack_px * size.y / file.height_px;
    return std::abs(corners[3].x - corners[0].x) < slack_lon &&
           std::abs(corners[2].x - corners[1].x) < slack_lon &&
           std::abs(corners[1].y - corners[0].y) < slack_lat &&
           std::abs(corners[2].y - corners[3].y) < slack_lat;
}

std::string look_at(const MapMiddle& middle, const Corners& corners) {
    const glm::dvec3 at_m = on_ellipsoid_m({middle.lon_deg, middle.lat_deg});
    double farthest_m = 0.0;
    for (const Degrees& corner : corners)
        farthest_m = std::max(farthest_m, glm::length(on_ellipsoid_m(corner) - at_m));
    return "  <LookAt>" + kml_element("longitude", middle.lon_deg) + kml_element("latitude", middle.lat_deg) +
           kml_element("altitude", 0.0) + kml_element("heading", middle.up_azimuth_deg) +
           kml_element("tilt", 0.0) + kml_element("range", range_share * 2.0 * farthest_m) +
           "<altitudeMode>clampToGround</altitudeMode></LookAt>\n";
}

std::string lat_lon_box(const Corners& corners) {
    return "  <LatLonBox>" + kml_element("north", corners[2].y) + kml_element("south", corners[0].y) +
           kml_element("east", corners[2].x) + kml_element("west", corners[0].x) + "</LatLonBox>\n";
}

std::string lat_lon_quad(const Corners& corners) {
    std::string text = "  <gx:LatLonQuad><coordinates>";
    for (std::size_t i = 0; i < corners.size(); ++i) {
        char place[80];
        std::snprintf(place, sizeof place, "%s%.9f,%.9f", i == 0 ? "" : " ", corners[i].x, corners[i].y);
        text += place;
    }
    return text + "</coordinates></gx:LatLonQuad>\n";
}

}  // namespace

Result<GroundOverlay> ground_overlay(const MapFrame& map, int legend_px, const std::string& picture_name,
                                     const std::string& attribution) {
    ORO_TRY(const MapMiddle middle, map_middle(map));
    ORO_TRY(MapPlaces places, MapPlaces::of(map));
    MapFrame file = map;
    file.height_px += legend_px;
    ORO_TRY(const Corners corners,
            corners_of(file, middle, {0.5 * map.width_px, 0.5 * map.height_px}, places));
    GroundOverlay overlay;
    overlay.off_px = most_off_m(file, corners, places) / middle.pixel_m;
    if (!is_convex(corners) || !(overlay.off_px < most_off_share * std::min(file.width_px, file.height_px)))
        return no_overlay("it does not lie between its corners as longitudes and latitudes");
    const bool box = overlay.off_px < box_slack_px && is_box(file, corners);
    overlay.kml =
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<kml xmlns=\"http://www.opengis.net/kml/2.2\" "
        "xmlns:gx=\"http://www.google.com/kml/ext/2.2\">\n<GroundOverlay>\n" +
        kml_name_and_description(picture_name, attribution) + look_at(middle, corners) + "  <Icon><href>" +
        reference_to(picture_name) + "</href></Icon>\n" +
        (box ? lat_lon_box(corners) : lat_lon_quad(corners)) + "</GroundOverlay>\n</kml>\n";
    return overlay;
}

}  // namespace oro
