// Which part of a grid each tile of a tileset covers.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace oro {

struct TileIndex {
    int row{}, column{}, level{};
    friend bool operator==(const TileIndex&, const TileIndex&) = default;
};

// Tiles of level 0 have so many quads between posts along each side; those of each level above twice as many
// as those below it, so that four refine one. The last level is one tile.
class TilesetLayout {
  public:
    static constexpr int usual_quads = 256;

    // rows, columns: of posts. quads: of a tile of level 0, a whole number of leaves (8).
    TilesetLayout(int rows, int columns, int quads = usual_quads)
        : rows_(std::max(1, rows - 1)), columns_(std::max(1, columns - 1)), quads_(quads) {
        while (this->rows(levels_ - 1) > 1 || this->columns(levels_ - 1) > 1) ++levels_;
    }
    [[nodiscard]] int levels() const { return levels_; }
    [[nodiscard]] int rows(int level) const { return tiles(rows_, level); }
    [[nodiscard]] int columns(int level) const { return tiles(columns_, level); }
    [[nodiscard]] std::size_t count(int level) const {
        return static_cast<std::size_t>(rows(level)) * static_cast<std::size_t>(columns(level));
    }
    [[nodiscard]] std::uint64_t all() const {
        std::uint64_t sum = 0;
        for (int level = 0; level < levels_; ++level) sum += count(level);
        return sum;
    }
    [[nodiscard]] std::size_t number(const TileIndex& tile) const {
        return static_cast<std::size_t>(tile.row) * static_cast<std::size_t>(columns(tile.level)) +
               static_cast<std::size_t>(tile.column);
    }
    [[nodiscard]] TileIndex tile(std::size_t number, int level) const {
        const auto across = static_cast<std::size_t>(columns(level));
        return {static_cast<int>(number / across), static_cast<int>(number % across), level};
    }
    // Posts on its four sides: the tile is what lies between them.
    struct Lines {
        int north, east, south, west;
    };
    [[nodiscard]] Lines lines(const TileIndex& tile) const {
        const auto end = [&](int number, int all) {
            return static_cast<int>(std::min<std::int64_t>(all, first_quad(number, tile.level)));
        };
        return {end(tile.row, rows_), end(tile.column + 1, columns_), end(tile.row + 1, rows_),
                end(tile.column, columns_)};
    }
    // The number of the tile that the quad after a line of posts is in.
    [[nodiscard]] int tile_of(int line, int level) const {
        return static_cast<int>(line / first_quad(1, level));
    }

  private:
    [[nodiscard]] std::int64_t first_quad(int number, int level) const {
        return static_cast<std::int64_t>(number) * quads_ << level;
    }
    [[nodiscard]] int tiles(int all, int level) const {
        return static_cast<int>((all + first_quad(1, level) - 1) / first_quad(1, level));
    }
    int rows_, columns_;  // of quads
    int quads_;
    int levels_{1};
};

}  // namespace oro
