// Must hold: what a page of made terrain is said to lie in holds all that is drawn of it and of the pages
// below it, and asking that first leaves out only pages of which nothing is in the picture.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <memory>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "core/earth/culling.h"
#include "core/frame/casters.h"
#include "core/frame/frame_plan.h"
#include "core/made_pages/made_pages.h"

namespace oro {
namespace {

// Made terrain on a box of whole degrees; N is 0.
struct MadeBox {
    const char* name;
    std::int64_t posts_per_deg;
    int west, south, east, north;
};
std::unique_ptr<RegionPages> pages_of(const MadeBox& box) {
    MadeTerrain terrain;
    terrain.seed = 3;
    terrain.octaves = 9;
    terrain.low = -200 * 2048;
    terrain.high = 4000 * 2048;
    terrain.posts_per_deg = box.posts_per_deg;
    terrain.west = box.west * box.posts_per_deg;
    terrain.east = box.east * box.posts_per_deg;
    terrain.south = box.south * box.posts_per_deg;
    terrain.north = box.north * box.posts_per_deg;
    PostGrid grid;
    const auto per_deg = static_cast<double>(box.posts_per_deg);
    grid.lat = {per_deg, 0.0, terrain.north, -1, terrain.rows()};
    grid.lon = {per_deg, 0.0, terrain.west, 1, terrain.columns()};
    const HeightField field = made_field(terrain, grid, {});
    return made_posts_of(field)->pages(field);
}

// Whether a place lies in the sphere and, by the derivation of HorizonCone, in the cone.
bool holds(const PageBound& bound, const HorizonOccluder& occluder, const Ecef& place) {
    if (glm::distance(bound.centre.m, place.m) > bound.radius_m) return false;
    const std::array<glm::dvec3, 1> one{place.m};
    const HorizonCone cone = horizon_cone(occluder, one);
    const double cosine = std::clamp(glm::dot(cone.direction, bound.horizon.direction), -1.0, 1.0);
    return bound.horizon.angle_rad >= std::numbers::pi ||
           std::acos(cosine) + cone.angle_rad <= bound.horizon.angle_rad + 1e-9;
}

// Of the ground of a page: its corners and places between them, as low and as high as the rule allows.
int outside(const RegionPages& pages, const PageIndex& page, const PageBound& bound, std::mt19937& random) {
    const PostGrid& grid = pages.facts().grid;
    const LevelGrid level = level_grid(grid, page.level);
    constexpr int quads = static_cast<int>(gpu::page_quads);
    const auto lat_deg = [&](double share) {
        const double first = grid.lat.at_deg(level.row.region_post(page.row * quads));
        return first + share * (grid.lat.at_deg(level.row.region_post((page.row + 1) * quads)) - first);
    };
    const auto lon_deg = [&](double share) {
        const double first = grid.lon.at_deg(level.column.region_post(page.column * quads));
        return first + share * (grid.lon.at_deg(level.column.region_post((page.column + 1) * quads)) - first);
    };
    std::uniform_real_distribution<double> any(0.0, 1.0);
    int beyond = 0;
    for (int i = 0; i < 40; ++i) {
        const double down = i < 4 ? i / 2 : any(random), right = i < 4 ? i % 2 : any(random);
        for (const double h_m : {-200.0, 1900.0, 4000.0})
            beyond += holds(bound, pages.facts().shape.occluder,
                            ecef_from_geodetic({lat_deg(down), lon_deg(right), h_m}))
                          ? 0
                          : 1;
    }
    return beyond;
}

class PageBounds : public ::testing::TestWithParam<MadeBox> {};

TEST_P(PageBounds, HoldAllGroundOfAPage) {
    const auto pages = pages_of(GetParam());
    std::mt19937 random(41);
    int bounds = 0, beyond = 0;
    for (int level = 0; level < pages->levels(); ++level) {
        const PageLayout layout = pages->layout(level);
        for (int i = 0; i < 60; ++i) {
            const PageIndex page{static_cast<int>(random() % static_cast<unsigned>(layout.rows)),
                                 static_cast<int>(random() % static_cast<unsigned>(layout.columns)), level};
            const auto bound = pages->bound(page);
            if (!bound) continue;
            ++bounds;
            beyond += outside(*pages, page, *bound, random);
        }
    }
    EXPECT_GE(bounds, 60);
    EXPECT_EQ(beyond, 0) << "seed 41";
}

INSTANTIATE_TEST_SUITE_P(Made, PageBounds,
                         ::testing::Values(MadeBox{"Alps", 60, 0, 40, 20, 55},
                                           MadeBox{"Pole", 60, -180, 70, 180, 90},
                                           MadeBox{"Fiji", 60, 170, -25, 190, -5},
                                           MadeBox{"Equator", 60, -40, -30, 40, 30},
                                           MadeBox{"World", 20, -179, -60, 179, 60}),
                         [](const auto& one) { return std::string(one.param.name); });

// The pages of others, with their bounds or without; counts the records that are asked for.
class CountedPages : public RegionPages {
  public:
    CountedPages(const RegionPages& of, bool bounded)
        : RegionPages(of.facts(), of.levels()), of_(of), bounded_(bounded) {}
    [[nodiscard]] Result<PageRecord> record(const PageIndex& page) const override {
        ++records;
        return of_.record(page);
    }
    [[nodiscard]] std::optional<PageBound> bound(const PageIndex& page) const override {
        return bounded_ ? of_.bound(page) : std::nullopt;
    }
    Result<void> load(const PageIndex& page, gpu::PageBlock& block) const override {
        return of_.load(page, block);
    }
    mutable std::atomic<int> records{};

  private:
    const RegionPages& of_;
    bool bounded_;
};

// Whether the nodes of a page are all out of the picture, each by its own sphere or beyond the horizon.
bool is_unseen(const RegionPages& pages, const PageIndex& index, const Camera& camera, const Tile& tile) {
    const auto record = pages.record(index);
    const auto block = std::make_unique<gpu::PageBlock>();
    EXPECT_TRUE(record.ok() && pages.load(index, *block).ok());
    const PageSummary& page = record->summary;
    if (beyond_horizon(horizon_eye(pages.facts().shape.occluder, camera.eye_ecef()), page.horizon))
        return true;
    const auto planes = frustum_planes_view(projection_of_tile(camera, tile));
    return std::ranges::all_of(block->meshlets, [&](const gpu::MeshletBounds& node) {
        const glm::dvec3 ecef_m = page.origin_ecef.m + page.ecef_from_page * glm::dvec3(node.centre);
        return node.radius < 0.0F ||
               beyond_frustum(planes, camera.view_from_ecef() * (ecef_m - camera.eye_ecef().m), node.radius);
    });
}

TEST(PageBoundsOfFrames, LeaveOutWhatIsNotInThePicture) {
    const auto pages = pages_of({"Alps", 60, 0, 40, 20, 55});
    const CountedPages bounded(*pages, true), plain(*pages, false);
    std::mt19937 random(42);
    std::uniform_real_distribution<double> any(0.0, 1.0);
    std::size_t chosen = 0, unseen = 0;
    for (int eye = 0; eye < 40; ++eye) {
        Camera camera;
        camera.eye = {41.0 + 13.0 * any(random), 1.0 + 18.0 * any(random), 4100.0 + 20'000.0 * any(random)};
        camera.attitude = {.heading_deg = 360.0 * any(random), .pitch_deg = -30.0 * any(random)};
        camera.width_px = 640;
        camera.height_px = 360;
        const Tile whole{.width_px = 640, .height_px = 360};
        const auto everything = [](const PageIndex&) { return std::uint64_t{1}; };
        const auto with = plan_grid(bounded, everything, {camera, whole, 1.0});
        const auto without = plan_grid(plain, everything, {camera, whole, 1.0});
        ASSERT_TRUE(with.ok() && without.ok());
        std::vector<PageIndex> left_out = without->page_indices;
        for (const PageIndex& page : with->page_indices)
            EXPECT_EQ(std::erase(left_out, page), 1U) << "seed 42, eye " << eye;
        for (const PageIndex& page : left_out)
            EXPECT_TRUE(is_unseen(*pages, page, camera, whole))
                << "seed 42, eye " << eye << ": " << page.level << ", " << page.row << ", " << page.column;
        chosen += with->page_indices.size();
        unseen += left_out.size();
    }
    std::printf(
        "40 eyes: %zu pages chosen, %zu unseen ones left out; %d records asked for, %d without bounds\n",
        chosen, unseen, bounded.records.load(), plain.records.load());
    EXPECT_GT(chosen, 400U);
    EXPECT_LT(bounded.records, 0.7 * plain.records);
}

// Shadows ask for it: it must not take the records of all of a world, which would be measured.
TEST(PageBounds, TopOfAWorldIsThatOfItsRule) {
    const auto pages = pages_of({"world", 3600, -179, -60, 179, 60});
    const auto top_m = region_top_m(*pages);
    ASSERT_TRUE(top_m.ok());
    EXPECT_GE(*top_m, 4000.0);
    EXPECT_LE(*top_m, 4002.0);
}

}  // namespace
}  // namespace oro
