#include "geo/places/geodesic.h"

#include <GeographicLib/Geodesic.hpp>

namespace oro {

GeodesicPath geodesic_between(double from_lat_deg, double from_lon_deg, double to_lat_deg,
                              double to_lon_deg) {
    double distance_m = 0.0, start_deg = 0.0, end_deg = 0.0;
    GeographicLib::Geodesic::WGS84().Inverse(from_lat_deg, from_lon_deg, to_lat_deg, to_lon_deg, distance_m,
                                             start_deg, end_deg);
    return {distance_m, start_deg < 0.0 ? start_deg + 360.0 : start_deg};
}

LatLon geodesic_towards(double from_lat_deg, double from_lon_deg, double bearing_deg, double distance_m) {
    LatLon there{};
    GeographicLib::Geodesic::WGS84().Direct(from_lat_deg, from_lon_deg, bearing_deg, distance_m,
                                            there.lat_deg, there.lon_deg);
    return there;
}

}  // namespace oro
