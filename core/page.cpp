#include "core/page.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "core/high_low.h"

namespace oro {
namespace {

constexpr int quads = static_cast<int>(gpu::page_quads);
constexpr int posts = static_cast<int>(gpu::page_posts);
constexpr int stride = static_cast<int>(gpu::height_stride);
constexpr int meshlet_quads = static_cast<int>(gpu::meshlet_quads);
constexpr int meshlets_per_side = static_cast<int>(gpu::meshlets_per_side);

// The terms of gpu::RowTerms and gpu::ColumnTerms before they are rounded.
struct Row {
    double R, C, S, P, Z;
};
struct Column {
    double V, W;
};

// A page while it is built: its posts in double, then what the block and the summary make of them.
class Draft {
  public:
    // `heights` may be null: then each post's is worked out where it is needed.
    Draft(const HeightField& field, const RegionShape& shape, const DrawnHeights* heights, PageIndex index,
          gpu::PageBlock& block)
        : field_(field),
          shape_(shape),
          heights_(heights),
          block_(block),
          level_(level_grid(field.grid, index.level)),
          first_row_(index.row * quads),
          first_column_(index.column * quads) {
        summary_.index = index;
    }

    PageSummary build() {
        measure_heights();
        place_origin();
        fill_tables();
        fill_heights();
        fill_borders();
        place_posts();
        bound_meshlets();
        bound_page();
        return summary_;
    }

  private:
    void measure_heights();
    void place_origin();
    void fill_tables();
    void fill_heights();
    void fill_borders();
    void place_posts();
    void bound_meshlets();
    void bound_page();
    void bound_meshlet(int number);
    int mark_triangles(int number);
    std::optional<PageIndex> region_post(int row, int column) const;
    double height_m(PageIndex post) const;
    glm::dvec3 scaled(const glm::dvec3& position_m) const;

    static std::size_t at(int row, int column) { return static_cast<std::size_t>(row * posts + column); }
    bool drawable(int row, int column) const {
        return block_.dh[static_cast<std::size_t>(row + 1) * stride + static_cast<std::size_t>(column + 1)] >
               gpu::void_dh_limit_m;
    }

    const HeightField& field_;
    const RegionShape& shape_;
    const DrawnHeights* heights_;
    gpu::PageBlock& block_;
    LevelGrid level_;
    int first_row_;  // of the level's posts
    int first_column_;
    PageSummary summary_{};
    double middle_lon_deg_{};  // of the origin, in the region's own whole turn
    double rho0_m_{};
    double z0_m_{};
    std::array<double, gpu::page_heights> h_m_{};  // with the apron; NaN where void
    std::array<Row, gpu::page_posts> rows_{};
    std::array<Column, gpu::page_posts> columns_{};
    std::vector<glm::dvec3> position_m_;  // page frame
    std::vector<bool> drawn_;             // posts that belong to a triangle
    std::array<glm::dvec3, gpu::meshlets_per_page>
        directions_{};  // of the meshlets' horizon cones, page frame
};

// Number in the region of a level's post, and where that post would lie beyond the region's end.
std::int64_t post_beyond(const LevelAxis& axis, int post) {
    return post <= axis.quads ? axis.region_post(post) : std::int64_t{post} << axis.level;
}

// The region's post at a page's row and column, -1 .. 129; nothing outside the region. The apron goes on
// round the Earth.
std::optional<PageIndex> Draft::region_post(int row, int column) const {
    const int level_row = first_row_ + row;
    int level_column = first_column_ + column;
    const int quads_round = level_.column.quads;
    if (field_.grid.goes_round()) {
        if (level_column == -1) level_column = quads_round - 1;
        if (level_column == quads_round + 1 && column == posts) level_column = 1;
    }
    if (level_row < 0 || level_row > level_.row.quads) return std::nullopt;
    if (level_column < 0 || level_column > quads_round) return std::nullopt;
    return PageIndex{level_.row.region_post(level_row), level_.column.region_post(level_column)};
}

// Drawn height of a region's post; NaN where void.
double Draft::height_m(PageIndex post) const {
    if (heights_ != nullptr) {
        const std::int32_t steps = heights_->at(post.row, post.column);
        return steps == void_height_steps ? std::numeric_limits<double>::quiet_NaN() : steps * height_step_m;
    }
    if (is_void(field_.H_at_post_m(post.row, post.column))) return std::numeric_limits<double>::quiet_NaN();
    return drawn_h_m(field_, post.row, post.column, shape_.exaggeration);
}

void Draft::measure_heights() {
    double lowest_m = std::numeric_limits<double>::infinity();
    double highest_m = -lowest_m;
    for (int row = -1; row <= posts; ++row) {
        for (int column = -1; column <= posts; ++column) {
            double& h_m = h_m_[static_cast<std::size_t>((row + 1) * stride + column + 1)];
            h_m = std::numeric_limits<double>::quiet_NaN();
            const std::optional<PageIndex> post = region_post(row, column);
            if (post) h_m = height_m(*post);
            if (std::isnan(h_m) || row < 0 || row == posts || column < 0 || column == posts) continue;
            lowest_m = std::min(lowest_m, h_m);
            highest_m = std::max(highest_m, h_m);
        }
    }
    if (lowest_m > highest_m) lowest_m = highest_m = 0.0;
    summary_.lowest_h_m = lowest_m;
    summary_.highest_h_m = highest_m;
    summary_.origin.h_m = std::round(0.5 * (lowest_m + highest_m));
}

void Draft::place_origin() {
    const PostGrid& grid = field_.grid;
    // A coarse page may be far larger than what the region has of it.
    const auto end = [&](const LevelAxis& axis, int first) {
        return axis.level == 0 ? first + quads : axis.region_post(std::min(first + quads, axis.quads));
    };
    const double lat_deg = 0.5 * (grid.lat.at_deg(post_beyond(level_.row, first_row_)) +
                                  grid.lat.at_deg(end(level_.row, first_row_)));
    middle_lon_deg_ = 0.5 * (grid.lon.at_deg(post_beyond(level_.column, first_column_)) +
                             grid.lon.at_deg(end(level_.column, first_column_)));
    // A coarse page may hang over a pole; its origin stays on this side.
    summary_.origin.lat_deg = std::clamp(lat_deg, -90.0, 90.0);
    summary_.origin.lon_deg = normalised_lon_deg(middle_lon_deg_);
    const SineCosine lat = sine_cosine_deg(summary_.origin.lat_deg);
    const SineCosine lon = sine_cosine_deg(summary_.origin.lon_deg);
    const double normal_m = prime_vertical_radius_m(summary_.origin.lat_deg);
    rho0_m_ = (normal_m + summary_.origin.h_m) * lat.cosine;
    z0_m_ = (normal_m * (1.0 - wgs84_e2) + summary_.origin.h_m) * lat.sine;
    summary_.origin_ecef = Ecef{{rho0_m_ * lon.cosine, rho0_m_ * lon.sine, z0_m_}};
    summary_.ecef_from_page =
        glm::dmat3(lon.cosine, lon.sine, 0.0, -lon.sine, lon.cosine, 0.0, 0.0, 0.0, 1.0);
}

void Draft::fill_tables() {
    const PostGrid& grid = field_.grid;
    const double h0_m = summary_.origin.h_m;
    for (int i = 0; i < posts; ++i) {
        const std::size_t n = static_cast<std::size_t>(i);
        const double lat_deg = row_lat_deg(grid, post_beyond(level_.row, first_row_ + i));
        const SineCosine lat = sine_cosine_deg(lat_deg);
        const double normal_m = prime_vertical_radius_m(lat_deg);
        const double P = (normal_m + h0_m) * lat.cosine;
        const double Z = (normal_m * (1.0 - wgs84_e2) + h0_m) * lat.sine - z0_m_;
        rows_[n] = {P - rho0_m_, lat.cosine, lat.sine, P, Z};
        block_.rows[n] = {static_cast<float>(rows_[n].R), static_cast<float>(rows_[n].C),
                          static_cast<float>(rows_[n].S), static_cast<float>(rows_[n].P),
                          static_cast<float>(rows_[n].Z)};
        const double turn_deg =
            grid.lon.at_deg(post_beyond(level_.column, first_column_ + i)) - middle_lon_deg_;
        const double half_sine = sine_cosine_deg(0.5 * turn_deg).sine;
        columns_[n] = {2.0 * half_sine * half_sine, sine_cosine_deg(turn_deg).sine};
        block_.columns[n] = {static_cast<float>(columns_[n].V), static_cast<float>(columns_[n].W)};
    }
    const double lat0_deg = summary_.origin.lat_deg;
    block_.h0_m = static_cast<float>(h0_m);
    const double step = std::ldexp(1.0, level_.level());
    block_.row_spacing_m = static_cast<float>((meridian_radius_m(lat0_deg) + h0_m) *
                                              radians_from_deg(step * grid.lat.spacing_deg()).rad);
    block_.column_spacing_rad = static_cast<float>(radians_from_deg(step * grid.lon.spacing_deg()).rad);
    block_.exaggeration = static_cast<float>(shape_.exaggeration);
    for (int corner = 0; corner < 4; ++corner) {
        const std::int64_t row = first_row_ + (corner / 2) * quads;
        const std::int64_t column = first_column_ + (corner % 2) * quads;
        const double lat_deg = grid.lat.at_deg(row << level_.level());
        const double lon_deg = grid.lon.at_deg(column << level_.level());
        block_.N_m[corner] = static_cast<float>(field_.undulation.at_m(lat_deg, lon_deg));
    }
}

void Draft::fill_heights() {
    for (std::size_t i = 0; i < h_m_.size(); ++i) {
        block_.dh[i] =
            std::isnan(h_m_[i]) ? gpu::void_dh_m : static_cast<float>(h_m_[i] - summary_.origin.h_m);
    }
}

void Draft::fill_borders() {
    for (int row = 0; row < posts; ++row) {
        const bool whole_row = row == 0 || row == quads;
        for (int column = 0; column < posts; column += whole_row ? 1 : quads) {
            gpu::BorderPost& border = block_.borders[gpu::border_index_cpu(
                static_cast<std::uint32_t>(row), static_cast<std::uint32_t>(column))];
            border = {gpu::vec3(0.0F), gpu::vec3(0.0F)};
            if (!drawable(row, column)) continue;
            const PageIndex post = *region_post(row, column);
            const Ecef ecef = post_ecef(field_, post.row, post.column, shape_.exaggeration);
            split_high_low(ecef.m, border.high, border.low);
        }
    }
}

void Draft::place_posts() {
    position_m_.assign(static_cast<std::size_t>(posts) * posts, glm::dvec3(0.0));
    drawn_.assign(position_m_.size(), false);
    for (int i = 0; i < posts; ++i) {
        const Row& row = rows_[static_cast<std::size_t>(i)];
        for (int j = 0; j < posts; ++j) {
            if (!drawable(i, j)) continue;
            const Column& column = columns_[static_cast<std::size_t>(j)];
            const double dh_m =
                h_m_[static_cast<std::size_t>((i + 1) * stride + j + 1)] - summary_.origin.h_m;
            const double r = row.P + dh_m * row.C;
            position_m_[at(i, j)] = {row.R + dh_m * row.C - r * column.V, r * column.W, row.Z + dh_m * row.S};
        }
    }
}

// Scaled space turned as the page's frame is (the two equatorial radii are equal, so scaling and turning
// commute).
glm::dvec3 Draft::scaled(const glm::dvec3& position_m) const {
    return (position_m + glm::dvec3(rho0_m_, 0.0, z0_m_)) / shape_.occluder.radii_m;
}

// Marks the posts of a meshlet that belong to a triangle; number of triangles.
int Draft::mark_triangles(int number) {
    const int first_row = number / meshlets_per_side * meshlet_quads;
    const int first_column = number % meshlets_per_side * meshlet_quads;
    int triangles = 0;
    for (int row = first_row; row < first_row + meshlet_quads; ++row) {
        for (int column = first_column; column < first_column + meshlet_quads; ++column) {
            if (!drawable(row, column) || !drawable(row + 1, column + 1)) continue;
            for (const int side : {0, 1}) {
                if (!drawable(row + 1 - side, column + side)) continue;
                ++triangles;
                drawn_[at(row, column)] = drawn_[at(row + 1, column + 1)] = true;
                drawn_[at(row + 1 - side, column + side)] = true;
            }
        }
    }
    return triangles;
}

struct Sphere {
    glm::vec3 centre;
    float radius;
};
// Around points, with the centre already rounded to float. Slack for the rounding of the points themselves
// when the GPU places them in float.
Sphere sphere_around(std::span<const glm::dvec3> points) {
    glm::dvec3 low = points[0];
    glm::dvec3 high = points[0];
    for (const glm::dvec3& point : points) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
    const glm::vec3 centre(0.5 * (low + high));
    double square = 0.0;
    double size = 0.0;
    for (const glm::dvec3& point : points) {
        const glm::dvec3 offset = point - glm::dvec3(centre);
        square = std::max(square, glm::dot(offset, offset));
        size = std::max(size, glm::dot(point, point));
    }
    const double radius = std::sqrt(square) + 1.0e-3 + 4.0e-7 * std::sqrt(size);
    return {centre, std::nextafter(static_cast<float>(radius), std::numeric_limits<float>::infinity())};
}

void Draft::bound_meshlet(int number) {
    gpu::MeshletBounds& bounds = block_.meshlets[number];
    bounds = {gpu::vec3(0.0F), -1.0F, gpu::vec3(0.0F), 0.0F, 0.0F, -1.0F, 0U};
    const int rows = level_.row.quads_of_node(first_row_ / meshlet_quads + number / meshlets_per_side);
    const int columns =
        level_.column.quads_of_node(first_column_ / meshlet_quads + number % meshlets_per_side);
    bounds.quads = static_cast<gpu::uint>(rows) | static_cast<gpu::uint>(columns) << 4U;
    // A post may belong to a neighbour's triangle alone: keeping it costs a little and loses nothing.
    const int triangles = mark_triangles(number);
    if (triangles == 0) return;
    summary_.triangles += static_cast<std::uint32_t>(triangles);
    ++summary_.meshlets;
    std::array<glm::dvec3, gpu::meshlet_vertices> points;
    std::array<glm::dvec3, gpu::meshlet_vertices> points_scaled;
    std::size_t count = 0;
    const int first_row = number / meshlets_per_side * meshlet_quads;
    const int first_column = number % meshlets_per_side * meshlet_quads;
    for (int row = first_row; row <= first_row + meshlet_quads; ++row) {
        for (int column = first_column; column <= first_column + meshlet_quads; ++column) {
            if (!drawn_[at(row, column)]) continue;
            points[count] = position_m_[at(row, column)];
            points_scaled[count] = scaled(points[count]);
            ++count;
        }
    }
    const Sphere sphere = sphere_around(std::span(points).first(count));
    const HorizonCone cone = horizon_cone_scaled(std::span(points_scaled).first(count));
    bounds.centre = sphere.centre;
    bounds.radius = sphere.radius;
    bounds.lod_radius = sphere.radius;
    bounds.horizon_angle_rad =
        std::nextafter(static_cast<float>(cone.angle_rad), std::numeric_limits<float>::infinity());
    directions_[static_cast<std::size_t>(number)] = cone.direction;
}

void Draft::bound_meshlets() {
    for (int number = 0; number < static_cast<int>(gpu::meshlets_per_page); ++number) bound_meshlet(number);
}

void Draft::bound_page() {
    std::vector<glm::dvec3> points;
    for (std::size_t i = 0; i < position_m_.size(); ++i) {
        if (drawn_[i]) points.push_back(position_m_[i]);
    }
    if (points.empty()) return;
    const Sphere sphere = sphere_around(points);
    summary_.centre_m = glm::dvec3(sphere.centre);
    summary_.radius_m = sphere.radius;
    for (glm::dvec3& point : points) point = scaled(point);
    const HorizonCone cone = horizon_cone_scaled(points);
    summary_.horizon = {summary_.ecef_from_page * cone.direction, cone.angle_rad};
    for (std::size_t i = 0; i < directions_.size(); ++i) {
        if (block_.meshlets[i].radius < 0.0F) continue;
        block_.meshlets[i].horizon_offset =
            gpu::vec3(summary_.ecef_from_page * (directions_[i] - cone.direction));
    }
}

}  // namespace

PageLayout page_layout(const PostGrid& grid) {
    return level_grid(grid, 0).pages();
}

RegionShape region_shape(const HeightField& field, double exaggeration) {
    assert(exaggeration >= 0.0);
    const PostGrid& grid = field.grid;
    const std::vector<float>& N_m = field.undulation.N_m;
    const double lowest_N_m = N_m.empty() ? 0.0 : *std::min_element(N_m.begin(), N_m.end());
    double lowest_h_m = 0.0;
    double diagonal_m = 0.0;
    for (int row = 0; row < grid.rows(); ++row) {
        for (int column = 0; column < grid.columns(); ++column) {
            const float H_m = field.H_at_post_m(row, column);
            // Most posts cannot be the lowest whatever their undulation.
            if (is_void(H_m) || static_cast<double>(H_m) * exaggeration + lowest_N_m >= lowest_h_m) continue;
            lowest_h_m = std::min(lowest_h_m, drawn_h_m(field, row, column, exaggeration));
        }
        const double lat_deg = grid.lat.at_deg(row);
        const double south_m = meridian_radius_m(lat_deg) * radians_from_deg(grid.lat.spacing_deg()).rad;
        const double east_m = prime_vertical_radius_m(lat_deg) * sine_cosine_deg(lat_deg).cosine *
                              radians_from_deg(grid.lon.spacing_deg()).rad;
        diagonal_m = std::max(diagonal_m, std::hypot(south_m, east_m));
    }
    return {occluder_below(lowest_h_m, diagonal_m), exaggeration};
}

PageSummary build_page(const HeightField& field, const RegionShape& shape, PageIndex index,
                       gpu::PageBlock& block) {
    Draft draft(field, shape, nullptr, index, block);
    return draft.build();
}

PageSummary build_page(const HeightField& field, const RegionShape& shape, const DrawnHeights& heights,
                       PageIndex index, gpu::PageBlock& block) {
    assert(heights.rows == field.grid.rows() && heights.columns == field.grid.columns());
    Draft draft(field, shape, &heights, index, block);
    return draft.build();
}

}  // namespace oro
