// Must hold: posts that the GPU makes for measuring have the bits of those that the CPU makes, and so all
// that is measured on them has.
#include "render/made/gpu_post_maker.h"

#include <algorithm>
#include <cstring>
#include <thread>
#include <vector>

#include "core/made/made_heights.h"
#include "core/made_pages/made_pages.h"
#include "tests/core/made_pages/made_ground.h"
#include "tests/support/gpu_fixture.h"

namespace oro {
namespace {

class GpuPosts : public test::GpuTest {
  protected:
    // Rows and columns as levels have them: not each, and poles and 180 degrees among them.
    GpuPosts() {
        made_ = made_terrain_of_tests();
        made_.octaves = 14;
        made_.cell_shift = 26;
        rule_ = made_rule(made_);
        for (int i = 0; i < 300; ++i) numbers_.push_back(i == 299 ? 2 * 90 * 1200 : i * 719);
        for (const int number : numbers_) rows_.push_back(made_row(90 * 1200 - number, made_.posts_per_deg));
        for (int i = 0; i < 517; ++i) columns_.push_back(made_column(-180 * 1200 + i * 833, 1200));
    }
    // Posts of which all or the coarse ones differ from those of the CPU; all where nothing was made.
    std::size_t posts_that_differ(MadePostMaker& maker, std::uint32_t coarse_octaves) const {
        const auto made = maker.make(rule_, rows_, columns_, coarse_octaves);
        if (!made) return rows_.size() * columns_.size();
        EXPECT_EQ(made->all.size(), rows_.size() * columns_.size());
        EXPECT_EQ(made->coarse.size(), coarse_octaves != no_coarse_octaves ? made->all.size() : 0U);
        MadeTerrain world = made_;
        world.north = 90 * 1200;
        std::vector<std::int32_t> steps(columns_.size()), coarse(columns_.size());
        std::size_t differ = 0;
        for (std::size_t row = 0; row < rows_.size(); ++row) {
            made_row_coarse_heights(world, rule_, numbers_[row], columns_,
                                    std::min(coarse_octaves, rule_.octaves), steps, coarse);
            for (std::size_t i = 0; i < steps.size(); ++i) {
                const std::size_t post = row * columns_.size() + i;
                differ += made->all[post] != steps[i] ||
                          (coarse_octaves != no_coarse_octaves && made->coarse[post] != coarse[i]);
            }
        }
        return differ;
    }

    MadeTerrain made_;
    gpu::MadeRule rule_{};
    std::vector<int> numbers_;
    std::vector<MadeRow> rows_;
    std::vector<MadeColumn> columns_;
};

TEST_F(GpuPosts, AreThoseOfTheCpu) {
    const auto maker = gpu_post_maker(*gpu_);
    for (const std::uint32_t coarse_octaves : {0U, 1U, 9U, 14U, no_coarse_octaves})
        EXPECT_EQ(posts_that_differ(*maker, coarse_octaves), 0U) << coarse_octaves;
    columns_.resize(3);  // fewer than its buffers hold
    EXPECT_EQ(posts_that_differ(*maker, 5), 0U);
}

TEST_F(GpuPosts, AreForOneThreadAndForFbm) {
    const auto maker = gpu_post_maker(*gpu_);
    bool is_made = true;
    std::jthread([&] {
        is_made = maker->make(rule_, rows_, columns_, no_coarse_octaves).has_value();
    }).join();
    EXPECT_FALSE(is_made);
    rule_.kind = gpu::made_ridged;
    EXPECT_FALSE(maker->make(rule_, rows_, columns_, no_coarse_octaves).has_value());
}

// Counts what is asked of another.
class CountedMaker : public MadePostMaker {
  public:
    explicit CountedMaker(std::shared_ptr<MadePostMaker> maker) : maker_(std::move(maker)) {}
    std::optional<MadeSteps> make(const gpu::MadeRule& rule, std::span<const MadeRow> rows,
                                  std::span<const MadeColumn> columns,
                                  std::uint32_t coarse_octaves) override {
        auto made = maker_->make(rule, rows, columns, coarse_octaves);
        if (made) posts += made->all.size();
        return made;
    }
    std::size_t posts{};

  private:
    std::shared_ptr<MadePostMaker> maker_;
};

TEST_F(GpuPosts, MeasureTheSamePages) {
    const HeightField field = made_ground();
    const auto by_gpu = made_posts_of(field)->pages(field);
    const auto counted = std::make_shared<CountedMaker>(gpu_post_maker(*gpu_));
    make_posts_by(*by_gpu, counted);
    const auto block = std::make_unique<gpu::PageBlock>(), true_block = std::make_unique<gpu::PageBlock>();
    int pages = 0;
    for (const PageIndex page : {PageIndex{0, 0, 4}, {1, 1, 3}, {3, 2, 2}, {15, 15, 0}}) {
        ASSERT_TRUE(by_gpu->record(page).ok());
        ASSERT_TRUE(by_gpu->load(page, *block).ok());
        ASSERT_TRUE(pages_for_any().load(page, *true_block).ok());
        pages += std::memcmp(block.get(), true_block.get(), sizeof *block) == 0 ? 1 : 0;
    }
    EXPECT_EQ(pages, 4);
    EXPECT_GT(counted->posts, 1'000'000U);
}

}  // namespace
}  // namespace oro
