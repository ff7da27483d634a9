#include "core/growth/growth_plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <tuple>
#include <utility>

#include "core/earth/ellipsoid.h"
#include "core/growth/covering_pages.h"
#include "core/growth/tree_reach.h"
#include "core/growth/tree_sites.h"

namespace oro::gpu {
namespace {
#define ORO_FUNCTION [[maybe_unused]]
#include "shaders/growth/reach.glsl"
#undef ORO_FUNCTION
}  // namespace
}  // namespace oro::gpu

namespace oro {
namespace {

constexpr double tile_circle_m = 185.0;  // around a tile's middle: holds it

// What the tiles of a row of the lattice have in common.
struct TileRow {
    double south_deg, north_deg;
    std::uint32_t columns;          // tiles round the Earth
    SineCosine middle;              // of the latitude of their middles
    double normal_m;                // the radius of curvature along the prime vertical there
    double south_post, north_post;  // rows of posts along their edges; on a net nothing

    [[nodiscard]] double west_deg(std::uint32_t column) const {
        return -180.0 + 360.0 * static_cast<double>(column) / columns;
    }
};
TileRow tile_row(const PostGrid& grid, std::uint32_t row) {
    const double lat_deg = site_tile_south_deg(row) + 0.5 * (site_tile_south_deg(1) - site_tile_south_deg(0));
    const SineCosine lat = sine_cosine_deg(lat_deg);
    const double south_deg = site_tile_south_deg(row), north_deg = site_tile_south_deg(row + 1);
    return {south_deg,
            north_deg,
            site_tile_columns(row),
            lat,
            wgs84_a_m / std::sqrt(1.0 - wgs84_e2 * lat.sine * lat.sine),
            grid.net ? 0.0 : grid.lat.index_at(south_deg),
            grid.net ? 0.0 : grid.lat.index_at(north_deg)};
}

// Fractional numbers of the posts at a tile's corners: south-west, south-east, north-west, north-east.
std::array<PostNumber, 4> corners_of(const PostGrid& grid, const TileRow& row, std::uint32_t column) {
    const double west_deg = row.west_deg(column), east_deg = west_deg + 360.0 / row.columns;
    if (grid.net)
        return {grid.post_at(row.south_deg, west_deg), grid.post_at(row.south_deg, east_deg),
                grid.post_at(row.north_deg, west_deg), grid.post_at(row.north_deg, east_deg)};
    const double west = grid.column_at(west_deg), east = grid.column_at(east_deg);
    return {{{row.south_post, west}, {row.south_post, east}, {row.north_post, west}, {row.north_post, east}}};
}

// A tile of the lattice on the grid; none where no part of it is there.
std::optional<gpu::GrowthTile> tile_on_grid(const PostGrid& grid, const CoveringPages& pages,
                                            const TileRow& lattice_row, std::uint32_t row,
                                            std::uint32_t column) {
    const std::array<PostNumber, 4> posts = corners_of(grid, lattice_row, column);
    TileCorners corners{};
    for (std::size_t i = 0; i < posts.size(); ++i) corners[i] = {posts[i].row, posts[i].column};
    return growth_tile(grid, pages, row, column, corners);
}

// Which tiles the frustum does not leave out. Light that bends, lean and what a tile's trees reach beyond it
// are within the slack.
class TilesInView {
  public:
    TilesInView(const Camera& camera, const Tile& tile, double exaggeration)
        : tallest_m_(40.0 * std::max(exaggeration, 1.0)),
          beside_m_(26.0 + 4.0 * std::max(exaggeration, 1.0)),
          eye_(camera.eye_ecef().m),
          eye_h_m_(camera.eye.h_m),
          tangent_(std::abs(std::tan(camera.eye.lat_deg * std::numbers::pi / 180.0))),
          view_from_ecef_(camera.view_from_ecef()),
          view_from_enu_(view_from_ecef_ * ecef_from_enu(camera.eye.lat_deg, camera.eye.lon_deg)),
          planes_(frustum_planes_view(projection_of_tile(camera, tile))) {
        for (std::size_t i = 0; i < planes_.size(); ++i)
            up_[i] = glm::dot(glm::dvec3(planes_[i]), view_from_enu_[2]);
    }
    [[nodiscard]] bool may_show(const TileRow& row, std::uint32_t column, const GroundRange& ground) const {
        const double slack_m = tile_circle_m + beside_m_;
        const double lon_deg = row.west_deg(column) + 180.0 / row.columns;
        const auto [low, high] = view_of(row, lon_deg, ground.low_m, ground.high_m + tallest_m_);
        for (const Plane& plane : planes_) {
            const glm::dvec3 normal(plane);
            if (!(std::max(glm::dot(normal, low), glm::dot(normal, high)) + plane.w >= -slack_m))
                return false;
        }
        return true;
    }

    // From where to where, metres east of the eye, tiles of a row may show whose middles lie so far north of
    // it: for none beyond, within a distance, is the answer below true. The first is larger where there are
    // none.
    [[nodiscard]] std::pair<double, double> columns_that_may_show(double north_m, double within_m,
                                                                  const GroundRange& ground) const {
        constexpr double earth_m = 6371.0e3, rounding_m = 1.0;
        const double square = within_m * within_m * (1.0 + 1.0e-6), drop_m = square / (2.0 * earth_m);
        const double slack_m = tile_circle_m + 30.0 + beside_m_ + 0.012 * std::sqrt(square) +
                               tangent_ * square / earth_m + rounding_m;
        const double low_m = ground.low_m - eye_h_m_ - drop_m, high_m = ground.high_m + tallest_m_ - eye_h_m_;
        const double half_m = std::sqrt(std::max(0.0, square - north_m * north_m)) + rounding_m;
        double from_m = -half_m, to_m = half_m;
        for (std::size_t i = 0; i < planes_.size(); ++i) {
            const glm::dvec3 normal(planes_[i]);
            const double east = glm::dot(normal, view_from_enu_[0]);
            const double rest_m = glm::dot(normal, view_from_enu_[1]) * north_m +
                                  std::max(up_[i] * low_m, up_[i] * high_m) + planes_[i].w + slack_m;
            // East times so many metres and the rest are above nothing.
            if (east > 1.0e-6) from_m = std::max(from_m, -rest_m / east - rounding_m);
            if (east < -1.0e-6) to_m = std::min(to_m, -rest_m / east + rounding_m);
        }
        return {from_m, to_m};
    }

    // Whether a tile may show whose middle lies so far east and north of the eye by its degrees
    // (tiles_around), and whose ground is between two heights. Quicker than the above, and never false where
    // that is true.
    [[nodiscard]] bool may_show(double east_m, double north_m, const GroundRange& ground) const {
        constexpr double earth_m = 6371.0e3;
        const double square = east_m * east_m + north_m * north_m, drop_m = square / (2.0 * earth_m);
        // Degrees differ by 0.7 % in length from the equator to the poles, and meridians draw near each
        // other.
        const double slack_m =
            tile_circle_m + 30.0 + beside_m_ + 0.012 * std::sqrt(square) + tangent_ * square / earth_m;
        const double low_m = ground.low_m - eye_h_m_ - drop_m;
        const double high_m = ground.high_m + tallest_m_ - eye_h_m_ - drop_m;
        const glm::dvec3 level = view_from_enu_ * glm::dvec3(east_m, north_m, 0.0);
        for (std::size_t i = 0; i < planes_.size(); ++i) {
            const double above_m = std::max(up_[i] * low_m, up_[i] * high_m);
            if (!(glm::dot(glm::dvec3(planes_[i]), level) + above_m + planes_[i].w >= -slack_m)) return false;
        }
        return true;
    }

  private:
    // Of two heights over a place in the middle of a row: ecef_from_geodetic() of both.
    [[nodiscard]] std::pair<glm::dvec3, glm::dvec3> view_of(const TileRow& row, double lon_deg, double low_m,
                                                            double high_m) const {
        const SineCosine &lat = row.middle, lon = sine_cosine_deg(lon_deg);
        const auto at = [&](double h_m) {
            const double rho_m = (row.normal_m + h_m) * lat.cosine;
            const double z_m = (row.normal_m * (1.0 - wgs84_e2) + h_m) * lat.sine;
            return view_from_ecef_ * (glm::dvec3(rho_m * lon.cosine, rho_m * lon.sine, z_m) - eye_);
        };
        return {at(low_m), at(high_m)};
    }
    double tallest_m_;  // of trees, as drawn
    double beside_m_;   // their crowns and their lean, beside a tile
    glm::dvec3 eye_;
    double eye_h_m_, tangent_;
    glm::dmat3 view_from_ecef_, view_from_enu_;
    std::array<Plane, 5> planes_;
    std::array<double, 5> up_;  // of each: along the vertical
};

// A tile of the lattice near the eye.
struct NearTile {
    double distance_m;
    std::uint32_t row, column;
};

// Those within reach that may show, of ground between two heights; nearest first. None near a pole.
std::vector<NearTile> tiles_around(const Geodetic& eye, double reach_m, const TilesInView& in_view,
                                   const GroundRange& ground) {
    constexpr double m_per_deg = 111320.0;
    const double cosine = std::cos(eye.lat_deg * std::numbers::pi / 180.0);
    std::vector<NearTile> near;
    // No tile that is within reach by its exact distance is beyond it by its square.
    const double reach_square = (reach_m + tile_circle_m) * (reach_m + tile_circle_m) * (1.0 + 1.0e-9);
    if (cosine < 0.05) return near;
    const double tile_deg = site_tile_south_deg(1) - site_tile_south_deg(0),
                 reach_deg = reach_m / m_per_deg * 1.01;
    const std::int64_t first = std::max<std::int64_t>(site_tile_row_at(eye.lat_deg - reach_deg), 0);
    const std::int64_t last =
        std::min<std::int64_t>(site_tile_row_at(eye.lat_deg + reach_deg), gpu::site_tile_rows - 1);
    for (std::int64_t row = first; row <= last; ++row) {
        const auto tile_row = static_cast<std::uint32_t>(row);
        const std::int64_t count = site_tile_columns(tile_row);
        const double tiles_per_deg = static_cast<double>(count) / 360.0;
        const double middle = (eye.lon_deg + 180.0) * tiles_per_deg;
        const double north_m = (site_tile_south_deg(tile_row) + 0.5 * tile_deg - eye.lat_deg) * m_per_deg;
        const auto across = static_cast<std::int64_t>(std::ceil(reach_deg / cosine * tiles_per_deg)) + 1;
        const double around_m = reach_m + tile_circle_m;
        const auto [west_m, east_most_m] = in_view.columns_that_may_show(north_m, around_m, ground);
        if (west_m > east_most_m) continue;
        const auto first_of = [&](double east_m) {
            const double number = east_m / (m_per_deg * cosine) * tiles_per_deg + middle - 0.5;
            return static_cast<std::int64_t>(std::floor(number - std::floor(middle)));
        };
        for (std::int64_t i = std::max(-across, first_of(west_m) - 1),
                          last_column = std::min(across, first_of(east_most_m) + 2);
             i <= last_column; ++i) {
            const std::int64_t number = static_cast<std::int64_t>(std::floor(middle)) + i;
            const double east_m =
                (static_cast<double>(number) + 0.5 - middle) / tiles_per_deg * m_per_deg * cosine;
            if (north_m * north_m + east_m * east_m > reach_square ||
                !in_view.may_show(east_m, north_m, ground))
                continue;
            const double distance_m = std::hypot(north_m, east_m);
            if (distance_m > reach_m + tile_circle_m) continue;
            near.push_back(
                {distance_m, tile_row, static_cast<std::uint32_t>((number % count + count) % count)});
        }
    }
    std::ranges::sort(near, {},
                      [](const NearTile& one) { return std::tuple(one.distance_m, one.row, one.column); });
    return near;
}

// What a frame has of a grid.
struct FramedGround {
    const PostGrid& grid;
    std::span<const PageIndex> page_indices;
    const GroundRangeOf& of_page;
    GroundRange all;  // of all its pages
};

// The tiles within reach that may show, at most so many, the nearest.
std::vector<gpu::GrowthTile> tiles_in_view(const FramedGround& ground, const TilesInView& in_view,
                                           const Geodetic& eye, double reach_m, std::size_t most) {
    std::vector<gpu::GrowthTile> tiles;
    const auto around = tiles_around(eye, reach_m, in_view, ground.all);
    if (around.empty()) return tiles;
    const CoveringPages pages(ground.page_indices);
    const auto [lowest, highest] = std::ranges::minmax(around, {}, &NearTile::row);
    std::vector<TileRow> rows;
    for (std::uint32_t row = lowest.row; row <= highest.row; ++row)
        rows.push_back(tile_row(ground.grid, row));
    for (const NearTile& near : around) {
        if (tiles.size() == most) break;
        const TileRow& row = rows[near.row - lowest.row];
        const auto tile = tile_on_grid(ground.grid, pages, row, near.row, near.column);
        if (tile && in_view.may_show(row, near.column, ground.of_page(tile->page))) tiles.push_back(*tile);
    }
    return tiles;
}

bool is_whole_picture(const Camera& camera, const Tile& tile) {
    return tile.width_px == camera.width_px && tile.height_px == camera.height_px;
}

}  // namespace

GrowthPlan plan_growth(const PostGrid& grid, std::span<const PageIndex> page_indices,
                       const GroundRangeOf& ground, const GrowthView& view) {
    GrowthPlan plan;
    plan.reach_m = static_cast<float>(reach_of_trees_m(view.camera, view.tau_px));
    if (page_indices.empty()) return plan;
    FramedGround framed{grid, page_indices, ground, ground(0)};
    for (std::size_t i = 1; i < page_indices.size(); ++i) {
        const GroundRange one = ground(i);
        framed.all = {std::min(framed.all.low_m, one.low_m), std::max(framed.all.high_m, one.high_m)};
    }
    const auto seen = [&](const Tile& part, std::size_t most) {
        return tiles_in_view(framed, TilesInView(view.camera, part, view.exaggeration), view.camera.eye,
                             static_cast<double>(plan.reach_m), most);
    };
    plan.tiles = seen(view.tile, gpu::growth_tiles_max);
    // Far forests rise, and water mirrors, where a picture has trees: in all of its tiles.
    if (plan.tiles.empty() && !is_whole_picture(view.camera, view.tile))
        plan.tiles = seen({0, 0, view.camera.width_px, view.camera.height_px}, 1);
    return plan;
}

double reach_of_trees_m(const Camera& camera, double tau_px) {
    const double per_tangent = 0.5 * camera.height_px / camera.half_fov_tangent().y;
    return static_cast<double>(
        gpu::tree_reach_m(static_cast<float>(per_tangent), static_cast<float>(tau_px)));
}

int canopy_rise_px(const Camera& camera, double tau_px) {
    // Twice: a metre covers more pixels towards the corners of a wide picture.
    const auto per_tangent = static_cast<float>(0.5 * camera.height_px / camera.half_fov_tangent().y);
    const float reach_m = gpu::tree_reach_m(per_tangent, static_cast<float>(tau_px));
    return static_cast<int>(gpu::canopy_most_px(2.0F * per_tangent, reach_m));
}

}  // namespace oro
