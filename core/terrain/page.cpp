#include "core/terrain/page.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/base/pooled_object.h"
#include "core/terrain/node_box.h"
#include "core/terrain/page_on_net.h"
#include "core/terrain/page_posts.h"
#include "core/terrain/placed_posts.h"

namespace oro {
namespace {

constexpr int quads = static_cast<int>(gpu::page_quads);
constexpr int posts = static_cast<int>(gpu::page_posts);
constexpr int stride = static_cast<int>(gpu::height_stride);
constexpr int meshlet_quads = static_cast<int>(gpu::meshlet_quads);
constexpr int meshlets_per_side = static_cast<int>(gpu::meshlets_per_side);

// Distance of a place from the Earth's axis.
double cylinder_rho_m(const Geodetic& place) {
    return (prime_vertical_radius_m(place.lat_deg) + place.h_m) * sine_cosine_deg(place.lat_deg).cosine;
}

// Builds a page: its posts in double, then what the block and the summary make of them.
class PageBuilder {
  public:
    PageBuilder(const PostGrid& grid, const RegionShape& shape, const PageHeights& heights, PageIndex index,
                MeshletBounding bounding, gpu::PageBlock& block, PlacedPosts& placed)
        : grid_(grid),
          shape_(shape),
          heights_(heights),
          bounding_(bounding),
          block_(block),
          posts_(grid, index),
          placed_(placed) {
        summary_.index = index;
    }

    PageSummary build() {
        measure_heights();
        place_origin();
        fill_block();
        place_posts();
        bound_meshlets();
        bound_page();
        return summary_;
    }

  private:
    void measure_heights();
    void place_origin();
    void fill_block();
    void place_posts();
    void place_by_net();
    void place_by_angles();
    void bound_meshlets();
    void bound_page();
    void bound_meshlet(int number, const PostSphere* known);
    std::size_t gather_meshlet(int number, std::array<glm::dvec3, gpu::meshlet_vertices>& points) const;
    void bound_finely(int number);
    void bound_by_horizon(int number, std::span<const HorizonPoint> points);
    int mark_triangles(int number);
    bool may_have_triangles(int first_row, int first_column, int rows, int columns) const;
    gpu::uint halves_of(int number) const;
    gpu::uint box_around(std::span<const glm::dvec3> points, const gpu::MeshletBounds& bounds) const;

    static std::size_t at(int row, int column) { return static_cast<std::size_t>(row * posts + column); }
    std::int32_t steps(int row, int column) const {
        return heights_.steps[static_cast<std::size_t>((row + 1) * stride + column + 1)];
    }
    bool drawable(int row, int column) const { return steps(row, column) != void_height_steps; }

    const PostGrid& grid_;
    const RegionShape& shape_;
    const PageHeights& heights_;
    MeshletBounding bounding_;
    gpu::PageBlock& block_;
    PagePosts posts_;
    PageSummary summary_{};
    double middle_lon_deg_{};  // of the origin, in the region's own whole turn
    double rho0_m_{};
    double z0_m_{};
    PlacedPosts& placed_;
    bool whole_{true};  // without a void post
    std::array<glm::dvec3, gpu::meshlets_per_page>
        directions_{};  // of the meshlets' horizon cones, page frame
};

void PageBuilder::measure_heights() {
    std::int32_t lowest = std::numeric_limits<std::int32_t>::max();
    std::int32_t highest = std::numeric_limits<std::int32_t>::min();
    for (int row = 0; row < posts; ++row) {
        for (int column = 0; column < posts; ++column) {
            if (!drawable(row, column)) {
                whole_ = false;
                continue;
            }
            lowest = std::min(lowest, steps(row, column));
            highest = std::max(highest, steps(row, column));
        }
    }
    if (lowest > highest) lowest = highest = 0;
    summary_.lowest_h_m = lowest * height_step_m;
    summary_.highest_h_m = highest * height_step_m;
    summary_.origin.h_m = std::round(0.5 * (summary_.lowest_h_m + summary_.highest_h_m));
}

void PageBuilder::place_origin() {
    // A coarse page may be far larger than what the region has of it.
    const auto end = [&](const LevelAxis& axis, int first) {
        return axis.level == 0 ? first + quads : axis.region_post(std::min(first + quads, axis.quads));
    };
    const LevelGrid& level = posts_.level();
    if (grid_.net) {
        const PostPlace middle = net_page_middle(grid_, summary_.index);
        summary_.origin = {middle.lat_deg, middle.lon_deg, summary_.origin.h_m};
        set_page_frame(summary_);
        rho0_m_ = cylinder_rho_m(summary_.origin);
        z0_m_ = summary_.origin_ecef.m.z;
        return;
    }
    const double lat_deg = 0.5 * (grid_.lat.at_deg(post_beyond(level.row, posts_.first_row())) +
                                  grid_.lat.at_deg(end(level.row, posts_.first_row())));
    middle_lon_deg_ = 0.5 * (grid_.lon.at_deg(post_beyond(level.column, posts_.first_column())) +
                             grid_.lon.at_deg(end(level.column, posts_.first_column())));
    // A coarse page may hang over a pole; its origin stays on this side.
    summary_.origin.lat_deg = std::clamp(lat_deg, -90.0, 90.0);
    summary_.origin.lon_deg = normalised_lon_deg(middle_lon_deg_);
    set_page_frame(summary_);
    rho0_m_ = cylinder_rho_m(summary_.origin);
    z0_m_ = summary_.origin_ecef.m.z;
}

void PageBuilder::fill_block() {
    set_spacing(grid_, summary_, block_);
    std::ranges::copy(heights_.sw_ne, std::begin(block_.sw_ne));
    std::copy(heights_.steps.begin(), heights_.steps.end(), std::begin(block_.heights));
}

// By the grid's net, turned into the page's frame.
void PageBuilder::place_by_net() {
    const glm::dmat3 page_from_ecef = glm::transpose(summary_.ecef_from_page);
    for_each_normal(grid_, summary_.index, [&](int i, int j, const glm::dvec3& normal) {
        if (!drawable(i, j)) return;
        const Ecef place = ecef_along(normal, steps(i, j) * height_step_m);
        const glm::dvec3 position_m = page_from_ecef * (place.m - summary_.origin_ecef.m);
        placed_.x[at(i, j)] = position_m.x;
        placed_.y[at(i, j)] = position_m.y;
        placed_.z[at(i, j)] = position_m.z;
    });
}

void PageBuilder::place_posts() {
    std::ranges::fill(placed_.drawn, static_cast<unsigned char>(whole_ ? 1 : 0));
    if (grid_.net) {
        place_by_net();
    } else {
        place_by_angles();
    }
    // Scaled space turned as the page's frame is (the two equatorial radii are equal, so scaling and turning
    // commute).
    scale_posts({rho0_m_, 0.0, z0_m_}, shape_.occluder.radii_m, placed_);
}

void PageBuilder::place_by_angles() {
    std::array<double, gpu::page_posts> V{};
    std::array<double, gpu::page_posts> W{};
    for (int j = 0; j < posts; ++j) {
        const double turn_deg =
            grid_.lon.at_deg(post_beyond(posts_.level().column, posts_.first_column() + j)) - middle_lon_deg_;
        const double half_sine = sine_cosine_deg(0.5 * turn_deg).sine;
        V[static_cast<std::size_t>(j)] = 2.0 * half_sine * half_sine;
        W[static_cast<std::size_t>(j)] = sine_cosine_deg(turn_deg).sine;
    }
    // What stands for a void post is placed, too, and not drawn.
    for (int i = 0; i < posts; ++i) {
        const double lat_deg = row_lat_deg(grid_, post_beyond(posts_.level().row, posts_.first_row() + i));
        const SineCosine lat = sine_cosine_deg(lat_deg);
        place_row({prime_vertical_radius_m(lat_deg), lat.cosine, lat.sine, rho0_m_, z0_m_},
                  &heights_.steps[static_cast<std::size_t>((i + 1) * stride + 1)], V, W,
                  static_cast<std::size_t>(i), placed_);
    }
}

// Marks the posts of a meshlet that belong to a triangle; number of triangles.
int PageBuilder::mark_triangles(int number) {
    if (whole_) return 2 * meshlet_quads * meshlet_quads;
    const int first_row = number / meshlets_per_side * meshlet_quads;
    const int first_column = number % meshlets_per_side * meshlet_quads;
    int triangles = 0;
    for (int row = first_row; row < first_row + meshlet_quads; ++row) {
        for (int column = first_column; column < first_column + meshlet_quads; ++column) {
            if (!drawable(row, column) || !drawable(row + 1, column + 1)) continue;
            for (const int side : {0, 1}) {
                if (!drawable(row + 1 - side, column + side)) continue;
                ++triangles;
                placed_.drawn[at(row, column)] = placed_.drawn[at(row + 1, column + 1)] = 1;
                placed_.drawn[at(row + 1 - side, column + side)] = 1;
            }
        }
    }
    return triangles;
}

// Whether so many rows and columns of posts can make a triangle: not those that lie in one row or column.
// What stitching moves stays among the posts of a half, so this holds for all edges.
bool PageBuilder::may_have_triangles(int first_row, int first_column, int rows, int columns) const {
    int row_there = -1, column_there = -1;
    bool one_row = true, one_column = true;
    for (int row = first_row; row < first_row + rows; ++row) {
        for (int column = first_column; column < first_column + columns; ++column) {
            if (!drawable(row, column)) continue;
            if (row_there < 0) {
                row_there = row;
                column_there = column;
            }
            one_row = one_row && row == row_there;
            one_column = one_column && column == column_there;
            if (!one_row && !one_column) return true;
        }
    }
    return false;
}

// Which halves of a meshlet have triangles, as PageBlock::boxes says it.
gpu::uint PageBuilder::halves_of(int number) const {
    if (whole_) return gpu::both_halves;
    constexpr int half = static_cast<int>(gpu::half_quads), side = static_cast<int>(gpu::meshlet_posts);
    const int row = number / meshlets_per_side * meshlet_quads;
    const int column = number % meshlets_per_side * meshlet_quads;
    if (!may_have_triangles(row + half, column, half + 1, side)) return gpu::first_rows;
    if (!may_have_triangles(row, column, half + 1, side)) return gpu::last_rows;
    return may_have_triangles(row, column + half, side, half + 1) ? gpu::both_halves : gpu::first_columns;
}

// The posts of a meshlet that are drawn.
std::size_t PageBuilder::gather_meshlet(int number,
                                        std::array<glm::dvec3, gpu::meshlet_vertices>& points) const {
    std::size_t count = 0;
    const int first_row = number / meshlets_per_side * meshlet_quads;
    const int first_column = number % meshlets_per_side * meshlet_quads;
    for (int row = first_row; row <= first_row + meshlet_quads; ++row) {
        for (int column = first_column; column <= first_column + meshlet_quads; ++column)
            if (placed_.drawn[at(row, column)] != 0) points[count++] = placed_.position_m(at(row, column));
    }
    return count;
}

// known: its sphere, of a page without void posts.
void PageBuilder::bound_meshlet(int number, const PostSphere* known) {
    gpu::MeshletBounds& bounds = block_.meshlets[number];
    bounds = {gpu::vec3(0.0F), -1.0F, gpu::vec3(0.0F), 0.0F, 0.0F, -1.0F};
    block_.boxes[number] = 0;
    // A post may belong to a neighbour's triangle alone: keeping it costs a little and loses nothing.
    const int triangles = mark_triangles(number);
    if (triangles == 0) return;
    summary_.triangles += static_cast<std::uint32_t>(triangles);
    ++summary_.meshlets;
    std::array<glm::dvec3, gpu::meshlet_vertices> points;
    const PostSphere sphere =
        known != nullptr ? *known : sphere_around(std::span(points).first(gather_meshlet(number, points)));
    bounds.centre = sphere.centre;
    bounds.radius = sphere.radius;
    bounds.lod_radius = sphere.radius;
    if (bounding_ == MeshletBounding::whole) bound_finely(number);
}

// All but the sphere.
void PageBuilder::bound_finely(int number) {
    std::array<glm::dvec3, gpu::meshlet_vertices> points;
    std::array<HorizonPoint, gpu::meshlet_vertices> horizon;
    const std::size_t count = gather_meshlet(number, points);
    const glm::dvec3 origin_m(rho0_m_, 0.0, z0_m_);
    for (std::size_t i = 0; i < count; ++i)
        horizon[i] = horizon_point((points[i] + origin_m) / shape_.occluder.radii_m);
    block_.boxes[number] =
        node_box(std::span(points).first(count), block_.meshlets[number], summary_.origin.lat_deg) |
        halves_of(number) << gpu::halves_bit;
    bound_by_horizon(number, std::span(horizon).first(count));
}

void PageBuilder::bound_by_horizon(int number, std::span<const HorizonPoint> points) {
    const HorizonCone cone = horizon_cone(points);
    block_.meshlets[number].horizon_angle_rad =
        std::nextafter(static_cast<float>(cone.angle_rad), std::numeric_limits<float>::infinity());
    directions_[static_cast<std::size_t>(number)] = cone.direction;
}

void PageBuilder::bound_meshlets() {
    constexpr int meshlets = static_cast<int>(gpu::meshlets_per_page);
    std::array<PostSphere, gpu::meshlets_per_page> spheres;
    if (whole_) spheres_of_meshlets(placed_, spheres);
    for (int number = 0; number < meshlets; ++number)
        bound_meshlet(number, whole_ ? &spheres[static_cast<std::size_t>(number)] : nullptr);
}

void PageBuilder::bound_page() {
    const std::size_t count = whole_ ? PlacedPosts::count : placed_.gather_drawn();
    if (count == 0) return;
    const PostSphere sphere = sphere_around(placed_, count);
    summary_.centre_m = glm::dvec3(sphere.centre);
    summary_.radius_m = sphere.radius;
    const HorizonCone cone = horizon_cone(placed_, count);
    summary_.horizon = {summary_.ecef_from_page * cone.direction, cone.angle_rad};
    for (std::size_t i = 0; bounding_ == MeshletBounding::whole && i < directions_.size(); ++i) {
        if (block_.meshlets[i].radius < 0.0F) continue;
        block_.meshlets[i].horizon_offset =
            gpu::vec3(summary_.ecef_from_page * (directions_[i] - cone.direction));
    }
}

}  // namespace

std::int64_t post_beyond(const LevelAxis& axis, int post) {
    return post <= axis.quads ? axis.region_post(post) : std::int64_t{post} << axis.level;
}

void set_spacing(const PostGrid& grid, const PageSummary& page, gpu::PageBlock& block) {
    const Geodetic& origin = page.origin;
    block.turn = gpu::vec3(0.0F);
    const SineCosine lat = sine_cosine_deg(origin.lat_deg);
    block.up = gpu::vec2(lat.cosine, lat.sine);
    if (grid.net) {
        set_net_spacing(*grid.net, page, block);
        return;
    }
    block.row_spacing_m = static_cast<float>((meridian_radius_m(origin.lat_deg) + origin.h_m) *
                                             radians_from_deg(grid.lat.spacing_deg()).rad);
    block.column_spacing_m = static_cast<float>((prime_vertical_radius_m(origin.lat_deg) + origin.h_m) *
                                                radians_from_deg(grid.lon.spacing_deg()).rad);
}

void set_page_frame(PageSummary& summary) {
    const SineCosine lat = sine_cosine_deg(summary.origin.lat_deg);
    const SineCosine lon = sine_cosine_deg(summary.origin.lon_deg);
    const double normal_m = prime_vertical_radius_m(summary.origin.lat_deg);
    const double rho_m = cylinder_rho_m(summary.origin);
    const double z_m = (normal_m * (1.0 - wgs84_e2) + summary.origin.h_m) * lat.sine;
    summary.origin_ecef = Ecef{{rho_m * lon.cosine, rho_m * lon.sine, z_m}};
    summary.ecef_from_page = glm::dmat3(lon.cosine, lon.sine, 0.0, -lon.sine, lon.cosine, 0.0, 0.0, 0.0, 1.0);
}

PageSummary build_page(const PostGrid& grid, const RegionShape& shape, const PageHeights& heights,
                       PageIndex index, gpu::PageBlock& block, MeshletBounding bounding) {
    const PooledObject<std::unique_ptr<PlacedPosts>, std::make_unique<PlacedPosts>> placed;
    return PageBuilder(grid, shape, heights, index, bounding, block, *placed.get()).build();
}

PageSummary build_page(const HeightField& field, const RegionShape& shape, PageIndex index,
                       gpu::PageBlock& block) {
    const PageHeights heights =
        page_heights(field.grid, field.undulation, shape.exaggeration, page_elevations(field, index), index);
    return build_page(field.grid, shape, heights, index, block);
}

}  // namespace oro
