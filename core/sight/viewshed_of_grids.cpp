// What an eye sees where several grids are the ground.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <mutex>
#include <numbers>
#include <utility>

#include "core/base/parallel.h"
#include "core/sight/viewshed.h"

namespace oro {
namespace {

// Whether another grid, or a step along its rim, may come between the eye and a target.
bool others_reach(const TrueGround& ground, std::size_t grid, const ViewshedRequest& request) {
    for (std::size_t other = 0; other < ground.grids(); ++other) {
        if (other == grid) continue;
        const ViewshedWindow window =
            window_around(ground.surface(other).field().grid, request.eye, request.radius_m);
        if (window.rows > 0 && window.columns > 0) return true;
    }
    return false;
}

// The circle around an eye: as Viewshed of one grid has it, an angle at the centre of curvature.
class Reach {
  public:
    explicit Reach(const ViewshedRequest& request)
        : enu_(ecef_from_enu(request.eye.lat_deg, request.eye.lon_deg)),
          eye_m_(ecef_from_geodetic(request.eye).m) {
        const double lat_deg = request.eye.lat_deg;
        const double radius_m = std::sqrt(prime_vertical_radius_m(lat_deg) * meridian_radius_m(lat_deg));
        centre_m_ = radius_m + request.eye.h_m;
        tangent_ = std::tan(request.radius_m / radius_m);
    }
    [[nodiscard]] bool holds(const Geodetic& place) const {
        const glm::dvec3 way = glm::transpose(enu_) * (ecef_from_geodetic(place).m - eye_m_);
        const double below_m = centre_m_ + way.z;
        return below_m > 0.0 && std::hypot(way.x, way.y) <= below_m * tangent_;
    }

  private:
    glm::dmat3 enu_;
    glm::dvec3 eye_m_;
    double centre_m_;
    double tangent_;
};

float missed_by_m(const Lookout& lookout, const Geodetic& target) {
    const std::optional<double> by_m = lookout.missed_by_m(target);
    return by_m ? static_cast<float>(*by_m) : std::numeric_limits<float>::infinity();
}

}  // namespace

std::optional<std::size_t> grid_of_most(const TrueGround& ground, const std::vector<Geodetic>& eyes,
                                        double radius_m) {
    constexpr int bearings = 64, rings = 24;
    // First what a grid has of the places, then what of it is seen: of two that hold all the finer.
    std::vector<std::pair<int, int>> held(ground.grids());
    for (const Geodetic& eye : eyes) {
        const glm::dmat3 enu = ecef_from_enu(eye.lat_deg, eye.lon_deg);
        for (int i = 0; i < bearings * rings; ++i) {
            // Rings of the same area, turned so that they do not line up with a grid.
            const double angle =
                radius_m / wgs84_a_m * std::sqrt((static_cast<double>(i / bearings) + 0.5) / rings);
            const double bearing = 2.0 * std::numbers::pi * (i % bearings) / bearings + 0.1 * (i / bearings);
            const PostPlace place =
                place_of_normal(std::cos(angle) * enu[2] +
                                std::sin(angle) * (std::cos(bearing) * enu[1] + std::sin(bearing) * enu[0]));
            for (std::size_t grid = 0; grid < held.size(); ++grid)
                held[grid].first += ground.surface(grid).h_m(place.lat_deg, place.lon_deg).has_value();
            if (const auto shown = ground.grid_at(place.lat_deg, place.lon_deg)) ++held[*shown].second;
        }
    }
    const auto most = std::ranges::max_element(held);
    if (most->first == 0) return std::nullopt;
    return static_cast<std::size_t>(most - held.begin());
}

Viewshed viewshed_of_grids(const TrueGround& ground, std::size_t grid, const ViewshedRequest& request,
                           const ViewshedProgress& progress) {
    const TrueSurface& surface = ground.surface(grid);
    if (!others_reach(ground, grid, request)) return viewshed(surface, request, progress);
    Viewshed viewshed{window_around(surface.field().grid, request.eye, request.radius_m), {}, 0};
    const ViewshedWindow& window = viewshed.window;
    if (window.rows < 1 || window.columns < 1) return {};
    viewshed.missed_by_m.assign(
        static_cast<std::size_t>(window.rows) * static_cast<std::size_t>(window.columns), Viewshed::unknown);
    const Lookout lookout(ground, request.eye, request.air);
    const Reach reach(request);
    std::mutex telling;
    int done = 0;
    in_parallel(window.rows, request.threads, [&](int number) {
        std::size_t asked = 0;
        const int row = window.first_row + number;
        for (int column = window.first_column; column < window.first_column + window.columns; ++column) {
            Geodetic target = target_over_post(surface, row, column, 0.0);
            const std::optional<double> ground_m = ground.h_m(target.lat_deg, target.lon_deg);
            if (!ground_m) continue;
            target.h_m = *ground_m;
            if (!reach.holds(target)) continue;
            target.h_m += std::max(request.target_m, least_above_m);
            viewshed.missed_by_m[window.number(row, column)] = missed_by_m(lookout, target);
            ++asked;
        }
        const std::lock_guard lock(telling);
        viewshed.asked += asked;
        if (progress) progress(static_cast<double>(++done) / window.rows);
    });
    return viewshed;
}

}  // namespace oro
