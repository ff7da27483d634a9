// Several grids in one tileset: one surface without holes or double ground whatever levels are drawn, each
// tile within its error. Against the true ground of the region.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

#include "core/truth/triangle_bvh.h"
#include "geo/tilesets/ground_tileset.h"
#include "geo/tilesets/region_tiles.h"
#include "geo/together/region_ground.h"
#include "tests/geo/tilesets/read_tileset.h"
#include "tests/geo/tilesets/tile_geometry.h"
#include "tests/support/rough_terrain.h"
#include "tests/support/test_data.h"
#include "tests/support/three_grids.h"

namespace oro {
namespace {
namespace fs = std::filesystem;

constexpr unsigned grids_seed = 20261129;

// A region's tileset, written and read back.
struct ExportedGrids {
    explicit ExportedGrids(Region made) : region(std::move(made)), folder(test::scratch_folder()) {
        auto tiles_of = RegionTiles::of(region, 2);
        EXPECT_TRUE(tiles_of.ok()) << tiles_of.error().line();
        auto truth = RegionGround::of(region, 1.0);
        EXPECT_TRUE(truth.ok()) << truth.error().line();
        if (!tiles_of.ok() || !truth.ok()) return;
        region_tiles = std::move(*tiles_of);
        ground = std::move(*truth);
        for (TilesetGrid& grid : region_tiles->ground.grids) grid.finest_error_m = 4.0;
        request.tile_quads = 64;
        request.threads = 2;
        request.most_between = 200;  // so that there are several beside each other
        auto done = write_tileset(folder, region_tiles->ground, request, {});
        EXPECT_TRUE(done.ok()) << done.error().line();
        if (!done.ok()) return;
        written = *done;
        tiles = test::read_tileset(folder, "ADD");
    }
    Region region;
    std::unique_ptr<RegionTiles> region_tiles;
    std::unique_ptr<const RegionGround> ground;
    TilesetRequest request;
    fs::path folder;
    TilesetWritten written;
    std::vector<test::ReadTile> tiles;
};

// What a viewer may draw: all between grids, and of each grid tiles of any levels beside each other.
struct DrawnTiles {
    explicit DrawnTiles(const ExportedGrids& exported, std::mt19937& random) {
        for (const int child : exported.tiles.front().children)
            test::random_cut(exported.tiles, child, random, numbers);
        std::vector<std::array<glm::dvec3, 3>> ground, all;
        std::vector<std::uint32_t> owners, owners_of_all;
        for (const int number : numbers) {
            const test::ReadTile& tile = exported.tiles[static_cast<std::size_t>(number)];
            for (std::size_t i = 0; i < tile.triangles.size(); ++i) {
                const auto& of = tile.triangles[i];
                const std::array corners{tile.posts_m[of[0]], tile.posts_m[of[1]], tile.posts_m[of[2]]};
                all.push_back(corners);
                owners_of_all.push_back(static_cast<std::uint32_t>(number));
                if (i >= tile.ground_triangles) continue;
                ground.push_back(corners);
                owners.push_back(static_cast<std::uint32_t>(number));
            }
        }
        const PostGrid& grid = exported.region.grids.front().field.grid;
        const glm::dmat3 enu = ecef_from_enu(0.5 * (grid.north_deg() + grid.south_deg()),
                                             0.5 * (grid.west_deg() + grid.east_deg()));
        bare.emplace(std::move(ground), enu, std::move(owners));
        walled.emplace(std::move(all), enu, std::move(owners_of_all));
    }
    std::vector<int> numbers;
    std::optional<TriangleBvh> bare, walled;  // without walls and steps, with them
};

constexpr double above_ground_m = 20000.0;

// How many grounds lie over each other there, and whose is the uppermost.
struct OverPlace {
    int grounds{};
    std::uint32_t owner{};
};
OverPlace over_place(const DrawnTiles& drawn, double lat_deg, double lon_deg) {
    OverPlace over;
    const glm::dvec3 up = ecef_from_enu(lat_deg, lon_deg)[2];
    glm::dvec3 from = ecef_from_geodetic({lat_deg, lon_deg, above_ground_m}).m;
    double left_m = 2.0 * above_ground_m;
    while (const auto hit = drawn.bare->first_hit(from, -up, left_m)) {
        if (over.grounds == 0) over.owner = hit->owner;
        ++over.grounds;
        // A line through a common side meets both.
        constexpr double apart_m = 0.02;
        from -= (hit->along_m + apart_m) * up;
        left_m -= hit->along_m + apart_m;
    }
    return over;
}

double distance_to_tile(const test::ReadTile& tile, const glm::dvec3& at_m) {
    double nearest_m = 1.0e9;
    for (std::size_t i = 0; i < tile.ground_triangles; ++i) {
        const auto& of = tile.triangles[i];
        nearest_m = std::min(nearest_m, test::distance_to(at_m, {tile.posts_m[of[0]], tile.posts_m[of[1]],
                                                                 tile.posts_m[of[2]]}));
    }
    return nearest_m;
}

struct GridsHeld {
    int places{}, between{}, above{}, above_tenth{}, odd{}, odd_around{};
    std::vector<int> of_grids;
};

// Rims of triangles of 18 km bend by some 7 m from those beside them: there a line from above may meet two
// grounds or none. So far from it, on one side, it meets one.
bool is_odd_around(const ExportedGrids& exported, const DrawnTiles& drawn, double lat_deg, double lon_deg) {
    int well = 0;
    constexpr double away_deg = 20.0 / 111000.0;
    constexpr int directions = 16;
    for (int i = 0; i < directions; ++i) {
        const double turn = 2.0 * std::numbers::pi * i / directions;
        const double lat = lat_deg + away_deg * std::sin(turn),
                     lon = lon_deg + 1.4 * away_deg * std::cos(turn);
        const bool is_there = exported.ground->ground().h_m(lat, lon).has_value();
        well += over_place(drawn, lat, lon).grounds == (is_there ? 1 : 0) ? 1 : 0;
    }
    return well < directions / 4;
}

GridsHeld hold_grids(const ExportedGrids& exported, int cuts, int places) {
    std::printf("seed %u\n", grids_seed);
    std::mt19937 random(grids_seed);
    const PostGrid& grid = exported.region.grids.front().field.grid;
    std::uniform_real_distribution<double> lats(grid.south_deg() - 0.002, grid.north_deg() + 0.002),
        lons(grid.west_deg() - 0.002, grid.east_deg() + 0.002);
    GridsHeld held;
    held.of_grids.resize(exported.region.grids.size());
    for (int i = 0; i < cuts; ++i) {
        const DrawnTiles drawn(exported, random);
        for (int j = 0; j < places / cuts; ++j) {
            const double lat_deg = lats(random), lon_deg = lons(random);
            const auto h_m = exported.ground->ground().h_m(lat_deg, lon_deg);
            const OverPlace over = over_place(drawn, lat_deg, lon_deg);
            if (over.grounds != (h_m ? 1 : 0)) {
                ++held.odd;
                held.odd_around += is_odd_around(exported, drawn, lat_deg, lon_deg) ? 1 : 0;
                continue;
            }
            if (!h_m) continue;
            ++held.places;
            ++held.of_grids[exported.ground->ground().grid_at(lat_deg, lon_deg).value_or(0)];
            const test::ReadTile& tile = exported.tiles[over.owner];
            held.between += tile.uri.starts_with("between/") ? 1 : 0;
            const double off_m = distance_to_tile(tile, ecef_from_geodetic({lat_deg, lon_deg, *h_m}).m);
            held.above += off_m > tile.error_m ? 1 : 0;
            held.above_tenth += off_m > 0.1 * tile.error_m ? 1 : 0;
        }
    }
    std::printf(
        "%d places, %d of them between grids; %d above the error, %d above a tenth of it; %d odd, %d "
        "of them around\n",
        held.places, held.between, held.above, held.above_tenth, held.odd, held.odd_around);
    return held;
}

// Whether a line to a place comes from above all ground on its way.
bool is_from_above(const ExportedGrids& exported, const glm::dvec3& place_m, const glm::dvec3& up) {
    constexpr double step_m = 40.0, reach_m = 15000.0, rim_m = 400.0;
    for (double along_m = step_m; along_m < reach_m; along_m += step_m) {
        const Geodetic there = geodetic_from_ecef({place_m + along_m * up});
        const auto h_m = exported.ground->ground().h_m(there.lat_deg, there.lon_deg);
        if (!h_m) {
            // Over a hole or beyond the data: high enough above what lies around.
            const Geodetic place = geodetic_from_ecef({place_m});
            return there.h_m > place.h_m + rim_m;
        }
        if (there.h_m < *h_m) return false;
    }
    return true;
}

struct GridsGaps {
    int lines{}, without_walls{}, with_walls{};
};

// Lines that come from above to the rims between grids.
GridsGaps gaps_between_grids(const ExportedGrids& exported, int cuts, int lines) {
    std::mt19937 random(grids_seed);
    std::uniform_real_distribution<double> share;
    GridsGaps gaps;
    for (int i = 0; i < cuts; ++i) {
        const DrawnTiles drawn(exported, random);
        for (int j = 0; j < lines; ++j) {
            const auto& between = exported.region_tiles->ground.between;
            const Seam& seam = between[random() % between.size()].seam;
            if (seam.skirts.empty()) continue;
            const SeamSkirt& skirt = seam.skirts[random() % seam.skirts.size()];
            const double along = share(random), upwards = share(random);
            const glm::dvec3 top = glm::mix(skirt.top[0].at.m, skirt.top[1].at.m, along),
                             foot = glm::mix(skirt.foot[0].at.m, skirt.foot[1].at.m, along);
            constexpr double hair_m = 0.02;
            const glm::dvec3 at_m =
                glm::mix(foot, top, upwards) + hair_m * (share(random) - 0.5) * skirt.side;
            const Geodetic at = geodetic_from_ecef({at_m});
            if (!exported.ground->ground().h_m(at.lat_deg, at.lon_deg)) continue;
            const double turn = 2.0 * std::numbers::pi * share(random), rise = 0.3 + 1.27 * share(random);
            const glm::dvec3 up =
                ecef_from_enu(at.lat_deg, at.lon_deg) *
                glm::dvec3(std::cos(turn) * std::cos(rise), std::sin(turn) * std::cos(rise), std::sin(rise));
            const glm::dvec3 from = at_m + above_ground_m * up;
            if (!is_from_above(exported, at_m, up)) continue;
            ++gaps.lines;
            if (drawn.bare->first_hit(from, -up, 1.2 * above_ground_m)) continue;
            ++gaps.without_walls;
            gaps.with_walls += drawn.walled->first_hit(from, -up, 1.2 * above_ground_m) ? 0 : 1;
        }
    }
    std::printf("%d lines, %d through gaps, %d without walls and steps\n", gaps.lines, gaps.with_walls,
                gaps.without_walls);
    return gaps;
}

// strip: between grids that only meet in a line there is no ground, but steps alone.
void expect_one_ground(const ExportedGrids& exported, int cuts, int places, int lines, bool strip = true) {
    ASSERT_FALSE(exported.tiles.empty());
    const GridsHeld held = hold_grids(exported, cuts, places);
    EXPECT_EQ(held.above, 0);
    EXPECT_GT(held.above_tenth, 0);
    EXPECT_EQ(held.between > 0, strip);
    EXPECT_EQ(held.odd_around, 0);
    EXPECT_LT(held.odd, places / 100);
    for (const int of_grid : held.of_grids) EXPECT_GT(of_grid, 0);
    const GridsGaps gaps = gaps_between_grids(exported, cuts, lines);
    EXPECT_EQ(gaps.with_walls, 0);
    EXPECT_GT(gaps.without_walls, 0);
    EXPECT_GT(gaps.lines, lines / 4);
}

// A grid on degrees; over it one turned, with holes and a step; over both a finer one.
TEST(GridsTileset, ThreeThatLieOverEachOtherAreOneGround) {
    const ExportedGrids exported(test::three_grids(200));
    expect_one_ground(exported, 8, 106000, 3000);
}

// 3" beside 1", with one line of posts in common.
TEST(GridsTileset, TwoThatMeetInALineAreOneGround) {
    Region region{std::vector<RegionGrid>(2)};
    region.grids[0].field = test::rough_field(47.0, 8.0, 131, 131);
    region.grids[0].rank = 1;
    region.grids[1].field = test::made_field(47.0, 8.0 + 130.0 / 1200.0, 3600.0, 391, 241, test::rough_H_m);
    region.grids[1].rank = 0;
    const ExportedGrids exported(std::move(region));
    expect_one_ground(exported, 4, 20000, 2000, false);
}

// 1" whose rim is a part of the posts' lines of the 3" around it.
TEST(GridsTileset, AFinerOneOnTheLinesOfTheOtherIsOneGround) {
    Region region{std::vector<RegionGrid>(2)};
    region.grids[0].field = test::rough_field(47.0, 8.0, 131, 131);
    region.grids[0].rank = 1;
    region.grids[1].field =
        test::made_field(47.0 - 30.0 / 1200.0, 8.0 + 40.0 / 1200.0, 3600.0, 181, 151, test::rough_H_m);
    region.grids[1].rank = 0;
    const ExportedGrids exported(std::move(region));
    expect_one_ground(exported, 4, 20000, 2000);
}

// Parts by themselves, and then all of them: the bytes of one go.
TEST(GridsTileset, OfPartsHasTheBytesOfOneGo) {
    const ExportedGrids one(test::three_grids(100));
    ASSERT_FALSE(one.tiles.empty());
    const fs::path scratch = test::scratch_folder();
    const auto kept = KeptTiles::open(scratch / "kept", "key");
    ASSERT_TRUE(kept.ok());
    TilesetRequest request = one.request;
    request.kept = &*kept;
    request.parts = 2;
    for (const int part : {1, 0}) {
        request.part = part;
        ASSERT_TRUE(make_tiles(one.region_tiles->ground, request, {}).ok());
    }
    request.part = 0;
    request.parts = 1;
    fs::create_directory(scratch / "joined");
    for (TilesetGrid& grid : one.region_tiles->ground.grids)
        grid.ground = []() -> Result<std::unique_ptr<ClusteredGround>> {
            return Error{ErrorKind::failed, "ground", "is asked for though all tiles are kept"};
        };
    const auto done = write_tileset(scratch / "joined", one.region_tiles->ground, request, {});
    ASSERT_TRUE(done.ok()) << done.error().line();
    std::size_t files = 0;
    for (const auto& entry : fs::recursive_directory_iterator(one.folder)) {
        if (!entry.is_regular_file()) continue;
        ++files;
        EXPECT_TRUE(test::all_bytes(entry.path()) ==
                    test::all_bytes(scratch / "joined" / fs::relative(entry.path(), one.folder)));
    }
    EXPECT_GT(files, 10U);
}

}  // namespace
}  // namespace oro
