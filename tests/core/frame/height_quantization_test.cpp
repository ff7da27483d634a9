// Heights in 16 bits: the finest steps that hold a range, and nothing lost but half a step.
#include "core/frame/height_quantization.h"

#include <gtest/gtest.h>

#include <random>

#include "core/frame/region_pages.h"
#include "tests/support/made_terrain.h"

namespace oro {
namespace {

TEST(HeightQuantization, StepsAreTheFinestThatHoldTheRange) {
    EXPECT_EQ(sixteen_bits(0, 0).shift, 0);
    EXPECT_EQ(sixteen_bits(-32767, 32767).shift, 0);  // 65,534 steps
    EXPECT_EQ(sixteen_bits(-32767, 32768).shift, 1);
    // 32 m fit 2^-11 m, 9,000 m 2^-2 m.
    EXPECT_EQ(sixteen_bits(height_steps(400.0), height_steps(431.9)).step_m(), 1.0 / 2048.0);
    EXPECT_EQ(sixteen_bits(height_steps(0.0), height_steps(8849.0)).step_m(), 0.25);
    EXPECT_EQ(sixteen_bits(-highest_height_steps, highest_height_steps).shift, 16);
    EXPECT_EQ(HeightQuantization{}.error_m(), 0.0);
}

TEST(HeightQuantization, HeightsComeBackWithinHalfAStep) {
    constexpr unsigned seed = 73;
    std::mt19937_64 random(seed);
    for (int i = 0; i < 200; ++i) {
        const auto between = [&](std::int64_t low, std::int64_t high) {
            return static_cast<std::int32_t>(
                low + static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(high - low + 1)));
        };
        const std::int32_t lowest = between(-highest_height_steps, highest_height_steps);
        const std::int32_t highest =
            between(lowest, std::min<std::int64_t>(highest_height_steps,
                                                   std::int64_t{lowest} + (std::int64_t{1} << (i % 31))));
        const HeightQuantization coding = sixteen_bits(lowest, highest);
        const std::int64_t half = (std::int64_t{1} << coding.shift) / 2;
        for (int j = 0; j < 1000; ++j) {
            const std::int32_t steps = j == 0 ? lowest : j == 1 ? highest : between(lowest, highest);
            const std::int16_t code = coding.code(steps);
            ASSERT_NE(code, HeightQuantization::void_code);
            ASSERT_LE(std::abs(std::int64_t{coding.steps(code)} - steps), half)
                << "seed " << seed << ": " << steps << " of " << lowest << " to " << highest;
        }
    }
    EXPECT_EQ(sixteen_bits(0, 100).code(void_height_steps), HeightQuantization::void_code);
    EXPECT_EQ(sixteen_bits(0, 100).steps(HeightQuantization::void_code), void_height_steps);
}

TEST(HeightQuantization, ARegionsOwn) {
    HeightField field = test::made_field(47.0, 8.0, 1200.0, 300, 200, [](double lat_deg, double) {
        return static_cast<float>(2000.0 + 1500.0 * std::sin(40.0 * lat_deg));
    });
    field.H_m[5000] = void_height_m;
    field.H_m[7] = -200.0F;
    field.H_m[59999] = 4200.0F;
    const auto pages = pages_in_memory(field, 1.0, 2);
    const auto coding = height_quantization(*pages, HeightStorage::i16);
    ASSERT_TRUE(coding.ok());
    EXPECT_TRUE(coding->sixteen);
    EXPECT_EQ(coding->step_m(), 0.125);  // 65,534 steps of half that hold 4,095.9 m, not 4,400
    EXPECT_NEAR(coding->offset_steps * height_step_m, 2000.0, 1e-3);
    EXPECT_FALSE(height_quantization(*pages, HeightStorage::f32)->sixteen);
}

// 65,536 x 65,536 pages, whose number is 0 in 32 bits; none can be read.
class UnreadablePages : public RegionPages {
  public:
    UnreadablePages() : RegionPages(facts_of_many()) {}
    [[nodiscard]] Result<PageRecord> record(const PageIndex& /*page*/) const override {
        return Error{ErrorKind::failed, "many.oro", "is damaged"};
    }
    Result<void> load(const PageIndex& /*page*/, gpu::PageBlock& /*block*/) const override {
        return Error{ErrorKind::failed, "many.oro", "is damaged"};
    }

  private:
    static RegionFacts facts_of_many() {
        RegionFacts facts;
        facts.grid.lat = {1.0e5, 47.0, 0, -1, (1 << 23) + 1};
        facts.grid.lon = {1.0e5, 8.0, 0, +1, (1 << 23) + 1};
        return facts;
    }
};

TEST(HeightQuantization, AsksForMorePagesThanAnIntHolds) {
    const auto coding = height_quantization(UnreadablePages(), HeightStorage::i16);
    ASSERT_FALSE(coding.ok());
    EXPECT_EQ(coding.error().line(), "many.oro: is damaged");
}

}  // namespace
}  // namespace oro
