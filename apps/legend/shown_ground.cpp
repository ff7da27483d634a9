#include "apps/legend/shown_ground.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "apps/eye/standpoint.h"
#include "core/terrain/ground.h"
#include "core/truth/oracle.h"
#include "geo/drape/image_cover.h"
#include "geo/rasters/map_frame.h"

namespace oro {
namespace {

constexpr int columns_of_points = 64, rows_of_points = 48;

struct GroundPlaces {
    std::vector<double> lat_deg, lon_deg;
    double nearest_m{std::numeric_limits<double>::infinity()};
    void take(double lat, double lon) {
        lat_deg.push_back(lat);
        lon_deg.push_back(lon);
    }
};

template <class Each>
void at_each_point(double width_px, double height_px, const Each& each) {
    for (int row = 0; row < rows_of_points; ++row)
        for (int column = 0; column < columns_of_points; ++column)
            each((column + 0.5) / columns_of_points * width_px, (row + 0.5) / rows_of_points * height_px);
}

std::optional<double> ground_at(const View& view, const Region& region, double lat_deg, double lon_deg) {
    return ground_h_m(grid_at(region, lat_deg, lon_deg).field, lat_deg, lon_deg, view.exaggeration);
}

// Of a map, those that have ground.
Result<GroundPlaces> places_of_map(const View& view, const Region& region) {
    GroundPlaces places;
    ORO_TRY(MapPlaces map, MapPlaces::of(*view.map));
    at_each_point(view.map->width_px, view.map->height_px, [&](double x, double y) {
        const auto place = map.at(x, y);
        if (place && ground_at(view, region, place->lat_deg, place->lon_deg))
            places.take(place->lat_deg, place->lon_deg);
    });
    return places;
}

Result<GroundPlaces> places_of_picture(const View& view, const RegionGround& ground) {
    GroundPlaces places;
    const Camera& camera = view.camera;
    const Oracle oracle(ground.ground(), sight_from(camera.eye, view.model.air));
    const double reach_m = sight_reach_m(camera.eye.h_m);
    at_each_point(camera.width_px, camera.height_px, [&](double x, double y) {
        const auto hit = oracle.first_hit(camera.ecef_direction_at({x, y}), reach_m);
        if (!hit) return;
        places.nearest_m = std::min(places.nearest_m, hit->distance_m);
        if (hit->mesh == 0) places.take(hit->point.lat_deg, hit->point.lon_deg);
    });
    // What could not be read counts as void: sight lines went through it.
    ORO_CHECK(ground.ground().health());
    return places;
}

}  // namespace

Result<ShownGround> ground_shown(const View& view, const RegionGround& ground) {
    ORO_TRY(const GroundPlaces places,
            view.map ? places_of_map(view, ground.region()) : places_of_picture(view, ground));
    ShownGround shown;
    shown.nearest_m = places.nearest_m;
    const Geodetic& eye = view.camera.eye;
    if (const auto h_m = ground_at(view, ground.region(), eye.lat_deg, eye.lon_deg))
        shown.eye_over_ground_m = eye.h_m - *h_m;
    std::vector<bool> hidden(places.lat_deg.size());
    if (view.drape_opacity >= 1.0) {
        ORO_TRY(hidden, hidden_by_images(view.images, places.lat_deg, places.lon_deg));
    }
    std::vector<int> codes(hidden.size(), no_cover_code);
    if (view.cover) ORO_CHECK(view.cover->codes_at(places.lat_deg, places.lon_deg, codes));
    shown.under_images = !hidden.empty() && std::ranges::all_of(hidden, [](bool one) { return one; });
    for (std::size_t i = 0; i < codes.size(); ++i) {
        if (hidden[i]) continue;
        if (codes[i] != no_cover_code && view.cover->table().class_of(codes[i]))
            shown.codes.insert(codes[i]);
        else
            shown.by_rule = true;
    }
    return shown;
}

}  // namespace oro
