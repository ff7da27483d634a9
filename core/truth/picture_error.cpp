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

constexpr double skyline_step_px = 1.0 / 64.0;

// Where the highest ground of a column begins: 0 when it is at the top, nothing where there is none.
std::optional<double> column_skyline_px(const Oracle& oracle, const Camera& camera, int column,
                                        double reach_m) {
    const auto is_ground = [&](double y_px) {
        const glm::dvec3 ray = camera.ecef_direction_at({column + 0.5, y_px});
        return oracle.first_hit(ray, reach_m).has_value();
    };
    if (is_ground(0.0)) return 0.0;
    double sky_px = 0.0, ground_px = 0.5;
    while (!is_ground(ground_px)) {
        if (ground_px >= camera.height_px) return std::nullopt;
        sky_px = ground_px;
        ground_px = std::min(ground_px + 1.0, static_cast<double>(camera.height_px));
    }
    while (ground_px - sky_px > skyline_step_px) {
        const double middle_px = 0.5 * (sky_px + ground_px);
        (is_ground(middle_px) ? ground_px : sky_px) = middle_px;
    }
    return 0.5 * (sky_px + ground_px);
}

// Between which heights a column's drawn skyline lies; from minus infinity where the first sample has ground.
struct DrawnSkyline {
    double sky_px;
    double ground_px;
};
std::optional<DrawnSkyline> drawn_skyline(const Camera& camera, std::span<const DrawnDepths> samples,
                                          int column) {
    double sky_px = -std::numeric_limits<double>::infinity();
    for (int row = 0; row < camera.height_px; ++row) {
        const std::size_t pixel = static_cast<std::size_t>(row) * static_cast<std::size_t>(camera.width_px) +
                                  static_cast<std::size_t>(column);
        for (const DrawnDepths& sample : samples) {
            const double y_px = row + sample.sample_px.y;
            if (sample.depths[pixel] > 0.0F) return DrawnSkyline{sky_px, y_px};
            sky_px = y_px;
        }
    }
    return std::nullopt;
}

double to_segment_px(const glm::dvec2& point, const glm::dvec2& from, const glm::dvec2& to) {
    const glm::dvec2 along = to - from;
    const double length = glm::dot(along, along);
    const double share = length > 0.0 ? std::clamp(glm::dot(point - from, along) / length, 0.0, 1.0) : 0.0;
    return glm::length(point - from - share * along);
}

// How far what is known of a column's drawn skyline lies from the true skyline, a line through all columns:
// upright where ground ends. Straight down the column an upright edge would be far away that is off by a
// thousandth.
double off_line_px(const Skyline& truth, const Camera& camera, int column, const DrawnSkyline& drawn) {
    const auto at = [&](int i) {
        const float y_px = truth.y_px[static_cast<std::size_t>(i)];
        return glm::dvec2(i + 0.5, y_px == not_measured ? camera.height_px : static_cast<double>(y_px));
    };
    const double x_px = column + 0.5, y_px = at(column).y;
    const double sky_px = std::max(drawn.sky_px, -1.0e6);
    double off_px = std::max({sky_px - y_px, y_px - drawn.ground_px, 0.0});
    const int last = static_cast<int>(truth.y_px.size()) - 1;
    for (int away = 0; away < off_px; ++away) {
        for (const int from : {column - away - 1, column + away}) {
            if (from < 0 || from + 1 > last) continue;
            const glm::dvec2 a = at(from), b = at(from + 1);
            const double near_px =
                std::min(to_segment_px({x_px, sky_px}, a, b), to_segment_px({x_px, drawn.ground_px}, a, b));
            off_px = std::min(off_px, near_px);
        }
    }
    return off_px;
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

Skyline true_skyline(const TrueSurface& surface, const Sight& sight, const Camera& camera, int threads) {
    Skyline skyline;
    skyline.y_px.assign(static_cast<std::size_t>(camera.width_px), not_measured);
    const double reach_m = sight_reach_m(geodetic_from_ecef(sight.eye).h_m);
    const Oracle oracle(surface, sight);
    in_parallel(camera.width_px, threads, [&](int column) {
        if (const auto y_px = column_skyline_px(oracle, camera, column, reach_m))
            skyline.y_px[static_cast<std::size_t>(column)] = static_cast<float>(*y_px);
    });
    return skyline;
}

SkylineError skyline_error(const Skyline& truth, const Camera& camera, std::span<const DrawnDepths> samples) {
    assert(truth.y_px.size() == static_cast<std::size_t>(camera.width_px) && !samples.empty());
    std::vector<DrawnDepths> from_top(samples.begin(), samples.end());
    std::sort(from_top.begin(), from_top.end(),
              [](const DrawnDepths& a, const DrawnDepths& b) { return a.sample_px.y < b.sample_px.y; });
    const double last_sample_px = camera.height_px - 1 + from_top.back().sample_px.y;
    SkylineError error;
    error.px.assign(truth.y_px.size(), not_measured);
    for (std::size_t column = 0; column < truth.y_px.size(); ++column) {
        const float true_px = truth.y_px[column];
        const auto drawn = drawn_skyline(camera, from_top, static_cast<int>(column));
        if (drawn.has_value() != (true_px != not_measured)) {
            // Ground below the last sample is not drawn, whatever is there.
            if (drawn || static_cast<double>(true_px) < last_sample_px) ++error.in_one_only;
            continue;
        }
        // Ground at the top in both: the skyline is not in the picture.
        if (!drawn || (true_px <= 0.0F && std::isinf(drawn->sky_px))) continue;
        error.px[column] = static_cast<float>(off_line_px(truth, camera, static_cast<int>(column), *drawn));
    }
    error.summary_px = summary_of(error.px);
    return error;
}

SkylineError skyline_error(const TrueSurface& surface, const Sight& sight, const Camera& camera,
                           std::span<const DrawnDepths> samples, int threads) {
    return skyline_error(true_skyline(surface, sight, camera, threads), camera, samples);
}

}  // namespace oro
