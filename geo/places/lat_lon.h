// A place on the ellipsoid without a height.
#pragma once

namespace oro {

// A geodetic latitude and longitude in WGS84 degrees. The range is what the function that gives it says.
struct LatLon {
    double lat_deg;
    double lon_deg;
};

}  // namespace oro
