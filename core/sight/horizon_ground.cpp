#include "core/sight/horizon_ground.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/base/parallel.h"
#include "core/terrain/drawn_heights.h"
#include "core/truth/oracle.h"

namespace oro {
namespace {

int column_of_grid(const PostGrid& grid, int column) {
    if (!grid.wraps_longitude()) return column;
    const int turn = grid.columns() - 1;
    return ((column % turn) + turn) % turn;
}

}  // namespace

PostEye::PostEye(const Geodetic& place, const Air& air, double radius)
    : ecef(ecef_from_geodetic(place)),
      enu_from_ecef(glm::transpose(ecef_from_enu(place.lat_deg, place.lon_deg))),
      h_m(place.h_m),
      bend_per_m(0.5 * sight_from(place, air).refraction.curvature_per_m()),
      bulge_per_m(0.5 / gaussian_radius_m(place.lat_deg) - bend_per_m),
      radius_m(radius) {}

struct HorizonGround::Search {
    const PostEye& eye;
    glm::dvec3 right, along, up;  // ECEF
    double fall_per_m;            // level ground falls by at least this times the square of the distance
    double tangent{none};         // the largest so far
    std::int64_t leaf{-1};        // that has it
    std::int64_t looked_at{-1};   // the leaf that was looked at first
};

HorizonGround::HorizonGround(const TrueSurface& surface, const GridPart& window, int threads)
    : window_(window),
      posts_(window.count(), glm::dvec3(std::numeric_limits<double>::quiet_NaN())),
      sw_ne_(window.count(), 0) {
    in_parallel(window.rows, threads, [&](int row) { place_row(surface, row); });
    const auto blocks = [](int cells) { return std::max(1, (cells + block_cells - 1) / block_cells); };
    Level first{blocks(window.rows - 1), blocks(window.columns - 1), {}};
    first.blocks.resize(static_cast<std::size_t>(first.rows) * static_cast<std::size_t>(first.columns));
    in_parallel(first.rows, threads, [&](int row) {
        for (int column = 0; column < first.columns; ++column)
            first.blocks[static_cast<std::size_t>(row) * static_cast<std::size_t>(first.columns) +
                         static_cast<std::size_t>(column)] = block_of_posts(surface, row, column);
    });
    levels_.push_back(std::move(first));
    while (levels_.back().blocks.size() > 1) {
        const Level& below = levels_.back();
        Level level{(below.rows + 1) / 2, (below.columns + 1) / 2, {}};
        level.blocks.resize(static_cast<std::size_t>(level.rows) * static_cast<std::size_t>(level.columns));
        join_blocks(below, level);
        levels_.push_back(std::move(level));
    }
    // An ellipsoid's largest radius of curvature is that at its poles, a^2 / b.
    largest_radius_m_ =
        wgs84_a_m * wgs84_a_m / wgs84_b_m + std::max(0.0, levels_.back().blocks.front().highest_h_m);
}

void HorizonGround::place_row(const TrueSurface& surface, int row) {
    const PostGrid& grid = surface.field().grid;
    const int grid_row = window_.first_row + row;
    std::vector<glm::dvec3> normals;
    if (grid.net) {
        normals.resize(static_cast<std::size_t>(window_.columns));
        grid.net->normals_of_row(grid_row, window_.first_column, normals);
    }
    const double lat_deg = grid.net ? 0.0 : row_lat_deg(grid, grid_row);
    const auto first = static_cast<std::size_t>(row) * static_cast<std::size_t>(window_.columns);
    for (int i = 0; i < window_.columns; ++i) {
        const auto number = static_cast<std::size_t>(i);
        const int column = column_of_grid(grid, window_.first_column + i);
        if (row + 1 < window_.rows && i + 1 < window_.columns)
            sw_ne_[first + number] = surface.diagonal_of_many(grid_row, column) == Diagonal::sw_ne ? 1 : 0;
        const std::optional<double> h_m = surface.post_h_m(grid_row, column);
        if (!h_m) continue;
        posts_[first + number] = grid.net ? ecef_along(normals[number], *h_m).m
                                          : ecef_from_geodetic({lat_deg, grid.lon.at_deg(column), *h_m}).m;
    }
}

HorizonGround::Block HorizonGround::block_of_posts(const TrueSurface& surface, int row, int column) const {
    const int last_row = std::min((row + 1) * block_cells, window_.rows - 1);
    const int last_column = std::min((column + 1) * block_cells, window_.columns - 1);
    Block block;
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-low);
    block.highest_h_m = none;
    const auto each = [&](const auto& take) {
        for (int r = row * block_cells; r <= last_row; ++r) {
            for (int c = column * block_cells; c <= last_column; ++c) {
                const glm::dvec3& post =
                    posts_[static_cast<std::size_t>(r) * static_cast<std::size_t>(window_.columns) +
                           static_cast<std::size_t>(c)];
                if (!std::isnan(post.x)) take(r, c, post);
            }
        }
    };
    each([&](int r, int c, const glm::dvec3& post) {
        low = glm::min(low, post);
        high = glm::max(high, post);
        const int of_grid = column_of_grid(surface.field().grid, window_.first_column + c);
        block.highest_h_m =
            std::max(block.highest_h_m, surface.post_h_m(window_.first_row + r, of_grid).value_or(none));
    });
    if (low.x > high.x) return block;
    block.middle = 0.5 * (low + high);
    constexpr double rounded_m = 1.0e-3;
    each([&](int, int, const glm::dvec3& post) {
        block.radius_m = std::max(block.radius_m, glm::length(post - block.middle) + rounded_m);
    });
    return block;
}

// A sphere around up to four others: around the box of their middles.
void HorizonGround::join_blocks(const Level& below, Level& level) const {
    for (int row = 0; row < level.rows; ++row) {
        for (int column = 0; column < level.columns; ++column) {
            Block& block =
                level.blocks[static_cast<std::size_t>(row) * static_cast<std::size_t>(level.columns) +
                             static_cast<std::size_t>(column)];
            glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-low);
            block.highest_h_m = none;
            const auto each = [&](const auto& take) {
                for (int r = 2 * row; r < std::min(2 * row + 2, below.rows); ++r) {
                    for (int c = 2 * column; c < std::min(2 * column + 2, below.columns); ++c) {
                        const Block& one = below.blocks[static_cast<std::size_t>(r) *
                                                            static_cast<std::size_t>(below.columns) +
                                                        static_cast<std::size_t>(c)];
                        if (one.radius_m >= 0.0) take(one);
                    }
                }
            };
            each([&](const Block& one) {
                low = glm::min(low, one.middle);
                high = glm::max(high, one.middle);
                block.highest_h_m = std::max(block.highest_h_m, one.highest_h_m);
            });
            if (low.x > high.x) continue;
            block.middle = 0.5 * (low + high);
            each([&](const Block& one) {
                block.radius_m =
                    std::max(block.radius_m, glm::length(one.middle - block.middle) + one.radius_m);
            });
        }
    }
}

// An upper bound of the tangents of a block, and how near it may be. The Earth lies within the sphere of its
// largest radius of curvature that touches it below the eye, and ground of height h within that of h more: at
// a distance s across the level plane it is at most h - h_eye - s^2 / (2 (R + h)) high.
// Source: W. Blaschke, Kreis und Kugel, 1916 (a convex body within a ball that rolls around it).
double HorizonGround::bound(const Block& block, const Search& search, double& near_m) const {
    if (block.radius_m < 0.0) return none;
    const glm::dvec3 offset = block.middle - search.eye.ecef.m;
    const double right_m = glm::dot(offset, search.right);
    const double half2 = block.radius_m * block.radius_m - right_m * right_m;
    if (half2 < 0.0) return none;
    // What the upright plane cuts from the sphere.
    const double along_m = glm::dot(offset, search.along), half_m = std::sqrt(half2);
    near_m = std::max(0.0, along_m - half_m);
    const double far_m = std::min(along_m + half_m, search.eye.radius_m);
    if (far_m <= 0.0 || near_m > search.eye.radius_m) return none;
    constexpr double rounded_m = 1.0e-5;
    const double rise_m = block.highest_h_m - search.eye.h_m + rounded_m;
    if (rise_m >= 0.0)
        return near_m > 0.0 ? rise_m / near_m - search.fall_per_m * near_m
                            : std::numeric_limits<double>::infinity();
    const double at_m = std::clamp(std::sqrt(-rise_m / search.fall_per_m), near_m, far_m);
    return rise_m / at_m - search.fall_per_m * at_m;
}

// The upright plane cuts a triangle along a line from one edge to another: straight, and bulging with the
// Earth. Over it the tangent is A / s + B - bulge s, largest at an end or where its derivative is 0.
void HorizonGround::take_triangle(const std::array<const SeenPost*, 3>& corners, Search& search) const {
    struct Cut {
        double along_m, up_m;
    };
    std::array<Cut, 4> cuts{};
    std::size_t count = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const SeenPost &a = *corners[i], &b = *corners[(i + 1) % 3];
        if (a.right_m == 0.0 && count < 4) cuts[count++] = {a.along_m, a.up_m};
        if (!(a.right_m * b.right_m < 0.0) || count == 4) continue;
        const double share = a.right_m / (a.right_m - b.right_m);
        const double across_m = b.right_m - a.right_m, forth_m = b.along_m - a.along_m;
        const double bulge_m =
            search.eye.bulge_per_m * share * (1.0 - share) * (across_m * across_m + forth_m * forth_m);
        cuts[count++] = {a.along_m + share * forth_m, a.up_m + share * (b.up_m - a.up_m) + bulge_m};
    }
    if (count == 0) return;
    const auto [first, last] =
        std::minmax_element(cuts.begin(), cuts.begin() + static_cast<std::ptrdiff_t>(count),
                            [](const Cut& one, const Cut& other) { return one.along_m < other.along_m; });
    const double bulge = search.eye.bulge_per_m, length_m = last->along_m - first->along_m;
    const double slope = length_m > 0.0 ? (last->up_m - first->up_m) / length_m : 0.0;
    const double a = first->up_m - slope * first->along_m - bulge * first->along_m * last->along_m;
    const double b = slope + bulge * (first->along_m + last->along_m);
    const double from_m = std::max(0.0, first->along_m), to_m = std::min(last->along_m, search.eye.radius_m);
    if (!(to_m > 0.0) || from_m > to_m) return;
    const auto take = [&](double s_m) {
        if (s_m > 0.0) search.tangent = std::max(search.tangent, a / s_m + b - bulge * s_m);
    };
    take(from_m);
    take(to_m);
    if (a < 0.0 && bulge > 0.0) {
        const double top_m = std::sqrt(-a / bulge);
        if (top_m > from_m && top_m < to_m) take(top_m);
    }
}

void HorizonGround::search_leaf(std::int64_t number, Search& search) const {
    const int columns = levels_.front().columns;
    const int first_row = static_cast<int>(number / columns) * block_cells,
              first_column = static_cast<int>(number % columns) * block_cells;
    const int rows_of = std::min(block_cells, window_.rows - 1 - first_row),
              columns_of = std::min(block_cells, window_.columns - 1 - first_column);
    constexpr int side = block_cells + 1;
    constexpr double on_line_m = 1.0e-7;
    std::array<SeenPost, static_cast<std::size_t>(side * side)> seen;
    const auto at = [](int row, int column) { return static_cast<std::size_t>(row * side + column); };
    const auto of_window = [&](int row, int column) {
        return static_cast<std::size_t>(first_row + row) * static_cast<std::size_t>(window_.columns) +
               static_cast<std::size_t>(first_column + column);
    };
    for (int row = 0; row <= rows_of; ++row) {
        for (int column = 0; column <= columns_of; ++column) {
            const glm::dvec3 offset = posts_[of_window(row, column)] - search.eye.ecef.m;
            const double right_m = glm::dot(offset, search.right), along_m = glm::dot(offset, search.along);
            seen[at(row, column)] = {std::abs(right_m) < on_line_m ? 0.0 : right_m, along_m,
                                     glm::dot(offset, search.up) +
                                         search.eye.bend_per_m * (right_m * right_m + along_m * along_m)};
        }
    }
    for (int row = 0; row < rows_of; ++row) {
        for (int column = 0; column < columns_of; ++column) {
            // Most cells lie on one side of the upright plane. (A post that is no number is on neither.)
            int right = 0, left = 0;
            for (const std::size_t corner :
                 {at(row, column), at(row, column + 1), at(row + 1, column), at(row + 1, column + 1)}) {
                right += seen[corner].right_m > 0.0;
                left += seen[corner].right_m < 0.0;
            }
            if (right == 4 || left == 4) continue;
            const Diagonal diagonal = sw_ne_[of_window(row, column)] != 0 ? Diagonal::sw_ne : Diagonal::nw_se;
            for (const bool west : {true, false}) {
                std::array<const SeenPost*, 3> corners{};
                const CellCorners places = cell_corners(diagonal, west);
                for (std::size_t i = 0; i < 3; ++i)
                    corners[i] = &seen[at(row + places[i][0], column + places[i][1])];
                const double one = corners[0]->right_m, two = corners[1]->right_m,
                             three = corners[2]->right_m;
                // No number, no ground.
                if (!(std::min({one, two, three}) <= 0.0 && std::max({one, two, three}) >= 0.0)) continue;
                if (std::isnan(one + two + three)) continue;
                take_triangle(corners, search);
            }
        }
    }
}

double HorizonGround::most_tangent(const PostEye& eye, double sine, double cosine, std::int64_t& leaf) const {
    const glm::dmat3 ecef_from_enu = glm::transpose(eye.enu_from_ecef);
    Search search{eye, ecef_from_enu * glm::dvec3(cosine, -sine, 0.0),
                  ecef_from_enu * glm::dvec3(sine, cosine, 0.0), ecef_from_enu[2],
                  0.5 / largest_radius_m_ - eye.bend_per_m};
    const auto look = [&](std::int64_t number) {
        const double before = search.tangent;
        search_leaf(number, search);
        if (search.tangent > before) search.leaf = number;
    };
    if (leaf >= 0) {
        look(leaf);
        search.looked_at = leaf;
    }
    struct Waiting {
        int level, row, column;
        double bound, near_m;
    };
    std::array<Waiting, 128> waiting;  // at most 3 more for each level
    std::size_t count = 0;
    const auto add = [&](int level, int row, int column) {
        const Level& of = levels_[static_cast<std::size_t>(level)];
        if (row >= of.rows || column >= of.columns) return;
        Waiting one{level, row, column, none, 0.0};
        one.bound = bound(of.blocks[static_cast<std::size_t>(row) * static_cast<std::size_t>(of.columns) +
                                    static_cast<std::size_t>(column)],
                          search, one.near_m);
        if (one.bound > search.tangent) waiting[count++] = one;
    };
    add(static_cast<int>(levels_.size()) - 1, 0, 0);
    while (count > 0) {
        const Waiting next = waiting[--count];
        if (next.bound <= search.tangent) continue;
        if (next.level == 0) {
            const std::int64_t number =
                static_cast<std::int64_t>(next.row) * levels_.front().columns + next.column;
            if (number != search.looked_at) look(number);
            continue;
        }
        const std::size_t first = count;
        for (int i = 0; i < 4; ++i) add(next.level - 1, 2 * next.row + i / 2, 2 * next.column + i % 2);
        std::sort(waiting.begin() + static_cast<std::ptrdiff_t>(first),
                  waiting.begin() + static_cast<std::ptrdiff_t>(count),
                  [](const Waiting& one, const Waiting& other) { return one.near_m > other.near_m; });
    }
    leaf = search.leaf;
    return search.tangent;
}

}  // namespace oro
