#include "core/cluster_windows/window_margins.h"

#include <algorithm>

namespace oro {
namespace {

// How far triangles lie across a line of a level.
std::int64_t across(std::int64_t side) {
    return side / 4;
}

}  // namespace

WindowMargins::WindowMargins(Along along, const WindowSizes& sizes)
    : along_(along), above_(sizes.above), levels_(sizes.levels) {
    for (int level = 1; level <= sizes.levels; ++level) tilings_.emplace_back(level, sizes.kept_share);
}

WindowMargins::Tile WindowMargins::tile_at(int level, std::int64_t place, bool mirrored) const {
    // A place on a line belongs to the tile that is farther in.
    const auto at = static_cast<std::int32_t>(mirrored ? -place - 1 : place);
    const bool rows = along_ == Along::rows;
    const GroupTiling& tiling = tilings_[static_cast<std::size_t>(level - 1)];
    const PlaneBox box =
        tiling.box_of(tiling.tile_of(rows ? SurfaceVertex{at, 0, 0} : SurfaceVertex{0, at, 0}));
    const std::int64_t first = rows ? box.first_row : box.first_column;
    const std::int64_t last = rows ? box.last_row : box.last_column;
    return mirrored ? Tile{-last, -first} : Tile{first, last};
}

// Follows what is not whole and what is needed from level to level: a group that the window answers for, and
// all that use what it made.
bool WindowMargins::is_enough(std::int64_t first, std::int64_t own, bool mirrored) const {
    const auto first_owned = [&](int level) {
        const Tile tile = tile_at(level, own, mirrored);
        return tile.near + tile.far >= 2 * own ? tile : tile_at(level, tile.far, mirrored);
    };
    // Not whole up to here, and in need from here on.
    std::int64_t reached = first, needed = own;
    if (above_ > 0) {
        const Tile begun = tile_at(above_, first, mirrored);
        reached = tile_at(above_, first + across(begun.side()), mirrored).far + across(begun.side());
        needed = first_owned(above_).near - across(begun.side());
    }
    for (int level = above_ + 1; level <= levels_; ++level) {
        const Tile owned = first_owned(level);
        const std::int64_t quarter = level == 1 ? 0 : owned.side() / 4;
        const Tile user = tile_at(level, needed, mirrored);
        if (std::min(owned.near, user.near) - quarter <= reached) return false;
        reached = tile_at(level, reached + quarter, mirrored).far + across(owned.side());
        needed = owned.near - across(owned.side());
    }
    return true;
}

std::int64_t WindowMargins::nearest_enough(std::int64_t own, bool mirrored) const {
    std::int64_t first = own - (own % leaf_side + leaf_side) % leaf_side;
    while (!is_enough(first, own, mirrored)) first -= leaf_side;
    return first;
}

int WindowMargins::begin(int own) const {
    return static_cast<int>(nearest_enough(own, false));
}

int WindowMargins::end(int own) const {
    return static_cast<int>(-nearest_enough(-std::int64_t{own}, true));
}

// Lines come again after the widest tile.
int WindowMargins::most() const {
    int most = leaf_side;
    for (int own = 0; own < tile_at(levels_, 0, false).side(); own += leaf_side)
        most = std::max({most, own - begin(own), end(own - 1) - own + 1});
    return most;
}

}  // namespace oro
