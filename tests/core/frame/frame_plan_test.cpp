#include "core/frame/frame_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <memory>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "core/frame/frame_tables.h"
#include "core/lod/levels_gpu.h"
#include "tests/core/terrain/placed_posts.h"
#include "tests/core/truth/world_field.h"

namespace oro {
namespace {

using Key = std::array<int, 3>;  // level, row, column
Key key(const PageIndex& page) {
    return {page.level, page.row, page.column};
}

std::uint64_t everything(const PageIndex&) {
    return 1;
}

// 9 x 9 pages of 3" posts, and 4 levels above them.
struct Region {
    HeightField field =
        test::world_field(1200.0, 47 * 1200, 8 * 1200, 1100, 1100, [](double lat_deg, double lon_deg) {
            return 1500.0 + 1000.0 * std::sin(lat_deg * 90.0) * std::cos(lon_deg * 70.0);
        });
    std::unique_ptr<RegionPages> pages = pages_in_memory(field, 1.0, 2);

    [[nodiscard]] PageRecord record(const PageIndex& index) const {
        return std::move(pages->record(index)).value();
    }
    [[nodiscard]] GridPlan plan(const Camera& camera, const Tile& tile, double tau_px) const {
        Result<GridPlan> plan = plan_grid(*pages, everything, {camera, tile, tau_px});
        EXPECT_TRUE(plan.ok());
        return std::move(plan).value();
    }
};
const Region& alpine_region() {
    static const Region region;
    return region;
}

// Pages of the level below a page's.
std::size_t pages_below(const RegionPages& pages, const PageIndex& page) {
    if (page.level == 0) return 0;
    const PageLayout below = pages.layout(page.level - 1);
    const int rows = std::min(2, below.rows - 2 * page.row);
    const int columns = std::min(2, below.columns - 2 * page.column);
    return static_cast<std::size_t>(rows * columns);
}

TEST(FramePlan, KeepsEveryPageWithAPostInThePicture) {
    const Region& region = alpine_region();
    ASSERT_EQ(region.pages->layout(0).rows, 9);
    ASSERT_EQ(region.pages->layout(0).columns, 9);
    std::mt19937_64 random(42);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    std::size_t left_out = 0;
    for (int i = 0; i < 100; ++i) {
        Camera camera;
        camera.width_px = 400;
        camera.height_px = 300;
        camera.eye = {46.5 + 0.6 * unit(random), 8.5 + 0.6 * unit(random),
                      2600.0 + 2000.0 * (unit(random) + 1.0)};
        camera.attitude = {180.0 * unit(random), 30.0 * unit(random) - 20.0, 20.0 * unit(random)};
        const GridPlan plan = region.plan(camera, {0, 0, 400, 300, {0.5, 0.5}}, 0.0);
        // Each page below one that is kept is kept itself or hidden.
        std::size_t asked = 1;
        std::set<Key> kept;
        for (const PageIndex& page : plan.page_indices) {
            asked += pages_below(*region.pages, page);
            kept.insert(key(page));
        }
        EXPECT_EQ(plan.pages.size() + plan.pages_beyond_frustum + plan.pages_beyond_horizon, asked);
        EXPECT_EQ(plan.pages_beyond_horizon, 0U) << "the horizon is farther than the region is wide";
        EXPECT_EQ(kept.size(), plan.pages.size());
        EXPECT_EQ(plan.page_indices.size(), plan.pages.size());
        EXPECT_EQ(plan.pages_wanted, plan.pages.size());
        EXPECT_TRUE(plan.missing.empty());
        const glm::dmat3 view_from_ecef = camera.view_from_ecef();
        const glm::dvec2 tangent = camera.half_fov_tangent();
        for (int n = 0; n < 81; ++n) {
            if (kept.contains({0, n / 9, n % 9})) continue;
            ++left_out;
            for (int k = 0; k < 400; ++k) {
                const int row = n / 9 * 128 + k / 20 * 6;
                const int column = n % 9 * 128 + k % 20 * 6;
                if (row >= 1100 || column >= 1100) continue;
                const glm::dvec3 view =
                    view_from_ecef * (post_ecef(region.field, row, column, 1.0).m - camera.eye_ecef().m);
                const bool seen = view.z < -0.01 && std::abs(view.x) <= -view.z * tangent.x &&
                                  std::abs(view.y) <= -view.z * tangent.y;
                ASSERT_FALSE(seen) << "page " << n << " has a post in the picture";
            }
        }
    }
    std::printf("%zu pages of level 0 left out of 100 pictures\n", left_out);
    EXPECT_GT(left_out, 1000U);
}

Camera looking_north_east() {
    Camera camera;
    camera.width_px = 400;
    camera.height_px = 300;
    camera.eye = {46.2, 8.2, 4000.0};
    camera.attitude = {30.0, -10.0, 5.0};
    return camera;
}

TEST(FramePlan, PlacesPagesAndSortsThemByDistance) {
    const Region& region = alpine_region();
    const Camera camera = looking_north_east();
    for (const double tau_px : {0.0, 1.0, 8.0}) {
        const GridPlan plan = region.plan(camera, {0, 0, 400, 300, {0.5, 0.5}}, tau_px);
        ASSERT_GT(plan.pages.size(), 10U);
        EXPECT_EQ(plan.constants.page_count, plan.pages.size());
        double before_m = 0.0;
        for (std::size_t i = 0; i < plan.pages.size(); ++i) {
            const PageRecord record = region.record(plan.page_indices[i]);
            const PageSummary& page = record.summary;
            const glm::dvec3 offset =
                page.ecef_from_page * page.centre_m + page.origin_ecef.m - camera.eye_ecef().m;
            const double distance_m = std::max(0.0, glm::length(offset) - record.reach_m);
            EXPECT_GE(distance_m, before_m - 1e-6);
            before_m = distance_m;
            // The frame's floats put a point of the page where doubles put it, but for 6e-8 of its distance
            // an axis.
            const glm::dvec3 point(1000.0, -2000.0, 500.0);
            const glm::dvec3 truth = camera.view_from_ecef() *
                                     (page.origin_ecef.m + page.ecef_from_page * point - camera.eye_ecef().m);
            const gpu::vec3 got = plan.pages[i].view_from_page * gpu::vec3(point) + plan.pages[i].origin_view;
            EXPECT_LT(glm::length(glm::dvec3(got) - truth), 2e-7 * glm::length(truth) + 1e-3);
        }
    }
}

// A post by its page's place in the tables, and where it truly is.
TEST(FramePlan, PagesFindTheirPostsInTheTables) {
    const Region& region = alpine_region();
    const Camera camera = looking_north_east();
    const GridPlan plan = region.plan(camera, {0, 0, 400, 300, {0.5, 0.5}}, 1.0);
    const DrawnHeights heights = drawn_heights(region.field, 1.0, 1);
    std::set<int> levels;
    for (std::size_t i = 0; i < plan.pages.size(); ++i) {
        const gpu::FramePage& page = plan.pages[i];
        const PageIndex& index = plan.page_indices[i];
        levels.insert(index.level);
        EXPECT_EQ(page.level, static_cast<unsigned>(index.level));
        EXPECT_EQ(page.block, gpu::uvec2(1U, 0U));
        for (const auto& [row, column] : {std::pair{0U, 0U}, {77U, 5U}, {128U, 128U}}) {
            const unsigned region_row = page.first_row + (row << page.level);
            const unsigned region_column = page.first_column + (column << page.level);
            if (region_row > plan.constants.last_row || region_column > plan.constants.last_column) continue;
            const auto r = static_cast<int>(region_row), c = static_cast<int>(region_column);
            const gpu::vec3 at = test::place_from_eye(plan.row_terms.at(page.row_terms + row),
                                                      plan.column_terms.at(page.column_terms + column),
                                                      plan.constants.reference_steps, heights.at(r, c));
            const glm::dvec3 truth =
                camera.view_from_ecef() * (post_ecef(region.field, r, c, 1.0).m - camera.eye_ecef().m);
            EXPECT_LT(glm::distance(glm::dvec3(plan.constants.view_from_eye * at), truth),
                      1e-3 + 3e-7 * glm::length(truth));
        }
    }
    EXPECT_GE(levels.size(), 4U);
}

TEST(FramePlan, PagesKnowTheirParentsAndWhatLiesBesideThese) {
    const Region& region = alpine_region();
    const GridPlan plan = region.plan(looking_north_east(), {0, 0, 400, 300, {0.5, 0.5}}, 1.0);
    const auto number_of = [&](const Key& wanted) {
        const auto found = std::find_if(plan.page_indices.begin(), plan.page_indices.end(),
                                        [&](const PageIndex& page) { return key(page) == wanted; });
        return found == plan.page_indices.end()
                   ? gpu::no_page
                   : static_cast<std::uint32_t>(found - plan.page_indices.begin());
    };
    std::size_t with_neighbours = 0;
    for (std::size_t i = 0; i < plan.pages.size(); ++i) {
        const gpu::FramePage& page = plan.pages[i];
        const auto& [row, column, level] = plan.page_indices[i];
        EXPECT_EQ(page.parent, number_of({level + 1, row / 2, column / 2}));
        EXPECT_EQ(page.parent == gpu::no_page, level == 4);
        EXPECT_EQ(page.quarter, static_cast<unsigned>(row % 2 * 2 + column % 2));
        const PageLayout layout = region.pages->layout(level);
        const int steps[4][2] = {{-1, 0}, {0, 1}, {1, 0}, {0, -1}};
        for (int edge = 0; edge < 4; ++edge) {
            const int r = row + steps[edge][0], c = column + steps[edge][1];
            const bool inside = r >= 0 && c >= 0 && r < layout.rows && c < layout.columns;
            const std::uint32_t expected = inside ? number_of({level + 1, r / 2, c / 2}) : gpu::no_page;
            EXPECT_EQ(page.neighbours[edge], expected);
            with_neighbours += expected != gpu::no_page ? 1 : 0;
        }
        EXPECT_EQ(page.last_column, 15U);
    }
    EXPECT_GT(with_neighbours, plan.pages.size());
}

// Device addresses have two words.
TEST(FramePlan, HandsOnTheAddressesOfBlocks) {
    const Region& region = alpine_region();
    const auto address = [](const PageIndex& page) {
        return 0x1'0000'0040U + (static_cast<std::uint64_t>(page.level) << 48U) +
               static_cast<std::uint64_t>(page.row * 16 + page.column) * 0x1000U;
    };
    const Result<GridPlan> plan =
        plan_grid(*region.pages, address, {looking_north_east(), {0, 0, 400, 300, {}}, 1.0});
    ASSERT_TRUE(plan.ok());
    for (std::size_t i = 0; i < plan->pages.size(); ++i) {
        const std::uint64_t expected = address(plan->page_indices[i]);
        EXPECT_EQ(plan->pages[i].block.x, expected & 0xffffffffU);
        EXPECT_EQ(plan->pages[i].block.y, expected >> 32U);
    }
}

TEST(FramePlan, WithNothingThereEverythingIsMissing) {
    const Region& region = alpine_region();
    const Tile tile{0, 0, 400, 300, {0.5, 0.5}};
    const GridPlan all = region.plan(looking_north_east(), tile, 1.0);
    const Result<GridPlan> plan =
        plan_grid(*region.pages, [](const PageIndex&) { return 0U; }, {looking_north_east(), tile, 1.0});
    ASSERT_TRUE(plan.ok());
    EXPECT_TRUE(plan->pages.empty());
    EXPECT_TRUE(plan->row_terms.empty());
    EXPECT_EQ(plan->constants.page_count, 0U);
    ASSERT_EQ(plan->missing.size(), all.pages.size());
    EXPECT_EQ(plan->pages_wanted, all.pages.size());
    EXPECT_EQ(plan->missing.front().level, 4) << "the top page first";
    EXPECT_EQ(plan->missing.back().level, 0);
    // A region of one post has nothing to want.
    const auto nothing =
        pages_in_memory(test::world_field(1200.0, 0, 0, 1, 1, [](double, double) { return 7.0; }), 1.0, 1);
    const Result<GridPlan> empty = plan_grid(*nothing, everything, {looking_north_east(), tile, 1.0});
    ASSERT_TRUE(empty.ok());
    EXPECT_TRUE(empty->pages.empty());
    EXPECT_TRUE(empty->missing.empty());
}

// A region whose pages are all seen and never good enough; one of them may not be readable.
class EndlessPages : public RegionPages {
  public:
    EndlessPages(const PostGrid& grid, Key unreadable)
        : RegionPages({grid, {}, {occluder_below(0.0, 0.0), 1.0}, 0}), unreadable_(unreadable) {}

    [[nodiscard]] Result<PageRecord> record(const PageIndex& page) const override {
        if (key(page) == unreadable_) return Error{ErrorKind::failed, "terrain.oro", "page 7 is cut off"};
        PageRecord record{};
        record.summary.index = page;
        record.reach_m = 1.0e12;
        record.horizon.angle_rad = 4.0;
        for (PageQuarter& quarter : record.quarters) quarter.largest_error_m = gpu::unfit_error_m;
        return record;
    }
    Result<void> load(const PageIndex&, gpu::PageBlock&) const override { return {}; }

  private:
    Key unreadable_;
};

TEST(FramePlan, SaysWhatCannotBeRead) {
    const PostGrid grid{{1200.0, 0.0, 47 * 1200, -1, 400}, {1200.0, 0.0, 0, 1, 500}};
    for (const Key& page : {Key{2, 0, 0}, Key{1, 0, 1}, Key{0, 3, 3}}) {
        const Result<GridPlan> plan =
            plan_grid(EndlessPages(grid, page), everything, {looking_north_east(), {}, 1.0});
        ASSERT_FALSE(plan.ok());
        EXPECT_EQ(plan.error().line(), "terrain.oro: page 7 is cut off");
    }
}

TEST(FramePlan, HasAsManyPagesAsTriangleIdsCanNumber) {
    // 313 x 313 pages and all above them are 130,998; 314 x 314 are 131,625.
    const auto planned = [](int pages) {
        const PostGrid grid{{1200.0, 0.0, 60 * 1200, -1, pages * 128 + 1},
                            {1200.0, 0.0, 0, 1, pages * 128 + 1}};
        return plan_grid(EndlessPages(grid, {-1, 0, 0}), everything, {looking_north_east(), {}, 1.0});
    };
    const Result<GridPlan> most = planned(313);
    ASSERT_TRUE(most.ok());
    EXPECT_EQ(most->pages.size(), 130998U);
    const Result<GridPlan> more = planned(314);
    ASSERT_FALSE(more.ok());
    EXPECT_EQ(more.error().kind, ErrorKind::failed);
    EXPECT_NE(more.error().what.find("131625 pages"), std::string::npos) << more.error().what;
    EXPECT_NE(more.error().what.find("at most 131071"), std::string::npos) << more.error().what;
    EXPECT_NE(more.error().what.find("--tau"), std::string::npos);
}

}  // namespace
}  // namespace oro
