// What the GPU makes of a frame's plan, held against the reference choice of levels; and what it makes of it
// when pages are missing.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <map>
#include <random>
#include <set>
#include <tuple>

#include "core/frame/frame_plan.h"
#include "core/lod/levels.h"
#include "tests/core/frame/simulated_frame.h"
#include "tests/core/lod/covering.h"
#include "tests/core/lod/pyramid_region.h"
#include "tests/core/truth/world_field.h"

namespace oro {
namespace {

using test::Region, test::PyramidPages, test::patchy_field, test::random_camera, test::whole, test::taus_px;

using Key = std::array<int, 3>;  // level, row, column
Key key(const PageIndex& page) {
    return {page.level, page.row, page.column};
}
Key page_of_node(int level, int row, int column) {
    return {level, row / 16, column / 16};
}

HeightField patchy_with_voids() {
    HeightField field = patchy_field(420, 470);
    for (int row = 130; row < 200; ++row) {
        for (int column = 129; column < 256; ++column)
            field.H_m[static_cast<std::size_t>(row * 470 + column)] = void_height_m;
    }
    field.H_m[300 * 470 + 77] = void_height_m;
    return field;
}

// Rough in the west, smooth in the east, so that levels differ across the seam, too.
HeightField round_field(int columns, int rows) {
    const double per_deg = columns / 360.0;
    const auto west = -static_cast<std::int64_t>(columns) / 2;
    return test::world_field(per_deg, static_cast<std::int64_t>(60.0 * per_deg), west, rows, columns + 1,
                             [](double lat_deg, double lon_deg) {
                                 const double rough = std::max(0.0, -lon_deg / 180.0);
                                 return 1000.0 + 30.0 * std::sin(0.1 * lat_deg) +
                                        9.0e3 * std::pow(rough, 3.0) *
                                            std::sin(7.7 * lat_deg + lon_deg * 5.1) *
                                            std::cos(0.0174532925 * lon_deg * 0.5);
                             });
}

GridPlan planned(const PyramidPages& pages, const Residency& residency, const Camera& camera, double tau_px) {
    Result<GridPlan> plan = plan_grid(pages, residency, {camera, whole(camera), tau_px});
    EXPECT_TRUE(plan.ok());
    return std::move(plan).value();
}

std::set<Key> keys(const std::vector<PageIndex>& pages) {
    std::set<Key> all;
    for (const PageIndex& page : pages) all.insert(key(page));
    return all;
}

struct Compared {
    std::size_t nodes{};
    std::size_t stitched{};
    std::size_t next_to_hidden{};  // edges beside a page that the frame does not have
    std::size_t pages{};
    std::size_t pages_of_reference{};
};

// The page that holds the parent of the node beyond an edge (0 north, 1 east, 2 south, 3 west).
Key parent_page_beyond(const Region& region, const DrawnNode& node, int edge) {
    constexpr int steps[4][2] = {{-1, 0}, {0, 1}, {1, 0}, {0, -1}};
    const int columns = region.grid(node.level).column.nodes();
    const int column = (node.column + steps[edge][1] + columns) % columns;
    return page_of_node(node.level + 1, (node.row + steps[edge][0]) / 2, column / 2);
}

// The GPU's nodes are the reference's, with their edges; but beside pages that are hidden, which the GPU has
// no word of, an edge may be left as it is.
void expect_reference(const Region& region, const GridPlan& plan, const NodeSelection& reference,
                      Compared& compared) {
    const std::set<Key> in_plan = keys(plan.page_indices);
    std::map<Key, std::uint32_t> expected;
    for (const DrawnNode& node : reference.nodes) {
        expected[{node.level, node.row, node.column}] = node.edges;
        Key page = page_of_node(node.level, node.row, node.column);
        for (; page[0] < static_cast<int>(region.pyramid.levels.size());
             page = {page[0] + 1, page[1] / 2, page[2] / 2})
            ASSERT_TRUE(in_plan.contains(page)) << page[0] << ": " << page[1] << " " << page[2];
    }
    for (const DrawnNode& node : test::drawn_nodes(plan)) {
        const auto found = expected.find({node.level, node.row, node.column});
        ASSERT_NE(found, expected.end()) << node.level << ": " << node.row << " " << node.column;
        for (int edge = 0; edge < 4; ++edge) {
            const std::uint32_t bit = 1U << edge;
            if ((node.edges & bit) == (found->second & bit)) continue;
            ASSERT_EQ(node.edges & bit, 0U) << "is stitched to what is not coarser";
            ASSERT_FALSE(in_plan.contains(parent_page_beyond(region, node, edge)))
                << node.level << ": " << node.row << " " << node.column << " edge " << edge;
            ++compared.next_to_hidden;
        }
        compared.stitched += node.edges != 0 ? 1 : 0;
        ++compared.nodes;
        expected.erase(found);
    }
    ASSERT_TRUE(expected.empty()) << expected.size() << " nodes are not drawn";
    compared.pages += plan.pages.size();
    compared.pages_of_reference += reference.pages_seen;
}

void print(const char* what, unsigned seed, const Compared& compared) {
    std::printf(
        "%s, seed %u: %zu nodes (%zu stitched), %zu edges beside hidden pages; %zu pages, %zu by nodes\n",
        what, seed, compared.nodes, compared.stitched, compared.next_to_hidden, compared.pages,
        compared.pages_of_reference);
}

TEST(FrameChoice, DrawsTheNodesOfTheReference) {
    const unsigned seed = 31;
    std::mt19937_64 random(seed);
    const Region regions[] = {Region(patchy_field(600, 521)), Region(patchy_with_voids()),
                              Region(round_field(300, 121))};
    Compared compared, unhidden;
    for (int i = 0; i < 300; ++i) {
        const Region& region = regions[i % 3];
        const Camera camera = random_camera(random, region);
        const double tau_px = taus_px[i / 3 % 3];
        const PyramidPages pages(region.field, region.pyramid);
        const GridPlan plan = planned(pages, pages.residency(), camera, tau_px);
        EXPECT_TRUE(plan.missing.empty());
        EXPECT_EQ(plan.pages_wanted, plan.pages.size());
        ASSERT_NO_FATAL_FAILURE(expect_reference(
            region, plan, select_nodes(region.pyramid, camera, whole(camera), tau_px), compared))
            << i;
        // Where nothing is hidden, every edge agrees.
        const PyramidPages all(region.field, region.unhidden);
        ASSERT_NO_FATAL_FAILURE(expect_reference(region, planned(all, all.residency(), camera, tau_px),
                                                 select_nodes(region.unhidden, camera, whole(camera), tau_px),
                                                 unhidden))
            << i;
    }
    print("seen", seed, compared);
    print("all", seed, unhidden);
    EXPECT_GT(compared.nodes, 10000U);
    EXPECT_GT(compared.stitched, 1000U);
    EXPECT_EQ(unhidden.next_to_hidden, 0U);
    EXPECT_GT(unhidden.stitched, 1000U);
}

// Pages of nodes that end within a page, with it, and in one page alone; on coarser levels, too.
TEST(FrameChoice, MeetsItselfRoundTheEarth) {
    const unsigned seed = 32;
    std::mt19937_64 random(seed);
    Compared compared;
    for (const auto& [columns, rows] : {std::pair{384, 129},
                                        {380, 200},
                                        {256, 140},
                                        {768, 260},
                                        {128, 62},
                                        {100, 49},
                                        {600, 300},
                                        {420, 209},
                                        {640, 150}}) {
        const Region region(round_field(columns, rows));
        ASSERT_TRUE(region.pyramid.wraps_longitude);
        const PyramidPages pages(region.field, region.unhidden);
        for (int i = 0; i < 40; ++i) {
            Camera camera = random_camera(random, region);
            if (i % 2 == 0) camera.eye.lon_deg = 180.0 + 0.1 * (i % 5 - 2);  // near the seam
            camera.eye.h_m += 1.0e5 * (i % 4);
            const double tau_px = taus_px[i % 3] * 0.5;
            const GridPlan plan = planned(pages, pages.residency(), camera, tau_px);
            const std::vector<DrawnNode> drawn = test::drawn_nodes(plan);
            std::vector<int> level_at;
            ASSERT_NO_FATAL_FAILURE(test::expect_one_cover(region, drawn, level_at)) << columns;
            ASSERT_NO_FATAL_FAILURE(test::expect_steps_of_one(region, level_at)) << columns;
            ASSERT_NO_FATAL_FAILURE(expect_reference(
                region, plan, select_nodes(region.unhidden, camera, whole(camera), tau_px), compared))
                << columns << " columns, " << i;
            if (i < 8) {
                ASSERT_NO_FATAL_FAILURE(test::expect_watertight(region, drawn)) << columns;
            }
        }
    }
    print("round", seed, compared);
    EXPECT_GT(compared.stitched, 1000U);
    EXPECT_EQ(compared.next_to_hidden, 0U);
}

// A quarter that is good enough has no node that is not, whatever tau is.
TEST(FrameChoice, AQuartersBoundHoldsForItsNodesInFloat) {
    std::mt19937_64 random(33);
    const Region regions[] = {Region(patchy_field(600, 521)), Region(patchy_with_voids()),
                              Region(round_field(300, 121))};
    std::size_t nodes = 0, close = 0;
    for (int i = 0; i < 150; ++i) {
        const Region& region = regions[i % 3];
        const PyramidPages pages(region.field, region.unhidden);
        const Camera camera = random_camera(random, region);
        const LevelView view = level_view(camera, 1.0);
        const GridPlan plan = planned(pages, pages.residency(), camera, 0.25);
        for (std::size_t n = 0; n < plan.pages.size(); ++n) {
            const PyramidPage& page = pages.at(plan.page_indices[n]);
            const PageSummary& summary = page.summary;
            if (summary.index.level == 0) continue;
            for (int q = 0; q < 4; ++q) {
                const PageQuarter& quarter = page.quarters[static_cast<std::size_t>(q)];
                if (quarter.lod_radius_m < 0.0 || quarter.largest_error_m >= gpu::unfit_error_m) continue;
                const glm::dvec3 centre =
                    camera.view_from_ecef() *
                    (summary.origin_ecef.m + summary.ecef_from_page * quarter.centre_m - camera.eye_ecef().m);
                const float px = gpu::projected_error_px(
                    gpu::vec3(centre), static_cast<float>(quarter.lod_radius_m), quarter.largest_error_m,
                    view.pixels_per_tangent, view.corner_tangent);
                for (int m = 0; m < 64; ++m) {
                    const gpu::MeshletBounds& node =
                        page.nodes[static_cast<std::size_t>((q / 2 * 8 + m / 8) * 16 + q % 2 * 8 + m % 8)];
                    if (node.radius < 0.0F) continue;
                    const gpu::vec3 at =
                        plan.pages[n].view_from_page * node.centre + plan.pages[n].origin_view;
                    ASSERT_TRUE(gpu::node_acceptable(plan.pages[n].level, node, at, view.pixels_per_tangent,
                                                     view.corner_tangent, px));
                    ++nodes;
                    close += gpu::projected_error_px(at, node.lod_radius, node.error_m,
                                                     view.pixels_per_tangent, view.corner_tangent) > 0.9F * px
                                 ? 1
                                 : 0;
                }
            }
        }
    }
    std::printf("%zu nodes, of which %zu are within a tenth of their quarter's bound\n", nodes, close);
    EXPECT_GT(nodes, 50000U);
    EXPECT_GT(close, 1000U);
}

// Some of the pages, the top one always.
std::set<Key> random_residents(const Region& region, std::mt19937_64& random) {
    const double missing = std::array{0.03, 0.2, 0.5, 0.9}[random() % 4];
    std::set<Key> there;
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (const PyramidLevel& level : region.pyramid.levels) {
        for (const PyramidPage& page : level.pages) {
            if (level.pages.size() == 1 || unit(random) >= missing) there.insert(key(page.summary.index));
        }
    }
    return there;
}

double distance_m(const PyramidPage& page, const Camera& camera) {
    const glm::dvec3 centre =
        page.summary.origin_ecef.m + page.summary.ecef_from_page * page.summary.centre_m;
    return std::max(0.0, glm::distance(centre, camera.eye_ecef().m) - page.reach_m);
}

// `missing` has what a frame with everything has and this one has not, what others wait for first.
void expect_missing(const PyramidPages& pages, const Camera& camera, const GridPlan& all,
                    const GridPlan& plan, const std::set<Key>& there) {
    std::set<Key> expected;
    for (const PageIndex& page : all.page_indices) {
        if (!there.contains(key(page))) expected.insert(key(page));
    }
    ASSERT_EQ(keys(plan.missing), expected);
    ASSERT_EQ(plan.missing.size(), expected.size());
    ASSERT_EQ(plan.pages_wanted, all.pages.size());
    const std::set<Key> of_all = keys(all.page_indices);
    for (const PageIndex& page : plan.page_indices) {
        ASSERT_TRUE(there.contains(key(page)));
        ASSERT_TRUE(of_all.contains(key(page)));
    }
    for (std::size_t i = 1; i < plan.missing.size(); ++i) {
        const PageIndex& before = plan.missing[i - 1];
        ASSERT_GE(before.level, plan.missing[i].level);
        if (before.level != plan.missing[i].level) continue;
        ASSERT_LE(distance_m(pages.at(before), camera), distance_m(pages.at(plan.missing[i]), camera) + 1e-6);
    }
}

TEST(FrameChoice, HasNoGapsWhateverIsMissing) {
    const unsigned seed = 34;
    std::mt19937_64 random(seed);
    const Region regions[] = {Region(patchy_field(1100, 1050)), Region(round_field(600, 300)),
                              Region(round_field(380, 189)), Region(patchy_with_voids())};
    std::size_t missing = 0, stitched = 0, fallbacks = 0, waiting = 0;
    for (int i = 0; i < 400; ++i) {
        const Region& region = regions[i % 4];
        const bool with_voids = i % 4 == 3;
        const PyramidPages pages(region.field, region.unhidden);
        const Camera camera = random_camera(random, region);
        const double tau_px = taus_px[i / 4 % 3];
        const std::set<Key> there = random_residents(region, random);
        const GridPlan all = planned(pages, pages.residency(), camera, tau_px);
        const GridPlan plan =
            planned(pages, pages.residency([&](const PageIndex& page) { return there.contains(key(page)); }),
                    camera, tau_px);
        ASSERT_NO_FATAL_FAILURE(expect_missing(pages, camera, all, plan, there)) << i;
        const std::vector<DrawnNode> drawn = test::drawn_nodes(plan);
        std::vector<int> level_at;
        ASSERT_NO_FATAL_FAILURE(test::expect_one_cover(region, drawn, level_at, with_voids)) << i;
        ASSERT_NO_FATAL_FAILURE(test::expect_steps_of_one(region, level_at)) << i;
        if (i < 60 && !with_voids) {
            ASSERT_NO_FATAL_FAILURE(test::expect_watertight(region, drawn)) << i;
        }
        missing += plan.missing.size();
        waiting += plan.pages_wanted - plan.missing.size() - plan.pages.size();
        for (const DrawnNode& node : drawn) stitched += node.edges != 0 ? 1 : 0;
        for (const gpu::FramePage& page : plan.pages) fallbacks += page.fallback_quarters != 0 ? 1 : 0;
    }
    std::printf(
        "seed %u: 400 frames, %zu pages missing, %zu waiting; %zu pages stand in, %zu nodes stitched\n", seed,
        missing, waiting, fallbacks, stitched);
    EXPECT_GT(missing, 1000U);
    EXPECT_GT(waiting, 1000U);
    EXPECT_GT(stitched, 1000U);
}

// With what is hidden left out: every post that can be seen is in a node that is drawn, and in one alone.
TEST(FrameChoice, CoversWhatCanBeSeenWhateverIsMissing) {
    std::mt19937_64 random(35);
    const Region region(patchy_field(600, 521));
    const PyramidPages pages(region.field, region.pyramid);
    const int rows = region.grid(0).row.nodes(), columns = region.grid(0).column.nodes();
    std::size_t uncovered = 0, covered = 0;
    for (int i = 0; i < 40; ++i) {
        const Camera camera = random_camera(random, region);
        const std::set<Key> there = random_residents(region, random);
        const GridPlan plan =
            planned(pages, pages.residency([&](const PageIndex& page) { return there.contains(key(page)); }),
                    camera, 1.0);
        std::vector<int> times(static_cast<std::size_t>(rows * columns), 0);
        for (const DrawnNode& node : test::drawn_nodes(plan)) {
            for (int row = node.row << node.level; row < std::min(rows, (node.row + 1) << node.level);
                 ++row) {
                for (int column = node.column << node.level;
                     column < std::min(columns, (node.column + 1) << node.level); ++column)
                    ++times[static_cast<std::size_t>(row * columns + column)];
            }
        }
        const auto planes = frustum_planes_view(projection_of_tile(camera, whole(camera)));
        const HorizonEye eye = horizon_eye(region.pyramid.shape.occluder, camera.eye_ecef());
        const glm::dmat3 view_from_ecef = camera.view_from_ecef();
        for (int n = 0; n < rows * columns; ++n) {
            ASSERT_LE(times[static_cast<std::size_t>(n)], 1);
            covered += static_cast<std::size_t>(times[static_cast<std::size_t>(n)]);
            if (times[static_cast<std::size_t>(n)] == 1) continue;
            ++uncovered;
            for (int p = 0; p < 81; ++p) {
                const test::RegionPost post{std::min(n / columns * 8 + p / 9, 599),
                                            std::min(n % columns * 8 + p % 9, 520)};
                const glm::dvec3 at = view_from_ecef * (region.ecef_m(post) - camera.eye_ecef().m);
                if (beyond_frustum(planes, at, -1.0e-6)) continue;
                const std::array points{region.ecef_m(post)};
                ASSERT_TRUE(beyond_horizon(eye, horizon_cone(region.pyramid.shape.occluder, points))) << i;
            }
        }
    }
    std::printf("%zu full-resolution nodes covered, %zu not\n", covered, uncovered);
    EXPECT_GT(covered, 10000U);
    EXPECT_GT(uncovered, 10000U);
}

}  // namespace
}  // namespace oro
