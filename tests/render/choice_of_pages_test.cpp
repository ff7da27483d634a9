// Pages chosen by the device: those of the processor's plan, in its order, of eyes in motion, whatever is
// missing.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <memory>
#include <random>
#include <vector>

#include "core/frame/chosen_pages.h"
#include "core/frame/plan_memory.h"
#include "render/pipelines/choice_pass.h"
#include "render/pipelines/plan_pass.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/rough_terrain.h"

namespace oro {
namespace {

constexpr double posts_per_deg = 100.0, first_north_deg = 47.0, first_west_deg = 8.0;

// Flies on over so many degrees of the fields of the test, or begins anew.
class WanderingEye {
  public:
    WanderingEye(std::uint64_t seed, double down_deg, double right_deg)
        : random_(seed), down_deg_(down_deg), right_deg_(right_deg) {}
    FrameView next() {
        if (count_++ % 10 == 0) begin();
        Camera& camera = view_.camera;
        const double step_deg = 3.0e-6 * std::abs(camera.eye.h_m) * between(0.0, 1.0);
        camera.eye.lat_deg += step_deg * between(-1.0, 1.0);
        camera.eye.lon_deg += step_deg * between(-1.0, 1.0);
        camera.eye.h_m *= 1.0 + 0.05 * between(-1.0, 1.0);
        camera.attitude.heading_deg += between(-6.0, 6.0);
        return view_;
    }
    double between(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random_);
    }

  private:
    // From below the mountains' tops to far above the region, which is then a small part of the picture.
    void begin() {
        Camera camera;
        camera.width_px = static_cast<int>(between(64.0, 2000.0));
        camera.height_px = static_cast<int>(between(64.0, 1200.0));
        camera.vertical_fov_deg = between(5.0, 90.0);
        camera.eye = {first_north_deg - between(-0.1, 1.1) * down_deg_,
                      first_west_deg + between(-0.1, 1.1) * right_deg_, 600.0 * std::exp(between(0.0, 6.0))};
        const bool looks_far = count_ % 20 == 1;
        camera.attitude = {between(0.0, 360.0), looks_far ? between(-15.0, 5.0) : between(-90.0, -15.0),
                           between(-20.0, 20.0)};
        view_ = {
            camera, {0, 0, camera.width_px, camera.height_px, {0.5, 0.5}}, std::exp(between(-3.0, 1.5)), {}};
    }
    std::mt19937_64 random_;
    double down_deg_, right_deg_;
    FrameView view_;
    int count_{};
};

// Some pages are on the GPU and some are hidden: by their places and a salt alone.
struct Chance {
    std::uint64_t salt;
    double share;
    bool operator()(const PageIndex& page) const {
        std::uint64_t x = salt + static_cast<std::uint64_t>(page.row) * 0x9e3779b97f4a7c15ULL +
                          static_cast<std::uint64_t>(page.column) * 0xc2b2ae3d27d4eb4fULL +
                          static_cast<std::uint64_t>(page.level) * 0x165667b19e3779f9ULL;
        x = (x ^ x >> 31U) * 0xbf58476d1ce4e5b9ULL;
        return static_cast<double>((x ^ x >> 27U) >> 11U) < share * 9007199254740992.0;
    }
};

constexpr std::size_t room = 4096;  // for the pages of a frame

template <class Value>
std::vector<Value> values_of(const Buffer& buffer, std::size_t count) {
    std::vector<Value> values(count);
    if (count > 0) std::memcpy(values.data(), buffer.mapped, count * sizeof(Value));
    return values;
}

// One grid, chosen on both sides.
class ChosenGrid {
  public:
    ChosenGrid(const Gpu& gpu, std::unique_ptr<RegionPages> pages)
        : pages_(std::move(pages)), memory_(*pages_), numbers_(*pages_), blocks_(numbers_.page_count()) {
        const std::size_t count = numbers_.page_count();
        records_ = made(gpu, count * sizeof(gpu::ChoicePage));
        const std::span records(reinterpret_cast<gpu::ChoicePage*>(records_.mapped), count);
        const auto filled = fill_choice_records(*pages_, numbers_, records);
        EXPECT_TRUE(filled.ok()) << filled.error().line();
        terms_ = made(gpu, sizeof(gpu::ChoiceTerms));
        blocks_on_device_ = made(gpu, count * sizeof(gpu::uvec2));
        changes_ = made(gpu, count * sizeof(gpu::BlockChange));
        ratings_ = made(gpu, count * sizeof(gpu::uint));
        slots_ = made(gpu, count * sizeof(gpu::uint));
        counts_ = made(gpu, sizeof(gpu::ChoiceCounts));
        wanted_ = made(gpu, room * sizeof(gpu::WantedPage));
        frame_pages_ = made(gpu, room * sizeof(gpu::FramePage));
        made_numbers_ =
            made(gpu, (room + numbers_.row_count() + numbers_.column_count()) * sizeof(gpu::uint));
    }

    GridPlan planned(const FrameView& view, const Chance& here, const Chance& hidden) {
        auto plan = plan_grid(
            memory_, [&](const PageIndex& page) { return here(page) ? address_of(page) : 0; }, view, {},
            gpu::shading_spacing_px, hidden);
        EXPECT_TRUE(plan.ok()) << plan.error().line();
        return std::move(plan).value();
    }

    // The device knows only what has changed since the last eye.
    void choose(const Gpu& gpu, const ChoicePass& pass, Commands& commands, const FrameView& view,
                const Chance& here) {
        gpu::ChoiceTerms terms = choice_terms(*pages_, numbers_, view, ModelView(view.camera, view.model, {}),
                                              gpu::shading_spacing_px);
        auto* const changes = reinterpret_cast<gpu::BlockChange*>(changes_.mapped);
        for (std::uint32_t number = 0; number < numbers_.page_count(); ++number) {
            const PageIndex page = numbers_.page(number);
            const std::uint64_t address = here(page) ? address_of(page) : 0;
            if (address == blocks_[number]) continue;
            blocks_[number] = address;
            changes[terms.change_count++] = {number, 0, address_words(address)};
        }
        terms.capacity = room;
        terms.records = address_words(records_.address);
        terms.blocks = address_words(blocks_on_device_.address);
        terms.changes = address_words(changes_.address);
        terms.ratings = address_words(ratings_.address);
        terms.slots = address_words(slots_.address);
        terms.counts = address_words(counts_.address);
        terms.wanted = address_words(wanted_.address);
        terms.pages = address_words(frame_pages_.address);
        terms.numbers = address_words(made_numbers_.address);
        std::memcpy(terms_.mapped, &terms, sizeof(terms));
        std::memset(counts_.mapped, 0, sizeof(gpu::ChoiceCounts));
        const auto run = commands.run(gpu, [&](VkCommandBuffer recorded) {
            pass.record(recorded, terms, terms_.address);
            ChoicePass::record_end(recorded);
            memory_barrier(recorded, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                           VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT, VK_PIPELINE_STAGE_2_HOST_BIT,
                           VK_ACCESS_2_HOST_READ_BIT);
        });
        ASSERT_TRUE(run.ok()) << run.error().line();
    }

    void expect_same(const GridPlan& plan, const Chance& hidden) const {
        const gpu::ChoiceCounts counts = this->counts();
        const auto wanted = values_of<gpu::WantedPage>(wanted_, counts.wanted);
        const ChosenPages chosen = chosen_pages(numbers_, counts, wanted, hidden);
        ASSERT_TRUE(chosen.is_whole);
        ASSERT_EQ(counts.undecided, 0U);
        ASSERT_EQ(chosen.page_indices, plan.page_indices);
        ASSERT_EQ(chosen.missing, plan.missing);
        ASSERT_EQ(chosen.missing_hidden, plan.missing_hidden);
        ASSERT_EQ(chosen.hidden, plan.hidden);
        ASSERT_EQ(chosen.pages_wanted, plan.pages_wanted);
        ASSERT_EQ(chosen.pages_beyond_frustum, plan.pages_beyond_frustum);
        ASSERT_EQ(chosen.pages_beyond_horizon, plan.pages_beyond_horizon);
        expect_same_pages(plan);
    }

    [[nodiscard]] gpu::ChoiceCounts counts() const {
        return values_of<gpu::ChoiceCounts>(counts_, 1).front();
    }

  private:
    static Buffer made(const Gpu& gpu, std::size_t size) {
        auto buffer = create_buffer(
            gpu, size, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT,
            MemoryKind::readback, "choice");
        EXPECT_TRUE(buffer.ok()) << buffer.error().line();
        std::memset(buffer->mapped, 0, size);
        return std::move(buffer).value();
    }
    // Of no memory: the choice reads none.
    [[nodiscard]] std::uint64_t address_of(const PageIndex& page) const {
        return (std::uint64_t{numbers_.of(page)} + 1) << 20U;
    }
    // What the frame draws them by, but for their places, and for where their rows and columns lie.
    void expect_same_pages(const GridPlan& plan) const {
        const auto pages = values_of<gpu::FramePage>(frame_pages_, plan.pages.size());
        const auto numbers = values_of<gpu::uint>(
            made_numbers_, numbers_.row_count() + numbers_.column_count() + plan.pages.size());
        for (std::size_t i = 0; i < pages.size(); ++i) {
            const gpu::FramePage &page = pages[i], &expected = plan.pages[i];
            const PageIndex& index = plan.page_indices[i];
            const gpu::uint row = numbers_.row(index), column = numbers_.row_count() + numbers_.column(index);
            ASSERT_EQ(numbers[row], numbers_.row(index));
            ASSERT_EQ(numbers[column], numbers_.column(index));
            ASSERT_EQ(numbers[numbers_.row_count() + numbers_.column_count() + i], numbers_.of(index));
            ASSERT_EQ(page.row_terms, gpu::page_posts * numbers_.row(index));
            ASSERT_EQ(page.column_terms, gpu::page_posts * numbers_.column(index));
            // Where the frustum hides none of a page the device finds that with its place.
            ASSERT_EQ(page.cull, expected.cull | gpu::cull_by_frustum);
            ASSERT_EQ(page.block, expected.block);
            ASSERT_EQ(page.means, expected.means);
            ASSERT_EQ(page.places, expected.places);
            ASSERT_EQ(page.level, expected.level);
            ASSERT_EQ(page.first_row, expected.first_row);
            ASSERT_EQ(page.first_column, expected.first_column);
            ASSERT_EQ(page.quarter, expected.quarter);
            ASSERT_EQ(page.parent, expected.parent);
            for (std::size_t side = 0; side < 4; ++side) {
                ASSERT_EQ(page.neighbours[side], expected.neighbours[side]);
                ASSERT_EQ(page.children[side], expected.children[side]);
            }
            ASSERT_EQ(page.last_column, expected.last_column);
            ASSERT_EQ(page.west_column, expected.west_column);
            ASSERT_EQ(page.fallback_quarters, expected.fallback_quarters);
        }
    }

    std::unique_ptr<RegionPages> pages_;
    PlanMemory memory_;
    PageNumbers numbers_;
    std::vector<std::uint64_t> blocks_;
    Buffer records_, terms_, blocks_on_device_, changes_, ratings_, slots_, counts_, wanted_, frame_pages_,
        made_numbers_;
};

class ChoiceOfPages : public test::GpuTest {
  protected:
    // Grids side by side, each of so many posts.
    void expect_same(int grids, int rows, int columns, int eyes, std::uint64_t seed) {
        if (!PlanPass::can_run(*gpu_)) GTEST_SKIP() << "the device has no doubles";
        std::printf("seed %llu\n", static_cast<unsigned long long>(seed));
        auto pass = ChoicePass::create(*gpu_);
        ASSERT_TRUE(pass.ok()) << pass.error().line();
        auto commands = Commands::create(*gpu_, "choice");
        ASSERT_TRUE(commands.ok()) << commands.error().line();
        std::vector<std::unique_ptr<ChosenGrid>> chosen;
        for (int grid = 0; grid < grids; ++grid) {
            const HeightField field =
                test::made_field(first_north_deg, first_west_deg + grid * (columns - 6) / posts_per_deg,
                                 posts_per_deg, rows, columns, test::rough_H_m);
            chosen.push_back(std::make_unique<ChosenGrid>(*gpu_, pages_in_memory(field, 1.0, 2)));
        }
        WanderingEye eye(seed, rows / posts_per_deg, grids * columns / posts_per_deg);
        std::size_t pages = 0, missing = 0, frustum = 0, horizon = 0, most = 0;
        for (int i = 0; i < eyes; ++i) {
            const FrameView view = eye.next();
            constexpr double shares[] = {1.0, 0.97, 0.8, 0.4, 1.0};
            const Chance here{seed + static_cast<std::uint64_t>(i / 2), shares[i % 5]},
                hidden{seed * 3 + static_cast<std::uint64_t>(i), 0.3};
            for (auto& grid : chosen) {
                const GridPlan plan = grid->planned(view, here, hidden);
                grid->choose(*gpu_, *pass, *commands, view, here);
                grid->expect_same(plan, hidden);
                if (HasFatalFailure()) FAIL() << "eye " << i;
                pages += plan.pages.size();
                missing += plan.missing.size();
                frustum += plan.pages_beyond_frustum;
                horizon += plan.pages_beyond_horizon;
                most = std::max(most, plan.pages_wanted);
            }
        }
        std::printf(
            "%d eyes: %zu pages, at most %zu at once; %zu missing, %zu beyond the frustum, %zu beyond the "
            "horizon\n",
            eyes, pages, most, missing, frustum, horizon);
        // Or the eyes see nothing.
        EXPECT_GT(pages, 5U * static_cast<std::size_t>(eyes));
        EXPECT_GT(missing, static_cast<std::size_t>(eyes));
        EXPECT_GT(frustum, static_cast<std::size_t>(eyes));
        EXPECT_GT(horizon, static_cast<std::size_t>(eyes) / 10);
    }
};

TEST_F(ChoiceOfPages, IsThatOfTheProcessorsPlan) {
    expect_same(1, 1000, 1400, 60, 61);
}

TEST_F(ChoiceOfPages, IsThatOfTheProcessorsPlanOfTwoGrids) {
    expect_same(2, 700, 700, 40, 62);
}

// In tests/long.cmake.
class ChoiceOfPagesLong : public ChoiceOfPages {};
TEST_F(ChoiceOfPagesLong, IsThatOfTheProcessorsPlanAt500Eyes) {
    expect_same(1, 1800, 2400, 500, 6100);
}
TEST_F(ChoiceOfPagesLong, IsThatOfTheProcessorsPlanOfTwoGridsAt500Eyes) {
    expect_same(2, 1800, 1200, 500, 6200);
}

}  // namespace
}  // namespace oro
