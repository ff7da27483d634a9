#include "geo/sources/raster_place.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "core/earth/ellipsoid.h"

namespace oro {
namespace {

Error reason(const std::string& what) {
    return Error{ErrorKind::failed, "", what};
}

struct Spot {
    double lon_deg;
    double lat_deg;
};

// Posts to WGS84 degrees.
class Outwards {
  public:
    Outwards(const Source& source, OGRSpatialReferenceH horizontal)
        : crs_from_post_(source.crs_from_post),
          transformation_(OCTNewCoordinateTransformation(horizontal, wgs84_degrees().get())) {}
    [[nodiscard]] bool usable() const { return transformation_ != nullptr; }

    [[nodiscard]] std::optional<Spot> at(double column, double row) const {
        const auto& m = crs_from_post_;
        double x = m[0] + m[1] * column + m[2] * row;
        double y = m[3] + m[4] * column + m[5] * row;
        int done = 0;
        OCTTransformEx(transformation_.get(), 1, &x, &y, nullptr, &done);
        if (!done || !std::isfinite(x) || !std::isfinite(y) || std::abs(y) > 90.0 + 1e-9) return std::nullopt;
        return Spot{x, y};
    }

  private:
    std::array<double, 6> crs_from_post_;
    CoordinateTransformation transformation_;
};

constexpr int samples = 32;  // intervals along each side

// True when the CRS's degrees are WGS84's to 0.1 mm over the whole raster.
bool is_wgs84_degrees(const Source& source, OGRSpatialReferenceH horizontal, const Outwards& outwards) {
    if (!OSRIsGeographic(horizontal)) return false;
    const auto& m = source.crs_from_post;
    if (m[2] != 0.0 || m[4] != 0.0 || m[1] <= 0.0) return false;
    for (int i = 0; i <= 4; ++i) {
        for (int j = 0; j <= 4; ++j) {
            const double column = (source.report.columns - 1) * (i / 4.0);
            const double row = (source.report.rows - 1) * (j / 4.0);
            const auto spot = outwards.at(column, row);
            const double lat_deg = m[3] + m[5] * row;
            if (std::abs(lat_deg) > 90.0 - 1e-6) continue;
            if (!spot) return false;
            const double turn = std::remainder(spot->lon_deg - (m[0] + m[1] * column), 360.0);
            if (std::abs(turn) > 1e-9 || std::abs(spot->lat_deg - lat_deg) > 1e-9) return false;
        }
    }
    return true;
}

// Spacings such as 0.000833333333333 mean a whole number of posts a degree, when over all posts that moves
// none by 1/1000.
double posts_per_deg(double spacing_deg, int count) {
    const double per_deg = 1.0 / spacing_deg;
    const double drift_allowed = 1e-3 / std::max(1, count - 1);
    const auto near = [&](double exact) { return std::abs(spacing_deg * exact - 1.0) < drift_allowed; };
    if (per_deg >= 1.0) return near(std::round(per_deg)) ? std::round(per_deg) : per_deg;
    const double whole = 1.0 / std::round(spacing_deg);
    return near(whole) ? whole : per_deg;
}

SourceAxis axis(double start_deg, double step_deg, int count) {
    SourceAxis result{posts_per_deg(std::abs(step_deg), count), start_deg, step_deg > 0.0 ? 1 : -1, count};
    // The same for the first post: on a whole or a half post, or where it is.
    const double twice = 2.0 * start_deg * result.posts_per_deg;
    if (std::abs(twice - std::round(twice)) < 2e-3)
        result.start_deg = std::round(twice) / (2.0 * result.posts_per_deg);
    return result;
}

Result<void> place_on_degrees(Source& source) {
    const auto& m = source.crs_from_post;
    source.on_degrees = true;
    source.lat_axis = axis(m[3], m[5], source.report.rows);
    source.lon_axis = axis(m[0], m[1], source.report.columns);
    const double last_lat = source.lat_axis.at_deg(source.lat_axis.count - 1);
    source.south_deg = std::min(source.lat_axis.start_deg, last_lat);
    source.north_deg = std::max(source.lat_axis.start_deg, last_lat);
    source.lat_spacing_deg = 1.0 / source.lat_axis.posts_per_deg;
    source.lon_spacing_deg = 1.0 / source.lon_axis.posts_per_deg;
    if (source.north_deg > 90.0 + 1e-6 || source.south_deg < -90.0 - 1e-6)
        return reason(
            "its latitudes go beyond 90 degrees: the coordinates are not the degrees that its CRS says");
    constexpr double half_and_whole_turn_deg = 540.0;  // a world from -180, or one that begins anywhere in it
    const double last_lon = source.lon_axis.at_deg(source.lon_axis.count - 1);
    if (std::max(std::abs(source.lon_axis.start_deg), std::abs(last_lon)) > half_and_whole_turn_deg)
        return reason(
            "its longitudes go beyond 540 degrees: the coordinates are not the degrees that its CRS says");
    source.lon_axis.start_deg -= std::floor((source.lon_axis.start_deg + 180.0) / 360.0) * 360.0;
    source.lon = {source.lon_axis.start_deg, source.lon_axis.at_deg(source.lon_axis.count - 1)};
    // Round the Earth when no post is missing between the last and the first; a second copy of the first is
    // left out.
    const double round_trip = 360.0 * source.lon_axis.posts_per_deg;
    if (source.lon_axis.count + 1e-3 >= round_trip) {
        source.full_circle = true;
        source.lon_axis.count = std::min(source.lon_axis.count, static_cast<int>(std::lround(round_trip)));
    }
    return {};
}

// Bounds by sampled posts, with the turns of the perimeter telling whether a pole lies inside.
Result<void> place_by_samples(Source& source, const Outwards& outwards) {
    const double last_column = source.report.columns - 1;
    const double last_row = source.report.rows - 1;
    source.south_deg = 90.0;
    source.north_deg = -90.0;
    std::vector<double> lons;
    for (int i = 0; i <= samples; ++i) {
        for (int j = 0; j <= samples; ++j) {
            const auto spot = outwards.at(last_column * i / samples, last_row * j / samples);
            if (!spot) continue;
            source.south_deg = std::min(source.south_deg, spot->lat_deg);
            source.north_deg = std::max(source.north_deg, spot->lat_deg);
            lons.push_back(spot->lon_deg);
        }
    }
    if (lons.size() < 2 || source.south_deg >= source.north_deg)
        return reason("PROJ cannot place its corners on the Earth: the georeference and the CRS do not fit");
    bool whole_perimeter = true;
    std::optional<Spot> before;
    double lon = 0.0, west = 0.0, east = 0.0, start = 0.0;
    for (int i = 0; i <= 4 * samples; ++i) {
        const double along = static_cast<double>(i % samples) / samples;
        const int side = (i / samples) % 4;
        const double column = side == 0 ? along : side == 1 ? 1.0 : side == 2 ? 1.0 - along : 0.0;
        const double row = side == 0 ? 0.0 : side == 1 ? along : side == 2 ? 1.0 : 1.0 - along;
        const auto spot = outwards.at(column * last_column, row * last_row);
        if (!spot) {
            whole_perimeter = false;
            continue;
        }
        if (!before) {
            lon = west = east = start = spot->lon_deg;
        } else {
            lon += std::remainder(spot->lon_deg - before->lon_deg, 360.0);
        }
        west = std::min(west, lon);
        east = std::max(east, lon);
        before = spot;
    }
    const bool pole_inside = whole_perimeter && std::abs(lon - start) > 180.0;
    if (pole_inside)
        (source.north_deg + source.south_deg > 0.0 ? source.north_deg : source.south_deg) =
            source.north_deg + source.south_deg > 0.0 ? 90.0 : -90.0;
    if (pole_inside || !whole_perimeter || east - west >= 360.0) {
        source.full_circle = true;
        source.lon = {-180.0, 180.0};
        return {};
    }
    const double turn = std::floor((west + 180.0) / 360.0) * 360.0;
    source.lon = {west - turn, east - turn};
    return {};
}

// The smaller ground distance between neighbouring posts in a source's middle, where degrees of longitude say
// nothing.
std::optional<double> spacing_at_pole(const Source& source, const Outwards& outwards) {
    const double column = 0.5 * (source.report.columns - 1), row = 0.5 * (source.report.rows - 1);
    const auto here = outwards.at(column, row), right = outwards.at(column + 1.0, row),
               below = outwards.at(column, row + 1.0);
    if (!here || !right || !below) return std::nullopt;
    const auto ecef_m = [](const Spot& spot) {
        return ecef_from_geodetic({spot.lat_deg, spot.lon_deg, 0.0}).m;
    };
    const double spacing_m =
        std::min(glm::length(ecef_m(*right) - ecef_m(*here)), glm::length(ecef_m(*below) - ecef_m(*here)));
    return spacing_m > 0.0 ? std::optional(spacing_m) : std::nullopt;
}

// Ground distance between neighbouring posts, the smaller of both directions, and its degrees; the median of
// five places.
Result<void> measure_spacing(Source& source, const Outwards& outwards) {
    struct Spacing {
        double metres, lat_deg, lon_deg;
    };
    std::vector<Spacing> found;
    for (const auto& [u, v] : {std::pair{0.5, 0.5}, {0.25, 0.25}, {0.75, 0.25}, {0.25, 0.75}, {0.75, 0.75}}) {
        const double column = (source.report.columns - 1) * u;
        const double row = (source.report.rows - 1) * v;
        const auto here = outwards.at(column, row);
        const auto right = outwards.at(column + 0.5, row);
        const auto below = outwards.at(column, row + 0.5);
        if (!here || !right || !below || std::abs(here->lat_deg) > 89.99) continue;
        const double meridian = radians_from_deg(1.0).rad * meridian_radius_m(here->lat_deg);
        const double parallel = radians_from_deg(1.0).rad * prime_vertical_radius_m(here->lat_deg) *
                                std::cos(radians_from_deg(here->lat_deg).rad);
        const auto metres = [&](const Spot& there) {
            return 2.0 * std::hypot((there.lat_deg - here->lat_deg) * meridian,
                                    std::remainder(there.lon_deg - here->lon_deg, 360.0) * parallel);
        };
        const double spacing = std::min(metres(*right), metres(*below));
        if (spacing > 0.0) found.push_back({spacing, spacing / meridian, spacing / parallel});
    }
    if (found.empty()) {
        // All of it lies within 1 km of a pole.
        if (const auto spacing = spacing_at_pole(source, outwards)) {
            const double degree_m = radians_from_deg(1.0).rad * wgs84_a_m;
            constexpr double cosine = 1.7e-4;  // at 89.99
            found.push_back({*spacing, *spacing / degree_m, *spacing / (degree_m * cosine)});
        }
    }
    if (found.empty())
        return reason(
            "the distance between its posts cannot be told: the georeference and the CRS do not fit");
    std::ranges::sort(found, {}, &Spacing::metres);
    const Spacing& middle = found[found.size() / 2];
    source.report.spacing_m = middle.metres;
    source.lat_spacing_deg = middle.lat_deg;
    source.lon_spacing_deg = middle.lon_deg;
    return {};
}

}  // namespace

Result<void> place_on_earth(Source& source, OGRSpatialReferenceH horizontal) {
    const Outwards outwards(source, horizontal);
    if (!outwards.usable()) return reason("PROJ cannot turn its CRS into WGS84");
    if (is_wgs84_degrees(source, horizontal, outwards)) {
        ORO_CHECK(place_on_degrees(source));
        const double middle = 0.5 * (source.south_deg + source.north_deg);
        source.report.spacing_m = radians_from_deg(source.lat_spacing_deg).rad * meridian_radius_m(middle);
    } else {
        ORO_CHECK(place_by_samples(source, outwards));
        ORO_CHECK(measure_spacing(source, outwards));
        source.projected = !OSRIsGeographic(horizontal);
        const auto& m = source.crs_from_post;
        const double metre_deg = 1.0 / (radians_from_deg(1.0).rad * wgs84_a_m);
        source.report.nominal_spacing_deg =
            std::sqrt(std::abs(m[1] * m[5] - m[2] * m[4])) *
            (source.projected ? OSRGetLinearUnits(horizontal, nullptr) * metre_deg : 1.0);
        if (!source.projected) {
            source.lat_spacing_deg = std::hypot(source.crs_from_post[4], source.crs_from_post[5]);
            source.lon_spacing_deg = std::hypot(source.crs_from_post[1], source.crs_from_post[2]);
        }
    }
    SourceReport& report = source.report;
    report.lat_spacing_deg = source.lat_spacing_deg;
    report.lon_spacing_deg = source.lon_spacing_deg;
    const bool round = source.full_circle;
    const double east = source.lon.east_deg > 180.0 ? source.lon.east_deg - 360.0 : source.lon.east_deg;
    report.box = {round ? -180.0 : source.lon.west_deg, source.south_deg, round ? 180.0 : east,
                  source.north_deg};
    return {};
}

}  // namespace oro
