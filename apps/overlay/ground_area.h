// Whether a place on the ground lies in a polygon.
#pragma once

#include <cstddef>
#include <vector>

#include "geo/vectors/vector_file.h"

namespace oro {

// The area of a polygon without its holes; its sides are even in latitude and longitude, the shorter way
// round, as its outline is drawn. Where rings cross or overlap, what an odd number of them goes round is in
// it. One that goes round a pole has no area: which side of it is meant nobody says.
class GroundArea {
  public:
    explicit GroundArea(const VectorShape& polygon);

    // False everywhere where it has none. Cost: the sides near that latitude.
    [[nodiscard]] bool holds(double lat_deg, double lon_deg) const;
    [[nodiscard]] bool is_empty() const { return sides_.empty(); }

  private:
    struct Side {
        double south_deg, north_deg;        // not equal
        double at_south_deg, at_north_deg;  // longitudes, counted on from the polygon's first place
    };
    void add_ring(const std::vector<VectorPlace>& ring, double near_deg);
    void sort_into_bands();
    [[nodiscard]] std::size_t band_of(double lat_deg) const;

    std::vector<Side> sides_;
    double west_deg_{}, east_deg_{}, south_deg_{}, north_deg_{};
    std::vector<std::size_t> begins_;    // of each band of latitudes in in_bands_, and the end
    std::vector<std::size_t> in_bands_;  // numbers of sides
};

}  // namespace oro
