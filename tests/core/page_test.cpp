#include "core/page.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <memory>
#include <random>
#include <vector>

#include "tests/core/world_field.h"

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

const gpu::BorderPost& rim(const BuiltPage& page, int row, int column) {
    return page.block
        ->borders[gpu::border_index_cpu(static_cast<std::uint32_t>(row), static_cast<std::uint32_t>(column))];
}
float dh(const BuiltPage& page, int row, int column) {
    return page.block->dh[(row + 1) * 131 + column + 1];
}
bool same_bits(const gpu::BorderPost& a, const gpu::BorderPost& b) {
    return std::memcmp(&a, &b, sizeof a) == 0;
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

TEST(Page, BorderIndexIsOneToOne) {
    std::vector<int> uses(gpu::border_posts, 0);
    for (std::uint32_t row = 0; row <= gpu::page_quads; ++row) {
        for (std::uint32_t column = 0; column <= gpu::page_quads; ++column) {
            if (row % gpu::page_quads != 0 && column % gpu::page_quads != 0) continue;
            ++uses.at(gpu::border_index_cpu(row, column));
        }
    }
    for (const int count : uses) EXPECT_EQ(count, 1);
}

TEST(Page, RimPostsHaveTheSameBitsInEveryPage) {
    for (const std::int64_t north : {47 * 1200, -20 * 1200 + 7, 90 * 1200 - 3}) {
        const HeightField field = rough_field(north, 179 * 1200 + 1100);
        const PageLayout layout = page_layout(field.grid);
        std::vector<BuiltPage> pages;
        for (int i = 0; i < layout.rows * layout.columns; ++i)
            pages.push_back(built(field, {i / layout.columns, i % layout.columns}, 1.5));
        const auto page = [&](int row, int column) -> const BuiltPage& {
            return pages[static_cast<std::size_t>(row * layout.columns + column)];
        };
        for (int row = 0; row < layout.rows; ++row) {
            for (int column = 0; column < layout.columns; ++column) {
                for (int i = 0; i <= quads; ++i) {
                    const bool above = row == 0 || same_bits(rim(page(row, column), 0, i),
                                                             rim(page(row - 1, column), quads, i));
                    const bool left = column == 0 || same_bits(rim(page(row, column), i, 0),
                                                               rim(page(row, column - 1), i, quads));
                    ASSERT_TRUE(above && left) << row << " " << column << " " << i;
                }
                ASSERT_TRUE(
                    row == 0 || column == 0 ||
                    same_bits(rim(page(row, column), 0, 0), rim(page(row - 1, column - 1), quads, quads)));
            }
        }
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
    EXPECT_NEAR(dh(first, 10, -1) + first.block->h0_m, field.h_at_post_m(10, 359), 1e-3);
    const BuiltPage last = built(field, {0, 2});
    EXPECT_EQ(dh(last, 10, 360 - 2 * 128 + 1), gpu::void_dh_m) << "no triangle is drawn twice";
    EXPECT_EQ(dh(first, -1, 10), gpu::void_dh_m) << "nothing beyond the pole";
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
    ASSERT_TRUE(field.grid.goes_round());
    for (int row = 0; row < 1315; ++row)
        ASSERT_TRUE(same_bits(post_ecef(field, row, 0, 1.0), post_ecef(field, row, 2628, 1.0))) << row;
    for (int column = 1; column <= 2628; ++column) {
        ASSERT_TRUE(same_bits(post_ecef(field, 0, 0, 1.0), post_ecef(field, 0, column, 1.0))) << column;
        ASSERT_TRUE(same_bits(post_ecef(field, 1314, 0, 1.0), post_ecef(field, 1314, column, 1.0))) << column;
    }
    // The heights of the blocks follow: at the pole all columns of a page are one height.
    const BuiltPage page = built(field, {0, 3});
    for (int column = 0; column <= quads; ++column) EXPECT_EQ(dh(page, 0, column), dh(page, 0, 0));
}

TEST(Page, TheApronOfAWholePageEarthGoesRoundInTheEast) {
    // 256 columns of 1.40625 degrees: the last column is a page's last.
    const HeightField field = test::world_field(256.0 / 360.0, 20, -128, 30, 257,
                                                [](double, double lon_deg) { return std::abs(lon_deg); });
    const BuiltPage last = built(field, {0, 1});
    EXPECT_NEAR(dh(last, 3, 129) + last.block->h0_m, field.H_at_post_m(3, 1), 1e-3);
}

TEST(Page, HeightsAreRelativeToAWholeMetreInTheMiddle) {
    HeightField field = rough_field(47 * 1200, 8 * 1200);
    const BuiltPage page = built(field, {1, 1}, 2.0);
    EXPECT_EQ(page.summary.origin.h_m, std::round(page.summary.origin.h_m));
    EXPECT_EQ(page.block->h0_m, static_cast<float>(page.summary.origin.h_m));
    EXPECT_EQ(page.block->exaggeration, 2.0F);
    EXPECT_NEAR(page.summary.origin.h_m, 0.5 * (page.summary.lowest_h_m + page.summary.highest_h_m), 0.5);
    EXPECT_NEAR(page.summary.origin.lat_deg, 47.0 - 192.0 / 1200.0, 1e-12);
    EXPECT_NEAR(page.summary.origin.lon_deg, 8.0 + 192.0 / 1200.0, 1e-12);
    for (int row = -1; row <= 129; ++row) {
        for (int column = -1; column <= 129; ++column) {
            const float H_m = field.H_at_post_m(128 + row, 128 + column);
            const double N_m = field.h_at_post_m(128 + row, 128 + column) - static_cast<double>(H_m);
            const double expected = static_cast<double>(H_m) * 2.0 + N_m - page.summary.origin.h_m;
            if (is_void(H_m)) {
                ASSERT_EQ(dh(page, row, column), gpu::void_dh_m);
            } else {
                ASSERT_NEAR(dh(page, row, column), expected, 3e-4);
            }
        }
    }
    const auto N_at = [&](int row, int column) {
        return field.undulation.at_m(field.grid.lat.at_deg(row), field.grid.lon.at_deg(column));
    };
    EXPECT_NEAR(page.block->N_m[0], N_at(128, 128), 1e-5);
    EXPECT_NEAR(page.block->N_m[1], N_at(128, 256), 1e-5);
    EXPECT_NEAR(page.block->N_m[2], N_at(256, 128), 1e-5);
    EXPECT_NEAR(page.block->N_m[3], N_at(256, 256), 1e-5);
    // A 3" row at 46.84 N: the meridian's radius there is 6,369.3 km.
    EXPECT_NEAR(page.block->row_spacing_m, meridian_radius_m(46.84) * 3.0 / 3600.0 * 0.0174532925, 0.1);
    EXPECT_FLOAT_EQ(page.block->column_spacing_rad, 1.4544411e-5F);
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
    for (const float dh_m : page.block->dh) EXPECT_EQ(dh_m, gpu::void_dh_m);
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
