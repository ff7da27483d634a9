#include "geo/tilesets/tile_maker.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/parallel.h"
#include "geo/tilesets/ground_mesh.h"
#include "geo/tilesets/level_cut.h"

namespace oro {
namespace {

// What a level aims at.
struct LevelAim {
    double cut_m{};   // error of the cut of clusters
    double step_m{};  // that positions are rounded to
};

// Errors grow from level to level by this while a tile's sides are doubled: so tiles of all levels have some
// as many triangles.
constexpr double error_growth = 3.0;
// Of positions with 16 bits, and with those of float, a sign among them.
constexpr double steps_of_short = 65000.0, steps_of_float = 0x1.0p23;

// The step is a sixteenth of the error, or somewhat more where positions then have 16 bits.
LevelAim aim_of(const ClusteredGround& ground, const TilesetLayout& layout, int level,
                double finest_error_m) {
    constexpr double usual_share = 1.0 / 16.0, most_share = 1.0 / 8.0;
    constexpr double finest_m = 0x1.0p-11, coarsest_of_posts_m = 0x1.0p-4, share_of_posts = 0x1.0p-10;
    const PostGrid& grid = ground.grid();
    const double spacing_m = largest_spacing_m(grid);
    const double error_m =
        level == 0 ? finest_error_m
                   : std::max(finest_error_m, usual_finest_error_m(grid)) * std::pow(error_growth, level);
    const TilesetLayout::Lines first = layout.lines({0, 0, level});
    const double size_m =
        std::min(3.0 * wgs84_a_m, spacing_m * std::hypot(first.south - first.north, first.east - first.west));
    LevelAim aim;
    aim.step_m =
        std::max({finest_m, usual_share * error_m, std::min(coarsest_of_posts_m, share_of_posts * spacing_m),
                  size_m / steps_of_float});
    const double short_m = size_m / steps_of_short;
    if (short_m <= most_share * error_m) aim.step_m = std::max(aim.step_m, short_m);
    const double rise_m = ground.highest_h_m() - ground.lowest_h_m() + 2.0 * error_m;
    aim.cut_m = std::max(
        0.0, error_m - TileBounds::added_m(grid, ground.highest_h_m() + error_m, rise_m, aim.step_m));
    return aim;
}

}  // namespace

double largest_spacing_m(const PostGrid& grid) {
    return wgs84_a_m * std::max(grid.row_step_rad(), grid.column_step_rad());
}

TileMaker::TileMaker(const TilesetGrid& grid, const TilesetRequest& request)
    : grid_(grid), request_(request), layout_(grid.posts->rows(), grid.posts->columns(), request.tile_quads) {
    if (request.kept != nullptr) kept_ = request.kept->of(grid.name);
}

bool TileMaker::all_kept() const {
    if (!kept_) return false;
    for (int level = 0; level < layout_.levels(); ++level)
        for (std::size_t number = 0; number < layout_.count(level); ++number)
            if (is_own(number) && !kept_->has(layout_.tile(number, level))) return false;
    return true;
}

Result<void> TileMaker::begin() {
    ORO_TRY(ground_, grid_.ground());
    cuts_.resize(static_cast<std::size_t>(layout_.levels()));
    in_parallel(layout_.levels(), request_.threads, [&](int level) {
        const LevelAim aim = aim_of(*ground_, layout_, level, grid_.finest_error_m);
        cuts_[static_cast<std::size_t>(level)] = level_cut(*ground_, layout_, level, aim.cut_m, aim.step_m);
    });
    bounds_ = TileBounds::of(*ground_, layout_, cuts_);
    return {};
}

void TileMaker::begin_level(int level) {
    if (!ground_) return;
    const LevelCut& cut = cuts_[static_cast<std::size_t>(level)];
    rims_ = CutRims::of(*ground_, cut, grid_.beside);
    if (request_.normals) normals_ = normals_of(*ground_, cut);
}

Result<KeptTile> TileMaker::made(const TileIndex& tile) const {
    KeptTile made;
    if (!bounds_->drawn(tile)) return made;
    const TileWalls walls = bounds_->walls(tile, others_ ? &*others_ : nullptr);
    const GroundMesh mesh = ground_mesh(*ground_, layout_, cuts_[static_cast<std::size_t>(tile.level)], rims_,
                                        tile, walls, normals_);
    VertexFacts facts;
    if (grid_.facts) {
        ORO_TRY(facts, grid_.facts(tile.level, mesh.places));
    }
    GlbLook look = request_.look;
    look.sources = grid_.sources;
    made = {true, mesh.ground_triangles, bounds_->error_m(tile), mesh.box, glb_bytes(mesh, facts, look)};
    return made;
}

Result<KeptTile> TileMaker::tile(const TileIndex& tile) const {
    return kept_or_made(kept_ ? &*kept_ : nullptr, tile, [&] { return made(tile); });
}

}  // namespace oro
