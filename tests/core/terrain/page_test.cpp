#include "core/terrain/page.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <memory>
#include <random>
#include <vector>

#include "tests/core/truth/world_field.h"

namespace oro {
namespace {

constexpr int quads = static_cast<int>(gpu::page_quads);

struct BuiltPage {
    std::unique_ptr<gpu::PageBlock> block = std::make_unique<gpu::PageBlock>();
    PageSummary summary;
};
BuiltPage built(const HeightField& field, PageIndex index, double exaggeration = 1.0) {
    BuiltPage page;
    std::memset(static_cast<void*>(page.block.get()), 0xA5, sizeof(gpu::PageBlock));
    page.summary = build_page(field, region_shape(field, exaggeration), index, *page.block);
    return page;
}

std::int32_t height(const BuiltPage& page, int row, int column) {
    return page.block->heights[(row + 1) * 131 + column + 1];
}
bool same_bits(const Ecef& a, const Ecef& b) {
    return std::memcmp(&a, &b, sizeof a) == 0;
}

// Rough ground with some voids and an undulation, two pages and a bit along each axis.
HeightField rough_field(std::int64_t north, std::int64_t west, double per_deg = 1200.0) {
    std::mt19937_64 random(17);
    HeightField field = test::world_field(per_deg, north, west, 300, 290, [&](double, double) {
        const double value = static_cast<double>(random() % 300000) / 100.0;
        return random() % 50 == 0 ? static_cast<double>(void_height_m) : value;
    });
    field.undulation.lat = {4.0, 0.0, 4 * 90, -1, 721};
    field.undulation.lon = {4.0, 0.0, -4 * 180, +1, 1441};
    for (int i = 0; i < 721 * 1441; ++i) {
        field.undulation.N_m.push_back(static_cast<float>(60.0 * std::sin(i * 0.01)));
    }
    return field;
}

TEST(PageLayout, CoversTheGrid) {
    PostGrid grid;
    const auto layout = [&](int rows, int columns) {
        grid.lat.count = rows;
        grid.lon.count = columns;
        const PageLayout got = page_layout(grid);
        return std::array{got.rows, got.columns};
    };
    EXPECT_EQ(layout(2, 2), (std::array{1, 1}));
    EXPECT_EQ(layout(129, 130), (std::array{1, 2}));
    EXPECT_EQ(layout(1201, 3601), (std::array{10, 29}));
    EXPECT_EQ(layout(1, 1), (std::array{0, 0}));
}

// All pages of all levels.
template <class Visit>
void for_each_page(const PostGrid& grid, const Visit& visit) {
    for (int level = 0; level < level_count(grid); ++level) {
        const PageLayout layout = level_grid(grid, level).pages();
        for (int i = 0; i < layout.rows * layout.columns; ++i)
            visit(PageIndex{i / layout.columns, i % layout.columns, level});
    }
}

// What every page must hold at row and column -1 .. 129: the height of the region's post, by the rule as it
// is said; nothing beyond the region but round the Earth.
std::int32_t height_by_rule(const PostGrid& grid, const DrawnHeights& heights, PageIndex index, int row,
                            int column) {
    const LevelGrid level = level_grid(grid, index.level);
    const int last = level.column.quads;
    const int r = index.row * quads + row;
    int c = index.column * quads + column;
    const bool round = grid.wraps_longitude();
    if (round && c == -1) c = last - 1;
    if (round && c == last + 1 && column == quads + 1) c = 1;
    if (r < 0 || c < 0 || r > level.row.quads || c > last) return void_height_steps;
    return heights.at(level.row.region_post(r), level.column.region_post(c));
}

TEST(Page, APostHasOneHeightInEveryPageAndLevel) {
    static_assert(gpu::void_height == void_height_steps);
    static_assert(static_cast<double>(gpu::height_step_m) == height_step_m);
    for (const std::int64_t north : {47 * 1200, -20 * 1200 + 7, 90 * 1200 - 3, 90 * 1200}) {
        const HeightField field = rough_field(north, 179 * 1200 + 1100);
        const DrawnHeights heights = drawn_heights(field, 1.5, 1);
        int pages = 0;
        for_each_page(field.grid, [&](const PageIndex& index) {
            const BuiltPage page = built(field, index, 1.5);
            ++pages;
            for (int row = -1; row <= quads + 1; ++row) {
                for (int column = -1; column <= quads + 1; ++column)
                    ASSERT_EQ(height(page, row, column),
                              height_by_rule(field.grid, heights, index, row, column))
                        << index.level << ": " << row << " " << column;
            }
        });
        EXPECT_EQ(pages, 9 + 4 + 1);
    }
}

TEST(Page, PostsHaveTheSameBitsInEveryRegion) {
    HeightField whole = rough_field(47 * 1200, 8 * 1200);
    HeightField part = whole;
    part.grid.lat.first -= 31;
    part.grid.lat.count = 200;
    part.grid.lon.first += 77;
    part.grid.lon.count = 100;
    part.H_m.clear();
    for (int row = 0; row < 200; ++row) {
        for (int column = 0; column < 100; ++column)
            part.H_m.push_back(whole.H_at_post_m(row + 31, column + 77));
    }
    for (int row = 0; row < 200; ++row) {
        for (int column = 0; column < 100; ++column) {
            if (is_void(part.H_at_post_m(row, column))) continue;
            ASSERT_TRUE(
                same_bits(post_ecef(part, row, column, 2.0), post_ecef(whole, row + 31, column + 77, 2.0)));
        }
    }
}

// One degree posts over the whole Earth; the poles have one height, the antimeridian too.
HeightField whole_earth() {
    return test::world_field(1.0, 90, -180, 181, 361, [](double lat_deg, double lon_deg) {
        return std::abs(lat_deg) == 90.0 ? 500.0 : 1000.0 + 10.0 * lat_deg + 3.0 * std::abs(lon_deg);
    });
}

TEST(Page, TheWholeEarthCloses) {
    HeightField field = whole_earth();
    EXPECT_EQ(page_layout(field.grid).columns, 3);
    for (int row = 0; row < 181; ++row)
        ASSERT_TRUE(same_bits(post_ecef(field, row, 0, 1.0), post_ecef(field, row, 360, 1.0))) << row;
    for (int column = 1; column <= 360; ++column) {
        ASSERT_TRUE(same_bits(post_ecef(field, 0, 0, 1.0), post_ecef(field, 0, column, 1.0))) << column;
        ASSERT_TRUE(same_bits(post_ecef(field, 180, 0, 1.0), post_ecef(field, 180, column, 1.0))) << column;
    }
    // The apron goes round: west of the first column lies the last but one.
    const BuiltPage first = built(field, {0, 0});
    EXPECT_EQ(height(first, 10, -1), height_steps(field.h_at_post_m(10, 359)));
    const BuiltPage last = built(field, {0, 2});
    EXPECT_EQ(height(last, 10, 360 - 2 * 128 + 1), gpu::void_height) << "no triangle is drawn twice";
    EXPECT_EQ(height(first, -1, 10), gpu::void_height) << "nothing beyond the pole";
    std::uint32_t triangles = 0;
    for (int i = 0; i < 6; ++i) triangles += built(field, {i / 3, i % 3}).summary.triangles;
    EXPECT_EQ(triangles, 2U * 180U * 360U);
}

// Odd spacings, whose angles are rounded differently a whole turn on, an undulation that differs along the
// pole, and sources that give one point two heights: none of it may open the seam.
TEST(Page, TheWholeEarthClosesWhateverTheSourceSays) {
    int number = 0;
    HeightField field = test::world_field(
        7.3, 657, -100, 1315, 2629, [&](double, double) { return static_cast<double>(number++ % 977); });
    field.undulation.lat = {1.0, 0.0, 90, -1, 181};
    field.undulation.lon = {1.0, 0.0, -180, +1, 361};
    for (int i = 0; i < 181 * 361; ++i) field.undulation.N_m.push_back(static_cast<float>(i % 89));
    ASSERT_TRUE(field.grid.wraps_longitude());
    for (int row = 0; row < 1315; ++row)
        ASSERT_TRUE(same_bits(post_ecef(field, row, 0, 1.0), post_ecef(field, row, 2628, 1.0))) << row;
    for (int column = 1; column <= 2628; ++column) {
        ASSERT_TRUE(same_bits(post_ecef(field, 0, 0, 1.0), post_ecef(field, 0, column, 1.0))) << column;
        ASSERT_TRUE(same_bits(post_ecef(field, 1314, 0, 1.0), post_ecef(field, 1314, column, 1.0))) << column;
    }
    // The heights of the blocks follow: at the pole all columns of a page are one height.
    const BuiltPage page = built(field, {0, 3});
    for (int column = 0; column <= quads; ++column) EXPECT_EQ(height(page, 0, column), height(page, 0, 0));
}

TEST(Page, TheApronOfAWholePageEarthGoesRoundInTheEast) {
    // 256 columns of 1.40625 degrees: the last column is a page's last.
    const HeightField field = test::world_field(256.0 / 360.0, 20, -128, 30, 257,
                                                [](double, double lon_deg) { return std::abs(lon_deg); });
    const BuiltPage last = built(field, {0, 1});
    EXPECT_EQ(height(last, 3, 129), height_steps(field.H_at_post_m(3, 1)));
}

// The Earth in odd spacings with all that makes a post's height differ from its own column's: a pole's row
// with different H and N in its columns, the first of them void; twins of which one is void, or both.
HeightField difficult_earth() {
    std::mt19937_64 random(23);
    HeightField field = test::world_field(2.3, 207, -100, 415, 829, [&](double, double) {
        return 0.01 * static_cast<double>(random() % 500000);
    });
    const auto H_m = [&](int row, int column) -> float& {
        return field.H_m[static_cast<std::size_t>(row * 829 + column)];
    };
    for (int i = 0; i < 5000; ++i) field.H_m[random() % field.H_m.size()] = void_height_m;
    for (int column = 0; column < 7; ++column) H_m(0, column) = H_m(414, column) = void_height_m;
    for (const int row : {20, 21, 200}) H_m(row, 0) = void_height_m;
    for (const int row : {21, 22, 201}) H_m(row, 828) = void_height_m;
    field.undulation.lat = {1.0, 0.0, 90, -1, 181};
    field.undulation.lon = {1.0, 0.0, -180, +1, 361};
    for (int i = 0; i < 181 * 361; ++i)
        field.undulation.N_m.push_back(static_cast<float>(i % 89) * 1.37F - 60.0F);
    return field;
}

// Heights by way of H, as a file keeps them, are those by way of the whole region's heights, bit for bit.
TEST(Page, HeightsComeFromElevationsAsFromDrawnHeights) {
    HeightField at_pole = rough_field(90 * 1200, 179 * 1200 + 1100);
    HeightField without_N = rough_field(-20 * 1200 + 7, 8 * 1200);
    without_N.undulation = {};
    const HeightField fields[] = {difficult_earth(), std::move(at_pole), std::move(without_N)};
    std::size_t posts = 0, voids = 0;
    for (const HeightField& field : fields) {
        for (const double exaggeration : {0.0, 1.0, 1.7, 3.0e3}) {
            const DrawnHeights heights = drawn_heights(field, exaggeration, 2);
            for_each_page(field.grid, [&](const PageIndex& index) {
                const PageHeights whole = page_heights(field.grid, heights, index);
                const PageHeights from_H = page_heights(field.grid, field.undulation, exaggeration,
                                                        page_elevations(field, index), index);
                ASSERT_EQ(whole.steps, from_H.steps)
                    << index.level << ": " << index.row << " " << index.column;
                posts += whole.steps.size();
                voids += static_cast<std::size_t>(
                    std::count(whole.steps.begin(), whole.steps.end(), void_height_steps));
            });
        }
    }
    EXPECT_GT(posts, 4000000U);
    EXPECT_GT(voids, 50000U);
    EXPECT_LT(voids, posts / 2);
}

TEST(Page, ElevationsAreThoseOfTheCanonicalPost) {
    const HeightField field = difficult_earth();
    ASSERT_TRUE(field.grid.wraps_longitude());
    const PageElevations north_west = page_elevations(field, {0, 0, 0});
    const PageElevations east = page_elevations(field, {0, 6, 0});  // columns 768 .. 828
    const auto H_m = [](const PageElevations& page, int row, int column) {
        return page.H_m[static_cast<std::size_t>((row + 1) * 131 + column + 1)];
    };
    EXPECT_EQ(H_m(north_west, 0, 3), void_height_m) << "a void stays one, at a pole, too";
    EXPECT_EQ(H_m(north_west, 0, 100), field.H_at_post_m(0, 7)) << "the first that is not void";
    EXPECT_EQ(H_m(north_west, -1, 5), void_height_m);
    EXPECT_EQ(H_m(east, 5, 60), field.H_at_post_m(5, 0)) << "the last meridian is the first";
    EXPECT_EQ(H_m(east, 20, 60), field.H_at_post_m(20, 828)) << "but where that has nothing";
    EXPECT_EQ(H_m(east, 22, 60), void_height_m);
    EXPECT_EQ(H_m(east, 5, 62), void_height_m);
    EXPECT_EQ(H_m(north_west, 5, -1), field.H_at_post_m(5, 827));
}

TEST(Page, HeightsAreStepsAboveTheEllipsoid) {
    HeightField field = rough_field(47 * 1200, 8 * 1200);
    const BuiltPage page = built(field, {1, 1}, 2.0);
    EXPECT_EQ(page.summary.origin.h_m, std::round(page.summary.origin.h_m));
    EXPECT_NEAR(page.summary.origin.h_m, 0.5 * (page.summary.lowest_h_m + page.summary.highest_h_m), 0.5);
    EXPECT_NEAR(page.summary.origin.lat_deg, 47.0 - 192.0 / 1200.0, 1e-12);
    EXPECT_NEAR(page.summary.origin.lon_deg, 8.0 + 192.0 / 1200.0, 1e-12);
    for (int row = -1; row <= 129; ++row) {
        for (int column = -1; column <= 129; ++column) {
            const float H_m = field.H_at_post_m(128 + row, 128 + column);
            const double N_m = field.h_at_post_m(128 + row, 128 + column) - static_cast<double>(H_m);
            if (is_void(H_m)) {
                ASSERT_EQ(height(page, row, column), gpu::void_height);
            } else {
                // Half a step, and the rounding of N_m above.
                ASSERT_NEAR(height(page, row, column) / 2048.0, static_cast<double>(H_m) * 2.0 + N_m,
                            0.5 / 2048.0 + 1e-9);
            }
        }
    }
}

// A page of two levels: its spacing is that of the region's posts, at its own middle's latitude and height.
TEST(Page, SpacingIsThatOfTheRegionsPostsAtThePagesMiddle) {
    const HeightField field =
        test::world_field(1200.0, 47 * 1200, 8 * 1200, 300, 290, [](double, double) { return 3000.0; });
    // Radii of curvature at 46.84 N: M = 6,369,441.2 m, N = 6,389,527.0 m; 3 km more, by 3 seconds. Source:
    // Torge & Müller, Geodesy, 4th ed. 2012, eq. 4.13 and 4.14, by hand with the constants of TR8350.2.
    const BuiltPage page = built(field, {1, 1});
    EXPECT_NEAR(page.block->row_spacing_m, 92.683400, 1e-5);
    EXPECT_NEAR(page.block->column_spacing_m, 92.975536, 1e-5);
    // Per post of the region on coarse levels, too.
    const BuiltPage coarse = built(field, {0, 0, 1});
    EXPECT_NEAR(coarse.block->row_spacing_m, page.block->row_spacing_m, 0.01);
    EXPECT_NEAR(coarse.block->column_spacing_m, page.block->column_spacing_m, 0.01);
    gpu::PageBlock again;
    set_spacing(field.grid, page.summary, again);
    EXPECT_EQ(again.row_spacing_m, page.block->row_spacing_m);
    EXPECT_EQ(again.column_spacing_m, page.block->column_spacing_m);
}

// Brute force: every drawn triangle of the meshlet, its posts, from the field itself.
TEST(Page, BoundsHoldEveryTrianglesPosts) {
    const HeightField field = rough_field(47 * 1200, 179 * 1200 + 1000);
    const RegionShape shape = region_shape(field, 1.0);
    std::uint32_t all_triangles = 0;
    for (int p = 0; p < 9; ++p) {
        const BuiltPage page = built(field, {p / 3, p % 3});
        std::uint32_t triangles = 0;
        std::uint32_t meshlets = 0;
        for (int m = 0; m < 256; ++m) {
            const gpu::MeshletBounds& bounds = page.block->meshlets[m];
            std::uint32_t in_meshlet = 0;
            std::vector<glm::dvec3> posts;
            for (int q = 0; q < 64; ++q) {
                const int row = p / 3 * 128 + m / 16 * 8 + q / 8;
                const int column = p % 3 * 128 + m % 16 * 8 + q % 8;
                if (row + 1 >= field.grid.rows() || column + 1 >= field.grid.columns()) continue;
                for (int side = 0; side < 2; ++side) {
                    const PageIndex corners[] = {
                        {row, column}, {row + 1 - side, column + side}, {row + 1, column + 1}};
                    bool drawn = true;
                    for (const PageIndex& c : corners)
                        drawn = drawn && !is_void(field.H_at_post_m(c.row, c.column));
                    if (!drawn) continue;
                    ++in_meshlet;
                    for (const PageIndex& c : corners)
                        posts.push_back(post_ecef(field, c.row, c.column, 1.0).m);
                }
            }
            triangles += in_meshlet;
            meshlets += in_meshlet > 0 ? 1 : 0;
            ASSERT_EQ(bounds.radius < 0.0F, in_meshlet == 0) << m;
            const glm::dvec3 direction = page.summary.horizon.direction + glm::dvec3(bounds.horizon_offset);
            for (const glm::dvec3& post : posts) {
                const glm::dvec3 in_page =
                    glm::transpose(page.summary.ecef_from_page) * (post - page.summary.origin_ecef.m);
                ASSERT_LE(glm::length(in_page - glm::dvec3(bounds.centre)), bounds.radius);
                ASSERT_LE(glm::length(in_page - page.summary.centre_m), page.summary.radius_m);
                const glm::dvec3 scaled = shape.occluder.scaled(Ecef{post});
                const double r = glm::length(scaled);
                ASSERT_GT(r, 1.0);
                const double angle = std::acos(1.0 / r) + glm::length(glm::cross(direction, scaled)) / r;
                ASSERT_LE(angle, static_cast<double>(bounds.horizon_angle_rad) + 1e-6);
            }
            // And not much larger than needed: 8 x 8 quads of 3", 3 km of relief.
            ASSERT_LT(bounds.radius, 2000.0F);
        }
        EXPECT_EQ(page.summary.triangles, triangles);
        EXPECT_EQ(page.summary.meshlets, meshlets);
        all_triangles += triangles;
    }
    EXPECT_GT(all_triangles, 150000U);
}

TEST(Page, AVoidPageDrawsNothing) {
    const HeightField field = test::world_field(1200.0, 47 * 1200, 8 * 1200, 20, 20, [](double, double) {
        return static_cast<double>(void_height_m);
    });
    const BuiltPage page = built(field, {0, 0});
    EXPECT_EQ(page.summary.triangles, 0U);
    EXPECT_EQ(page.summary.meshlets, 0U);
    for (const gpu::MeshletBounds& bounds : page.block->meshlets) EXPECT_LT(bounds.radius, 0.0F);
    for (const int steps : page.block->heights) EXPECT_EQ(steps, gpu::void_height);
}

TEST(Page, TheSameInputGivesTheSameBytes) {
    const HeightField field = rough_field(47 * 1200, 8 * 1200);
    const BuiltPage a = built(field, {2, 2});
    BuiltPage b;
    b.summary = build_page(field, region_shape(field, 1.0), {2, 2}, *b.block);
    EXPECT_EQ(std::memcmp(a.block.get(), b.block.get(), sizeof(gpu::PageBlock)), 0);
}

TEST(RegionShape, TheOccluderLiesBelowEveryTriangle) {
    // A deep and coarse region: half a degree, down to -430 m. The deepest places of the triangles are inside
    // them.
    const HeightField field = test::world_field(2.0, 20, 60, 41, 41, [](double lat_deg, double lon_deg) {
        return -430.0 + 20.0 * std::abs(std::sin(lat_deg * 3.0 + lon_deg));
    });
    const RegionShape shape = region_shape(field, 1.0);
    double lowest = 10.0;
    for (int row = 0; row < 40; ++row) {
        for (int column = 0; column < 40; ++column) {
            const glm::dvec3 a = post_ecef(field, row, column, 1.0).m;
            const glm::dvec3 b = post_ecef(field, row + 1, column, 1.0).m;
            const glm::dvec3 c = post_ecef(field, row + 1, column + 1, 1.0).m;
            for (int i = 0; i <= 10; ++i) {
                for (int j = 0; i + j <= 10; ++j) {
                    const glm::dvec3 point = a + (b - a) * (i / 10.0) + (c - a) * (j / 10.0);
                    lowest = std::min(lowest, glm::length(shape.occluder.scaled(Ecef{point})));
                }
            }
        }
    }
    EXPECT_GT(lowest, 1.0);
    EXPECT_LT(lowest, 1.0 + 60.0 / wgs84_a_m);
    // Heights above the ellipsoid do not lift it.
    EXPECT_LT(occluder_below(500.0, 0.0).radii_m.x, wgs84_a_m);
    EXPECT_GT(occluder_below(500.0, 0.0).radii_m.x, wgs84_a_m - 0.1);
}

}  // namespace
}  // namespace oro
