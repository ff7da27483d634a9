// How far a window of a region has to reach beyond what it owns.
#pragma once

#include <cstdint>
#include <vector>

#include "core/cluster_windows/region_windows.h"

namespace oro {

// Along one side of the region. A group beside a window's end is not whole, and from level to level this
// reaches farther in, up to a line of that level's tiles. Lines are known beforehand, so how far it comes is,
// too, but for triangles that lie across a line: these are taken to reach a quarter of a tile's side beyond
// it.
class WindowMargins {
  public:
    enum class Along : std::uint8_t { rows, columns };
    WindowMargins(Along along, const WindowSizes& sizes);

    // The last post, a whole number of leaves, that a window may begin at whose own posts begin at `own`;
    // below 0 where none in the region is far enough.
    [[nodiscard]] int begin(int own) const;
    // The first post, likewise, that it may end at whose last own post is `own`.
    [[nodiscard]] int end(int own) const;
    // What the place needs that needs most.
    [[nodiscard]] int most() const;

  private:
    // Places grow from the window's end inwards; where that is northwards or westwards, they are negative.
    struct Tile {
        std::int64_t near{};
        std::int64_t far{};
        [[nodiscard]] std::int64_t side() const { return far - near; }
    };
    [[nodiscard]] Tile tile_at(int level, std::int64_t place, bool mirrored) const;
    [[nodiscard]] bool is_enough(std::int64_t first, std::int64_t own, bool mirrored) const;
    [[nodiscard]] std::int64_t nearest_enough(std::int64_t own, bool mirrored) const;

    Along along_;
    int above_;
    int levels_;
    std::vector<GroupTiling> tilings_;  // level 1 first
};

}  // namespace oro
