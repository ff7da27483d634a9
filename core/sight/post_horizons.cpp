#include "core/sight/post_horizons.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <mutex>
#include <optional>

#include "core/base/parallel.h"
#include "core/sight/horizon_ground.h"
#include "core/sight/observer.h"
#include "core/sight/viewshed.h"
#include "core/truth/oracle.h"

namespace oro {
namespace {

constexpr double straight_deg = 90.0;

std::optional<Geodetic> eye_over_post(const TrueGround& ground, std::size_t grid, int row, int column,
                                      double above_m) {
    const TrueSurface& surface = ground.surface(grid);
    const PostGrid& posts = surface.field().grid;
    if (posts.wraps_longitude()) {
        const int turn = posts.columns() - 1;
        column = ((column % turn) + turn) % turn;
    }
    const PostPlace place = posts.place_at(row, column);
    std::optional<double> h_m = surface.post_h_m(row, column);
    if (h_m && ground.grids() > 1) h_m = ground.h_m(place.lat_deg, place.lon_deg);
    if (!h_m) return std::nullopt;
    return Geodetic{place.lat_deg, normalised_lon_deg(place.lon_deg),
                    *h_m + std::max(above_m, least_above_m)};
}

// All posts within the radius around those of a part.
GridPart window_of(const PostGrid& grid, const GridPart& part, double radius_m) {
    // Across the level plane ground is nearer than along the Earth, by less than this within 500 km.
    constexpr double wider = 1.01;
    GridPart window = part;
    int south = part.first_row + part.rows, east = part.first_column + part.columns;
    const auto take_in = [&](int row, int column) {
        const PostPlace place = grid.place_at(row, column);
        const GridPart around =
            window_around(grid, {place.lat_deg, normalised_lon_deg(place.lon_deg), 0.0}, wider * radius_m);
        if (around.count() == 0) return;
        int first = around.first_column;
        if (grid.wraps_longitude()) {
            const int turn = grid.columns() - 1;
            while (first + around.columns <= column) first += turn;
            while (first > column) first -= turn;
        }
        window.first_row = std::min(window.first_row, around.first_row);
        window.first_column = std::min(window.first_column, first);
        south = std::max(south, around.first_row + around.rows);
        east = std::max(east, first + around.columns);
    };
    const int last_row = part.first_row + part.rows - 1, last_column = part.first_column + part.columns - 1;
    for (int row = part.first_row; row <= last_row; ++row)
        for (const int column : {part.first_column, last_column}) take_in(row, column);
    for (int column = part.first_column; column <= last_column; ++column)
        for (const int row : {part.first_row, last_row}) take_in(row, column);
    window.rows = south - window.first_row;
    window.columns = east - window.first_column;
    // Once around is all there is.
    if (grid.wraps_longitude() && window.columns > grid.columns()) {
        window.first_column = 0;
        window.columns = grid.columns();
    }
    return window;
}

class Azimuths {
  public:
    explicit Azimuths(int count) {
        for (int i = 0; i < count; ++i) turns_.push_back(sine_cosine_deg(360.0 * i / count));
    }
    [[nodiscard]] std::size_t count() const { return turns_.size(); }
    [[nodiscard]] const SineCosine& operator[](std::size_t i) const { return turns_[i]; }

  private:
    std::vector<SineCosine> turns_;
};

// Puts what is found of one post into the answer.
void put(PostHorizons& answer, std::size_t post, const std::vector<std::optional<double>>& found_deg) {
    std::vector<double> known;
    for (std::size_t i = 0; i < found_deg.size(); ++i) {
        if (!found_deg[i]) continue;
        answer.elevation_deg[i][post] = static_cast<float>(*found_deg[i]);
        known.push_back(*found_deg[i]);
    }
    if (known.size() == found_deg.size()) answer.sky_view[post] = static_cast<float>(sky_view_factor(known));
}

}  // namespace

double sky_view_factor(const std::vector<double>& elevations_deg) {
    double sum = 0.0;
    for (const double elevation_deg : elevations_deg) {
        const double cosine = sine_cosine_deg(std::max(0.0, elevation_deg)).cosine;
        sum += cosine * cosine;
    }
    return sum / static_cast<double>(std::max<std::size_t>(1, elevations_deg.size()));
}

std::optional<double> horizon_by_lines_deg(const TrueGround& ground, const Geodetic& eye, const Air& air,
                                           double azimuth_deg, double radius_m) {
    const Sight sight = sight_from(eye, air);
    const Oracle oracle(ground, sight);
    const glm::dmat3 enu = ecef_from_enu(eye.lat_deg, eye.lon_deg);
    const SineCosine azimuth = sine_cosine_deg(azimuth_deg);
    const auto is_hit = [&](double elevation_deg) {
        const SineCosine elevation = sine_cosine_deg(elevation_deg);
        const glm::dvec3 direction = enu * glm::dvec3(elevation.cosine * azimuth.sine,
                                                      elevation.cosine * azimuth.cosine, elevation.sine);
        const double reach_m = radius_m / std::max(1.0e-3, elevation.cosine);
        return oracle.first_hit(direction, reach_m).has_value();
    };
    constexpr double nearly_straight_deg = 89.9;
    double low_deg = -nearly_straight_deg, high_deg = nearly_straight_deg;
    if (!is_hit(low_deg)) {
        // Straight below may be the data's rim: any line that meets ground is a begin.
        while (low_deg < 0.0 && !is_hit(low_deg)) low_deg *= 0.5;
        if (!is_hit(low_deg)) return std::nullopt;
    }
    if (is_hit(high_deg)) return straight_deg;
    while (high_deg - low_deg > 1.0e-5) {
        const double middle_deg = 0.5 * (low_deg + high_deg);
        (is_hit(middle_deg) ? low_deg : high_deg) = middle_deg;
    }
    return 0.5 * (low_deg + high_deg);
}

PostHorizons post_horizons(const TrueGround& ground, std::size_t grid, const PostHorizonsRequest& request,
                           const PostHorizonsProgress& progress) {
    const GridPart& part = request.part;
    PostHorizons answer{part, {}, std::vector<float>(part.count(), PostHorizons::unknown)};
    answer.elevation_deg.assign(static_cast<std::size_t>(request.directions),
                                std::vector<float>(part.count(), PostHorizons::unknown));
    if (part.count() == 0) return answer;
    const TrueSurface& surface = ground.surface(grid);
    std::optional<HorizonGround> triangles;
    if (ground.grids() == 1)
        triangles.emplace(surface, window_of(surface.field().grid, part, request.radius_m), request.threads);
    const Azimuths azimuths(request.directions);
    std::mutex telling;
    int done = 0;
    in_parallel(part.rows, request.threads, [&](int i) {
        std::vector<std::int64_t> leaves(azimuths.count(),
                                         -1);  // of the post before, which sees much the same
        std::vector<std::optional<double>> found_deg(azimuths.count());
        for (int j = 0; j < part.columns && !request.stop.stop_requested(); ++j) {
            const int row = part.first_row + i, column = part.first_column + j;
            const auto eye = eye_over_post(ground, grid, row, column, request.above_m);
            if (!eye) continue;
            const PostEye from(*eye, request.air, request.radius_m);
            for (std::size_t k = 0; k < azimuths.count(); ++k) {
                if (!triangles) {
                    found_deg[k] = horizon_by_lines_deg(ground, *eye, request.air,
                                                        360.0 * static_cast<double>(k) / request.directions,
                                                        request.radius_m);
                    continue;
                }
                const double tangent =
                    triangles->most_tangent(from, azimuths[k].sine, azimuths[k].cosine, leaves[k]);
                found_deg[k].reset();
                if (tangent > HorizonGround::none)
                    found_deg[k] = deg_from_radians(Radians(std::atan(tangent)));
            }
            put(answer, part.number(row, column), found_deg);
        }
        if (!progress) return;
        const std::lock_guard lock(telling);
        progress(static_cast<double>(++done) / part.rows);
    });
    return answer;
}

}  // namespace oro
