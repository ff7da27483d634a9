// The size of a cell of places.
#pragma once

namespace oro {

// The size of a cell around a place, WGS84 degrees, 0 or more.
struct CellSize {
    double lat_deg{};
    double lon_deg{};
};

}  // namespace oro
