#include "core/measure/skyline_error.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>

#include "core/base/parallel.h"

namespace oro {
namespace {

constexpr double skyline_step_px = 1.0 / 64.0;

// Where the highest ground of a column begins: 0 when it is at the top, nothing where there is none.
struct ColumnSkyline {
    double y_px;
    bool from_below;
};
std::optional<ColumnSkyline> column_skyline(const Oracle& oracle, const Camera& camera, int column,
                                            double reach_m) {
    bool from_below = false;  // the last ground that was met
    const auto is_ground = [&](double y_px) {
        const glm::dvec3 ray = camera.ecef_direction_at({column + 0.5, y_px});
        const auto hit = oracle.first_hit(ray, reach_m);
        if (hit) from_below = hit->from_below;
        return hit.has_value();
    };
    if (is_ground(0.0)) return ColumnSkyline{0.0, from_below};
    constexpr double step_px = 1.0 / skyline_samples;
    double sky_px = 0.0, ground_px = 0.5 * step_px;
    while (!is_ground(ground_px)) {
        if (ground_px >= camera.height_px) return std::nullopt;
        sky_px = ground_px;
        ground_px = std::min(ground_px + step_px, static_cast<double>(camera.height_px));
    }
    while (ground_px - sky_px > skyline_step_px) {
        const double middle_px = 0.5 * (sky_px + ground_px);
        (is_ground(middle_px) ? ground_px : sky_px) = middle_px;
    }
    return ColumnSkyline{0.5 * (sky_px + ground_px), from_below};
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

// Two skylines of a column that lie apart.
struct Apart {
    int column;
    double true_px;
    DrawnSkyline drawn;
};
constexpr double by_chance_px = 0.05;

// The circles on which places are tried: each twice as large as the one before up to where it is likely, then
// so much larger.
struct Circles {
    double likely_px;
    double growth;
    int directions;
};
constexpr double finest_px = 0.0125;

// How far the true picture is to be moved, in any direction, so that it has what is drawn in a column: ground
// at its first sample with ground, sky at those above. At most `off_px`, which columns alone tell: between
// them a line was drawn where there may be a step.
double moved_px(const Oracle& oracle, const Camera& camera, const Apart& apart, double off_px,
                const Circles& circles) {
    const double reach_m = sight_reach_m(camera.eye.h_m);
    constexpr double step_px = 1.0 / skyline_samples;
    const auto has_all = [&](const glm::dvec2& by_px) {
        const auto is_ground = [&](double y_px) {
            const glm::dvec2 at = glm::dvec2(apart.column + 0.5, y_px) + by_px;
            return oracle.first_hit(camera.ecef_direction_at(at), reach_m).has_value();
        };
        if (!is_ground(apart.drawn.ground_px)) return false;
        for (double y_px = apart.drawn.sky_px; y_px > std::max(apart.true_px - step_px, 0.0); y_px -= step_px)
            if (is_ground(y_px)) return false;
        return std::isinf(apart.drawn.sky_px) || !is_ground(apart.drawn.sky_px);
    };
    // Nearly always it is near what columns tell; but a slanting spire is passed by a hair's breadth.
    const auto next_px = [&](double by_px) {
        return by_px < circles.likely_px ? std::min(2.0 * by_px, circles.likely_px) : circles.growth * by_px;
    };
    for (double by_px = finest_px; by_px < off_px; by_px = next_px(by_px)) {
        for (int direction = 0; direction < circles.directions; ++direction) {
            const double turn = 2.0 * std::acos(-1.0) * direction / circles.directions;
            if (has_all(by_px * glm::dvec2(std::cos(turn), std::sin(turn)))) return by_px;
        }
    }
    return off_px;
}

// A few places near where the line says: what most columns need.
double moved_px(const Oracle& oracle, const Camera& camera, const Apart& apart, double off_px) {
    constexpr double step_aside_px = 1.0;
    return moved_px(oracle, camera, apart, off_px, {std::max(finest_px, off_px - step_aside_px), 1.2, 16});
}

// Tries many places for the columns that are farthest off, until the farthest is found.
void look_closely(const Oracle& oracle, const Camera& camera, std::vector<Apart> columns,
                  std::vector<float>& errors_px) {
    constexpr std::size_t most_columns = 32;
    const auto error_px = [&](const Apart& one) -> float& {
        return errors_px[static_cast<std::size_t>(one.column)];
    };
    const std::size_t count = std::min(columns.size(), most_columns);
    std::partial_sort(columns.begin(), columns.begin() + static_cast<std::ptrdiff_t>(count), columns.end(),
                      [&](const Apart& a, const Apart& b) { return error_px(a) > error_px(b); });
    float largest_px = 0.0F;
    for (std::size_t i = 0; i < count && error_px(columns[i]) > largest_px; ++i) {
        float& known_px = error_px(columns[i]);
        const double found_px =
            moved_px(oracle, camera, columns[i], static_cast<double>(known_px), {finest_px, 1.1, 96});
        known_px = static_cast<float>(found_px);
        largest_px = std::max(largest_px, known_px);
    }
}

}  // namespace

Skyline true_skyline(const TrueGround& ground, const Sight& sight, const Camera& camera, int threads) {
    Skyline skyline;
    skyline.y_px.assign(static_cast<std::size_t>(camera.width_px), not_measured);
    skyline.from_below.assign(skyline.y_px.size(), 0);
    const double reach_m = sight_reach_m(geodetic_from_ecef(sight.eye).h_m);
    const Oracle oracle(ground, sight);
    in_parallel(camera.width_px, threads, [&](int column) {
        const auto found = column_skyline(oracle, camera, column, reach_m);
        if (!found) return;
        skyline.y_px[static_cast<std::size_t>(column)] = static_cast<float>(found->y_px);
        skyline.from_below[static_cast<std::size_t>(column)] = found->from_below ? 1 : 0;
    });
    return skyline;
}

SkylineError skyline_error(const Skyline& truth, const Camera& camera, std::span<const DrawnDepths> samples,
                           const Oracle* oracle) {
    assert(truth.y_px.size() == static_cast<std::size_t>(camera.width_px) && !samples.empty());
    std::vector<DrawnDepths> from_top(samples.begin(), samples.end());
    std::sort(from_top.begin(), from_top.end(),
              [](const DrawnDepths& a, const DrawnDepths& b) { return a.sample_px.y < b.sample_px.y; });
    const double last_sample_px = camera.height_px - 1 + from_top.back().sample_px.y;
    SkylineError error;
    error.px.assign(truth.y_px.size(), not_measured);
    std::vector<Apart> apart;
    for (std::size_t column = 0; column < truth.y_px.size(); ++column) {
        if (!truth.from_below.empty() && truth.from_below[column] != 0) continue;
        const float true_px = truth.y_px[column];
        const auto drawn = drawn_skyline(camera, from_top, static_cast<int>(column));
        if (drawn.has_value() != (true_px != not_measured)) {
            // Ground below the last sample is not drawn, whatever is there.
            if (drawn || static_cast<double>(true_px) < last_sample_px) ++error.in_one_only;
            continue;
        }
        // Ground at the top in both: the skyline is not in the picture.
        if (!drawn || (true_px <= 0.0F && std::isinf(drawn->sky_px))) continue;
        const int x = static_cast<int>(column);
        double off_px = off_line_px(truth, camera, x, *drawn);
        if (oracle && off_px > skyline_step_px) {
            apart.push_back({x, static_cast<double>(true_px), *drawn});
            if (off_px > by_chance_px) off_px = moved_px(*oracle, camera, apart.back(), off_px);
        }
        error.px[column] = static_cast<float>(off_px);
    }
    if (oracle) look_closely(*oracle, camera, std::move(apart), error.px);
    error.summary_px = summary_of(error.px);
    return error;
}

SkylineError skyline_error(const TrueGround& ground, const Sight& sight, const Camera& camera,
                           std::span<const DrawnDepths> samples, int threads) {
    const Oracle oracle(ground, sight);
    return skyline_error(true_skyline(ground, sight, camera, threads), camera, samples, &oracle);
}

}  // namespace oro
