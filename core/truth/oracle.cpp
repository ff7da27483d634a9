#include "core/truth/oracle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "core/truth/oracle_scenery.h"
#include "core/truth/triangle_bvh.h"

namespace oro {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
using Block = TrueSurface::Block;

// Where on a ray from the origin a box begins and ends; begin > end when it is missed.
struct Span {
    double begin_m;
    double end_m;
};
Span span_in_box(const glm::dvec3& direction, const glm::dvec3& inverse, const glm::dvec3& low,
                 const glm::dvec3& high) {
    Span span{0.0, infinite};
    for (int axis = 0; axis < 3; ++axis) {
        if (direction[axis] == 0.0) {
            if (low[axis] > 0.0 || high[axis] < 0.0) return {infinite, 0.0};
            continue;
        }
        const double one_m = low[axis] * inverse[axis], other_m = high[axis] * inverse[axis];
        span.begin_m = std::max(span.begin_m, std::min(one_m, other_m));
        span.end_m = std::min(span.end_m, std::max(one_m, other_m));
    }
    return span;
}

}  // namespace

// One sight line against the surface.
class Oracle::Search {
  public:
    // start_m: where the line begins, from the eye, ECEF axes.
    Search(const Oracle::Scenery& scenery, const glm::dvec3& direction, double reach_m,
           const glm::dvec3& start_m)
        : scenery_(scenery),
          surface_(scenery.surface),
          grid_(scenery.surface.field().grid),
          start_(start_m),
          start_in_frame_(scenery.frame_from_ecef * start_m),
          direction_(direction),
          in_frame_(scenery.frame_from_ecef * direction),
          inverse_(1.0 / in_frame_),
          nearest_m_(reach_m) {}

    std::optional<SightHit> first_hit();

  private:
    // A point of the sight line, by grid: row and column fractional, column in the whole turn of a cell's.
    struct RayPoint {
        double t_m;
        double row;
        double column;
        double h_m;
        Geodetic point;
    };
    struct Waiting {
        Block block;
        Span span;
    };

    [[nodiscard]] RayPoint point_at(double t_m, double near_column) const;
    [[nodiscard]] Span between_meridians(const Block& block, Span span) const;
    void search_block(const Block& block, const Span& box);
    void walk(const Block& block, const RayPoint& from, const RayPoint& to, int depth);
    // A piece of the line that is all but straight in rows and columns, and a parabola in height: its places
    // at shares 0, 1/2 and 1.
    using Piece = std::array<RayPoint, 3>;
    // A triangle's plane in (row, column), both from the cell's corner.
    struct Triangle {
        int row;
        int column;
        Diagonal diagonal;
        bool west;
        CellPlane plane_m;
        [[nodiscard]] double above_m(const RayPoint& point) const {
            return point.h_m - plane_m.at_corner - plane_m.change_down * (point.row - row) -
                   plane_m.change_right * (point.column - column);
        }
        [[nodiscard]] bool holds(const RayPoint& point, double slack) const;
    };
    void search_piece(const Block& block, const Piece& piece);
    void search_cell(int row, int column, const Piece& piece);
    void search_triangle(const Triangle& triangle, const Piece& piece);
    bool take_root(const Triangle& triangle, const Piece& piece, double share, double slope_m);

    const Oracle::Scenery& scenery_;
    const TrueSurface& surface_;
    const PostGrid& grid_;
    glm::dvec3 start_;
    glm::dvec3 start_in_frame_;
    glm::dvec3 direction_;
    glm::dvec3 in_frame_;
    glm::dvec3 inverse_;
    double nearest_m_;
    std::optional<SightHit> hit_;
};

namespace {

// Far outside every grid: where a model of the Earth has no place.
constexpr Geodetic nowhere{1.0e6, 0.0, 0.0};

// A root is looked for this far beyond a triangle, in cells, because it is looked for on an approximation.
constexpr double search_slack = 0.02;

}  // namespace

Oracle::Search::RayPoint Oracle::Search::point_at(double t_m, double near_column) const {
    const Sight& sight = scenery_.sight;
    const glm::dvec3 offset_m = sight.refraction.true_m(start_ + t_m * direction_);
    const Geodetic point = sight.earth == Earth::ellipsoid
                               ? geodetic_from_ecef({sight.eye.m + offset_m})
                               : model_point(sight.earth, sight.place, offset_m).value_or(nowhere);
    if (grid_.net) {
        constexpr PostNumber outside{1.0e9, 1.0e9};
        const PostNumber post =
            point.lat_deg > 90.0 ? outside : grid_.net->post_at(point.lat_deg, point.lon_deg);
        return {t_m, post.row, post.column, point.h_m, point};
    }
    const double turn = 360.0 * grid_.lon.posts_per_deg;
    double column = grid_.lon.index_at(point.lon_deg);
    column -= turn * std::round((column - near_column) / turn);
    return {t_m, grid_.lat.index_at(point.lat_deg), column, point.h_m, point};
}

std::optional<SightHit> Oracle::Search::first_hit() {
    if (surface_.levels() == 0) return std::nullopt;
    std::array<Waiting, 160> waiting;  // at most 3 more for each level
    std::size_t count = 0;
    const auto add = [&](const Block& block) {
        const Oracle::Scenery::Box& box = scenery_.remembered_box(block);
        if (!box.holds_ground) return;
        const Span span =
            span_in_box(in_frame_, inverse_, box.low - start_in_frame_, box.high - start_in_frame_);
        if (span.begin_m <= span.end_m && span.begin_m < nearest_m_) waiting[count++] = {block, span};
    };
    add({surface_.levels() - 1, 0, 0});
    while (count > 0) {
        const Waiting next = waiting[--count];
        if (next.span.begin_m >= nearest_m_) continue;
        if (next.block.level == 0) {
            search_block(next.block, next.span);
            continue;
        }
        const std::size_t first = count;
        const int level = next.block.level - 1;
        const auto [rows, columns] = surface_.blocks(level);
        for (int i = 0; i < 4; ++i) {
            const Block below{level, 2 * next.block.row + i / 2, 2 * next.block.column + i % 2};
            if (below.row < rows && below.column < columns) add(below);
        }
        std::sort(waiting.begin() + static_cast<std::ptrdiff_t>(first),
                  waiting.begin() + static_cast<std::ptrdiff_t>(count),
                  [](const Waiting& a, const Waiting& b) { return a.span.begin_m > b.span.begin_m; });
    }
    return hit_;
}

namespace {

// The part of a span in which a parabola is at least -slack: all of it that lies between the first and the
// last such place.
Span where_positive(double at_0, double slope, double square, Span span, double slack) {
    const auto at = [&](double t) { return at_0 + slack + t * (slope + t * square); };
    const double discriminant = slope * slope - 4.0 * square * (at_0 + slack);
    const bool begins = at(span.begin_m) >= 0.0, ends = at(span.end_m) >= 0.0;
    if (begins && ends) return span;
    if (discriminant < 0.0) return {infinite, 0.0};
    const double q = -0.5 * (slope + std::copysign(std::sqrt(discriminant), slope));
    double first = q != 0.0 ? (at_0 + slack) / q : 0.0, last = square != 0.0 ? q / square : first;
    if (last < first) std::swap(first, last);
    const auto within = [&](double t) { return t >= span.begin_m && t <= span.end_m; };
    if (!begins) span.begin_m = within(first) ? first : within(last) ? last : infinite;
    if (!ends) span.end_m = within(last) ? last : within(first) ? first : 0.0;
    return span;
}

}  // namespace

// Over a pole the boxes of all blocks around it hold the same places: only between its own meridians a block
// is met.
Span Oracle::Search::between_meridians(const Block& block, Span span) const {
    const Sight& sight = scenery_.sight;
    if (sight.earth == Earth::flat || grid_.net) return span;  // neither has a pole where meridians meet
    const auto& meridians = scenery_.columns;
    const SineCosine& west = meridians[static_cast<std::size_t>(block.column)];
    const SineCosine& east =
        meridians[std::min(static_cast<std::size_t>(block.column) + 1, meridians.size() - 1)];
    constexpr double too_wide_deg = 170.0;  // a wedge that is not convex
    if (TrueSurface::block_cells * grid_.lon.spacing_deg() > too_wide_deg) return span;
    const glm::dvec3 fall = sight.refraction.straight()
                                ? glm::dvec3(0.0)
                                : -sight.refraction.lift_m(direction_) * sight.refraction.up();
    constexpr double slack_m = 1.0e-3;
    for (const glm::dvec3& inward :
         {glm::dvec3(-west.sine, west.cosine, 0.0), glm::dvec3(east.sine, -east.cosine, 0.0)})
        span = where_positive(glm::dot(inward, sight.eye.m + start_), glm::dot(inward, direction_),
                              glm::dot(inward, fall), span, slack_m);
    return span;
}

void Oracle::Search::search_block(const Block& block, const Span& box) {
    const Span span = between_meridians(block, {box.begin_m, std::min(box.end_m, nearest_m_)});
    if (!(span.begin_m <= span.end_m)) return;
    const double middle_column = (block.column + 0.5) * TrueSurface::block_cells;
    walk(block, point_at(span.begin_m, middle_column), point_at(span.end_m, middle_column), 0);
}

// Cuts the line until it is all but straight in rows and columns.
void Oracle::Search::walk(const Block& block, const RayPoint& from, const RayPoint& to, int depth) {
    if (from.t_m >= nearest_m_) return;
    const RayPoint middle =
        point_at(0.5 * (from.t_m + to.t_m), (block.column + 0.5) * TrueSurface::block_cells);
    const bool straight = std::abs(middle.row - 0.5 * (from.row + to.row)) < 0.005 &&
                          std::abs(middle.column - 0.5 * (from.column + to.column)) < 0.005;
    constexpr double short_enough_m = 20000.0;  // what a parabola follows to 1 cm
    constexpr int deepest = 40;                 // over a pole, where columns jump
    // Over the plane all heights along a line are a parabola.
    const bool parabola = scenery_.sight.earth == Earth::flat || to.t_m - from.t_m < short_enough_m;
    if ((straight && parabola) || depth == deepest) {
        search_piece(block, {from, middle, to});
        return;
    }
    walk(block, from, middle, depth + 1);
    walk(block, middle, to, depth + 1);
}

namespace {

// First and last cell of a block that a piece may touch along one axis.
struct CellRange {
    int first;
    int last;
};
CellRange cells_touched(double from, double to, int first, int count) {
    const double low = std::clamp(std::min(from, to) - search_slack, first - 1.0, first + count + 1.0);
    const double high = std::clamp(std::max(from, to) + search_slack, first - 1.0, first + count + 1.0);
    return {std::max(first, static_cast<int>(std::floor(low))),
            std::min(first + count - 1, static_cast<int>(std::floor(high)))};
}

}  // namespace

void Oracle::Search::search_piece(const Block& block, const Piece& piece) {
    constexpr int cells = TrueSurface::block_cells;
    const int first_row = block.row * cells, first_column = block.column * cells;
    const CellRange rows =
        cells_touched(piece[0].row, piece[2].row, first_row, std::min(cells, grid_.rows() - 1 - first_row));
    const double down = piece[2].row - piece[0].row, right = piece[2].column - piece[0].column;
    for (int row = rows.first; row <= rows.last; ++row) {
        // Columns of the part of the piece that lies over this row of cells.
        double begin = 0.0, end = 1.0;
        if (std::abs(down) > 1.0e-9) {
            const double one = (row - search_slack - piece[0].row) / down;
            const double other = (row + 1.0 + search_slack - piece[0].row) / down;
            begin = std::clamp(std::min(one, other), 0.0, 1.0);
            end = std::clamp(std::max(one, other), 0.0, 1.0);
        }
        const CellRange columns =
            cells_touched(piece[0].column + begin * right, piece[0].column + end * right, first_column,
                          std::min(cells, grid_.columns() - 1 - first_column));
        for (int column = columns.first; column <= columns.last; ++column) search_cell(row, column, piece);
    }
}

void Oracle::Search::search_cell(int row, int column, const Piece& piece) {
    const auto north_west = surface_.post_h_m(row, column),
               south_east = surface_.post_h_m(row + 1, column + 1);
    if (!north_west || !south_east) return;
    const Diagonal diagonal = surface_.diagonal_at(row, column);
    const auto south_west = surface_.post_h_m(row + 1, column),
               north_east = surface_.post_h_m(row, column + 1);
    if (diagonal == Diagonal::sw_ne && !(south_west && north_east)) return;
    for (const bool west : {true, false}) {
        if (!(west ? south_west : north_east)) continue;
        search_triangle({row, column, diagonal, west,
                         cell_plane(diagonal, west, *north_west, north_east.value_or(0.0),
                                    south_west.value_or(0.0), *south_east)},
                        piece);
    }
}

bool Oracle::Search::Triangle::holds(const RayPoint& point, double slack) const {
    const double down = point.row - row, right = point.column - column;
    if (down < -slack || right < -slack || down > 1.0 + slack || right > 1.0 + slack) return false;
    const double across = west_of_diagonal(diagonal, down, right);
    return west ? across >= -slack : across <= slack;
}

// Roots of the parabola through the piece's three heights above the triangle's plane, nearest first.
void Oracle::Search::search_triangle(const Triangle& triangle, const Piece& piece) {
    const double at_0 = triangle.above_m(piece[0]), at_half = triangle.above_m(piece[1]),
                 at_1 = triangle.above_m(piece[2]);
    const double square = 2.0 * (at_0 - 2.0 * at_half + at_1);
    const double slope = -3.0 * at_0 + 4.0 * at_half - at_1;
    std::array<double, 2> roots{infinite, infinite};
    // slope^2 - 4 square at_0, and the roots without loss. Source: W. H. Press et al., Numerical Recipes, 3rd
    // ed. 2007, eq. 5.6.4.
    const double discriminant = slope * slope - 4.0 * square * at_0;
    if (discriminant < 0.0) return;
    const double q = -0.5 * (slope + std::copysign(std::sqrt(discriminant), slope));
    if (q == 0.0) {
        if (at_0 == 0.0) roots[0] = 0.0;
    } else {
        roots = {at_0 / q, square == 0.0 ? infinite : q / square};
        if (roots[1] < roots[0]) std::swap(roots[0], roots[1]);
    }
    for (const double share : roots) {
        if (share < -search_slack || share > 1.0 + search_slack) continue;
        if (take_root(triangle, piece, share, slope + 2.0 * square * share)) return;
    }
}

// Follows a root to where the line itself meets the triangle, and takes it when it is the nearest so far.
bool Oracle::Search::take_root(const Triangle& triangle, const Piece& piece, double share, double slope_m) {
    const double length_m = piece[2].t_m - piece[0].t_m;
    const double rise =
        length_m > 0.0 ? slope_m / length_m : 0.0;  // metres above the plane for a metre along the line
    double t_m = piece[0].t_m + share * length_m;
    if (t_m - nearest_m_ > search_slack * length_m) return false;
    const double exact_m = 1.0e-9 + 4.0e-16 * t_m;
    RayPoint here = point_at(t_m, triangle.column + 0.5);
    if (!triangle.holds(here, 2.0 * search_slack)) return false;
    double above_m = triangle.above_m(here);
    for (int step = 0; step < 8 && std::abs(above_m) > exact_m && rise != 0.0; ++step) {
        const RayPoint next = point_at(t_m - above_m / rise, triangle.column + 0.5);
        const double next_m = triangle.above_m(next);
        if (!(std::abs(next_m) < std::abs(above_m))) break;  // no better: as exact as doubles are here
        here = next;
        t_m = next.t_m;
        above_m = next_m;
    }
    // What a rounded angle needs at a rim, so that no line slips through between two cells.
    const double rim_slack =
        std::max(1.0e-8, 4.0e-13 * std::max(grid_.lat.posts_per_deg, grid_.lon.posts_per_deg));
    constexpr double residual_m = 1.0e-4;
    if (t_m < 0.0 || t_m >= nearest_m_ || std::abs(above_m) > residual_m || !triangle.holds(here, rim_slack))
        return false;
    if (!scenery_.ground.shows(scenery_.grid, here.point.lat_deg, here.point.lon_deg)) return false;
    nearest_m_ = t_m;
    hit_ = SightHit{here.point,    t_m,        triangle.row, triangle.column,
                    triangle.west, rise > 0.0, above_m,      scenery_.grid};
    return true;
}

std::optional<SightHit> Oracle::first_hit_after(const glm::dvec3& start_m, const glm::dvec3& direction,
                                                double reach_m) const {
    std::optional<SightHit> nearest;
    for (const auto& scenery : sceneries_) {
        auto hit = Search(*scenery, direction, nearest ? nearest->distance_m : reach_m, start_m).first_hit();
        if (hit) nearest = hit;
    }
    double most_m = nearest ? nearest->distance_m : reach_m;
    std::optional<OfMesh> beside;
    if (pieces_) {
        if (const auto hit = pieces_->first_hit(start_m, direction, most_m))
            most_m = hit->along_m, beside = of_piece(hit->owner);
    }
    if (sight_.earth == Earth::ellipsoid) {
        for (const TrueMesh& mesh : ground_.meshes())
            if (const auto hit = mesh.first_hit(sight_.eye, sight_.refraction, start_m, direction, most_m))
                most_m = hit->along_m, beside = OfMesh{mesh.number(), hit->feature};
    }
    return beside ? hit_beside(start_m + most_m * direction, most_m, *beside) : nearest;
}

}  // namespace oro
