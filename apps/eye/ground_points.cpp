#include "apps/eye/ground_points.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/terrain/drawn_heights.h"
#include "geo/together/cut_regions.h"

namespace oro {
namespace {

// Rows and columns of a grid, the last ones included; none where the last is before the first.
struct PostsInCell {
    int first_row{};
    int last_row{};
    int first_column{};
    int last_column{};
    const PlaceCell* cell{};  // null: all posts in these rows and columns

    [[nodiscard]] int rows() const { return last_row - first_row + 1; }
    [[nodiscard]] int columns() const { return last_column - first_column + 1; }
};

bool is_in_cell(const PlaceCell& cell, const PostPlace& place) {
    constexpr double rounding_deg = 1e-9;
    const double half_deg = 0.5 * (cell.east_deg - cell.west_deg);
    const double from_middle_deg = std::remainder(place.lon_deg - (cell.west_deg + half_deg), 360.0);
    return place.lat_deg >= cell.south_deg - rounding_deg && place.lat_deg <= cell.north_deg + rounding_deg &&
           std::abs(from_middle_deg) <= half_deg + rounding_deg;
}

// Of posts on latitudes and longitudes those in the cell; of posts on a net those around it.
PostsInCell part_in(const PostGrid& grid, const PlaceCell& cell) {
    constexpr double rounding_posts = 1e-6;
    const double half_deg = 0.5 * (cell.east_deg - cell.west_deg), middle_deg = cell.west_deg + half_deg;
    double top = grid.rows(), bottom = -1.0, left = grid.columns(), right = -1.0;
    if (grid.net) {
        for (int i = 0; i < 9; ++i) {
            const PostNumber post =
                grid.post_at(cell.south_deg + 0.5 * (i / 3) * (cell.north_deg - cell.south_deg),
                             cell.west_deg + i % 3 * half_deg);
            top = std::min(top, post.row - 1.0), bottom = std::max(bottom, post.row + 1.0);
            left = std::min(left, post.column - 1.0), right = std::max(right, post.column + 1.0);
        }
    } else {
        top = grid.lat.index_at(cell.north_deg), bottom = grid.lat.index_at(cell.south_deg);
        const double middle = grid.column_at(middle_deg), half = half_deg * grid.lon.posts_per_deg;
        left = middle - half, right = middle + half;
    }
    const auto post = [](double number, int count) {
        return static_cast<int>(std::clamp(number, -1.0, static_cast<double>(count)));
    };
    PostsInCell part;
    part.first_row = std::max(0, post(std::ceil(top - rounding_posts), grid.rows()));
    part.last_row = std::min(grid.rows() - 1, post(std::floor(bottom + rounding_posts), grid.rows()));
    part.first_column = std::max(0, post(std::ceil(left - rounding_posts), grid.columns()));
    part.last_column = std::min(grid.columns() - 1, post(std::floor(right + rounding_posts), grid.columns()));
    part.cell = grid.net ? &cell : nullptr;
    return part;
}

// Whether there is ground between posts of a part: one row of posts, as neighbours share it, bounds none.
bool has_surface(const PostGrid& grid, const PostsInCell& part) {
    if (part.rows() < 2 || part.columns() < 2) return false;
    if (part.cell == nullptr) return true;
    const auto is_inside = [&](int row, int column) {
        return is_in_cell(*part.cell, grid.place_at(row, column));
    };
    for (int row = part.first_row; row < part.last_row; ++row)
        for (int column = part.first_column; column < part.last_column; ++column)
            if (is_inside(row, column) && is_inside(row, column + 1) && is_inside(row + 1, column) &&
                is_inside(row + 1, column + 1))
                return true;
    return false;
}

PostsInCell whole_part(const PostGrid& grid) {
    return {0, grid.rows() - 1, 0, grid.columns() - 1, nullptr};
}

bool has_ground(const HeightField& field, const PostsInCell& part, int row, int column) {
    return !is_void(field.H_at_post_m(row, column)) &&
           (part.cell == nullptr || is_in_cell(*part.cell, field.grid.place_at(row, column)));
}

// Posts all over a part of the drawn surface, at most some 64 x 64 of them.
void add_inner_points(const HeightField& field, const PostsInCell& part, double exaggeration,
                      std::vector<Ecef>& points) {
    const int row_step = std::max(1, part.rows() / 64), column_step = std::max(1, part.columns() / 64);
    for (int row = part.first_row; row <= part.last_row; row += row_step)
        for (int column = part.first_column; column <= part.last_column; column += column_step)
            if (has_ground(field, part, row, column))
                points.push_back(post_ecef(field, row, column, exaggeration));
}

// The first post with data of every row and column of a part (of every few where they are many), from both of
// its ends.
void add_rim_points(const HeightField& field, const PostsInCell& part, double exaggeration,
                    std::vector<Ecef>& points) {
    const auto add_ends = [&](int lines, int posts, auto post_of) {
        const int step = std::max(1, lines / 1024);
        for (int line = 0; line < lines;
             line = line + 1 == lines ? lines : std::min(line + step, lines - 1)) {
            const auto add_first = [&](int from, int towards) {
                for (int i = from; i >= 0 && i < posts; i += towards) {
                    const auto [row, column] = post_of(line, i);
                    if (!has_ground(field, part, row, column)) continue;
                    points.push_back(post_ecef(field, row, column, exaggeration));
                    return;
                }
            };
            add_first(0, 1);
            add_first(posts - 1, -1);
        }
    };
    add_ends(part.rows(), part.columns(), [&](int row, int column) {
        return std::pair{part.first_row + row, part.first_column + column};
    });
    add_ends(part.columns(), part.rows(), [&](int column, int row) {
        return std::pair{part.first_row + row, part.first_column + column};
    });
}

void find_middle(const std::vector<Ecef>& points, GroundPoints& ground) {
    glm::dvec3 mean(0.0);
    for (const Ecef& point : points) mean += point.m / static_cast<double>(points.size());
    for (const Ecef& point : points) ground.radius_m = std::max(ground.radius_m, glm::length(point.m - mean));
    // Of a region all around the Earth the middle is the Earth's.
    ground.middle = glm::length(mean) > 1e6 ? geodetic_from_ecef({mean}) : Geodetic{0.0, 0.0, 0.0};
}

}  // namespace

std::vector<Ecef> rim_points(const Region& region, double exaggeration) {
    std::vector<Ecef> rim;
    for (const RegionGrid& one : region.grids)
        add_rim_points(one.field, whole_part(one.field.grid), exaggeration, rim);
    return rim;
}

GroundPoints ground_points(const Region& region, double exaggeration, const PlaceCell* cell) {
    GroundPoints ground;
    std::vector<Ecef> rim;
    for (const RegionGrid& one : region.grids) {
        const PostGrid& grid = one.field.grid;
        const PostsInCell part = cell ? part_in(grid, *cell) : whole_part(grid);
        if (cell ? !has_surface(grid, part) : part.rows() <= 0 || part.columns() <= 0) continue;
        add_inner_points(one.field, part, exaggeration, ground.all);
        add_rim_points(one.field, part, exaggeration, rim);
    }
    if (rim.empty()) return ground;
    find_middle(ground.all.empty() ? rim : ground.all, ground);
    ground.all.insert(ground.all.end(), rim.begin(), rim.end());
    return ground;
}

}  // namespace oro
