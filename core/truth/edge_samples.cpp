#include "core/truth/view_samples.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>

#include "core/base/parallel.h"

namespace oro {
namespace {

constexpr std::size_t most_edges = 3000;
constexpr double step_share = 0.02, step_cells = 0.25;

class BehindEdges {
  public:
    BehindEdges(const TrueGround& ground, const Sight& sight, const Camera& camera)
        : ground_(ground),
          sight_(sight),
          view_from_ecef_(camera.view_from_ecef()),
          pixels_per_tangent_(0.5 * camera.height_px / camera.half_fov_tangent().y),
          reach_m_(picture_reach_m(ground, sight, camera.eye.h_m)) {
        for (std::size_t grid = 0; grid < ground.grids(); ++grid) {
            const TrueSurface& surface = ground.surface(grid);
            const double step_m = step_cells * wgs84_a_m * surface.field().grid.row_step_rad();
            const bool has_any = surface.levels() > 0;
            const double h_m = has_any ? surface.layer({surface.levels() - 1, 0, 0}).highest_h_m : 0.0;
            step_m_ = std::min(step_m_, step_m);
            highest_h_m_ = std::max(highest_h_m_, h_m);
        }
    }

    void follow(const PictureEdge& edge, std::vector<ViewSample>& found) const {
        const glm::dvec3 direction = edge.near.apparent_m / edge.near.distance_m;
        const double until_m = std::min(edge.until_m, reach_m_);
        double before_h_m = edge.near.point.h_m;
        for (double t_m = edge.near.distance_m; t_m < until_m;) {
            t_m += std::max(step_share * t_m, step_m_);
            const auto below = place_at(std::min(t_m, until_m) * direction);
            if (!below || (below->h_m > highest_h_m_ && below->h_m > before_h_m)) return;
            before_h_m = below->h_m;
            if (const auto sample = ground_at(*below, edge.near)) found.push_back(*sample);
        }
    }

  private:
    [[nodiscard]] std::optional<Geodetic> place_at(const glm::dvec3& apparent_m) const {
        const glm::dvec3 offset_m = sight_.refraction.true_m(apparent_m);
        if (sight_.earth != Earth::ellipsoid) return model_point(sight_.earth, sight_.place, offset_m);
        return geodetic_from_ecef({sight_.eye.m + offset_m});
    }

    // The ground straight above or below a place.
    [[nodiscard]] std::optional<ViewSample> ground_at(const Geodetic& place, const ViewSample& near) const {
        const std::size_t number = ground_.grid_at(place.lat_deg, place.lon_deg, 0);
        const TrueSurface& surface = ground_.surface(number);
        const PostGrid& grid = surface.field().grid;
        const auto [row, column] = grid.post_at(place.lat_deg, place.lon_deg);
        const auto h_m = surface.h_at_m(row, column);
        if (!h_m) return std::nullopt;
        const Geodetic point{place.lat_deg, place.lon_deg, *h_m};
        const glm::dvec3 offset_m = sight_.earth == Earth::ellipsoid
                                        ? ecef_from_geodetic(point).m - sight_.eye.m
                                        : model_offset_m(sight_.earth, sight_.place, point);
        const glm::dvec3 apparent_m = sight_.refraction.apparent_m(offset_m);
        const glm::dvec3 here = view_from_ecef_ * apparent_m, edge = view_from_ecef_ * near.apparent_m;
        if (here.z >= 0.0) return std::nullopt;
        const double away_px =
            glm::length(glm::dvec2(here) / here.z - glm::dvec2(edge) / edge.z) * pixels_per_tangent_;
        if (away_px > behind_edges_px) return std::nullopt;
        const auto slope = surface.slope_at(row, column);
        const int whole_row = std::clamp(static_cast<int>(row), 0, grid.rows() - 2);
        const int whole_column = std::clamp(static_cast<int>(column), 0, grid.columns() - 2);
        constexpr double seen_no_more = 1.0e-9;  // from_seen_px of 0 is for what is seen
        return ViewSample{point,
                          apparent_m,
                          glm::length(apparent_m),
                          slope ? slope->steepness() : 0.0,
                          whole_row,
                          whole_column,
                          row - whole_row >= column - whole_column,
                          false,
                          std::max(away_px, seen_no_more),
                          number};
    }

    const TrueGround& ground_;
    const Sight& sight_;
    glm::dmat3 view_from_ecef_;
    double pixels_per_tangent_;
    double reach_m_;
    double step_m_{std::numeric_limits<double>::infinity()};
    double highest_h_m_{-std::numeric_limits<double>::infinity()};
};

}  // namespace

double picture_reach_m(const TrueGround& ground, const Sight& sight, double eye_h_m) {
    const double reach_m = sight_reach_m(eye_h_m);
    if (sight.earth != Earth::flat) return reach_m;
    // Beyond, sight lines through air that bends them take minutes.
    constexpr double most_of_the_plane_m = 7.0e6;
    double north_deg = -90.0, south_deg = 90.0, east_deg = -1000.0, west_deg = 1000.0;
    for (std::size_t i = 0; i < ground.grids(); ++i) {
        const PostGrid& grid = ground.surface(i).field().grid;
        north_deg = std::max(north_deg, grid.north_deg());
        south_deg = std::min(south_deg, grid.south_deg());
        east_deg = std::max(east_deg, grid.east_deg());
        west_deg = std::min(west_deg, grid.west_deg());
    }
    const double across_deg = std::hypot(north_deg - south_deg, east_deg - west_deg);
    return reach_m + std::min(wgs84_a_m * radians_from_deg(across_deg).rad, most_of_the_plane_m);
}

std::vector<ViewSample> samples_behind(const TrueGround& ground, const Sight& sight, const Camera& camera,
                                       std::span<const PictureEdge> edges, int threads) {
    const BehindEdges behind(ground, sight, camera);
    const std::size_t each = edges.size() / most_edges + 1;
    std::vector<std::vector<ViewSample>> found((edges.size() + each - 1) / each);
    in_parallel(static_cast<int>(found.size()), threads, [&](int i) {
        const std::size_t index = static_cast<std::size_t>(i);
        behind.follow(edges[index * each], found[index]);
    });
    std::vector<ViewSample> all;
    for (const std::vector<ViewSample>& some : found) all.insert(all.end(), some.begin(), some.end());
    return all;
}

}  // namespace oro
