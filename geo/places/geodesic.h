// Distances and directions over the ellipsoid.
#pragma once

namespace oro {

// A geodetic latitude and longitude in WGS84 degrees. The range is what the function that gives it says.
struct LatLon {
    double lat_deg;
    double lon_deg;
};

struct GeodesicPath {
    double distance_m;   // along WGS84
    double bearing_deg;  // true, at the start, [0, 360)
};
// Shortest path between two places. Error: 15 nm (C. F. F. Karney, Algorithms for geodesics, J. Geodesy 87,
// 2013).
GeodesicPath geodesic_between(double from_lat_deg, double from_lon_deg, double to_lat_deg, double to_lon_deg);

// Where one comes to from a place by a direction over a distance; as exact.
LatLon geodesic_towards(double from_lat_deg, double from_lon_deg, double bearing_deg, double distance_m);

}  // namespace oro
