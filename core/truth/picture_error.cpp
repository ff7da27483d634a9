#include "core/truth/picture_error.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <numeric>
#include <optional>

#include "core/base/parallel.h"

namespace oro {
namespace {

// Number, from 1, of the value that a share of all are not larger than.
std::size_t nearest_rank(std::size_t count, std::size_t of_ten_thousand) {
    return (count * of_ten_thousand + 9999) / 10000;
}

// Of absolute values; reorders them.
template <class Value>
ErrorSummary summary_of_sizes(std::vector<Value>& sizes) {
    ErrorSummary summary;
    summary.count = sizes.size();
    if (sizes.empty()) return summary;
    const auto ranked = [&](std::size_t rank) {
        const auto nth = sizes.begin() + static_cast<std::ptrdiff_t>(rank - 1);
        std::nth_element(sizes.begin(), nth, sizes.end());
        return static_cast<double>(*nth);
    };
    summary.mean = std::accumulate(sizes.begin(), sizes.end(), 0.0) / static_cast<double>(sizes.size());
    summary.p99 = ranked(nearest_rank(sizes.size(), 9900));
    summary.p9999 = ranked(nearest_rank(sizes.size(), 9999));
    summary.largest = static_cast<double>(*std::max_element(sizes.begin(), sizes.end()));
    return summary;
}

// The part of a cell by which a point may lie outside and still be on the edge.
constexpr double edge_slack = 1.0e-7;

// Height of the surface at a place that may lie beside the region's edge by rounding.
std::optional<double> h_below_m(const TrueSurface& surface, double lat_deg, double lon_deg) {
    if (const std::optional<double> h_m = surface.h_m(lat_deg, lon_deg)) return h_m;
    const PostGrid& grid = surface.field().grid;
    const double row = grid.lat.index_at(lat_deg), column = grid.column_at(lon_deg);
    const auto outside = [](double index, int count) {
        return index < 0.5 * count ? std::max(-index, 0.0) : std::max(index - (count - 1), 0.0);
    };
    const double above = outside(row, grid.rows()), beside = outside(column, grid.columns());
    if (above > edge_slack || beside > edge_slack || (above == 0.0 && beside == 0.0)) return std::nullopt;
    // Twice as far back as it lay outside at most.
    const double south = above == 0.0 ? 0.0 : row < 0.5 * grid.rows() ? -1.0 : 1.0;
    const double west = beside == 0.0 ? 0.0 : column < 0.5 * grid.columns() ? 1.0 : -1.0;
    return surface.h_m(lat_deg + 2.0 * edge_slack * south * grid.lat.spacing_deg(),
                       lon_deg + 2.0 * edge_slack * west * grid.lon.spacing_deg());
}

}  // namespace

PointMeter::PointMeter(const TrueSurface& surface, const Sight& sight, const Camera& camera)
    : surface_(surface),
      sight_(sight),
      view_from_ecef_(camera.view_from_ecef()),
      tangent_(camera.half_fov_tangent()),
      size_px_(camera.width_px, camera.height_px),
      pixels_per_tangent_(0.5 * camera.height_px / tangent_.y) {}

glm::dvec3 PointMeter::offset_m(const glm::dvec2& point_px, float depth) const {
    const double z_m = near_plane_m / static_cast<double>(depth);
    const glm::dvec2 tangent = (2.0 * point_px / size_px_ - 1.0) * tangent_ * glm::dvec2(1.0, -1.0);
    return z_m * (glm::dvec3(tangent, -1.0) * view_from_ecef_);
}

std::optional<PointError> PointMeter::at(const glm::dvec3& drawn_m) const {
    const Geodetic point = geodetic_from_ecef({sight_.eye.m + sight_.refraction.true_m(drawn_m)});
    const std::optional<double> true_h_m = h_below_m(surface_, point.lat_deg, point.lon_deg);
    if (!true_h_m) return std::nullopt;
    const double height_m = point.h_m - *true_h_m;
    const glm::dvec3 truth_m = ecef_from_geodetic({point.lat_deg, point.lon_deg, *true_h_m}).m - sight_.eye.m;
    const glm::dvec3 seen = view_from_ecef_ * sight_.refraction.apparent_m(truth_m);
    const glm::dvec3 drawn = view_from_ecef_ * drawn_m;
    if (seen.z >= 0.0) return PointError{height_m, std::abs(height_m) * pixels_per_tangent_ / -drawn.z};
    const glm::dvec2 apart = glm::dvec2(seen) / seen.z - glm::dvec2(drawn) / drawn.z;
    return PointError{height_m, glm::length(apart) * pixels_per_tangent_};
}

ErrorSummary summary_of(std::vector<double> values) {
    for (double& value : values) value = std::abs(value);
    return summary_of_sizes(values);
}

ErrorSummary summary_of(std::span<const float> values) {
    std::vector<float> sizes;
    sizes.reserve(values.size());
    for (const float value : values) {
        if (value != not_measured) sizes.push_back(std::abs(value));
    }
    return summary_of_sizes(sizes);
}

InteriorError interior_error(const TrueSurface& surface, const Sight& sight, const Camera& camera,
                             const DrawnDepths& drawn, int threads) {
    const std::size_t width = static_cast<std::size_t>(camera.width_px);
    const std::size_t height = static_cast<std::size_t>(camera.height_px);
    assert(drawn.depths.size() == width * height);
    InteriorError error;
    error.height_m.assign(width * height, not_measured);
    error.px.assign(width * height, not_measured);
    const PointMeter meter(surface, sight, camera);
    std::vector<std::uint64_t> drawn_in_row(height), beyond_in_row(height);
    in_parallel(camera.height_px, threads, [&](int row) {
        const std::size_t r = static_cast<std::size_t>(row);
        for (std::size_t column = 0; column < width; ++column) {
            const std::size_t pixel = r * width + column;
            if (!(drawn.depths[pixel] > 0.0F)) continue;
            ++drawn_in_row[r];
            const glm::dvec2 corner(static_cast<double>(column), row);
            const auto measured = meter.at(meter.offset_m(corner + drawn.sample_px, drawn.depths[pixel]));
            if (!measured) {
                ++beyond_in_row[r];
                continue;
            }
            error.height_m[pixel] = static_cast<float>(measured->height_m);
            error.px[pixel] = static_cast<float>(measured->px);
        }
    });
    error.drawn = std::accumulate(drawn_in_row.begin(), drawn_in_row.end(), std::uint64_t{0});
    error.beyond_data = std::accumulate(beyond_in_row.begin(), beyond_in_row.end(), std::uint64_t{0});
    error.summary_m = summary_of(error.height_m);
    error.summary_px = summary_of(error.px);
    return error;
}

}  // namespace oro
