#include "geo/together/rim_diagonals.h"

#include <algorithm>
#include <cmath>

#include "core/terrain/cell_diagonal.h"

namespace oro {
namespace {

// The posts that are cut out around a cell, by its north-west post.
struct MaskedPosts {
    int around{};  // of its 4 x 4
    int own{};     // of its own four
};

class CutPosts {
  public:
    CutPosts(const PostGrid& grid, const std::vector<char>& masked) : grid_(grid), masked_(masked) {}
    [[nodiscard]] bool at(int row, int column) const {
        if (row < 0 || row >= grid_.rows() || column < 0 || column >= grid_.columns()) return false;
        return masked_[static_cast<std::size_t>(row) * static_cast<std::size_t>(grid_.columns()) +
                       static_cast<std::size_t>(column)] != 0;
    }
    [[nodiscard]] bool any_in(int row) const {
        const auto begin = masked_.begin() + std::int64_t{row} * grid_.columns();
        return std::find(begin, begin + grid_.columns(), char{1}) != begin + grid_.columns();
    }
    [[nodiscard]] MaskedPosts around(int row, int column) const {
        MaskedPosts count;
        for (int r = -1; r <= 2; ++r) {
            for (int c = -1; c <= 2; ++c) {
                if (!at(row + r, column + c)) continue;
                ++count.around;
                if (r >= 0 && r <= 1 && c >= 0 && c <= 1) ++count.own;
            }
        }
        return count;
    }

  private:
    const PostGrid& grid_;
    const std::vector<char>& masked_;
};

// How far the middle of a cell is from one diagonal to the other; nothing where a post has no height.
std::optional<double> diagonals_apart_m(const HeightField& field, int row, int column) {
    const float north_west = field.H_at_post_m(row, column), north_east = field.H_at_post_m(row, column + 1),
                south_west = field.H_at_post_m(row + 1, column),
                south_east = field.H_at_post_m(row + 1, column + 1);
    for (const float H_m : {north_west, north_east, south_west, south_east})
        if (is_void(H_m)) return std::nullopt;
    return 0.5 * std::abs(static_cast<double>(north_west) + south_east - north_east - south_west);
}

}  // namespace

std::optional<RimDiagonals> rim_diagonals(const HeightField& field, const GridClip& cut) {
    const PostGrid& grid = field.grid;
    if (cut.masked_posts.empty()) return std::nullopt;
    const CutPosts masked(grid, cut.masked_posts);
    std::vector<char> rows(static_cast<std::size_t>(grid.rows()) + 3);
    for (int row = 0; row < grid.rows(); ++row)
        rows[static_cast<std::size_t>(row) + 1] = masked.any_in(row) ? 1 : 0;
    RimDiagonals found;
    for (int row = 0; row + 1 < grid.rows(); ++row) {
        const auto first = rows.begin() + row;
        if (std::find(first, first + 4, char{1}) == first + 4) continue;
        for (int column = 0; column + 1 < grid.columns(); ++column) {
            const MaskedPosts count = masked.around(row, column);
            if (count.around == 0 || count.own == 4) continue;
            if (cell_diagonal(field, row, column) == Diagonal::nw_se) continue;
            const auto apart_m = diagonals_apart_m(field, row, column);
            if (!apart_m) continue;
            ++found.cells;
            if (*apart_m <= found.most_m) continue;
            found.most_m = *apart_m;
            found.place = grid.place_at(row + 0.5, column + 0.5);
        }
    }
    if (found.cells == 0) return std::nullopt;
    return found;
}

}  // namespace oro
