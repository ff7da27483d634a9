#include "core/sight/edge_crossings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace oro {
namespace {

// A place of the way by grid.
struct Step {
    double along_m;
    double row;
    double column;
};

class Crossings {
  public:
    Crossings(const TrueSurface& surface, const Way& way)
        : surface_(surface), grid_(surface.field().grid), way_(way) {}

    [[nodiscard]] Step at(double along_m) const {
        const Geodetic place = way_(along_m);
        const PostNumber post = grid_.post_at(place.lat_deg, place.lon_deg);
        return {along_m, post.row, post.column};
    }
    // Cuts the way until it is all but straight in rows and columns.
    void walk(const Step& from, const Step& to, int depth);
    std::vector<double> take() {
        std::sort(found_.begin(), found_.end());
        return std::move(found_);
    }

  private:
    [[nodiscard]] bool outside(const std::array<Step, 3>& piece) const;
    // Where a parabola through the values at a piece's begin, middle and end is a whole number; takes each of
    // those places, of the share of the piece's way, that is_edge() says yes to.
    template <class IsEdge>
    void search(const std::array<Step, 3>& piece, const std::array<double, 3>& value, double lowest,
                double highest, const IsEdge& is_edge);
    [[nodiscard]] bool splits(const std::array<Step, 3>& piece, double share, Diagonal diagonal) const;

    const TrueSurface& surface_;
    const PostGrid& grid_;
    const Way& way_;
    std::vector<double> found_;
};

bool Crossings::outside(const std::array<Step, 3>& piece) const {
    const auto all = [&](auto&& is) { return std::all_of(piece.begin(), piece.end(), is); };
    const double last_row = grid_.rows() - 1, last_column = grid_.columns() - 1;
    return all([](const Step& s) { return s.row < -1.0; }) ||
           all([&](const Step& s) { return s.row > last_row + 1.0; }) ||
           all([](const Step& s) { return s.column < -1.0; }) ||
           all([&](const Step& s) { return s.column > last_column + 1.0; });
}

void Crossings::walk(const Step& from, const Step& to, int depth) {
    constexpr double straight_cells = 0.002;  // what is left of a parabola then is a hundredth of it
    constexpr int deepest = 24;               // where columns jump: over a pole, and behind the grid
    const Step middle = at(0.5 * (from.along_m + to.along_m));
    const std::array piece{from, middle, to};
    const bool straight = std::abs(middle.row - 0.5 * (from.row + to.row)) < straight_cells &&
                          std::abs(middle.column - 0.5 * (from.column + to.column)) < straight_cells;
    if (straight) {
        if (outside(piece)) return;
        const double last_row = grid_.rows() - 1, last_column = grid_.columns() - 1;
        const auto always = [](double) { return true; };
        search(piece, {from.row, middle.row, to.row}, 0.0, last_row, always);
        search(piece, {from.column, middle.column, to.column}, 0.0, last_column, always);
        search(piece, {from.row - from.column, middle.row - middle.column, to.row - to.column}, -last_column,
               last_row, [&](double share) { return splits(piece, share, Diagonal::nw_se); });
        search(piece, {from.row + from.column, middle.row + middle.column, to.row + to.column}, 0.0,
               last_row + last_column, [&](double share) { return splits(piece, share, Diagonal::sw_ne); });
        return;
    }
    if (depth == deepest) {
        found_.push_back(middle.along_m);
        return;
    }
    walk(from, middle, depth + 1);
    walk(middle, to, depth + 1);
}

// Whether the cell there is split so. On the rim of cells it does not matter: rows and columns are edges.
bool Crossings::splits(const std::array<Step, 3>& piece, double share, Diagonal diagonal) const {
    if (grid_.rows() < 2 || grid_.columns() < 2) return false;
    const auto at = [&](double a, double b, double c) {
        return a + share * (-3.0 * a + 4.0 * b - c + share * 2.0 * (a - 2.0 * b + c));
    };
    const double row = std::floor(at(piece[0].row, piece[1].row, piece[2].row));
    const double column = std::floor(at(piece[0].column, piece[1].column, piece[2].column));
    return surface_.diagonal_at(static_cast<int>(std::clamp(row, 0.0, grid_.rows() - 2.0)),
                                static_cast<int>(std::clamp(column, 0.0, grid_.columns() - 2.0))) == diagonal;
}

template <class IsEdge>
void Crossings::search(const std::array<Step, 3>& piece, const std::array<double, 3>& value, double lowest,
                       double highest, const IsEdge& is_edge) {
    const double square = 2.0 * (value[0] - 2.0 * value[1] + value[2]);
    const double slope = -3.0 * value[0] + 4.0 * value[1] - value[2];
    const double length_m = piece[2].along_m - piece[0].along_m;
    // The parabola leaves what its three values span by less than this.
    const double beyond = 0.25 * std::abs(square);
    const auto [low, high] = std::minmax_element(value.begin(), value.end());
    const double first = std::ceil(std::max(*low - beyond, lowest));
    const double last = std::floor(std::min(*high + beyond, highest));
    for (double number = first; number <= last; number += 1.0) {
        const double at_0 = value[0] - number;
        const double discriminant = slope * slope - 4.0 * square * at_0;
        if (discriminant < 0.0) continue;
        // Without loss. Source: W. H. Press et al., Numerical Recipes, 3rd ed. 2007, eq. 5.6.4.
        const double q = -0.5 * (slope + std::copysign(std::sqrt(discriminant), slope));
        for (const double share : {q != 0.0 ? at_0 / q : -1.0, square != 0.0 ? q / square : -1.0}) {
            if (share >= 0.0 && share <= 1.0 && is_edge(share))
                found_.push_back(piece[0].along_m + share * length_m);
        }
    }
}

// Adds those of one grid, in order.
void add_crossings(const TrueSurface& surface, const Way& way, double from_m, double to_m,
                   std::vector<double>& all) {
    Crossings crossings(surface, way);
    // So short that a way turns to one side only in it.
    constexpr double longest_m = 5000.0;
    const int pieces = std::max(1, static_cast<int>(std::ceil((to_m - from_m) / longest_m)));
    Step from = crossings.at(from_m);
    for (int i = 1; i <= pieces; ++i) {
        const Step to = crossings.at(i == pieces ? to_m : from_m + (to_m - from_m) * i / pieces);
        crossings.walk(from, to, 0);
        from = to;
    }
    std::ranges::copy(crossings.take(), std::back_inserter(all));
}

}  // namespace

std::vector<double> edge_crossings(const TrueGround& ground, const Way& way, double from_m, double to_m) {
    std::vector<double> all;
    for (std::size_t grid = 0; grid < ground.grids(); ++grid)
        add_crossings(ground.surface(grid), way, from_m, to_m, all);
    const auto grid_at = [&](double along_m) {
        const Geodetic place = way(along_m);
        return ground.grid_at(place.lat_deg, place.lon_deg);
    };
    std::vector<double> stops;
    for (const double along_m : all) {
        const double before_m = along_m - off_rim_m, after_m = along_m + off_rim_m;
        const bool at_rim = ground.grids() > 1 && before_m > from_m && after_m < to_m &&
                            grid_at(before_m) != grid_at(after_m);
        if (at_rim) {
            stops.push_back(before_m);
            stops.push_back(after_m);
        } else {
            stops.push_back(along_m);
        }
    }
    std::ranges::sort(stops);
    return stops;
}

}  // namespace oro
