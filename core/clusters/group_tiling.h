// Where one group of a level ends and the next begins: lines in the plane, other ones for each level.
#pragma once

#include <compare>
#include <cstdint>
#include <limits>

#include "core/surface/surface_vertex.h"

namespace oro {

// Units of the plane along a side of a leaf, and of a group of level 1: 3 x 3 leaves of a grid.
inline constexpr int leaf_side = 8;
inline constexpr int first_group_side = 3 * leaf_side;

// One of the rectangles that a level's lines cut the plane into.
struct GroupTile {
    std::int64_t row{};
    std::int64_t column{};
    friend auto operator<=>(const GroupTile&, const GroupTile&) = default;
};

// Places, both ends included.
struct PlaneBox {
    std::int64_t first_row{};
    std::int64_t last_row{};
    std::int64_t first_column{};
    std::int64_t last_column{};

    [[nodiscard]] bool meets(const PlaneBox& other) const {
        return first_row <= other.last_row && other.first_row <= last_row &&
               first_column <= other.last_column && other.first_column <= last_column;
    }
};

// The longest edges that may be made, along each axis, in units of the plane.
struct EdgeLimit {
    std::int64_t rows{std::numeric_limits<std::int64_t>::max()};
    std::int64_t columns{std::numeric_limits<std::int64_t>::max()};
};

// Lines of one level, the same for any part of the plane that is built: what becomes of a place depends on
// what is around it alone. Lines of a level keep away from those of the two levels before. So what is locked
// on a line is free on the next level, but near the points where lines of two levels cross; and there it is
// free on the level after that (see group_assignment.h).
class GroupTiling {
  public:
    // level: 1 .. 80. kept_share: of a group's triangles, in what comes out of it. So that groups have as
    // many triangles on each level, tiles grow by that share, in whole doublings of one side or the other.
    GroupTiling(int level, double kept_share);

    // The tile of a triangle's middle.
    [[nodiscard]] GroupTile tile_of(const SurfaceVertex& a, const SurfaceVertex& b,
                                    const SurfaceVertex& c) const {
        return {row_.of(std::int64_t{a.row} + b.row + c.row),
                column_.of(std::int64_t{a.column} + b.column + c.column)};
    }
    [[nodiscard]] GroupTile tile_of(const SurfaceVertex& a) const { return tile_of(a, a, a); }
    [[nodiscard]] PlaneBox box_of(const GroupTile& tile) const;
    // A tile, and a quarter of its side around it.
    [[nodiscard]] PlaneBox widened(const GroupTile& tile) const;

    // A quarter of a tile's sides. Were edges as long as tiles, a group of flat ground would keep no vertex
    // but those on its border; the next level's borders could run along these alone, and all of them would
    // have to stay twice.
    [[nodiscard]] EdgeLimit longest_edges() const { return {row_.period / 4, column_.period / 4}; }

  private:
    struct Lines {
        std::int64_t period{};
        std::int64_t shift{};
        // By three times a place.
        [[nodiscard]] std::int64_t of(std::int64_t three_places) const {
            const std::int64_t from_line = three_places - 3 * shift;
            const std::int64_t by = 3 * period;
            return from_line >= 0 ? from_line / by : -((by - 1 - from_line) / by);
        }
        [[nodiscard]] std::int64_t distance(std::int64_t place) const;
    };
    static Lines lines_of(int level, double kept_share, int first_doubled);

    Lines row_;
    Lines column_;
};

}  // namespace oro
