#include "core/growth/meadow_plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <tuple>

#include "core/earth/ellipsoid.h"
#include "core/growth/covering_pages.h"
#include "core/growth/tree_sites.h"
#include "shaders/shared_meadow.h"

namespace oro {
namespace {

constexpr double meadow_circle_m = 7.0;  // around a tile's middle: holds it, and all that stands on it

// A tile of trees' sites whose grass may be near enough.
struct MeadowParent {
    std::uint32_t row, column;
    TileCorners corners;         // posts
    double south_deg, west_deg;  // and its size:
    double rise_deg, width_deg;
};
MeadowParent parent_at(const PostGrid& grid, std::uint32_t row, std::uint32_t column) {
    MeadowParent parent{row, column, {}, site_tile_south_deg(row), site_tile_west_deg(row, column), 0.0, 0.0};
    parent.rise_deg = site_tile_south_deg(row + 1) - parent.south_deg;
    parent.width_deg = 360.0 / site_tile_columns(row);
    for (std::uint32_t i = 0; i < 4; ++i) {
        const PostNumber post = grid.post_at(parent.south_deg + (i / 2) * parent.rise_deg,
                                             parent.west_deg + (i % 2) * parent.width_deg);
        parent.corners[i] = {post.row, post.column};
    }
    return parent;
}
// Of a place in it, 0 to 1 from the west and the south.
glm::dvec2 post_in(const MeadowParent& parent, double east, double north) {
    const TileCorners& c = parent.corners;
    return (c[0] * (1.0 - east) + c[1] * east) * (1.0 - north) + (c[2] * (1.0 - east) + c[3] * east) * north;
}

// Those within reach of the eye.
std::vector<MeadowParent> parents_around(const PostGrid& grid, const Geodetic& eye) {
    constexpr double m_per_deg = 111000.0, reach_m = static_cast<double>(gpu::meadow_reach_m) + 10.0;
    std::vector<MeadowParent> parents;
    const double cosine = std::cos(eye.lat_deg * std::numbers::pi / 180.0);
    if (cosine < 0.05) return parents;
    const double reach_deg = reach_m / m_per_deg;
    for (std::int64_t row = site_tile_row_at(eye.lat_deg - reach_deg);
         row <= site_tile_row_at(eye.lat_deg + reach_deg); ++row) {
        const auto tile_row = static_cast<std::uint32_t>(row);
        const std::int64_t count = site_tile_columns(tile_row);
        const double per_deg = static_cast<double>(count) / 360.0, middle = (eye.lon_deg + 180.0) * per_deg;
        const double reach = reach_deg / cosine * per_deg;
        for (auto column = static_cast<std::int64_t>(std::floor(middle - reach));
             column <= static_cast<std::int64_t>(std::floor(middle + reach)); ++column)
            parents.push_back(
                parent_at(grid, tile_row, static_cast<std::uint32_t>((column % count + count) % count)));
    }
    return parents;
}

// False where a place is too far away, whatever its height: by what is quick to reckon.
bool is_near(const Geodetic& eye, const Geodetic& middle) {
    constexpr double m_per_deg = 110000.0;  // or more
    constexpr double reach_m = static_cast<double>(gpu::meadow_reach_m) + 1.1 * meadow_circle_m;
    const double north_m = (middle.lat_deg - eye.lat_deg) * m_per_deg;
    const double around_deg = std::remainder(middle.lon_deg - eye.lon_deg, 360.0);
    const double east_m = around_deg * m_per_deg * std::cos(middle.lat_deg * std::numbers::pi / 180.0);
    return north_m * north_m + east_m * east_m < reach_m * reach_m;
}

// Which tiles of grass are near enough and may be in the picture.
class MeadowInView {
  public:
    MeadowInView(const Camera& camera, const Tile& tile, double exaggeration)
        : tallest_m_(std::max(exaggeration, 1.0)),
          eye_(camera.eye_ecef().m),
          view_from_ecef_(camera.view_from_ecef()),
          planes_(frustum_planes_view(projection_of_tile(camera, tile))) {}
    // Metres from the eye to the nearest of a tile's ground; negative where it does not show. Light that
    // bends moves what is so near by less than a millimetre.
    [[nodiscard]] double distance_m(const Geodetic& middle, const GroundRange& ground) const {
        const auto at = [&](double h_m) {
            return view_from_ecef_ * (ecef_from_geodetic({middle.lat_deg, middle.lon_deg, h_m}).m - eye_);
        };
        const glm::dvec3 low = at(ground.low_m), high = at(ground.high_m + tallest_m_);
        const glm::dvec3 along = high - low;
        const double share = std::clamp(-glm::dot(low, along) / glm::dot(along, along), 0.0, 1.0);
        const double nearest_m = glm::length(low + share * along);
        if (nearest_m > static_cast<double>(gpu::meadow_reach_m) + meadow_circle_m) return -1.0;
        for (const Plane& plane : planes_) {
            const glm::dvec3 normal(plane);
            if (!(std::max(glm::dot(normal, low), glm::dot(normal, high)) + plane.w >= -meadow_circle_m))
                return -1.0;
        }
        return nearest_m;
    }

  private:
    double tallest_m_;  // of grass, as drawn
    glm::dvec3 eye_;
    glm::dmat3 view_from_ecef_;
    std::array<Plane, 5> planes_;
};

}  // namespace

MeadowPlan plan_meadow(const PostGrid& grid, std::span<const PageIndex> page_indices,
                       const GroundRangeOf& ground, const GrowthView& view) {
    MeadowPlan plan;
    if (page_indices.empty()) return plan;
    const auto parents = parents_around(grid, view.camera.eye);
    if (parents.empty()) return plan;
    const CoveringPages pages(page_indices);
    const MeadowInView in_view(view.camera, view.tile, view.exaggeration);
    constexpr std::uint32_t side = gpu::meadow_tiles_per_side;
    std::vector<std::pair<double, gpu::GrowthTile>> near;
    for (const MeadowParent& parent : parents) {
        for (std::uint32_t i = 0; i < side * side; ++i) {
            constexpr double step = 1.0 / side;
            const double east = (i % side) * step, north = (i / side) * step;
            const Geodetic middle{parent.south_deg + (north + 0.5 * step) * parent.rise_deg,
                                  parent.west_deg + (east + 0.5 * step) * parent.width_deg, 0.0};
            if (!is_near(view.camera.eye, middle)) continue;
            const TileCorners corners{post_in(parent, east, north), post_in(parent, east + step, north),
                                      post_in(parent, east, north + step),
                                      post_in(parent, east + step, north + step)};
            const auto tile = growth_tile(grid, pages, parent.row * side + i / side,
                                          parent.column * side + i % side, corners);
            if (!tile) continue;
            const double distance_m = in_view.distance_m(middle, ground(tile->page));
            if (distance_m >= 0.0) near.emplace_back(distance_m, *tile);
        }
    }
    std::ranges::sort(
        near, {}, [](const auto& one) { return std::tuple(one.first, one.second.row, one.second.column); });
    if (near.size() > gpu::meadow_tiles_max) near.resize(gpu::meadow_tiles_max);
    for (const auto& [distance_m, tile] : near) plan.tiles.push_back(tile);
    return plan;
}

}  // namespace oro
