#include "apps/overlay/ground_area.h"

#include <algorithm>
#include <cmath>

namespace oro {
namespace {

// The same longitude in the turn that is nearest to another.
double near_to(double lon_deg, double near_deg) {
    return near_deg + std::remainder(lon_deg - near_deg, 360.0);
}

}  // namespace

GroundArea::GroundArea(const VectorShape& polygon) {
    if (polygon.paths.empty() || polygon.paths.front().empty()) return;
    // Holes are counted in the turn that the outer ring is in.
    double near_deg = polygon.paths.front().front().lon_deg;
    for (const std::vector<VectorPlace>& ring : polygon.paths) {
        add_ring(ring, near_deg);
        if (sides_.empty()) return;  // it goes round a pole, or is a line
        if (&ring != &polygon.paths.front()) continue;
        const auto [west, east] = std::minmax_element(
            sides_.begin(), sides_.end(),
            [](const Side& one, const Side& other) { return one.at_south_deg < other.at_south_deg; });
        near_deg = 0.5 * (west->at_south_deg + east->at_south_deg);
    }
    west_deg_ = south_deg_ = 1.0e9;
    east_deg_ = north_deg_ = -1.0e9;
    for (const Side& side : sides_) {
        west_deg_ = std::min({west_deg_, side.at_south_deg, side.at_north_deg});
        east_deg_ = std::max({east_deg_, side.at_south_deg, side.at_north_deg});
        south_deg_ = std::min(south_deg_, side.south_deg);
        north_deg_ = std::max(north_deg_, side.north_deg);
    }
    sort_into_bands();
}

void GroundArea::add_ring(const std::vector<VectorPlace>& ring, double near_deg) {
    const std::size_t first_side = sides_.size();
    double from_deg = near_to(ring.front().lon_deg, near_deg);
    const double first_deg = from_deg;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const VectorPlace &from = ring[i], &to = ring[(i + 1) % ring.size()];
        const double to_deg = near_to(to.lon_deg, from_deg);
        if (from.lat_deg < to.lat_deg) sides_.push_back({from.lat_deg, to.lat_deg, from_deg, to_deg});
        if (from.lat_deg > to.lat_deg) sides_.push_back({to.lat_deg, from.lat_deg, to_deg, from_deg});
        from_deg = to_deg;
    }
    if (std::abs(from_deg - first_deg) > 180.0) sides_.resize(first_side);
}

std::size_t GroundArea::band_of(double lat_deg) const {
    const auto bands = static_cast<double>(begins_.size() - 1);
    const double place = (lat_deg - south_deg_) / (north_deg_ - south_deg_) * bands;
    return static_cast<std::size_t>(std::clamp(place, 0.0, bands - 1.0));
}

// As many bands as there are sides, fewer where sides are long: their list stays within a few times that.
void GroundArea::sort_into_bands() {
    constexpr std::size_t most_bands = 65536;
    for (std::size_t bands = std::min(sides_.size(), most_bands);; bands = (bands + 1) / 2) {
        begins_.assign(bands + 1, 0);
        std::size_t sum = 0;
        for (const Side& side : sides_) sum += band_of(side.north_deg) - band_of(side.south_deg) + 1;
        if (sum > 8 * sides_.size() && bands > 1) continue;
        for (const Side& side : sides_) {
            for (std::size_t band = band_of(side.south_deg); band <= band_of(side.north_deg); ++band)
                ++begins_[band + 1];
        }
        for (std::size_t band = 0; band < bands; ++band) begins_[band + 1] += begins_[band];
        in_bands_.resize(sum);
        std::vector<std::size_t> next(begins_.begin(), begins_.end() - 1);
        for (std::size_t i = 0; i < sides_.size(); ++i) {
            const std::size_t last = band_of(sides_[i].north_deg);
            for (std::size_t band = band_of(sides_[i].south_deg); band <= last; ++band)
                in_bands_[next[band]++] = i;
        }
        return;
    }
}

bool GroundArea::holds(double lat_deg, double lon_deg) const {
    if (sides_.empty() || !(lat_deg >= south_deg_ && lat_deg <= north_deg_)) return false;
    const double lon = west_deg_ + std::remainder(lon_deg - west_deg_ - 180.0, 360.0) + 180.0;
    if (!(lon <= east_deg_)) return false;
    bool inside = false;
    const std::size_t band = band_of(lat_deg);
    for (std::size_t i = begins_[band]; i < begins_[band + 1]; ++i) {
        const Side& side = sides_[in_bands_[i]];
        if (lat_deg < side.south_deg || lat_deg >= side.north_deg) continue;
        const double share = (lat_deg - side.south_deg) / (side.north_deg - side.south_deg);
        const double at_deg = side.at_south_deg + share * (side.at_north_deg - side.at_south_deg);
        if (lon < at_deg) inside = !inside;
    }
    return inside;
}

}  // namespace oro
