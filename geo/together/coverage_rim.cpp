#include "geo/together/coverage_rim.h"

#include <cstddef>

namespace oro {
namespace {

// The two triangles of a cell, that of its south-west post and that of its north-east post: whether they are
// there.
struct CellGround {
    bool south_west{};
    bool north_east{};
};

class Posts {
  public:
    explicit Posts(const HeightField& field) : field_(field) {}
    // Which posts of a row have a height.
    [[nodiscard]] std::vector<char> row(int row) const {
        std::vector<char> there(static_cast<std::size_t>(field_.grid.columns()));
        for (int column = 0; column < field_.grid.columns(); ++column)
            there[static_cast<std::size_t>(column)] = is_void(field_.H_at_post_m(row, column)) ? 0 : 1;
        return there;
    }

  private:
    const HeightField& field_;
};

CellGround cell_ground(const std::vector<char>& north, const std::vector<char>& south, std::size_t column) {
    const bool diagonal = north[column] != 0 && south[column + 1] != 0;
    return {diagonal && south[column] != 0, diagonal && north[column + 1] != 0};
}

}  // namespace

std::vector<RimEdge> coverage_rim(const HeightField& field) {
    std::vector<RimEdge> rim;
    const int rows = field.grid.rows(), columns = field.grid.columns();
    if (rows < 2 || columns < 2) return rim;
    const Posts posts(field);
    const auto cells = static_cast<std::size_t>(columns) - 1;
    std::vector<CellGround> above(cells), here(cells);
    std::vector<char> north = posts.row(0);
    for (int row = 0; row < rows; ++row) {
        const bool last = row + 1 == rows;
        std::vector<char> south = last ? std::vector<char>() : posts.row(row + 1);
        for (std::size_t i = 0; i < cells; ++i) {
            here[i] = last ? CellGround{} : cell_ground(north, south, i);
            const int column = static_cast<int>(i);
            if (above[i].south_west != here[i].north_east) rim.push_back({{row, column}, {row, column + 1}});
            if (here[i].south_west != here[i].north_east)
                rim.push_back({{row, column}, {row + 1, column + 1}});
        }
        const bool round = field.grid.wraps_longitude();
        for (std::size_t i = 0; !last && i <= cells; ++i) {
            const bool east_of = i < cells ? here[i].south_west : round && here[0].south_west;
            const bool west_of = i > 0 ? here[i - 1].north_east : round && here[cells - 1].north_east;
            if (round && i == cells) break;
            const int column = static_cast<int>(i);
            if (east_of != west_of) rim.push_back({{row, column}, {row + 1, column}});
        }
        above.swap(here);
        north.swap(south);
    }
    return rim;
}

}  // namespace oro
