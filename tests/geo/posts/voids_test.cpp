#include "geo/posts/voids.h"

#include <gtest/gtest.h>

#include "tests/geo/written_terrain.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

using namespace test;

TEST(Voids, FilledByTheNamedMethodAndCounted) {
    const auto folder = scratch_folder();
    const auto plane = [](int r, int c) { return 1000 + r / 4 + c / 2; };
    RegionRequest request = request_for({write_hgt(folder / "N46E008.hgt", 1201, [&](int r, int c) {
        return r >= 500 && r < 520 && c >= 300 && c < 330 ? -32768 : plane(r, c);
    })});
    const auto holes = opened(request);
    request.fill_voids = true;
    const auto filled = opened(request);
    ASSERT_TRUE(holes && filled);
    EXPECT_EQ(holes->voids, 600U);
    EXPECT_EQ(holes->filled, 0U);
    EXPECT_EQ(holes->void_method, VoidMethod::holes);
    EXPECT_TRUE(is_void(holes->field.H_at_post_m(510, 310)));
    EXPECT_EQ(filled->voids, 0U);
    EXPECT_EQ(filled->filled, 600U);
    EXPECT_EQ(filled->void_method, VoidMethod::filled);
    for (int r = 500; r < 520; ++r) {
        for (int c = 300; c < 330; ++c) {
            EXPECT_NEAR(static_cast<double>(filled->field.H_at_post_m(r, c)), plane(r, c),
                        15.0);  // no pit, no 0 m
        }
    }
    EXPECT_EQ(filled->field.H_at_post_m(499, 310), holes->field.H_at_post_m(499, 310));
}

TEST(Voids, WhatNoSourceCoversStaysAHole) {
    const auto folder = scratch_folder();
    write_hgt(folder / "N10E020.hgt", 1201, [](int r, int c) { return r == 5 && c == 5 ? -32768 : 100; });
    write_hgt(folder / "N10E022.hgt", 1201, [](int, int) { return 100; });
    RegionRequest request = request_for({folder.string()});
    request.fill_voids = true;
    const auto region = opened(request);
    ASSERT_TRUE(region);
    EXPECT_EQ(region->filled, 1U);
    EXPECT_EQ(region->voids, 1199U * 1201U);
    EXPECT_TRUE(is_void(region->field.H_at_m(10.5, 21.001)));
}

TEST(Voids, RealHalfVoidTile) {
    const auto file = real_data("extremes/N44E005.hgt.zip");
    if (!file) GTEST_SKIP() << "needs extremes/N44E005.hgt.zip";
    RegionRequest request = request_for({file->string()});
    request.fill_voids = true;
    const auto region = opened(request);
    ASSERT_TRUE(region);
    EXPECT_EQ(region->filled + region->voids, 4822U);
    EXPECT_GT(region->filled, 4800U);
    EXPECT_GE(height_range(region->field).lowest_m, 32.0F);
    EXPECT_LE(height_range(region->field).highest_m, 2757.0F);
}

}  // namespace
}  // namespace oro
