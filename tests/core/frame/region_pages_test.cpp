// A region's pages in memory: what build_pyramid makes, whoever asks and whenever.
#include "core/frame/region_pages.h"

#include <gtest/gtest.h>

#include <cstring>
#include <memory>
#include <optional>
#include <thread>
#include <vector>

#include "tests/core/truth/world_field.h"
#include "tests/support/rough_terrain.h"

namespace oro {
namespace {

struct Built {
    PyramidPage page;
    gpu::PageBlock block;
};

HeightField lifted_field() {
    HeightField field = test::rough_field(47.0, 8.0, 300, 280);
    field.undulation.lat = {4.0, 0.0, 200, -1, 100};
    field.undulation.lon = {4.0, 0.0, 0, +1, 100};
    for (int i = 0; i < 10000; ++i) field.undulation.N_m.push_back(static_cast<float>(50.0 + i % 7));
    for (int row = 0; row < 140; ++row) {
        for (int column = 0; column < 150; ++column)
            field.H_m[static_cast<std::size_t>(row * 280 + column)] = void_height_m;
    }
    return field;
}

std::vector<Built> built_pages(const HeightField& field, double exaggeration) {
    std::vector<Built> pages;
    build_pyramid(field, region_shape(field, exaggeration), 1,
                  [&](const PyramidPage& page, const gpu::PageBlock& block) {
                      pages.push_back({page, block});
                  });
    return pages;
}

void expect_same(const PageSummary& a, const PageSummary& b) {
    EXPECT_EQ(a.index.row, b.index.row);
    EXPECT_EQ(a.index.column, b.index.column);
    EXPECT_EQ(a.index.level, b.index.level);
    EXPECT_EQ(a.origin_ecef.m, b.origin_ecef.m);
    EXPECT_EQ(a.ecef_from_page, b.ecef_from_page);
    EXPECT_EQ(a.centre_m, b.centre_m);
    EXPECT_EQ(a.radius_m, b.radius_m);
    EXPECT_EQ(a.triangles, b.triangles);
    EXPECT_EQ(a.lod_radius_m, b.lod_radius_m);
}

TEST(RegionPages, InMemoryGiveWhatThePyramidHas) {
    auto field = std::make_unique<HeightField>(lifted_field());
    const std::vector<Built> built = built_pages(*field, 1.7);
    ASSERT_EQ(built.size(), 9U + 4U + 1U);
    const auto pages = pages_in_memory(*field, 1.7, 2);
    std::uint64_t triangles = 0;
    for (const Built& expected : built) {
        if (expected.page.summary.index.level > 0) continue;
        triangles += expected.page.summary.triangles;
    }
    EXPECT_EQ(pages->facts().triangles, triangles);
    EXPECT_GT(triangles, 50000U);
    EXPECT_EQ(pages->facts().shape.exaggeration, 1.7);
    EXPECT_EQ(pages->facts().shape.occluder.radii_m, region_shape(*field, 1.7).occluder.radii_m);
    EXPECT_EQ(pages->facts().undulation.N_m, field->undulation.N_m);
    field.reset();  // is not needed any more

    EXPECT_EQ(pages->levels(), 3);
    EXPECT_FALSE(pages->wraps_longitude());
    EXPECT_EQ(pages->layout(0).rows, 3);
    EXPECT_EQ(pages->layout(1).columns, 2);
    EXPECT_EQ(pages->layout(2).columns, 1);
    auto block = std::make_unique<gpu::PageBlock>();
    for (const Built& expected : built) {
        const PageIndex& index = expected.page.summary.index;
        const Result<PageRecord> record = pages->record(index);
        ASSERT_TRUE(record.ok());
        expect_same(record->summary, expected.page.summary);
        EXPECT_EQ(record->reach_m, expected.page.reach_m);
        EXPECT_EQ(record->horizon.direction, expected.page.horizon.direction);
        EXPECT_EQ(record->horizon.angle_rad, expected.page.horizon.angle_rad);
        for (std::size_t i = 0; i < 4; ++i) {
            EXPECT_EQ(record->quarters[i].centre_m, expected.page.quarters[i].centre_m);
            EXPECT_EQ(record->quarters[i].lod_radius_m, expected.page.quarters[i].lod_radius_m);
            EXPECT_EQ(record->quarters[i].largest_error_m, expected.page.quarters[i].largest_error_m);
        }
        std::memset(static_cast<void*>(block.get()), 0xA5, sizeof *block);
        ASSERT_TRUE(pages->load(index, *block).ok());
        EXPECT_EQ(std::memcmp(block.get(), &expected.block, sizeof *block), 0)
            << index.level << ": " << index.row << " " << index.column;
    }
}

TEST(RegionPages, MayBeAskedFromSeveralThreads) {
    const HeightField field = lifted_field();
    const std::vector<Built> built = built_pages(field, 1.0);
    const auto pages = pages_in_memory(field, 1.0, 1);
    std::vector<int> wrong(4, 0);
    std::vector<std::thread> threads;
    for (std::size_t t = 0; t < wrong.size(); ++t) {
        threads.emplace_back([&, t] {
            auto block = std::make_unique<gpu::PageBlock>();
            for (std::size_t i = 0; i < 3 * built.size(); ++i) {
                const Built& expected = built[(i + 5 * t) % built.size()];
                const bool loaded = pages->load(expected.page.summary.index, *block).ok();
                const bool same = std::memcmp(block.get(), &expected.block, sizeof *block) == 0;
                wrong[t] += loaded && same ? 0 : 1;
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(wrong, std::vector<int>(4, 0));
}

TEST(RegionPages, TellHowFarTheyAre) {
    std::vector<double> shares;
    const auto caller = std::this_thread::get_id();
    pages_in_memory(lifted_field(), 1.0, 3, [&](double share) {
        EXPECT_EQ(std::this_thread::get_id(), caller);
        shares.push_back(share);
    });
    ASSERT_EQ(shares.size(), 14U);
    EXPECT_DOUBLE_EQ(shares.front(), 1.0 / 14.0);
    EXPECT_EQ(shares.back(), 1.0);
    for (std::size_t i = 1; i < shares.size(); ++i) EXPECT_GT(shares[i], shares[i - 1]);
}

TEST(RegionPages, GoRoundTheEarthAndMayHaveNothing) {
    const HeightField round = test::world_field(1.0, 20, -180, 30, 361, [](double, double) { return 7.0; });
    const auto pages = pages_in_memory(round, 1.0, 1);
    EXPECT_TRUE(pages->wraps_longitude());
    EXPECT_EQ(pages->facts().triangles, 2U * 29U * 360U);
    const HeightField one_post = test::world_field(1200.0, 0, 0, 1, 1, [](double, double) { return 7.0; });
    const auto nothing = pages_in_memory(one_post, 1.0, 1);
    EXPECT_EQ(nothing->levels(), 1);
    EXPECT_EQ(nothing->layout(0).rows, 0);
    EXPECT_EQ(nothing->facts().triangles, 0U);
}

}  // namespace
}  // namespace oro
