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
#include "tests/geo/tilesets/read_tileset.h"
#include "tests/support/net_terrain.h"
#include "tests/support/rough_terrain.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {
namespace fs = std::filesystem;
using test::ReadTile;

constexpr unsigned tiles_seed = 20261128;

// A field's tileset, written and read back.
struct Exported {
    explicit Exported(HeightField made, int threads = 2)
        : field(std::move(made)), surface(field, 1.0, 2), folder(test::scratch_folder()) {
        const auto pages = pages_in_memory(field, 1.0, threads);
        TilesetRequest request;
        request.look = {{0.5, 0.4, 0.3}, "nobody", "test"};
        request.metadata = {{"heights", "made \"up\""}};
        request.threads = threads;
        auto done = write_tileset(folder, *pages, request, {});
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

// The ground triangles of a tile by the posts that their vertices are.
class TileInPosts {
  public:
    TileInPosts(const ReadTile& tile, const PostGrid& grid) : tile_(&tile) {
        for (const glm::dvec3& post : tile.posts_m) {
            const Geodetic at = geodetic_from_ecef({post});
            posts_.push_back(grid.post_at(at.lat_deg, at.lon_deg));
        }
        for (std::size_t i = 0; i < tile.ground_triangles; ++i) {
            Corners corners{};
            for (std::size_t j = 0; j < 3; ++j) {
                const PostNumber& post = posts_[tile.triangles[i][j]];
                EXPECT_NEAR(post.row, std::round(post.row), 0.01);
                EXPECT_NEAR(post.column, std::round(post.column), 0.01);
                corners[j] = {std::round(post.row), std::round(post.column)};
            }
            const auto [first_row, last_row] = std::minmax({corners[0].row, corners[1].row, corners[2].row});
            const auto [first_column, last_column] =
                std::minmax({corners[0].column, corners[1].column, corners[2].column});
            quads_[{first_row, first_column}].push_back({i, corners});
            if (first_rows_.empty() || first_rows_.back() != first_row) first_rows_.push_back(first_row);
            first_columns_.push_back(first_column);
            last_row_ = std::max(last_row_, last_row);
            last_column_ = std::max(last_column_, last_column);
        }
        for (std::vector<double>* const firsts : {&first_rows_, &first_columns_}) {
            std::ranges::sort(*firsts);
            firsts->erase(std::unique(firsts->begin(), firsts->end()), firsts->end());
        }
    }
    // A place that the tile may have ground at: row and column.
    PostNumber random_place(std::mt19937& random) const {
        std::uniform_real_distribution<double> share;
        return {first_rows_.front() + share(random) * (last_row_ - first_rows_.front()),
                first_columns_.front() + share(random) * (last_column_ - first_columns_.front())};
    }
    // The tile's point there; nothing where it has no triangle.
    std::optional<glm::dvec3> point_at(const PostNumber& place) const {
        const auto quad =
            quads_.find({first_before(first_rows_, place.row), first_before(first_columns_, place.column)});
        if (quad == quads_.end()) return std::nullopt;
        for (const auto& [number, at] : quad->second) {
            const double whole = cross(at[0], at[1], at[2]);
            const double a = cross(place, at[1], at[2]) / whole, b = cross(at[0], place, at[2]) / whole;
            if (a < -1e-12 || b < -1e-12 || a + b > 1.0 + 1e-12) continue;
            const auto& triangle = tile_->triangles[number];
            return a * tile_->posts_m[triangle[0]] + b * tile_->posts_m[triangle[1]] +
                   (1.0 - a - b) * tile_->posts_m[triangle[2]];
        }
        return std::nullopt;
    }

  private:
    using Corners = std::array<PostNumber, 3>;
    static double cross(const PostNumber& a, const PostNumber& b, const PostNumber& c) {
        return (b.row - a.row) * (c.column - a.column) - (b.column - a.column) * (c.row - a.row);
    }
    static double first_before(const std::vector<double>& firsts, double at) {
        const auto next = std::ranges::upper_bound(firsts, at);
        return next == firsts.begin() ? firsts.front() : *(next - 1);
    }
    const ReadTile* tile_;
    std::vector<PostNumber> posts_;
    std::map<std::pair<double, double>, std::vector<std::pair<std::size_t, Corners>>> quads_;
    std::vector<double> first_rows_, first_columns_;
    double last_row_{}, last_column_{};
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
    const int of_each = places / static_cast<int>(with_content.size()) + 1;
    for (const ReadTile* const tile : with_content) {
        const TileInPosts in_posts(*tile, exported.field.grid);
        for (int i = 0; i < of_each; ++i) {
            const PostNumber place = in_posts.random_place(random);
            const auto is_h_m = exported.surface.h_at_m(place.row, place.column);
            const auto has_m = in_posts.point_at(place);
            held.uncovered += is_h_m.has_value() != has_m.has_value() ? 1 : 0;
            if (!is_h_m || !has_m) continue;
            ++held.places;
            const double off_m = glm::distance(*has_m, surface_point(exported.field.grid, place, *is_h_m));
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
    EXPECT_EQ(exported.tiles.size(), 16U + 4U + 1U);
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
        std::uint64_t without = 0;
        for (const TilesetLevel& level : exported.written.levels) without += level.without_content;
        EXPECT_EQ(without > 0, !turned);
        const auto empty =
            std::ranges::count_if(exported.tiles, [](const ReadTile& tile) { return tile.uri.empty(); });
        EXPECT_EQ(static_cast<std::uint64_t>(empty), without);
    }
}

// 180 E is in the middle; the pole is inside a turned one.
TEST(GroundTileset, RegionsHoldAcrossTheAntimeridianAndAPole) {
    const Exported over(test::made_field(10.0, 179.8, 600.0, 200, 240, [](double lat, double lon) {
        return static_cast<float>(100.0 * (lat - 9.0) + 50.0 * (lon - 179.0));
    }));
    expect_sound_tree(over.tiles);
    EXPECT_GT(over.tiles.front().region[0], over.tiles.front().region[2]);
    const test::PlaneOfPosts plane{200, 200, {89.99, 20.0}, 60.0, 10.0};
    const Exported pole(test::net_field(plane, [](double row, double column) {
        return static_cast<float>(100.0 + std::sin(0.1 * row) * 30.0 + column);
    }));
    expect_sound_tree(pole.tiles);
    EXPECT_EQ(held_to_errors(pole, 5000).above, 0);
    EXPECT_NEAR(pole.tiles.front().region[3], 0.5 * std::numbers::pi, 1e-12);
}

// A cut below a tile: it is drawn, or all below it are.
void random_cut(const std::vector<ReadTile>& tiles, int number, std::mt19937& random, std::vector<int>& cut) {
    const ReadTile& tile = tiles[static_cast<std::size_t>(number)];
    if (!tile.uri.empty() && (tile.children.empty() || random() % 2 == 0)) {
        cut.push_back(number);
        return;
    }
    for (const int child : tile.children) random_cut(tiles, child, random, cut);
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
            random_cut(exported.tiles, child, random, cut);
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
            // At a line of posts where pages of level 0 meet, or a hair beside it.
            const bool along_row = random() % 2 == 0;
            // Off the rim, which a line at a low angle may pass where a coarse tile lies lower.
            constexpr int rim_posts = 25;
            const int posts = along_row ? grid.rows() : grid.columns();
            const int lines_of_posts = (posts - 1 - rim_posts) / 128;
            const double line = 128.0 * (1 + static_cast<int>(random() % 1000) % lines_of_posts) +
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
            gaps.with_walls += walled.first_hit(from, -up, 2.0 * above_m) ? 0 : 1;
            gaps.without_walls += bare.first_hit(from, -up, 2.0 * above_m) ? 0 : 1;
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
    const Exported one(holed_field(), 1), five(holed_field(), 5);
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
            EXPECT_NEAR(local.x, -std::sqrt(0.5), 2e-3);
            EXPECT_NEAR(local.y, 0.0, 2e-3);
            EXPECT_NEAR(local.z, std::sqrt(0.5), 2e-3);
        }
    }
}

TEST(GroundTileset, AFullDiskIsTold) {
    const auto pages = pages_in_memory(test::rough_field(47.0, 8.0, 140, 140), 1.0, 1);
    const auto done = write_tileset("/dev/full", *pages, {}, {});
    ASSERT_FALSE(done.ok());
    EXPECT_EQ(done.error().kind, ErrorKind::failed);
}

}  // namespace
}  // namespace oro
