// Plans that keep something from frame to frame are those that are made from nothing.
#include "core/frame/plan_memory.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <glm/geometric.hpp>
#include <map>
#include <random>

#include "tests/core/truth/world_field.h"
#include "tests/support/rough_terrain.h"

namespace oro {
namespace {

TEST(PageTables, FindWhatWasPutIn) {
    constexpr unsigned seed = 5102;
    std::mt19937_64 random(seed);
    PageTable table;
    EXPECT_EQ(table.find(0, 0), PageTable::none);
    for (int turn = 0; turn < 50; ++turn) {
        table.clear();
        std::map<std::pair<int, int>, std::uint32_t> expected;
        const int side = 1 + static_cast<int>(random() % 60);
        for (int i = 0; i < 400; ++i) {
            const int row = static_cast<int>(random() % static_cast<unsigned>(side)),
                      column = static_cast<int>(random() % static_cast<unsigned>(side)) - 1;
            const auto number = static_cast<std::uint32_t>(random() % 1000);
            if (expected.try_emplace({row, column}, number).second) table.insert(row, column, number);
        }
        for (int row = -1; row <= side; ++row)
            for (int column = -1; column <= side; ++column) {
                const auto found = expected.find({row, column});
                ASSERT_EQ(table.find(row, column), found == expected.end() ? PageTable::none : found->second)
                    << "seed " << seed << ", turn " << turn;
            }
    }
}

template <class T>
bool same_bytes(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

void expect_same(const GridPlan& kept, const GridPlan& fresh) {
    EXPECT_EQ(std::memcmp(&kept.constants, &fresh.constants, sizeof(kept.constants)), 0);
    EXPECT_TRUE(same_bytes(kept.pages, fresh.pages));
    EXPECT_EQ(kept.page_indices, fresh.page_indices);
    EXPECT_TRUE(same_bytes(kept.row_terms, fresh.row_terms));
    EXPECT_TRUE(same_bytes(kept.column_terms, fresh.column_terms));
    EXPECT_EQ(kept.missing, fresh.missing);
    EXPECT_EQ(kept.missing_hidden, fresh.missing_hidden);
    EXPECT_EQ(kept.hidden, fresh.hidden);
    EXPECT_EQ(kept.pages_wanted, fresh.pages_wanted);
    EXPECT_EQ(kept.pages_beyond_frustum, fresh.pages_beyond_frustum);
    EXPECT_EQ(kept.pages_beyond_horizon, fresh.pages_beyond_horizon);
    EXPECT_TRUE(same_bytes(kept.casters.pages, fresh.casters.pages));
    EXPECT_TRUE(same_bytes(kept.casters.table, fresh.casters.table));
    EXPECT_EQ(std::memcmp(&kept.casters.frame, &fresh.casters.frame, sizeof(kept.casters.frame)), 0);
}

// An eye that flies, turns, and now and then is elsewhere.
class MovingCamera {
  public:
    MovingCamera(const PostGrid& grid, unsigned seed) : grid_(grid), random_(seed) { jump(); }
    const Camera& next() {
        if (random_() % 20 == 0) jump();
        camera_.eye.lat_deg += 1e-4 * between(-1.0, 1.0);
        camera_.eye.lon_deg += 1e-4 * between(-1.0, 1.0);
        camera_.eye.h_m += between(-10.0, 10.0);
        camera_.attitude.heading_deg = std::fmod(camera_.attitude.heading_deg + between(0.0, 5.0), 360.0);
        return camera_;
    }
    double between(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random_);
    }
    bool chance(double share) { return between(0.0, 1.0) < share; }

  private:
    void jump() {
        camera_.width_px = 640;
        camera_.height_px = 360;
        camera_.eye = {between(grid_.south_deg(), grid_.north_deg()),
                       between(grid_.west_deg(), grid_.east_deg()),
                       3000.0 + 2.0 * std::pow(2.0e5, between(0.0, 1.0))};
        camera_.attitude = {between(0.0, 360.0), between(-60.0, 5.0), 0.0};
    }

    const PostGrid& grid_;
    std::mt19937_64 random_;
    Camera camera_;
};

// Plans of an eye in motion, with pages that come and go, casters, and heights of each kind.
void expect_plans_of_motion(const HeightField& field, unsigned seed, int eyes, const WorldModel& model = {}) {
    const auto pages = pages_in_memory(field, 1.0, 2);
    MovingCamera eye(field.grid, seed);
    PlanMemory memory(*pages);
    const HeightQuantization packed{.packed = true},
        sixteen = *height_quantization(*pages, HeightStorage::i16);
    const double top_m = *region_top_m(*pages);
    std::size_t drawn = 0, missing = 0, casters = 0;
    for (int i = 0; i < eyes; ++i) {
        SCOPED_TRACE("seed " + std::to_string(seed) + ", eye " + std::to_string(i));
        const Camera& camera = eye.next();
        const double here = i % 3 == 0 ? 1.0 : eye.between(0.5, 1.0);
        const Residency residency = [&](const PageIndex& page) -> std::uint64_t {
            const std::uint64_t number =
                static_cast<std::uint64_t>(page.row * 1009 + page.column * 31 + page.level);
            const double share = static_cast<double>(number * 2654435761U % 1000) / 1000.0;
            return share < here ? 16 * (number + 1) : 0;
        };
        const IsHidden hidden = [&](const PageIndex& page) { return (page.row + page.column + i) % 7 == 0; };
        const HeightQuantization coding = i % 3 == 0 ? HeightQuantization{} : i % 3 == 1 ? packed : sixteen;
        const FrameView view{camera, {0, 0, 640, 360, {0.5, 0.5}}, i % 2 == 0 ? 1.0 : 0.25, model};
        ShadowRequest shadows{glm::normalize(glm::dvec3(0.5, eye.between(-1.0, 1.0), eye.between(0.05, 1.0))),
                              i % 4 != 0};
        auto kept = plan_grid(memory, residency, view, coding, gpu::shading_spacing_px, hidden);
        auto fresh = plan_grid(*pages, residency, view, coding, gpu::shading_spacing_px, hidden);
        ASSERT_TRUE(kept.ok() && fresh.ok());
        ASSERT_TRUE(plan_casters(memory, residency, view, shadows, top_m, *kept).ok());
        ASSERT_TRUE(plan_casters(*pages, residency, view, shadows, top_m, *fresh).ok());
        expect_same(*kept, *fresh);
        drawn += fresh->pages.size();
        missing += fresh->missing.size();
        casters += fresh->casters.pages.size();
    }
    std::printf("seed %u: %d eyes, %zu pages drawn, %zu missing, %zu cast\n", seed, eyes, drawn, missing,
                casters);
    EXPECT_GT(drawn, static_cast<std::size_t>(eyes));
    EXPECT_GT(missing, static_cast<std::size_t>(eyes) / 4);
    EXPECT_GT(casters, static_cast<std::size_t>(eyes));
}

TEST(PlanMemories, PlansAreThoseFromNothing) {
    expect_plans_of_motion(test::rough_field(47.0, 8.0, 900, 1100), 5103, 300);
}

TEST(PlanMemories, PlansRoundTheEarthAreThoseFromNothing) {
    const HeightField field =
        test::world_field(4.0, 4 * 60, -4 * 180, 4 * 120, 4 * 360 + 1, [](double lat_deg, double lon_deg) {
            return 1000.0 + 900.0 * std::sin(0.7 * lat_deg) * std::cos(0.0174532925 * 8.0 * lon_deg);
        });
    expect_plans_of_motion(field, 5104, 100);
    WorldModel sphere;
    sphere.earth = Earth::sphere;
    expect_plans_of_motion(field, 5105, 50, sphere);
}

}  // namespace
}  // namespace oro
