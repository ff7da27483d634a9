#include "core/made_pages/visible_ground.h"

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>
#include <limits>
#include <numbers>
#include <utility>

#include "core/base/parallel.h"
#include "core/earth/world_model.h"
#include "core/frame/model_view.h"
#include "core/lod/levels.h"
#include "core/made_pages/polar_horizon.h"

namespace oro {
namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();
constexpr float no_tangent = std::numeric_limits<float>::infinity();
// No radius of curvature of WGS84 is larger, nor smaller.
constexpr double most_curved_radius_m = 6'400'000.0, least_curved_radius_m = 6'335'000.0;
// More tiles are not worth their while: what is left is that the picture shows much of them.
constexpr std::size_t most_tiles = 60'000, most_tiles_listed = 400'000;
constexpr int nodes_of_tile = 2;  // along a side, of level 3

// Half the azimuths that a picture may show, from its heading on; pi: all.
double half_azimuths_rad(const FrameView& view) {
    const Camera& camera = view.camera;
    const glm::dmat3 view_from_enu =
        camera.view_from_ecef() * ecef_from_enu(camera.eye.lat_deg, camera.eye.lon_deg);
    const auto planes = frustum_planes_view(projection_of_tile(camera, view.tile));
    for (const double up : {1.0, -1.0}) {
        const glm::dvec3 seen = view_from_enu * glm::dvec3(0.0, 0.0, up);
        if (std::ranges::all_of(
                planes, [&](const Plane& plane) { return glm::dot(glm::dvec3(plane), seen) > -0.02; }))
            return std::numbers::pi;
    }
    const glm::dmat3 enu_from_ecef = glm::transpose(ecef_from_enu(camera.eye.lat_deg, camera.eye.lon_deg));
    const double heading = radians_from_deg(camera.attitude.heading_deg).rad;
    constexpr int parts = 64;
    double half_rad = 0.0;
    for (int i = 0; i <= parts; ++i)
        for (int side = 0; side < 4; ++side) {
            const double share = static_cast<double>(i) / parts;
            const glm::dvec2 of_tile = side == 0   ? glm::dvec2(share, 0.0)
                                       : side == 1 ? glm::dvec2(share, 1.0)
                                       : side == 2 ? glm::dvec2(0.0, share)
                                                   : glm::dvec2(1.0, share);
            const glm::dvec2 at_px{view.tile.x_px + of_tile.x * view.tile.width_px,
                                   view.tile.y_px + of_tile.y * view.tile.height_px};
            const glm::dvec3 to = enu_from_ecef * camera.ecef_direction_at(at_px);
            half_rad = std::max(
                half_rad, std::abs(std::remainder(std::atan2(to.x, to.y) - heading, 2.0 * std::numbers::pi)));
        }
    // What is between those places, and a pixel more.
    half_rad += 0.03 + 2.0 * camera.half_fov_tangent().y / camera.height_px;
    return half_rad > 1.5 ? std::numbers::pi : half_rad;
}

// The highest tangent under which what is no higher than h above the ellipsoid is seen, between two distances
// across the eye's vertical: no surface of that height lies above a sphere that touches it below the eye and
// has the largest radius of curvature.
double highest_tangent(double h_m, double eye_h_m, double curvature_per_m, double nearest_m,
                       double farthest_m) {
    const double over_m = h_m - eye_h_m,
                 bend = 0.5 / (most_curved_radius_m + std::max(h_m, 0.0)) - 0.5 * curvature_per_m;
    const auto at = [&](double m) { return over_m / m - bend * m; };
    double tangent = std::max(at(nearest_m), at(farthest_m));
    if (over_m < 0.0 && bend > 0.0) {
        const double best_m = std::sqrt(-over_m / bend);
        if (best_m > nearest_m && best_m < farthest_m) tangent = std::max(tangent, at(best_m));
    }
    return tangent;
}

}  // namespace

// Goes through tiles from the eye outwards.
class VisibleGroundSearch {
  public:
    VisibleGroundSearch(VisibleGround& found, const FrameView& view, const PictureCulling& culling,
                        double lowest_h_m, double highest_h_m, int threads);
    // False where it is given up.
    bool run();

  private:
    struct Listed {
        int row, column;
        double across_m, radius_m;  // of its middle; of all of it around that
        double azimuth_rad;
        bool is_ground;  // others lie beside the region
        [[nodiscard]] double nearest_m() const { return across_m - radius_m; }
    };
    struct PlacedPost {
        float azimuth_rad, across_m, low_tangent;
    };
    struct SeenPost {
        PlacedPost placed;
        float high_tangent, across_m;
        double nearest_m, farthest_m;  // from the eye: anything beside the post
        double low_h_m;
    };
    struct MadeTile {
        std::vector<PlacedPost> posts;
        std::array<VisibleGround::Reach, 4> reaches{};
        std::array<VisibleGround::Node, 4> nodes{};
    };
    struct Seen {
        glm::dvec3 enu_m;
        [[nodiscard]] double across_m() const { return std::hypot(enu_m.x, enu_m.y); }
        [[nodiscard]] double azimuth_rad() const { return std::atan2(enu_m.x, enu_m.y); }
    };
    [[nodiscard]] Seen seen(const glm::dvec3& ecef_m) const {
        glm::dvec3 enu = enu_from_ecef_ * (ecef_m - eye_ecef_);
        enu.z += 0.5 * curvature_per_m_ * (enu.x * enu.x + enu.y * enu.y);
        return {enu};
    }
    // From the picture's heading on.
    [[nodiscard]] double turned(double azimuth_rad) const {
        return std::remainder(azimuth_rad - heading_rad_, 2.0 * std::numbers::pi);
    }
    bool list_tiles();
    [[nodiscard]] std::optional<Listed> listed(int row, int column) const;
    [[nodiscard]] bool in_frustum(const Listed& tile) const;
    [[nodiscard]] VisibleGround::Reach whole_reach(const Listed& tile) const;
    void set_reach(const Listed& tile, int node, const VisibleGround::Reach& reach);
    [[nodiscard]] MadeTile made(const Listed& tile) const;
    [[nodiscard]] SeenPost seen_post(const Seen& low, const Seen& high, double low_h_m) const;
    static void take_post(const SeenPost& post, VisibleGround::Reach& reach, VisibleGround::Node& node);
    void take_unknown(const Listed& tile);
    void take(const MadeTile& tile);
    void find_nodes();

    VisibleGround& found_;
    const MadeRegion& region_;
    const PictureCulling& culling_;
    double lowest_h_m_, highest_h_m_;
    int threads_;
    Geodetic eye_;
    glm::dvec3 eye_ecef_;
    glm::dmat3 enu_from_ecef_;
    double curvature_per_m_, heading_rad_, half_rad_, reach_m_, post_m_;
    std::vector<Listed> tiles_;
    std::shared_ptr<PolarHorizon> horizon_;
    std::vector<VisibleGround::Node> of_nodes_;  // of all that were made
};

VisibleGroundSearch::VisibleGroundSearch(VisibleGround& found, const FrameView& view,
                                         const PictureCulling& culling, double lowest_h_m, double highest_h_m,
                                         int threads)
    : found_(found),
      region_(found.ground_.region()),
      culling_(culling),
      lowest_h_m_(lowest_h_m),
      highest_h_m_(highest_h_m),
      threads_(threads),
      eye_(view.camera.eye),
      eye_ecef_(view.camera.eye_ecef().m),
      enu_from_ecef_(glm::transpose(ecef_from_enu(eye_.lat_deg, eye_.lon_deg))),
      curvature_per_m_(Refraction(eye_, view.model.air).curvature_per_m()),
      heading_rad_(radians_from_deg(view.camera.attitude.heading_deg).rad),
      half_rad_(half_azimuths_rad(view)) {
    // The farthest place that is seen over the lowest ground.
    const double bend = 1.0 / most_curved_radius_m - curvature_per_m_;
    reach_m_ = bend > 0.02 / most_curved_radius_m
                   ? 1.02 * (std::sqrt(2.0 * std::max(0.0, eye_.h_m - lowest_h_m_) / bend) +
                             std::sqrt(2.0 * (highest_h_m_ - lowest_h_m_) / bend)) +
                         5000.0
                   : unbounded;
    const double step_rad =
        std::ldexp(radians_from_deg(region_.grid.lat.spacing_deg()).rad, CoarseGround::level);
    post_m_ = 1.02 * std::numbers::sqrt2 * step_rad * most_curved_radius_m;
    found_.margin_per_m_ = 1.02 * std::max(view.tau_px, 0.1) /
                           static_cast<double>(level_view(view.camera, view.tau_px).pixels_per_tangent);
    found_.margin_m_ = 2.0 + ModelView(view.camera, view.model, {}).rounding_m();
}

std::optional<VisibleGroundSearch::Listed> VisibleGroundSearch::listed(int row, int column) const {
    constexpr double half = CoarseGround::tile_cells / 2.0;
    const PostGrid& grid = region_.grid;
    const auto lat_deg = [&](double cells) { return grid.lat.at_deg(0) - cells * grid.lat.spacing_deg(); };
    const double middle_deg = lat_deg(CoarseGround::tile_cells * row + half);
    if (std::abs(middle_deg) > 88.0) return std::nullopt;
    const double lon_deg =
        grid.lon.at_deg(0) + (CoarseGround::tile_cells * column + half) * grid.lon.spacing_deg();
    const Seen middle = seen(ecef_from_geodetic({middle_deg, lon_deg, 0.0}).m);
    const double half_rad = half * radians_from_deg(grid.lat.spacing_deg()).rad;
    const double widest_deg = std::max(0.0, std::abs(middle_deg) - half * grid.lat.spacing_deg());
    const double across_m = middle.across_m();
    // Places that are higher lie farther out, as their vertical leans.
    const double leans_m =
        std::max(std::abs(highest_h_m_), std::abs(lowest_h_m_)) * across_m / least_curved_radius_m;
    const double radius_m =
        1.01 * most_curved_radius_m * half_rad * std::hypot(1.0, std::cos(radians_from_deg(widest_deg).rad)) +
        leans_m + post_m_;
    return Listed{row,
                  column,
                  across_m,
                  radius_m,
                  turned(middle.azimuth_rad()),
                  row >= 0 && column >= 0 && std::int64_t{row} * CoarseGround::tile_cells < grid.rows() - 1 &&
                      std::int64_t{column} * CoarseGround::tile_cells < grid.columns() - 1};
}

// Those in the picture's azimuths, and beside them; those around the region, too.
bool VisibleGroundSearch::list_tiles() {
    const PostGrid& grid = region_.grid;
    const double reach_deg = deg_from_radians(Radians(reach_m_ / least_curved_radius_m)) + 0.2;
    const double farthest_deg = std::abs(eye_.lat_deg) + reach_deg;
    if (!(farthest_deg < 85.0)) return false;
    const double lon_reach_deg = reach_deg / std::cos(radians_from_deg(farthest_deg).rad);
    const double column = grid.column_at(eye_.lon_deg), row = grid.lat.index_at(eye_.lat_deg);
    const auto tiles_of = [](int posts) { return (posts - 2) / CoarseGround::tile_cells + 1; };
    const auto tile_of = [](double cell, int tiles) {
        return static_cast<int>(
            std::clamp(std::floor(cell / CoarseGround::tile_cells), -1.0, static_cast<double>(tiles)));
    };
    const int rows = tiles_of(grid.rows()), columns = tiles_of(grid.columns());
    const double down = reach_deg / grid.lat.spacing_deg(), right = lon_reach_deg / grid.lon.spacing_deg();
    const int first_row = tile_of(row - down, rows), last_row = tile_of(row + down, rows);
    const int first_column = tile_of(column - right, columns), last_column = tile_of(column + right, columns);
    // What is on the other side of the first meridian is not looked for.
    if (grid.wraps_longitude() && (first_column < 0 || last_column >= columns)) return false;
    if (static_cast<double>(last_row - first_row + 1) * (last_column - first_column + 1) >
        static_cast<double>(most_tiles_listed))
        return false;
    for (int r = first_row; r <= last_row; ++r)
        for (int c = first_column; c <= last_column; ++c) {
            const std::optional<Listed> tile = listed(r, c);
            if (!tile || tile->nearest_m() > reach_m_) continue;
            const double around_rad =
                tile->nearest_m() > 0.0 ? std::asin(std::min(1.0, tile->radius_m / tile->across_m)) : 4.0;
            if (std::abs(tile->azimuth_rad) - around_rad <= half_rad_) tiles_.push_back(*tile);
        }
    found_.first_row_ = std::max(0, first_row) * nodes_of_tile;
    found_.first_column_ = std::max(0, first_column) * nodes_of_tile;
    found_.rows_ = (last_row + 1) * nodes_of_tile - found_.first_row_;
    found_.columns_ = (last_column + 1) * nodes_of_tile - found_.first_column_;
    found_.reaches_.assign(static_cast<std::size_t>(found_.rows_) * static_cast<std::size_t>(found_.columns_),
                           {no_tangent, 0.0F, 0.0F, 0.0F});
    std::ranges::sort(tiles_, {}, [](const Listed& tile) { return tile.nearest_m(); });
    return true;
}

bool VisibleGroundSearch::in_frustum(const Listed& tile) const {
    PageBound bound;
    const PostGrid& grid = region_.grid;
    constexpr double half = CoarseGround::tile_cells / 2.0;
    bound.centre = ecef_from_geodetic(
        {grid.lat.at_deg(0) - (CoarseGround::tile_cells * tile.row + half) * grid.lat.spacing_deg(),
         grid.lon.at_deg(0) + (CoarseGround::tile_cells * tile.column + half) * grid.lon.spacing_deg(),
         0.5 * (lowest_h_m_ + highest_h_m_)});
    bound.radius_m = tile.radius_m + 0.5 * (highest_h_m_ - lowest_h_m_);
    bound.horizon.angle_rad = 4.0;
    return culling_.may_show(bound);
}

// Of the highest ground there may be.
VisibleGround::Reach VisibleGroundSearch::whole_reach(const Listed& tile) const {
    const double nearest_m = tile.nearest_m();
    if (nearest_m < 10.0 * post_m_) return {no_tangent, 0.0F, 0.0F, 0.0F};
    const double around_rad = std::asin(std::min(1.0, tile.radius_m / tile.across_m)) + 1.0e-5;
    return {static_cast<float>(highest_tangent(highest_h_m_, eye_.h_m, curvature_per_m_, nearest_m,
                                               tile.across_m + tile.radius_m) +
                               1.0e-6),
            static_cast<float>(tile.azimuth_rad - around_rad),
            static_cast<float>(tile.azimuth_rad + around_rad), static_cast<float>(nearest_m)};
}

void VisibleGroundSearch::set_reach(const Listed& tile, int node, const VisibleGround::Reach& reach) {
    const int row = tile.row * nodes_of_tile + node / 2 - found_.first_row_;
    const int column = tile.column * nodes_of_tile + node % 2 - found_.first_column_;
    found_.reaches_[static_cast<std::size_t>(row) * static_cast<std::size_t>(found_.columns_) +
                    static_cast<std::size_t>(column)] = reach;
}

// Whatever is there hides nothing.
void VisibleGroundSearch::take_unknown(const Listed& tile) {
    constexpr int parts = 4;
    if (tile.nearest_m() < 2.0 * tile.radius_m) {
        horizon_->take(0.0, 4.0, 0.0, tile.across_m + tile.radius_m, -std::numeric_limits<float>::infinity());
        return;
    }
    // In parts, so that what is beside it is not unknown, too.
    const PostGrid& grid = region_.grid;
    const double radius_m = (tile.radius_m - post_m_) / parts + post_m_;
    for (int i = 0; i < parts * parts; ++i) {
        const double down = (i / parts + 0.5) / parts, right = (i % parts + 0.5) / parts;
        const Seen middle =
            seen(ecef_from_geodetic({grid.lat.at_deg(0) - CoarseGround::tile_cells * (tile.row + down) *
                                                              grid.lat.spacing_deg(),
                                     grid.lon.at_deg(0) + CoarseGround::tile_cells * (tile.column + right) *
                                                              grid.lon.spacing_deg(),
                                     0.0})
                     .m);
        const double across_m = middle.across_m();
        horizon_->take(turned(middle.azimuth_rad()), std::asin(std::min(1.0, radius_m / across_m)),
                       across_m - radius_m, across_m + radius_m, -std::numeric_limits<float>::infinity());
    }
}

VisibleGroundSearch::MadeTile VisibleGroundSearch::made(const Listed& tile) const {
    const CoarseGround::Tile ground = found_.ground_.tile(tile.row, tile.column);
    const PostGrid& grid = region_.grid;
    MadeTile made;
    made.posts.reserve(ground.coarse_m.size());
    for (int i = 0; i < 4; ++i) {
        made.reaches[static_cast<std::size_t>(i)] = {-no_tangent, 1.0e9F, -1.0e9F, no_tangent};
        made.nodes[static_cast<std::size_t>(i)] = {
            tile.row * nodes_of_tile + i / 2, tile.column * nodes_of_tile + i % 2, unbounded, 0.0, unbounded};
    }
    std::vector<SineCosine> columns;
    for (int c = 0; c < ground.columns; ++c)
        columns.push_back(
            sine_cosine_deg(grid.lon.at_deg(CoarseGround::region_post(tile.column, c, grid.columns() - 1))));
    constexpr int half = (CoarseGround::tile_posts - 1) / 2;
    for (int r = 0; r < ground.rows; ++r) {
        const double lat_deg = grid.lat.at_deg(CoarseGround::region_post(tile.row, r, grid.rows() - 1));
        const SineCosine lat = sine_cosine_deg(lat_deg);
        const double normal_m = prime_vertical_radius_m(lat_deg);
        const double polar_m = normal_m * (1.0 - wgs84_e2);
        for (int c = 0; c < ground.columns; ++c) {
            const std::size_t post = static_cast<std::size_t>(r * ground.columns + c);
            const SineCosine& lon = columns[static_cast<std::size_t>(c)];
            const auto at = [&](double h_m) {
                const double out_m = (normal_m + h_m) * lat.cosine;
                return seen({out_m * lon.cosine, out_m * lon.sine, (polar_m + h_m) * lat.sine});
            };
            const double low_h_m = static_cast<double>(ground.low_m(post));
            const SeenPost here =
                seen_post(at(low_h_m), at(static_cast<double>(ground.high_m(post))), low_h_m);
            made.posts.push_back(here.placed);
            for (int i = 0; i < 4; ++i)
                if ((i < 2 ? r <= half : r >= half) && (i % 2 == 0 ? c <= half : c >= half))
                    take_post(here, made.reaches[static_cast<std::size_t>(i)],
                              made.nodes[static_cast<std::size_t>(i)]);
        }
    }
    return made;
}

VisibleGroundSearch::SeenPost VisibleGroundSearch::seen_post(const Seen& low, const Seen& high,
                                                             double low_h_m) const {
    const double across_m = low.across_m(), high_across_m = high.across_m();
    const bool is_near = across_m < 6.0 * post_m_;
    // Between posts a way that is straight lies nearer to the eye's vertical.
    const double low_tangent = low.enu_m.z / across_m;
    const double nearer = post_m_ * post_m_ / (across_m * across_m);
    const double low_m = std::abs(low.enu_m.z), high_m = std::abs(high.enu_m.z);
    const bool is_level = low.enu_m.z < 0.0 && high.enu_m.z > 0.0;
    SeenPost post;
    post.placed = {
        static_cast<float>(turned(low.azimuth_rad())), static_cast<float>(across_m),
        is_near ? -no_tangent : static_cast<float>(low_tangent - std::abs(low_tangent) * nearer - 1.0e-6)};
    post.high_tangent = is_near ? no_tangent : static_cast<float>(high.enu_m.z / high_across_m + 1.0e-6);
    post.across_m = static_cast<float>(std::min(across_m, high_across_m));
    post.nearest_m = std::max(
        0.5,
        std::hypot(std::min(across_m, high_across_m), is_level ? 0.0 : std::min(low_m, high_m)) - post_m_);
    post.farthest_m = std::hypot(std::max(across_m, high_across_m), std::max(low_m, high_m)) + post_m_;
    post.low_h_m = low_h_m;
    return post;
}

void VisibleGroundSearch::take_post(const SeenPost& post, VisibleGround::Reach& reach,
                                    VisibleGround::Node& node) {
    reach.tangent = std::max(reach.tangent, post.high_tangent);
    reach.from_rad = std::min(reach.from_rad, post.placed.azimuth_rad);
    reach.to_rad = std::max(reach.to_rad, post.placed.azimuth_rad);
    reach.nearest_m = std::min(reach.nearest_m, post.across_m);
    node.nearest_m = std::min(node.nearest_m, post.nearest_m);
    node.farthest_m = std::max(node.farthest_m, post.farthest_m);
    node.lowest_h_m = std::min(node.lowest_h_m, post.low_h_m);
}

void VisibleGroundSearch::take(const MadeTile& tile) {
    for (const PlacedPost& post : tile.posts) {
        const double across_m = static_cast<double>(post.across_m);
        // How far it may be over the ground from where it is drawn, as heights are not known: its vertical
        // leans.
        const double around_m = post_m_ + 600.0 * across_m / least_curved_radius_m;
        horizon_->take(static_cast<double>(post.azimuth_rad),
                       across_m > around_m ? std::asin(around_m / across_m) : 4.0, across_m - around_m,
                       across_m + around_m, post.low_tangent);
    }
}

bool VisibleGroundSearch::run() {
    if (!std::isfinite(reach_m_) || !list_tiles()) return false;
    horizon_ =
        std::make_shared<PolarHorizon>(half_rad_, reach_m_, std::max(0.75 * post_m_, reach_m_ / 4096.0));
    found_.horizon_ = horizon_;
    std::vector<const Listed*> wanted;
    std::vector<MadeTile> of_tiles;
    const double ring_m = 2000.0;
    for (std::size_t first = 0; first < tiles_.size();) {
        const double from_m = std::max(0.0, tiles_[first].nearest_m());
        horizon_->finish_to(from_m);
        wanted.clear();
        for (; first < tiles_.size() && tiles_[first].nearest_m() <= from_m + ring_m; ++first) {
            const Listed& tile = tiles_[first];
            const VisibleGround::Reach reach = whole_reach(tile);
            if (tile.is_ground && in_frustum(tile) && !found_.is_hidden(reach)) {
                wanted.push_back(&tile);
                continue;
            }
            if (tile.is_ground)
                for (int node = 0; node < 4; ++node) set_reach(tile, node, reach);
            take_unknown(tile);
        }
        found_.tiles_ += wanted.size();
        if (found_.tiles_ > most_tiles) return false;
        of_tiles.resize(wanted.size());
        in_parallel(static_cast<int>(wanted.size()), threads_, [&](int i) {
            of_tiles[static_cast<std::size_t>(i)] = made(*wanted[static_cast<std::size_t>(i)]);
        });
        for (std::size_t i = 0; i < wanted.size(); ++i) {
            take(of_tiles[i]);
            for (int node = 0; node < 4; ++node) {
                const auto at = static_cast<std::size_t>(node);
                if (of_tiles[i].nodes[at].farthest_m <= 0.0) continue;  // beyond the region
                set_reach(*wanted[i], node, of_tiles[i].reaches[at]);
                of_nodes_.push_back(of_tiles[i].nodes[at]);
            }
        }
    }
    horizon_->finish_to(reach_m_);
    find_nodes();
    return true;
}

void VisibleGroundSearch::find_nodes() {
    found_.shows_.resize(found_.reaches_.size());
    for (int row = 0; row < found_.rows_; ++row)
        for (int column = 0; column < found_.columns_; ++column) {
            const VisibleGround::Reach reach =
                found_.reach_of(row + found_.first_row_, column + found_.first_column_);
            found_.shows_[static_cast<std::size_t>(row) * static_cast<std::size_t>(found_.columns_) +
                          static_cast<std::size_t>(column)] = found_.is_hidden(reach) ? 0 : 1;
        }
    for (const VisibleGround::Node& node : of_nodes_)
        if (found_.shows_of(node.row, node.column)) found_.nodes_.push_back(node);
}

std::unique_ptr<VisibleGround> VisibleGround::of(const CoarseGround& ground, const FrameView& view,
                                                 const PictureCulling& culling, double lowest_h_m,
                                                 double highest_h_m, int threads) {
    if (view.model.earth != Earth::ellipsoid || highest_measured_level(ground.region()) < 3 ||
        CoarseGround::level >= static_cast<int>(ground.region().bounds().size()))
        return nullptr;
    std::unique_ptr<VisibleGround> found(new VisibleGround(ground));
    VisibleGroundSearch search(*found, view, culling, lowest_h_m, highest_h_m, threads);
    if (!search.run()) return nullptr;
    return found;
}

VisibleGround::Reach VisibleGround::reach_of(int row, int column) const {
    const int r = row - first_row_, c = column - first_column_;
    if (r < 0 || c < 0 || r >= rows_ || c >= columns_) return {no_tangent, 0.0F, 0.0F, 0.0F};
    return reaches_[static_cast<std::size_t>(r) * static_cast<std::size_t>(columns_) +
                    static_cast<std::size_t>(c)];
}

// What is before it may be drawn lower by the tolerance.
bool VisibleGround::is_hidden(const Reach& reach) const {
    if (reach.tangent == no_tangent) return false;
    const double nearest_m = static_cast<double>(reach.nearest_m);
    const double hidden_below = static_cast<double>(horizon_->hidden_below(
        static_cast<double>(reach.from_rad) - 1.0e-6, static_cast<double>(reach.to_rad) + 1.0e-6, nearest_m));
    if (hidden_below == -unbounded) return false;
    // A node's triangles lie nearer to the eye's vertical than its posts by this share.
    const double half_rad = 0.5 * static_cast<double>(reach.to_rad - reach.from_rad);
    const double nearer = 1.0 / std::cos(std::min(half_rad, 1.5)) - 1.0;
    const double highest = static_cast<double>(reach.tangent) +
                           std::max(0.0, static_cast<double>(reach.tangent)) * nearer + margin_m_ / nearest_m;
    return highest < hidden_below - margin_per_m_ * (1.0 + hidden_below * hidden_below);
}

bool VisibleGround::shows_of(int row, int column) const {
    const int r = row - first_row_, c = column - first_column_;
    if (r < 0 || c < 0 || r >= rows_ || c >= columns_) return true;
    return shows_[static_cast<std::size_t>(r) * static_cast<std::size_t>(columns_) +
                  static_cast<std::size_t>(c)] != 0;
}

// Of a wider node all that is in it, together: where its triangles go from one place to another they may lie
// over ground that is lower.
bool VisibleGround::may_show(int node_level, int row, int column) const {
    const int up = node_level - 3;
    if (up == 0) return shows_of(row, column);
    if (up > 3) return true;
    Reach all{-no_tangent, 1.0e9F, -1.0e9F, no_tangent};
    const LevelGrid nodes = level_grid(ground_.region().grid, 3);
    const int last_row = std::min((row + 1) << up, nodes.row.nodes()) - 1,
              last_column = std::min((column + 1) << up, nodes.column.nodes()) - 1;
    for (int r = row << up; r <= last_row; ++r)
        for (int c = column << up; c <= last_column; ++c) {
            const Reach reach = reach_of(r, c);
            if (reach.tangent == no_tangent) return true;
            all.tangent = std::max(all.tangent, reach.tangent);
            all.from_rad = std::min(all.from_rad, reach.from_rad);
            all.to_rad = std::max(all.to_rad, reach.to_rad);
            all.nearest_m = std::min(all.nearest_m, reach.nearest_m);
        }
    return !is_hidden(all);
}

}  // namespace oro
