#include "geo/places/geodesic_area.h"

#include <GeographicLib/Geodesic.hpp>
#include <GeographicLib/PolygonArea.hpp>
#include <cmath>

namespace oro {

GeodesicArea geodesic_area(std::span<const LatLon> corners) {
    GeographicLib::PolygonArea polygon(GeographicLib::Geodesic::WGS84());
    for (const LatLon& corner : corners) polygon.AddPoint(corner.lat_deg, corner.lon_deg);
    GeodesicArea area;
    polygon.Compute(false, true, area.perimeter_m, area.area_m2);
    area.area_m2 = std::abs(area.area_m2);
    return area;
}

}  // namespace oro
