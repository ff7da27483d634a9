// Must hold: plans that do not wait for records ask for none that takes long, draw what plans draw that wait
// and lack the same pages, and come to the same frame; and records that are made ahead of a picture are all
// that it asks for.
#include "core/frame/records_ahead.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <random>
#include <set>
#include <vector>

#include "core/frame/plan_memory.h"
#include "tests/core/truth/world_field.h"

namespace oro {
namespace {

// 9 x 9 pages of 3" posts, and 4 levels above them.
const RegionPages& pages_in_ram() {
    static const HeightField field =
        test::world_field(1200.0, 47 * 1200, 8 * 1200, 1100, 1100, [](double lat_deg, double lon_deg) {
            return 1500.0 + 1000.0 * std::sin(lat_deg * 90.0) * std::cos(lon_deg * 70.0);
        });
    static const std::unique_ptr<RegionPages> pages = pages_in_memory(field, 1.0, 2);
    return *pages;
}

// The same pages, whose records take long until they are loaded. Where they lie is known.
class SlowPages : public RegionPages {
  public:
    SlowPages() : RegionPages(pages_in_ram().facts()) {}
    [[nodiscard]] Result<PageRecord> record(const PageIndex& page) const override {
        if (!known.contains(page)) ++waited_for;
        known.insert(page);
        return pages_in_ram().record(page);
    }
    [[nodiscard]] bool knows_record(const PageIndex& page) const override { return known.contains(page); }
    [[nodiscard]] std::optional<PageBound> bound(const PageIndex& page) const override {
        const PageRecord record = pages_in_ram().record(page).value();
        const PageSummary& summary = record.summary;
        return PageBound{{summary.origin_ecef.m + summary.ecef_from_page * summary.centre_m},
                         record.reach_m,
                         record.horizon};
    }
    Result<void> load(const PageIndex& page, gpu::PageBlock& block) const override {
        known.insert(page);
        return pages_in_ram().load(page, block);
    }
    mutable std::set<PageIndex> known;
    mutable int waited_for{};
};

FrameView some_view(std::mt19937_64& random) {
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    Camera camera;
    camera.width_px = 400;
    camera.height_px = 300;
    camera.eye = {46.5 + 0.5 * unit(random), 8.5 + 0.5 * unit(random), 3000.0 + 500.0 * unit(random)};
    camera.attitude = {180.0 * unit(random), -15.0 + 10.0 * unit(random), 0.0};
    return {camera, {0, 0, 400, 300, {0.5, 0.5}}, 1.0};
}

void expect_same_frame(const GridPlan& found, const GridPlan& expected) {
    ASSERT_EQ(found.page_indices, expected.page_indices);
    for (std::size_t i = 0; i < found.pages.size(); ++i) {
        const gpu::FramePage &one = found.pages[i], &other = expected.pages[i];
        EXPECT_EQ(one.fallback_quarters, other.fallback_quarters);
        EXPECT_EQ(one.parent, other.parent);
        for (int side = 0; side < 4; ++side) {
            EXPECT_EQ(one.neighbours[side], other.neighbours[side]);
            EXPECT_EQ(one.children[side], other.children[side]);
        }
    }
}

TEST(RecordsThatTakeLong, AreNotWaitedForAndMissingUntilTheyAreLoaded) {
    std::mt19937_64 random(53);
    std::size_t steps = 0;
    for (int eye = 0; eye < 10; ++eye) {
        const FrameView view = some_view(random);
        const SlowPages slow;
        PlanMemory memory(slow), waiting(pages_in_ram());
        memory.wait_for_records(false);
        std::set<PageIndex> here;
        const Residency residency = [&](const PageIndex& page) {
            return std::uint64_t{here.contains(page) ? 1U : 0U};
        };
        for (;; ++steps) {
            const auto plan = plan_grid(memory, residency, view);
            const auto expected = plan_grid(waiting, residency, view);
            ASSERT_TRUE(plan.ok() && expected.ok());
            expect_same_frame(*plan, *expected);
            if (plan->missing.empty()) {
                EXPECT_TRUE(expected->missing.empty());
                EXPECT_EQ(plan->pages_wanted, expected->pages_wanted);
                break;
            }
            // They come in any order, some at a time.
            std::vector<PageIndex> missing = plan->missing;
            std::ranges::shuffle(missing, random);
            missing.resize(std::min<std::size_t>(missing.size(), 3));
            for (const PageIndex& page : missing) {
                const auto block = std::make_unique<gpu::PageBlock>();
                ASSERT_TRUE(slow.load(page, *block).ok());
                here.insert(page);
            }
        }
        EXPECT_EQ(slow.waited_for, 0);
    }
    EXPECT_GT(steps, 100U);
}

TEST(RecordsAhead, AreAllThatAPictureAsksFor) {
    std::mt19937_64 random(54);
    const Residency all_here = [](const PageIndex&) { return std::uint64_t{1}; };
    for (const bool is_lit : {false, true}) {
        const FrameView view = some_view(random);
        ShadowRequest light;
        if (is_lit) light.sun_enu = glm::dvec3(0.6, 0.6, std::sqrt(0.28));
        const SlowPages slow;
        ASSERT_TRUE(make_records_ahead(slow, view, light, {}).ok());
        const int before = slow.waited_for;
        EXPECT_GT(before, 10);
        PlanMemory memory(slow);
        auto plan = plan_grid(memory, all_here, view);
        ASSERT_TRUE(plan.ok());
        if (is_lit) {
            ASSERT_TRUE(plan_casters(memory, all_here, view, light, 2600.0, *plan).ok());
        }
        EXPECT_EQ(slow.waited_for, before) << (is_lit ? "lit" : "not lit");
        EXPECT_TRUE(plan->missing.empty());
    }
}

TEST(RecordsAhead, EndOnceNobodyWantsThem) {
    std::mt19937_64 random(55);
    const SlowPages slow;
    std::stop_source stop;
    stop.request_stop();
    ASSERT_TRUE(make_records_ahead(slow, some_view(random), {}, stop.get_token()).ok());
    EXPECT_EQ(slow.waited_for, 0);
}

}  // namespace
}  // namespace oro
