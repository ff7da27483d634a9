// The true surface: heights by hand, layers by brute force, posts of a file, several threads.
#include "core/truth/true_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "core/truth/oracle.h"
#include "tests/core/truth/world_field.h"
#include "tests/support/rough_terrain.h"

namespace oro {
namespace {

constexpr double nothing = static_cast<double>(void_height_m);

// Posts of a degree from (2 N, 10 E): rows from north to south.
HeightField field_of(int rows, int columns, const std::vector<float>& H_m) {
    HeightField field = test::world_field(1.0, 2, 10, rows, columns, [](double, double) { return 0.0; });
    field.H_m = H_m;
    return field;
}

// Posts that are not in memory.
class OtherPosts : public PostSource {
  public:
    explicit OtherPosts(HeightField of) : of_(std::move(of)) {}
    [[nodiscard]] float H_m(int row, int column) const override { return of_.H_at_post_m(row, column); }
    [[nodiscard]] Result<void> health() const override { return {}; }

  private:
    HeightField of_;
};
HeightField read_when_asked(const HeightField& field) {
    HeightField other = field;
    other.range = height_range(field);
    other.posts = std::make_shared<OtherPosts>(field);
    other.H_m.clear();
    return other;
}

// N = 20 m + 3 m a degree eastward + 5 m a degree northward, around a field.
UndulationField tilted_N(const PostGrid& grid) {
    UndulationField undulation;
    const auto north = static_cast<std::int64_t>(std::ceil(grid.north_deg())),
               west = static_cast<std::int64_t>(std::floor(grid.west_deg()));
    undulation.lat = {1.0, 0.0, north, -1,
                      static_cast<int>(std::ceil(static_cast<double>(north) - grid.south_deg())) + 1};
    undulation.lon = {1.0, 0.0, west, +1,
                      static_cast<int>(std::ceil(grid.east_deg() - static_cast<double>(west))) + 1};
    for (int row = 0; row < undulation.lat.count; ++row) {
        for (int column = 0; column < undulation.lon.count; ++column)
            undulation.N_m.push_back(static_cast<float>(20.0 + 3.0 * undulation.lon.at_deg(column) +
                                                        5.0 * undulation.lat.at_deg(row)));
    }
    return undulation;
}

// Of each row, from its first column and from a later one; old rule: post by post.
void expect_rows_of_posts(const TrueSurface& surface) {
    const PostGrid& grid = surface.field().grid;
    for (int row = 0; row < grid.rows(); ++row) {
        for (const int first : {0, grid.columns() / 3, grid.columns() - 1}) {
            std::vector<double> h_m(static_cast<std::size_t>(grid.columns() - first), 1.0e9);
            surface.row_h_m(row, first, h_m);
            for (int column = first; column < grid.columns(); ++column) {
                const std::optional<double> post_m = surface.post_h_m(row, column);
                const double found_m = h_m[static_cast<std::size_t>(column - first)];
                ASSERT_EQ(post_m.has_value(), !std::isnan(found_m)) << row << ", " << column;
                ASSERT_TRUE(!post_m || found_m == *post_m) << row << ", " << column;
            }
        }
    }
}

TEST(TrueSurface, RowsHaveTheBitsOfTheirPosts) {
    HeightField field = test::world_field(4.0, 46, 7, 21, 33, [](double lat_deg, double lon_deg) {
        return 900.0 + 311.0 * std::sin(9.0 * lat_deg) + 170.0 * std::cos(7.0 * lon_deg);
    });
    field.H_m[5 * 33 + 4] = field.H_m[20 * 33 + 32] = field.H_m[7 * 33 + 32] = void_height_m;
    expect_rows_of_posts(TrueSurface(field, 1.5, 1));  // without N
    field.undulation = tilted_N(field.grid);
    expect_rows_of_posts(TrueSurface(field, 1.0, 1));
    expect_rows_of_posts(TrueSurface(field, 2.5, 1));
    const HeightField on_file = read_when_asked(field);
    expect_rows_of_posts(TrueSurface(on_file, 1.0, 1));
    // A meridian's two columns, and poles, are one point each.
    HeightField world = test::world_field(
        0.1, 9, -18, 19, 37, [](double lat_deg, double lon_deg) { return 10.0 * lat_deg + lon_deg; });
    world.undulation = tilted_N(world.grid);
    expect_rows_of_posts(TrueSurface(world, 1.0, 1));
}

// One cell, split from north-west (0) to south-east (40): over the south-west triangle h = 0 + 100 down + ...
// by hand: south-west post 100, north-east post 20.
//   (0.75 down, 0.25 right): 0 + 0.75 (100 - 0) + 0.25 (40 - 100) = 60
//   (0.25 down, 0.75 right): 0 + 0.75 (20 - 0) + 0.25 (40 - 20) = 20
//   on the diagonal, half way: 20, by either. With the other diagonal it would be (100 + 20) / 2 = 60.
TEST(TrueSurface, IsSplitFromNorthWestToSouthEast) {
    const HeightField field = field_of(2, 2, {0, 20, 100, 40});
    const TrueSurface surface(field, 1.0, 1);
    EXPECT_NEAR(*surface.h_m(1.25, 10.25), 60.0, 1e-9);
    EXPECT_NEAR(*surface.h_m(1.75, 10.75), 20.0, 1e-9);
    EXPECT_NEAR(*surface.h_m(1.5, 10.5), 20.0, 1e-9);
    EXPECT_NEAR(*surface.h_m(2.0, 10.5), 10.0, 1e-9);
    EXPECT_NEAR(*surface.h_m(1.5, 10.0), 50.0, 1e-9);
    EXPECT_NEAR(*surface.h_m(1.0, 11.0), 40.0, 1e-9);
}

// Exaggeration lifts H alone: 2.5 * 60 + N at (1.25 N, 10.25 E) = 150 + 20 + 30.75 + 6.25 = 207.
TEST(TrueSurface, ExaggeratesHAndNotN) {
    HeightField field = field_of(2, 2, {0, 20, 100, 40});
    field.undulation = tilted_N(field.grid);
    const TrueSurface surface(field, 2.5, 1);
    EXPECT_NEAR(*surface.h_m(1.25, 10.25), 207.0, 1e-9);
    EXPECT_NEAR(*surface.post_h_m(1, 0), 250.0 + 20.0 + 30.0 + 5.0, 1e-9);
}

// A row of posts is no surface; its posts are where they are.
TEST(TrueSurface, OneRowHasPostsAndNoSurface) {
    HeightField field = field_of(1, 3, {1, 2, 3});
    field.undulation = tilted_N(field.grid);
    const TrueSurface surface(field, 1.0, 2);
    EXPECT_EQ(surface.levels(), 0);
    EXPECT_NEAR(*surface.post_h_m(0, 1), 2.0 + 20.0 + 33.0 + 10.0, 1e-9);
    EXPECT_FALSE(surface.h_m(2.0, 11.0));
}

TEST(TrueSurface, VoidPostsTakeTheirTrianglesAlone) {
    constexpr float none = void_height_m;
    // South-west post void: the north-eastern triangle stays, its diagonal with it.
    const HeightField field = field_of(2, 2, {0, 20, none, 40});
    const TrueSurface surface(field, 1.0, 1);
    EXPECT_FALSE(surface.post_h_m(1, 0));
    EXPECT_FALSE(surface.h_m(1.25, 10.25));
    EXPECT_NEAR(*surface.h_m(1.75, 10.75), 20.0, 1e-9);
    EXPECT_NEAR(*surface.h_m(1.5, 10.5), 20.0, 1e-9);
    // An end of the diagonal void: nothing is left of the cell; the edge that a neighbour has stays.
    const HeightField wide = field_of(2, 3, {none, 20, 30, 10, 40, 50});
    const TrueSurface neighbour(wide, 1.0, 1);
    EXPECT_FALSE(neighbour.h_m(1.75, 10.75));
    EXPECT_FALSE(neighbour.h_m(1.25, 10.25));
    EXPECT_NEAR(*neighbour.h_m(1.5, 11.0), 30.0, 1e-9);
    EXPECT_NEAR(*neighbour.h_m(1.25, 11.25), 20.0 + 0.75 * 20.0 + 0.25 * 10.0, 1e-9);
}

TEST(TrueSurface, EndsAtItsRim) {
    const HeightField field = field_of(2, 2, {0, 20, 100, 40});
    const TrueSurface surface(field, 1.0, 1);
    // A rounded angle is still in; 1e-5 posts (a metre here) is not.
    EXPECT_NEAR(*surface.h_m(2.0 + 1e-9, 10.0 - 1e-9), 0.0, 1e-6);
    EXPECT_NEAR(*surface.h_m(1.0 - 1e-9, 11.0 + 1e-9), 40.0, 1e-6);
    EXPECT_FALSE(surface.h_m(2.0 + 1e-5, 10.5));
    EXPECT_FALSE(surface.h_m(1.0 - 1e-5, 10.5));
    EXPECT_FALSE(surface.h_m(1.5, 10.0 - 1e-5));
    EXPECT_FALSE(surface.h_m(1.5, 11.0 + 1e-5));
    EXPECT_NEAR(*surface.h_m(1.5, 370.5), 20.0, 1e-6);
    EXPECT_FALSE(surface.h_m(std::nan(""), 10.5));
}

// Round the Earth, both poles in it, 30 degrees a post: rows at 90, 60, ... -90.
HeightField whole_earth() {
    HeightField field =
        test::world_field(1.0 / 30.0, 3, -6, 7, 13, [](double, double lon_deg) { return lon_deg + 200.0; });
    return field;
}

TEST(TrueSurface, OnePointHasOneHeight) {
    HeightField field = whole_earth();
    const TrueSurface surface(field, 1.0, 1);
    for (int column = 0; column < 13; ++column) {
        EXPECT_EQ(surface.post_h_m(0, column), 20.0);
        EXPECT_EQ(surface.post_h_m(6, column), 20.0);
    }
    // The last column is the first.
    EXPECT_EQ(surface.post_h_m(3, 12), 20.0);
    EXPECT_EQ(surface.post_h_m(3, 11), 350.0);
    // Half way between 150 E and 180: (350 + 20) / 2.
    EXPECT_NEAR(*surface.h_m(0.0, 165.0), 185.0, 1e-9);
    // Half way between 20 at the pole and 230 at (60 N, 30 E).
    EXPECT_NEAR(*surface.h_m(75.0, 30.0), 125.0, 1e-9);
    EXPECT_NEAR(*surface.h_m(90.0, 77.0), 20.0, 1e-9);
    EXPECT_NEAR(*surface.h_m(0.0, -180.0), *surface.h_m(0.0, 180.0), 1e-9);
    // Where the first is void another is the pole's; void posts stay void.
    field.H_m[0] = void_height_m;
    field.H_m[1] = void_height_m;
    const TrueSurface holed(field, 1.0, 1);
    EXPECT_FALSE(holed.post_h_m(0, 1));
    for (int column = 2; column < 13; ++column) EXPECT_EQ(holed.post_h_m(0, column), 80.0);
}

// Every block of every level against all its posts.
void expect_layers_hold(const HeightField& field, double exaggeration, bool tight) {
    const TrueSurface surface(field, exaggeration, 2);
    const int rows = field.grid.rows(), columns = field.grid.columns();
    ASSERT_GT(surface.levels(), 0);
    ASSERT_EQ(surface.blocks(surface.levels() - 1), std::pair(1, 1));
    for (int level = 0; level < surface.levels(); ++level) {
        const int cells = TrueSurface::block_cells << level;
        const auto [down, across] = surface.blocks(level);
        ASSERT_EQ(down, (rows - 1 + cells - 1) / cells);
        ASSERT_EQ(across, (columns - 1 + cells - 1) / cells);
        for (int i = 0; i < down * across; ++i) {
            const TrueSurface::Block block{level, i / across, i % across};
            const TrueSurface::Layer layer = surface.layer(block);
            double lowest_m = std::numeric_limits<double>::infinity(), highest_m = -lowest_m;
            for (int row = block.row * cells; row <= std::min((block.row + 1) * cells, rows - 1); ++row) {
                for (int column = block.column * cells;
                     column <= std::min((block.column + 1) * cells, columns - 1); ++column) {
                    const auto h_m = surface.post_h_m(row, column);
                    if (!h_m) continue;
                    lowest_m = std::min(lowest_m, *h_m);
                    highest_m = std::max(highest_m, *h_m);
                }
            }
            if (lowest_m > highest_m) {
                ASSERT_TRUE(layer.empty() || !tight) << level << " " << block.row << " " << block.column;
                continue;
            }
            ASSERT_LE(layer.lowest_h_m, lowest_m) << level << " " << block.row << " " << block.column;
            ASSERT_GE(layer.highest_h_m, highest_m) << level << " " << block.row << " " << block.column;
            // Rounded to float outwards, on each level again: 6 units in the last place of some 14 km.
            if (level < 5) {
                ASSERT_GE(layer.lowest_h_m, lowest_m - 0.01);
                ASSERT_LE(layer.highest_h_m, highest_m + 0.01);
            }
        }
    }
}

TEST(TrueSurface, LayersHoldAllPosts) {
    std::mt19937_64 random(501);
    std::printf("seed 501\n");
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const std::pair<int, int> sizes[] = {{2, 2},     {5, 5},     {6, 3},     {2, 700},   {700, 2},
                                         {129, 129}, {130, 128}, {131, 259}, {300, 413}, {513, 130}};
    for (const auto& [rows, columns] : sizes) {
        HeightField field = test::world_field(1200.0, 56000, 9000, rows, columns, [&](double, double) {
            return unit(random) < 0.3 ? nothing : 8000.0 * unit(random) * unit(random) - 400.0;
        });
        field.undulation = tilted_N(field.grid);
        SCOPED_TRACE(std::to_string(rows) + " x " + std::to_string(columns));
        expect_layers_hold(field, 1.0, true);
        expect_layers_hold(field, 1.7, true);
        expect_layers_hold(read_when_asked(field), 1.0, false);
    }
}

TEST(TrueSurface, LayersOfVoidsAreEmpty) {
    const HeightField field =
        test::world_field(1200.0, 56000, 9000, 150, 260, [](double, double) { return nothing; });
    expect_layers_hold(field, 1.0, true);
}

// Where one point's posts differ in the data, one of them counts, which may lie in another chunk: the pole's
// in its first column, the antimeridian's at the other end of its row.
TEST(TrueSurface, LayersHoldPolesAndTwinColumns) {
    std::mt19937_64 random(502);
    std::printf("seed 502\n");
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (const int voids_at_the_pole : {0, 1, 130, 361}) {
        HeightField field =
            test::world_field(1.0, 90, -180, 181, 361, [&](double, double) { return 100.0 * unit(random); });
        for (int column = 0; column < voids_at_the_pole; ++column) {
            field.H_m[static_cast<std::size_t>(column)] = void_height_m;
            field.H_m[180U * 361U + static_cast<std::size_t>(column)] = void_height_m;
        }
        // A chunk that begins with a void at the pole, and far heights that only twins have.
        field.H_m[256] = void_height_m;
        field.H_m[180U * 361U + 256U] = void_height_m;
        for (const std::size_t pole : {std::size_t{0}, std::size_t{180} * 361U}) {
            float& first = field.H_m[pole + static_cast<std::size_t>(std::min(voids_at_the_pole, 360))];
            if (first != void_height_m) first = pole == 0 ? 9000.0F : -9000.0F;
        }
        for (std::size_t row = 1; row < 180; ++row) field.H_m[row * 361U] = 5000.0F;
        SCOPED_TRACE(voids_at_the_pole);
        expect_layers_hold(field, 1.0, true);
        expect_layers_hold(read_when_asked(field), 1.0, false);
    }
}

TEST(TrueSurface, PostsOfAFileAreTheSameSurface) {
    std::mt19937_64 random(503);
    std::printf("seed 503\n");
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    HeightField field = test::rough_field(47.0, 8.0, 203, 307);
    for (float& H_m : field.H_m) {
        if (unit(random) < 0.002) H_m = void_height_m;
    }
    field.undulation = tilted_N(field.grid);
    const HeightField other = read_when_asked(field);
    const TrueSurface in_memory(field, 1.0, 1), asked(other, 1.0, 1);
    const PostGrid& grid = field.grid;
    const auto place = [&] {
        return Geodetic{grid.south_deg() + unit(random) * (grid.north_deg() - grid.south_deg()),
                        grid.west_deg() + unit(random) * (grid.east_deg() - grid.west_deg()), 0.0};
    };
    for (int i = 0; i < 5000; ++i) {
        const Geodetic at = place();
        ASSERT_EQ(in_memory.h_m(at.lat_deg, at.lon_deg), asked.h_m(at.lat_deg, at.lon_deg));
    }
    int hits = 0;
    for (int i = 0; i < 2000; ++i) {
        Camera camera;
        camera.eye = place();
        camera.eye.h_m = in_memory.h_m(camera.eye.lat_deg, camera.eye.lon_deg).value_or(3000.0) +
                         std::pow(10.0, 4.0 * unit(random));
        camera.attitude = {360.0 * unit(random), 5.0 - 40.0 * unit(random), 0.0};
        const Sight sight = sight_from(camera.eye, {0.13});
        const glm::dvec3 direction = camera.ecef_direction_at({0.5, 0.5});
        const auto one = first_hit(in_memory, sight, direction, 1.0e6);
        const auto two = first_hit(asked, sight, direction, 1.0e6);
        ASSERT_EQ(one.has_value(), two.has_value()) << i;
        if (!one) continue;
        ++hits;
        ASSERT_NEAR(one->distance_m, two->distance_m, 1.0e-9) << i;
        ASSERT_EQ(one->row, two->row) << i;
        ASSERT_EQ(one->column, two->column) << i;
        ASSERT_EQ(one->west, two->west) << i;
    }
    std::printf("%d of 2000 lines meet ground\n", hits);
    EXPECT_GT(hits, 1000);
}

// Chunks are made by whoever asks first: all that ask at once get the same.
TEST(TrueSurface, ManyMayAskAtOnce) {
    const HeightField field = test::rough_field(47.0, 8.0, 300, 301);
    const TrueSurface one(field, 1.0, 1), shared(field, 1.0, 4);
    const auto ask = [](const TrueSurface& surface, int first) {
        std::vector<double> heights_m;
        const auto [down, across] = surface.blocks(0);
        heights_m.resize(static_cast<std::size_t>(2 * down * across));
        for (int i = 0; i < down * across; ++i) {
            const int block = (i + first) % (down * across);
            const TrueSurface::Layer layer = surface.layer({0, block / across, block % across});
            heights_m[static_cast<std::size_t>(2 * block)] = layer.lowest_h_m;
            heights_m[static_cast<std::size_t>(2 * block + 1)] = layer.highest_h_m;
        }
        return heights_m;
    };
    const std::vector<double> expected = ask(one, 0);
    std::vector<std::vector<double>> got(4);
    {
        std::vector<std::jthread> threads;
        for (int i = 0; i < 4; ++i)
            threads.emplace_back([&, i] { got[static_cast<std::size_t>(i)] = ask(shared, 1400 * (i / 2)); });
    }
    for (const std::vector<double>& answers : got) EXPECT_TRUE(answers == expected);
}

}  // namespace
}  // namespace oro
