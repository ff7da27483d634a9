#include "apps/output/map_middle.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "core/earth/ellipsoid.h"

namespace oro {

Result<MapMiddle> map_middle(const MapFrame& map) {
    ORO_TRY(MapPlaces places, MapPlaces::of(map));
    const double x_px = 0.5 * map.width_px, y_px = 0.5 * map.height_px;
    const auto middle = places.at(x_px, y_px);
    const auto above = places.at(x_px, y_px - 0.5), below = places.at(x_px, y_px + 0.5);
    const auto left = places.at(x_px - 0.5, y_px), right = places.at(x_px + 0.5, y_px);
    if (!middle || !above || !below || !left || !right)
        return Error{ErrorKind::usage, "the map's middle",
                     "has no place on the Earth, which --kml and --geopose need"};
    const auto on_ellipsoid = [](const MapPlace& place) {
        return ecef_from_geodetic({place.lat_deg, place.lon_deg, 0.0}).m;
    };
    const glm::dvec3 up = on_ellipsoid(*above) - on_ellipsoid(*below);
    const glm::dvec3 across = on_ellipsoid(*right) - on_ellipsoid(*left);
    const glm::dvec3 up_enu = glm::transpose(ecef_from_enu(middle->lat_deg, middle->lon_deg)) * up;
    MapMiddle found;
    found.lat_deg = middle->lat_deg;
    found.lon_deg = normalised_lon_deg(middle->lon_deg);
    found.up_azimuth_deg = deg_from_radians(Radians{std::atan2(up_enu.x, up_enu.y)});
    found.pixel_m = std::min(glm::length(up), glm::length(across));
    return found;
}

}  // namespace oro
