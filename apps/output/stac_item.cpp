#include "apps/output/stac_item.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include "apps/output/relative_reference.h"
#include "apps/report/json_object.h"
#include "apps/report/json_text.h"
#include "core/earth/ellipsoid.h"
#include "geo/files/foreign_text.h"
#include "geo/files/letter_case.h"
#include "geo/rasters/map_frame.h"

namespace oro {
namespace {

using nlohmann::ordered_json;
using Ring =
    std::vector<std::array<double, 2>>;  // longitude, latitude, degrees; the first not again at the end

constexpr int steps_a_side = 16;  // a side of a map is curved on latitudes and longitudes

// Where an item lies.
struct StacPlace {
    ordered_json geometry;  // null: nobody knows
    ordered_json box;
};

// The outline of a map, its longitudes going on past 180 where it does. Empty where a part of it has no
// place.
Ring outline_of(const MapFrame& map) {
    Result<MapPlaces> places = MapPlaces::of(map);
    if (!places.ok()) return {};
    const double right = map.width_px, bottom = map.height_px;
    const std::array<std::array<double, 2>, 5> corners{
        {{0.0, 0.0}, {0.0, bottom}, {right, bottom}, {right, 0.0}, {0.0, 0.0}}};
    Ring ring;
    for (std::size_t side = 0; side + 1 < corners.size(); ++side) {
        for (int step = 0; step < steps_a_side; ++step) {
            const double share = static_cast<double>(step) / steps_a_side;
            const auto place = places->at(std::lerp(corners[side][0], corners[side + 1][0], share),
                                          std::lerp(corners[side][1], corners[side + 1][1], share));
            if (!place) return {};
            const double last = ring.empty() ? 0.0 : ring.back()[0];
            ring.push_back({last + normalised_lon_deg(place->lon_deg - last), place->lat_deg});
        }
    }
    return ring;
}

// The part of a ring on one side of a meridian (Sutherland and Hodgman).
Ring part_of(const Ring& ring, double lon_deg, bool east_of) {
    const auto is_in = [&](const auto& place) { return east_of ? place[0] >= lon_deg : place[0] <= lon_deg; };
    Ring part;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const auto &one = ring[i], &next = ring[(i + 1) % ring.size()];
        if (is_in(one)) part.push_back(one);
        if (is_in(one) == is_in(next)) continue;
        const double share = (lon_deg - one[0]) / (next[0] - one[0]);
        part.push_back({lon_deg, std::lerp(one[1], next[1], share)});
    }
    return part;
}

ordered_json polygon_of(const Ring& ring, double shift_deg) {
    ordered_json places = ordered_json::array();
    for (std::size_t i = 0; i <= ring.size(); ++i) {
        const auto& place = ring[i % ring.size()];
        places.push_back({place[0] + shift_deg, place[1]});
    }
    return ordered_json::array({places});
}

// Counter-clockwise, as RFC 7946 has it.
void turn_right_way(Ring& ring) {
    double twice_area = 0.0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const auto &one = ring[i], &next = ring[(i + 1) % ring.size()];
        twice_area += one[0] * next[1] - next[0] * one[1];
    }
    if (twice_area < 0.0) std::ranges::reverse(ring);
}

StacPlace place_of_map(const MapFrame& map) {
    Ring ring = outline_of(map);
    if (ring.empty()) return {nullptr, nullptr};
    const double turn_deg =
        ring.back()[0] - ring.front()[0] + normalised_lon_deg(ring.front()[0] - ring.back()[0]);
    double south = 90.0, north = -90.0;
    for (const auto& place : ring) south = std::min(south, place[1]), north = std::max(north, place[1]);
    if (std::abs(turn_deg) > 180.0) {  // around a pole
        (std::abs(south) > std::abs(north) ? south : north) =
            std::abs(south) > std::abs(north) ? -90.0 : 90.0;
        const Ring cap{{-180.0, south}, {180.0, south}, {180.0, north}, {-180.0, north}};
        return {json_object("type", "Polygon", "coordinates", polygon_of(cap, 0.0)),
                ordered_json::array({-180.0, south, 180.0, north})};
    }
    turn_right_way(ring);
    const auto [west, east] =
        std::ranges::minmax_element(ring, {}, [](const auto& place) { return place[0]; });
    const ordered_json box =
        ordered_json::array({normalised_lon_deg((*west)[0]), south, normalised_lon_deg((*east)[0]), north});
    for (const double meridian : {-180.0, 180.0}) {
        if ((*west)[0] >= meridian || (*east)[0] <= meridian) continue;
        const ordered_json parts =
            ordered_json::array({polygon_of(part_of(ring, meridian, false), meridian < 0.0 ? 360.0 : 0.0),
                                 polygon_of(part_of(ring, meridian, true), meridian < 0.0 ? 0.0 : -360.0)});
        return {json_object("type", "MultiPolygon", "coordinates", parts), box};
    }
    return {json_object("type", "Polygon", "coordinates", polygon_of(ring, 0.0)), box};
}

StacPlace place_of_eye(const Geodetic& eye) {
    const double lon_deg = normalised_lon_deg(eye.lon_deg);
    return {json_object("type", "Point", "coordinates", ordered_json::array({lon_deg, eye.lat_deg, eye.h_m})),
            ordered_json::array({lon_deg, eye.lat_deg, eye.h_m, lon_deg, eye.lat_deg, eye.h_m})};
}

double azimuth_deg(double deg) {
    const double turned = std::fmod(deg, 360.0);
    return turned < 0.0 ? turned + 360.0 : turned;
}

void put_direction(const View& view, ordered_json& properties) {
    const Attitude& attitude = view.camera.attitude;
    if (view.map) {
        properties["view:off_nadir"] = 0.0;
    } else if (!view.panorama) {
        properties["view:azimuth"] = azimuth_deg(attitude.heading_deg);
        // The extension has none of what looks above level.
        if (attitude.pitch_deg <= 0.0) properties["view:off_nadir"] = 90.0 + attitude.pitch_deg;
    }
    if (view.sun) {
        properties["view:sun_azimuth"] = azimuth_deg(view.sun->azimuth_deg);
        properties["view:sun_elevation"] = view.sun->elevation_deg;
    }
    if (view.map) return;
    properties["orograph:heading_deg"] = attitude.heading_deg;
    properties["orograph:pitch_deg"] = attitude.pitch_deg;
    properties["orograph:roll_deg"] = attitude.roll_deg;
    properties["orograph:fov_deg"] = view.camera.vertical_fov_deg;
}

// The number of a CRS that a map's frame defines as EPSG:2056; nothing of one that is WKT.
std::optional<int> epsg_number(std::string_view definition) {
    constexpr std::string_view authority = "EPSG:";
    if (!definition.starts_with(authority)) return std::nullopt;
    definition.remove_prefix(authority.size());
    int number = 0;
    const auto [end, fault] =
        std::from_chars(definition.data(), definition.data() + definition.size(), number);
    if (fault != std::errc() || end != definition.data() + definition.size()) return std::nullopt;
    return number;
}

void put_projection(const MapFrame& map, ordered_json& properties) {
    if (const std::optional<int> number = epsg_number(map.crs)) {
        properties["proj:epsg"] = *number;
    } else {
        properties["proj:epsg"] = nullptr;
        properties["proj:wkt2"] = map.crs;
    }
    properties["proj:shape"] = ordered_json::array({map.height_px, map.width_px});
    const auto& m = map.crs_from_pixel;
    properties["proj:transform"] = ordered_json::array({m[1], m[2], m[0], m[4], m[5], m[3]});
}

}  // namespace

std::string picture_media_type(const std::string& name, bool is_map) {
    const std::string ending = lower_case(std::filesystem::path(name).extension().string());
    if (ending == ".png") return "image/png";
    if (ending == ".jpg" || ending == ".jpeg") return "image/jpeg";
    if (ending == ".tif" || ending == ".tiff")
        return is_map ? "image/tiff; application=geotiff" : "image/tiff";
    return ending == ".svg" ? "image/svg+xml" : "";
}

std::string stac_item_json(const View& view, const std::string& picture_name,
                           const std::vector<StacAsset>& assets) {
    const StacPlace place = view.map ? place_of_map(*view.map) : place_of_eye(view.camera.eye);
    ordered_json properties = json_object("datetime", time_text(view.time_utc_s));
    put_direction(view, properties);
    ordered_json extensions = ordered_json::array();
    const bool has_direction = std::ranges::any_of(
        properties.items(), [](const auto& one) { return one.key().starts_with("view:"); });
    if (has_direction) extensions.push_back("https://stac-extensions.github.io/view/v1.0.0/schema.json");
    if (view.map) {
        extensions.push_back("https://stac-extensions.github.io/projection/v1.1.0/schema.json");
        put_projection(*view.map, properties);
    }
    ordered_json named = ordered_json::object();
    for (const StacAsset& asset : assets)
        named[asset.key] = json_object("href", "./" + reference_to(asset.file_name), "type", asset.media_type,
                                       "roles", ordered_json::array({asset.role}));
    ordered_json item = json_object("type", "Feature", "stac_version", "1.0.0", "stac_extensions", extensions,
                                    "id", foreign_text(std::filesystem::path(picture_name).stem().string()),
                                    "geometry", place.geometry);
    if (!place.box.is_null()) item["bbox"] = place.box;
    item["properties"] = properties;
    item["links"] = ordered_json::array();
    item["assets"] = named;
    return json_text(item, true) + "\n";
}

}  // namespace oro
