// Packed heights of real data: every post of every level to the bit, in how many bytes.
#include <gtest/gtest.h>

#include <cstdio>
#include <memory>

#include "core/packed/packed_heights.h"
#include "core/terrain/page.h"
#include "geo/region/region.h"
#include "tests/support/open_grid.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

struct Count {
    std::uint64_t posts{}, voids{}, different{}, pages{}, words{};
    [[nodiscard]] double bytes_a_post() const {
        return 4.0 * static_cast<double>(words) / (static_cast<double>(pages) * 128.0 * 128.0);
    }
};

void add_page(const HeightField& field, double exaggeration, const PageIndex& index, Count& count) {
    const auto heights = std::make_unique<PageHeights>(
        page_heights(field.grid, field.undulation, exaggeration, page_elevations(field, index), index));
    const std::vector<std::uint32_t> packed = packed_heights(heights->steps, exaggeration);
    for (std::size_t i = 0; i < heights->steps.size(); ++i) {
        const std::int32_t steps = heights->steps[i];
        count.different +=
            unpacked_height(packed, i / gpu::height_stride, i % gpu::height_stride) != steps ? 1U : 0U;
        count.voids += steps == void_height_steps ? 1U : 0U;
    }
    count.posts += heights->steps.size();
    count.words += packed.size();
    ++count.pages;
}

// All pages of all levels, or nothing where the data are not there.
std::optional<Count> count_of(const char* name, double exaggeration = 1.0) {
    const auto data = test::real_data(name);
    if (!data) return std::nullopt;
    RegionRequest request;
    request.paths = {data->string()};
    const Result<RegionGrid> region = test::open_grid(request);
    EXPECT_TRUE(region.ok()) << region.error().line();
    const HeightField& field = region->field;
    Count count;
    for (int level = 0; level < level_count(field.grid); ++level) {
        const PageLayout layout = level_grid(field.grid, level).pages();
        for (int row = 0; row < layout.rows; ++row)
            for (int column = 0; column < layout.columns; ++column)
                add_page(field, exaggeration, {row, column, level}, count);
    }
    std::printf(
        "%s, heights %g times as high: %llu posts, %llu of them void, %llu differ; %.3f bytes a post\n", name,
        exaggeration, static_cast<unsigned long long>(count.posts),
        static_cast<unsigned long long>(count.voids), static_cast<unsigned long long>(count.different),
        count.bytes_a_post());
    EXPECT_EQ(count.different, 0U) << name;
    return count;
}

TEST(PackedRegion, OfTheAlpsTakesLessThanAThird) {
    const std::optional<Count> alps = count_of("alps");
    if (!alps) GTEST_SKIP() << "needs alps";
    EXPECT_GT(alps->posts, 10'000'000U);
    EXPECT_LE(alps->bytes_a_post(), 1.15);  // whole they take 4.19
}

TEST(PackedRegion, OfTheHimalayaTakesLessThanAThird) {
    const std::optional<Count> himalaya = count_of("himalaya");
    if (!himalaya) GTEST_SKIP() << "needs himalaya";
    EXPECT_GT(himalaya->posts, 10'000'000U);
    EXPECT_LE(himalaya->bytes_a_post(), 1.4);
}

// Voids, feet, floats, centimetres, nets, depths of the sea, the antimeridian, poles.
TEST(PackedRegion, OfEveryKindComesBack) {
    Count all;
    for (const auto& [name, exaggeration] : {std::pair{"extremes/N48W125.hgt.zip", 1.0},
                                             {"extremes/N44E005.hgt.zip", 1.0},
                                             {"extremes/N42E001.hgt.zip", 0.1},
                                             {"extremes/N27E086.hgt.zip", 2.0},
                                             {"extremes/ETOPO1_1deg_global.tif", 1.0},
                                             {"geotiff/N46E008_UTM32_feet_f32.tif", 1.0},
                                             {"geotiff/N46E008_EPSG2056_f32_cog.tif", 1.0},
                                             {"geotiff/vavilov_EPSG3413_f32.tif", 1.37},
                                             {"geotiff/demcompare_dem_cm.tif", 1.0},
                                             {"geotiff/fiji_antimeridian_etopo1_170_190.tif", 1.0},
                                             {"geotiff/antarctica_etopo1_EPSG3031_20km.tif", 1.0}}) {
        const std::optional<Count> one = count_of(name, exaggeration);
        if (!one) GTEST_SKIP() << "needs " << name;
        EXPECT_LE(one->bytes_a_post(), 3.3) << name;
        all.posts += one->posts;
        all.voids += one->voids;
    }
    EXPECT_GT(all.posts, 10'000'000U);
    EXPECT_GT(all.voids, 1'000'000U);
}

}  // namespace
}  // namespace oro
