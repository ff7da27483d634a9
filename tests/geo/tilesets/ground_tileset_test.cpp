// 3D Tiles against the surface: their files are read by the specifications, and each tile's error is held
// against brute force.
#include "geo/tilesets/ground_tileset.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <random>

#include "core/truth/triangle_bvh.h"
#include "core/truth/true_surface.h"
#include "tests/geo/tilesets/held_triangles.h"
#include "tests/geo/tilesets/read_tileset.h"
#include "tests/geo/tilesets/tile_geometry.h"
#include "tests/support/net_terrain.h"
#include "tests/support/rough_terrain.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {
namespace fs = std::filesystem;
using test::ReadTile;

constexpr unsigned tiles_seed = 20261128;

TilesetGrid grid_of(const HeightField& field, double finest_error_m, int threads) {
    TilesetGrid grid;
    grid.posts = &field.grid;
    grid.ground = [&field, threads] { return ClusteredGround::of(field, nullptr, threads); };
    grid.finest_error_m = finest_error_m;
    return grid;
}

// A field's tileset, written and read back.
struct Exported {
    explicit Exported(HeightField made, double finest_error_m = 5.0, int threads = 2)
        : field(std::move(made)), surface(field, 1.0, 2), folder(test::scratch_folder()) {
        TilesetRequest request;
        request.tile_quads = 64;
        request.look = {{0.5, 0.4, 0.3}, {}, "nobody", "test"};
        TilesetGrid grid = grid_of(field, finest_error_m, threads);
        grid.sources = {{"a.hgt", "nobody", "EGM96", 92.5, 16.0}, {"b.tif", "", "", 1.0, -1.0}};
        // West and east, of different colours.
        grid.facts = [](int, std::span<const VertexPlace> places) {
            VertexFacts facts;
            for (const VertexPlace& place : places) {
                const bool east = place.column >= 100.0;
                facts.sources.push_back(east ? 1 : 0);
                facts.colours.push_back({east ? 1.0 : 0.25, 0.5, 0.0});
            }
            return Result<VertexFacts>(facts);
        };
        request.metadata = {{"heights", "made \"up\""}};
        request.threads = threads;
        auto done = write_tileset(folder, {{std::move(grid)}, {}}, request, {});
        EXPECT_TRUE(done.ok()) << done.error().line();
        if (!done.ok()) return;
        written = done.value();
        tiles = test::read_tileset(folder);
    }
    HeightField field;
    TrueSurface surface;
    fs::path folder;
    TilesetWritten written;
    std::vector<ReadTile> tiles;
};

// The ground triangles of a tile by where their corners lie on the map.
class TileInPosts {
  public:
    TileInPosts(const ReadTile& tile, const PostGrid& grid) : tile_(&tile) {
        for (const glm::dvec3& post : tile.posts_m) {
            const Geodetic at = geodetic_from_ecef({post});
            posts_.push_back(grid.post_at(at.lat_deg, at.lon_deg));
        }
        for (std::size_t i = 0; i < tile.ground_triangles; ++i) {
            const auto& corners = tile.triangles[i];
            for (const std::uint32_t corner : corners) {
                first_row_ = std::min(first_row_, posts_[corner].row);
                last_row_ = std::max(last_row_, posts_[corner].row);
                first_column_ = std::min(first_column_, posts_[corner].column);
                last_column_ = std::max(last_column_, posts_[corner].column);
            }
            const auto [north, south] =
                std::minmax({posts_[corners[0]].row, posts_[corners[1]].row, posts_[corners[2]].row});
            const auto [west, east] = std::minmax(
                {posts_[corners[0]].column, posts_[corners[1]].column, posts_[corners[2]].column});
            for (int row = cell(north - 1.0); row <= cell(south + 1.0); ++row)
                for (int column = cell(west - 1.0); column <= cell(east + 1.0); ++column)
                    cells_[{row, column}].push_back(i);
        }
    }
    // A place that the tile may have ground at: row and column.
    PostNumber random_place(std::mt19937& random) const {
        std::uniform_real_distribution<double> share;
        return {first_row_ + share(random) * (last_row_ - first_row_),
                first_column_ + share(random) * (last_column_ - first_column_)};
    }
    // Whether a place is farther than that from the tile's edges.
    [[nodiscard]] bool within(const PostNumber& place, double margin) const {
        return place.row > first_row_ + margin && place.row < last_row_ - margin &&
               place.column > first_column_ + margin && place.column < last_column_ - margin;
    }
    // Whether a triangle lies over a place; over all of a square of some metres around it (margin > 0), or
    // over a part of it (< 0).
    [[nodiscard]] bool covers(const PostNumber& place, double margin) const {
        const auto cell_there = cells_.find({cell(place.row), cell(place.column)});
        if (cell_there == cells_.end()) return false;
        return std::ranges::any_of(cell_there->second, [&](std::size_t number) {
            const auto& of = tile_->triangles[number];
            // Seen from above: anticlockwise, with rows that run south.
            for (std::size_t i = 0; i < 3; ++i) {
                const PostNumber &a = posts_[of[i]], &b = posts_[of[(i + 1) % 3]];
                const double left =
                    (b.column - a.column) * (a.row - place.row) - (a.row - b.row) * (place.column - a.column);
                const double length = std::hypot(b.column - a.column, b.row - a.row);
                if (left < margin * length) return false;
            }
            return true;
        });
    }
    // How far a place in space over `place` is from the nearest triangle there.
    [[nodiscard]] double distance_m(const PostNumber& place, const glm::dvec3& at_m) const {
        double nearest_m = 1.0e9;
        const auto cell_there = cells_.find({cell(place.row), cell(place.column)});
        if (cell_there == cells_.end()) return nearest_m;
        for (const std::size_t number : cell_there->second) {
            const auto& of = tile_->triangles[number];
            nearest_m = std::min(
                nearest_m, test::distance_to(
                               at_m, {tile_->posts_m[of[0]], tile_->posts_m[of[1]], tile_->posts_m[of[2]]}));
        }
        return nearest_m;
    }

  private:
    static int cell(double post) { return static_cast<int>(std::floor(post / 4.0)); }
    const ReadTile* tile_;
    std::vector<PostNumber> posts_;
    std::map<std::pair<int, int>, std::vector<std::size_t>> cells_;
    double first_row_{1.0e9}, last_row_{-1.0e9}, first_column_{1.0e9}, last_column_{-1.0e9};
};

glm::dvec3 surface_point(const PostGrid& grid, const PostNumber& place, double h_m) {
    const PostPlace at = grid.place_at(place.row, place.column);
    return ecef_from_geodetic({at.lat_deg, at.lon_deg, h_m}).m;
}

struct HeldToErrors {
    int places{}, above{}, above_halved{}, uncovered{};
    double closest{};  // of a distance to its tile's error
};

// Each distance in space between the surface and a tile at one row and column against the tile's error, and
// against half of it: a test that finds nothing above a wrong error would be none.
HeldToErrors held_to_errors(const Exported& exported, int places) {
    std::printf("seed %u\n", tiles_seed);
    std::mt19937 random(tiles_seed);
    std::vector<const ReadTile*> with_content;
    for (const ReadTile& tile : exported.tiles)
        if (!tile.uri.empty()) with_content.push_back(&tile);
    HeldToErrors held;
    const int of_each = places / static_cast<int>(with_content.size()) + 20;
    for (const ReadTile* const tile : with_content) {
        const TileInPosts in_posts(*tile, exported.field.grid);
        for (int i = 0; i < of_each; ++i) {
            const PostNumber place = in_posts.random_place(random);
            const auto is_h_m = exported.surface.h_at_m(place.row, place.column);
            // Corners are rounded, by half a post at most: at edges of tiles and beside voids both may be.
            constexpr double margin_posts = 0.05, edge_posts = 1.0;
            held.uncovered +=
                in_posts.within(place, edge_posts) &&
                (is_h_m ? !in_posts.covers(place, -margin_posts) : in_posts.covers(place, 0.5 * edge_posts));
            if (!is_h_m || !in_posts.covers(place, -margin_posts)) continue;
            ++held.places;
            const double off_m =
                in_posts.distance_m(place, surface_point(exported.field.grid, place, *is_h_m));
            held.above += off_m > tile->error_m ? 1 : 0;
            held.above_halved += off_m > 0.5 * tile->error_m ? 1 : 0;
            held.closest = std::max(held.closest, off_m / tile->error_m);
        }
    }
    std::printf("%d places, %d above the error, %d above half of it, the closest at %.3f of it\n",
                held.places, held.above, held.above_halved, held.closest);
    return held;
}

// Each tile lies in its region, and it and its error in those of the tile above it.
void expect_sound_tree(const std::vector<ReadTile>& tiles) {
    for (const ReadTile& tile : tiles) {
        const auto& [west, south, east, north, lowest, highest] = tile.region;
        const bool round = east - west > 6.28;
        for (const glm::dvec3& post : tile.posts_m) {
            const Geodetic at = geodetic_from_ecef({post});
            const double lat = radians_from_deg(at.lat_deg).rad, lon = radians_from_deg(at.lon_deg).rad;
            const bool within =
                round || (west <= east ? lon >= west && lon <= east : lon >= west || lon <= east);
            ASSERT_TRUE(within && lat >= south && lat <= north && at.h_m >= lowest && at.h_m <= highest)
                << tile.uri << ": " << at.lat_deg << " " << at.lon_deg << " " << at.h_m;
        }
        if (tile.parent < 0) continue;
        const ReadTile& above = tiles[static_cast<std::size_t>(tile.parent)];
        EXPECT_LE(tile.error_m, above.error_m);
        EXPECT_LE(above.region[1], south);
        EXPECT_GE(above.region[3], north);
        EXPECT_LE(above.region[4], lowest);
        EXPECT_GE(above.region[5], highest);
    }
}

HeightField holed_field() {
    HeightField field = test::rough_field(47.0, 8.0, 300, 420);
    for (int row = 0; row < field.grid.rows(); ++row)
        for (int column = 0; column < field.grid.columns(); ++column)
            if (row + column < 90 || std::hypot(row - 170, column - 300) < 20.0)
                field.H_m[static_cast<std::size_t>(row * field.grid.columns() + column)] = void_height_m;
    return field;
}

HeightField turned_field() {
    const test::PlaneOfPosts plane{330, 290, {46.0, 8.0}, 25.0, 33.0};
    return test::net_field(plane, [&](double row, double column) {
        const PostPlace at = plane.place_of(row, column);
        return test::rough_H_m(at.lat_deg, at.lon_deg);
    });
}

TEST(GroundTileset, ErrorHoldsAtEveryPlace) {
    const Exported exported(test::rough_field(47.0, 8.0, 420, 390));
    EXPECT_EQ(exported.tiles.size(), 49U + 16U + 4U + 1U);
    EXPECT_LE(exported.written.grids.front().back().largest_error_m, 5.0);
    const HeldToErrors held = held_to_errors(exported, 100000);
    EXPECT_GE(held.places, 100000);
    EXPECT_EQ(held.above, 0);
    EXPECT_EQ(held.uncovered, 0);
    EXPECT_GT(held.above_halved, 0);
    expect_sound_tree(exported.tiles);
}

TEST(GroundTileset, ErrorHoldsOnANetAndBesideVoids) {
    for (const bool turned : {true, false}) {
        const Exported exported(turned ? turned_field() : holed_field());
        const HeldToErrors held = held_to_errors(exported, 20000);
        EXPECT_GT(held.places, 10000);
        EXPECT_EQ(held.above, 0);
        EXPECT_EQ(held.uncovered, 0);
        EXPECT_GT(held.above_halved, 0);
        expect_sound_tree(exported.tiles);
        EXPECT_TRUE(
            std::ranges::none_of(exported.tiles, [](const ReadTile& tile) { return tile.uri.empty(); }));
    }
}

// Each post is drawn where no error is allowed; what is left is rounding.
TEST(GroundTileset, TakesEveryPostWhereNothingMayBeOff) {
    const Exported exported(test::rough_field(47.0, 8.0, 140, 201), 0.0);
    const TilesetLevel& finest = exported.written.grids.front().back();
    EXPECT_EQ(finest.triangles, 2U * 139U * 200U);
    EXPECT_LT(finest.largest_error_m, 0.1);
    EXPECT_EQ(held_to_errors(exported, 20000).above, 0);
    // Fewer and fewer triangles.
    for (std::size_t i = 1; i < exported.written.grids.front().size(); ++i)
        EXPECT_LT(2 * exported.written.grids.front()[i - 1].triangles,
                  exported.written.grids.front()[i].triangles);
}

// Each region holds every point of its triangles, and is no deeper than the sagitta of the widest below the
// lowest vertex, or than the regions of tiles below it.
void expect_tight_regions(const std::vector<ReadTile>& tiles) {
    int outside = 0;
    for (const ReadTile& tile : tiles) {
        double lowest_h_m = 1.0e9, highest_h_m = -1.0e9, sagitta_m = 0.0;
        for (const glm::dvec3& post : tile.posts_m) {
            const double h_m = geodetic_from_ecef({post}).h_m;
            lowest_h_m = std::min(lowest_h_m, h_m);
            highest_h_m = std::max(highest_h_m, h_m);
        }
        for (const auto& of : tile.triangles) {
            const std::array corners_m{tile.posts_m[of[0]], tile.posts_m[of[1]], tile.posts_m[of[2]]};
            constexpr int points_of_side = 12;
            outside += test::points_outside(tile.region, corners_m, points_of_side);
            sagitta_m = std::max(sagitta_m, test::sagitta_m(corners_m, lowest_h_m));
        }
        double deepest_m = lowest_h_m - sagitta_m - 1.0;
        highest_h_m += 1.0;
        for (const int child : tile.children) {
            deepest_m = std::min(deepest_m, tiles[static_cast<std::size_t>(child)].region[4]);
            highest_h_m = std::max(highest_h_m, tiles[static_cast<std::size_t>(child)].region[5]);
        }
        EXPECT_GE(tile.region[4], deepest_m) << tile.uri;
        EXPECT_LE(tile.region[5], highest_h_m) << tile.uri;
    }
    EXPECT_EQ(outside, 0);
}

// 180 E is in the middle; the pole is inside a turned one.
TEST(GroundTileset, RegionsHoldAcrossTheAntimeridianAndAPole) {
    const Exported over(test::made_field(10.0, 179.8, 600.0, 200, 240, [](double lat, double lon) {
        return static_cast<float>(100.0 * (lat - 9.0) + 50.0 * (lon - 179.0));
    }));
    expect_sound_tree(over.tiles);
    expect_tight_regions(over.tiles);
    EXPECT_GT(over.tiles.front().region[0], over.tiles.front().region[2]);
    const test::PlaneOfPosts plane{200, 200, {89.99, 20.0}, 60.0, 10.0};
    const Exported pole(test::net_field(plane, [](double row, double column) {
        return static_cast<float>(100.0 + std::sin(0.1 * row) * 30.0 + column);
    }));
    expect_sound_tree(pole.tiles);
    expect_tight_regions(pole.tiles);
    EXPECT_EQ(held_to_errors(pole, 5000).above, 0);
    EXPECT_NEAR(pole.tiles.front().region[3], 0.5 * std::numbers::pi, 1e-12);
}

// Posts 20 km apart around a pole and over the antimeridian, with triangles of hundreds of kilometres.
TEST(GroundTileset, RegionsOfCoarsePostsHoldTrianglesAndAreNoDeeper) {
    for (const double lat_deg : {-88.0, 70.0}) {
        const test::PlaneOfPosts plane{130, 130, {lat_deg, 179.0}, 20000.0, 30.0};
        const Exported exported(test::net_field(plane,
                                                [](double row, double column) {
                                                    return static_cast<float>(1000.0 * std::sin(0.1 * row) *
                                                                              std::cos(0.07 * column));
                                                }),
                                4000.0);
        expect_sound_tree(exported.tiles);
        expect_tight_regions(exported.tiles);
        // The grid ends 1,300 km from its middle.
        EXPECT_GT(exported.tiles.front().region[3] - exported.tiles.front().region[1], 0.2);
        EXPECT_TRUE(lat_deg > 0.0 || exported.tiles.front().region[3] < -1.1);
    }
}

// Whether a line to a place is above all ground on its way: one at a low angle may come in below the rim,
// where there is no wall.
bool comes_from_the_sky(const Exported& exported, const PostNumber& at, double h_m, const glm::dvec3& up) {
    constexpr double step_m = 50.0, reach_m = 15000.0, clear_m = 400.0;
    const glm::dvec3 place = surface_point(exported.field.grid, at, h_m);
    for (double along_m = step_m; along_m < reach_m; along_m += step_m) {
        const Geodetic there = geodetic_from_ecef({place + along_m * up});
        const PostNumber post = exported.field.grid.post_at(there.lat_deg, there.lon_deg);
        const auto ground_h_m = exported.surface.h_at_m(post.row, post.column);
        // Before the rim it may be near the ground where it comes down to it.
        const bool rim = post.row < 1.0 || post.column < 1.0 || post.row > exported.field.grid.rows() - 2.0 ||
                         post.column > exported.field.grid.columns() - 2.0;
        if (!ground_h_m) return true;
        if (there.h_m < *ground_h_m + (rim ? clear_m : 0.0)) return false;
    }
    return true;
}

// The front faces of a cut, with or without its walls, that a line meets. Lines that come from above and meet
// none go through a gap.
struct Gaps {
    int lines{}, with_walls{}, without_walls{};
};
Gaps gaps_between_tiles(const Exported& exported, int cuts, int lines) {
    std::printf("seed %u\n", tiles_seed);
    std::mt19937 random(tiles_seed);
    std::uniform_real_distribution<double> share;
    const PostGrid& grid = exported.field.grid;
    Gaps gaps;
    for (int i = 0; i < cuts; ++i) {
        std::vector<int> cut;
        for (const int child : exported.tiles.front().children)
            test::random_cut(exported.tiles, child, random, cut);
        std::array<std::vector<std::array<glm::dvec3, 3>>, 2> triangles;  // without walls, with them
        for (const int number : cut) {
            const ReadTile& tile = exported.tiles[static_cast<std::size_t>(number)];
            for (std::size_t j = 0; j < tile.triangles.size(); ++j) {
                const auto& of = tile.triangles[j];
                const std::array corners{tile.posts_m[of[0]], tile.posts_m[of[1]], tile.posts_m[of[2]]};
                triangles[1].push_back(corners);
                if (j < tile.ground_triangles) triangles[0].push_back(corners);
            }
        }
        const PostPlace middle = grid.place_at(0.5 * grid.rows(), 0.5 * grid.columns());
        const glm::dmat3 enu = ecef_from_enu(middle.lat_deg, middle.lon_deg);
        const auto tree = [&](const auto& of) {
            return TriangleBvh(of, enu, std::vector<std::uint32_t>(of.size()));
        };
        const TriangleBvh bare = tree(triangles[0]), walled = tree(triangles[1]);
        for (int j = 0; j < lines; ++j) {
            // At a line of posts where tiles of level 0 meet, or a hair beside it.
            const bool along_row = random() % 2 == 0;
            constexpr int rim_posts = 25;
            const int posts = along_row ? grid.rows() : grid.columns();
            const int lines_of_posts = (posts - 1 - rim_posts) / 64;
            const double line = 64.0 * (1 + static_cast<int>(random() % 1000) % lines_of_posts) +
                                (share(random) - 0.5) * 1.0e-4;
            const int across = along_row ? grid.columns() : grid.rows();
            const double other = rim_posts + share(random) * (across - 2 * rim_posts);
            const PostNumber at = along_row ? PostNumber{line, other} : PostNumber{other, line};
            const auto h_m = exported.surface.h_at_m(at.row, at.column);
            if (!h_m) continue;
            const double turn = 2.0 * std::numbers::pi * share(random), rise = 0.3 + 1.27 * share(random);
            const glm::dvec3 up = enu * glm::dvec3(std::cos(turn) * std::cos(rise),
                                                   std::sin(turn) * std::cos(rise), std::sin(rise));
            constexpr double above_m = 20000.0;
            const glm::dvec3 from = surface_point(grid, at, *h_m) + above_m * up;
            ++gaps.lines;
            if (bare.first_hit(from, -up, 2.0 * above_m) || !comes_from_the_sky(exported, at, *h_m, up))
                continue;
            ++gaps.without_walls;
            gaps.with_walls += walled.first_hit(from, -up, 2.0 * above_m) ? 0 : 1;
        }
    }
    std::printf("%d lines, %d through gaps, %d without walls\n", gaps.lines, gaps.with_walls,
                gaps.without_walls);
    return gaps;
}

TEST(GroundTileset, WallsCloseGapsBetweenLevels) {
    const Exported plain(test::rough_field(47.0, 8.0, 420, 390));
    const Gaps gaps = gaps_between_tiles(plain, 6, 4000);
    EXPECT_EQ(gaps.with_walls, 0);
    EXPECT_GT(gaps.without_walls, 0);
    const Gaps turned = gaps_between_tiles(Exported(turned_field()), 3, 4000);
    EXPECT_EQ(turned.with_walls, 0);
    EXPECT_GT(turned.without_walls, 0);
}

TEST(GroundTileset, IsTheSameForAnyNumberOfThreads) {
    const Exported one(holed_field(), 5.0, 1), five(holed_field(), 5.0, 5);
    EXPECT_EQ(test::all_bytes(one.folder / "tileset.json"), test::all_bytes(five.folder / "tileset.json"));
    ASSERT_EQ(one.tiles.size(), five.tiles.size());
    for (std::size_t i = 0; i < one.tiles.size(); ++i) {
        if (one.tiles[i].uri.empty()) continue;
        EXPECT_TRUE(test::all_bytes(one.folder / one.tiles[i].uri) ==
                    test::all_bytes(five.folder / five.tiles[i].uri));
    }
}

// On a plane that rises to the east normals lean westwards: by 45 degrees where it rises a metre a metre.
TEST(GroundTileset, NormalsAreThoseOfTheGround) {
    const Exported exported(test::made_field(0.05, 10.0, 1200.0, 130, 130, [](double, double lon) {
        return static_cast<float>((lon - 10.0) * 111319.49);  // metres a degree on the equator
    }));
    ASSERT_FALSE(exported.tiles.front().posts_m.empty());
    for (const ReadTile& tile : exported.tiles) {
        for (std::size_t i = 0; i < tile.normals.size(); ++i) {
            const Geodetic at = geodetic_from_ecef({tile.posts_m[i]});
            const glm::dvec3 local = tile.normals[i] * ecef_from_enu(at.lat_deg, at.lon_deg);
            EXPECT_NEAR(local.x, -std::sqrt(0.5), 1e-2);
            EXPECT_NEAR(local.y, 0.0, 1e-2);
            EXPECT_NEAR(local.z, std::sqrt(0.5), 1e-2);
        }
    }
}

// Each vertex has its colour, and names its source in the table.
TEST(GroundTileset, VerticesTellTheirColoursAndSources) {
    const Exported exported(test::rough_field(47.0, 8.0, 100, 190));
    std::array<int, 2> found{};
    for (const ReadTile& tile : exported.tiles) {
        ASSERT_EQ(tile.sources.size(), tile.posts_m.size());
        ASSERT_EQ(tile.colours.size(), tile.posts_m.size());
        ASSERT_EQ(tile.source_names, (std::vector<std::string>{"a.hgt", "b.tif"}));
        ASSERT_EQ(tile.source_le90_m, (std::vector<float>{16.0F, -1.0F}));
        for (std::size_t i = 0; i < tile.posts_m.size(); ++i) {
            const Geodetic at = geodetic_from_ecef({tile.posts_m[i]});
            const double column = exported.field.grid.post_at(at.lat_deg, at.lon_deg).column;
            if (std::abs(column - 100.0) < 2.0) continue;
            const bool east = column > 100.0;
            ++found[east ? 1 : 0];
            EXPECT_EQ(tile.sources[i], east ? 1 : 0);
            EXPECT_NEAR(tile.colours[i].x, east ? 1.0 : 0.25, 1.0 / 255.0);
            EXPECT_NEAR(tile.colours[i].y, 0.5, 1.0 / 255.0);
        }
    }
    EXPECT_GT(found[0], 100);
    EXPECT_GT(found[1], 100);
    const auto json = nlohmann::json::parse(test::all_bytes(exported.folder / "tileset.json"));
    EXPECT_EQ(json["metadata"]["properties"]["sources"], (std::vector<std::string>{"a.hgt", "b.tif"}));
    EXPECT_EQ(json["metadata"]["properties"]["sourcesVerticalLe90"][0], 16.0);
    EXPECT_EQ(json["schema"]["classes"]["ground"]["properties"]["sources"]["array"], true);
}

// Three parts that are made by themselves, one of them twice, and a tileset of them: the bytes of one go, and
// the ground is not asked for again.
TEST(GroundTileset, OfPartsHasTheBytesOfOneGo) {
    const HeightField field = test::rough_field(47.0, 8.0, 150, 170);
    const fs::path scratch = test::scratch_folder();
    int asked = 0;
    TilesetGround ground{{grid_of(field, 5.0, 2)}, {}};
    ground.grids.front().ground = [&] {
        ++asked;
        return ClusteredGround::of(field, nullptr, 2);
    };
    TilesetRequest request;
    request.tile_quads = 64;
    fs::create_directory(scratch / "whole");
    ASSERT_TRUE(write_tileset(scratch / "whole", ground, request, {}).ok());
    const auto kept = KeptTiles::open(scratch / "kept", "key");
    ASSERT_TRUE(kept.ok());
    request.kept = &kept.value();
    request.parts = 3;
    std::uint64_t tiles = 0;
    for (const int part : {2, 0, 2, 1}) {
        request.part = part;
        const auto made = make_tiles(ground, request, {});
        ASSERT_TRUE(made.ok()) << made.error().line();
        if (part != 2 || tiles == 0) tiles += made.value();
    }
    EXPECT_EQ(tiles, 9U + 4U + 1U);
    EXPECT_EQ(asked, 1 + 3);
    request.part = 0;
    request.parts = 1;
    fs::create_directory(scratch / "joined");
    ASSERT_TRUE(write_tileset(scratch / "joined", ground, request, {}).ok());
    EXPECT_EQ(asked, 1 + 3);
    std::size_t files = 0;
    for (const auto& entry : fs::recursive_directory_iterator(scratch / "whole")) {
        if (!entry.is_regular_file()) continue;
        ++files;
        EXPECT_TRUE(test::all_bytes(entry.path()) ==
                    test::all_bytes(scratch / "joined" / fs::relative(entry.path(), scratch / "whole")));
    }
    EXPECT_EQ(files, 9U + 4U + 1U + 1U);
    EXPECT_FALSE(KeptTiles::open(scratch / "kept", "another").ok());
    // A tile that was cut is no tile.
    fs::resize_file(scratch / "kept" / "0-1-1.tile", 500);
    fs::create_directory(scratch / "again");
    const auto cut = write_tileset(scratch / "again", ground, request, {});
    ASSERT_FALSE(cut.ok());
    EXPECT_NE(cut.error().line().find("0-1-1.tile"), std::string::npos);
    fs::copy_file(scratch / "whole" / "tileset.json", scratch / "kept" / "mine.json");
    kept->remove();
    EXPECT_TRUE(fs::exists(scratch / "kept" / "mine.json"));
    EXPECT_FALSE(fs::exists(scratch / "kept" / "0-0-0.tile"));
}

TEST(GroundTileset, AFullDiskIsTold) {
    const HeightField field = test::rough_field(47.0, 8.0, 60, 60);
    const auto done = write_tileset("/dev/full", {{grid_of(field, 0.0, 1)}, {}}, {}, {});
    ASSERT_FALSE(done.ok());
    EXPECT_EQ(done.error().kind, ErrorKind::failed);
}

}  // namespace
}  // namespace oro
