// Made ground for tests of its pages: 2,048 posts a side, 3 seconds apart, at 46 N, 8 E; N is 0.
#pragma once

#include "core/made_pages/made_pages.h"

namespace oro {

// Levels 1 to 3 are measured against all posts, 4 to 6 against coarse octaves at every fourth.
inline MadeTerrain made_terrain_of_tests(MadeKind kind = MadeKind::fbm) {
    MadeTerrain terrain;
    terrain.kind = kind;
    terrain.seed = 3;
    terrain.octaves = 10;
    terrain.low = -200 * 2048;
    terrain.high = 4000 * 2048;
    terrain.posts_per_deg = 1200;
    terrain.west = 8 * 1200;
    terrain.east = terrain.west + 2047;
    terrain.south = 46 * 1200;
    terrain.north = terrain.south + 2047;
    return terrain;
}

inline PostGrid grid_of(const MadeTerrain& terrain) {
    PostGrid grid;
    const auto per_deg = static_cast<double>(terrain.posts_per_deg);
    grid.lat = {per_deg, 0.0, terrain.north, -1, terrain.rows()};
    grid.lon = {per_deg, 0.0, terrain.west, 1, terrain.columns()};
    return grid;
}

inline HeightField made_ground(MadeKind kind = MadeKind::fbm) {
    const MadeTerrain terrain = made_terrain_of_tests(kind);
    return made_field(terrain, grid_of(terrain), {});
}

// What is measured whole takes longest, and is the same for all tests.
inline const RegionPages& pages_for_any() {
    static const HeightField field = made_ground();
    static const std::unique_ptr<RegionPages> any = made_posts_of(field)->pages(field);
    return *any;
}
inline const RegionPages& ridged_pages_for_any() {
    static const HeightField field = made_ground(MadeKind::ridged);
    static const std::unique_ptr<RegionPages> any = made_posts_of(field)->pages(field);
    return *any;
}

}  // namespace oro
