// Must hold: no tree is left out that covers a pixel. A picture's ids of trees are held against every site of
// the lattice within reach, each crown asked for each pixel in double (tests/support/drawn/nearest_crowns.h).
// All of the ground is forest by a map of land cover, so that what stands on a site is known without the GPU.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <map>
#include <random>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "tests/styles/grown_frame.h"
#include "tests/support/asked_count.h"
#include "tests/support/drawn/frame_ground.h"
#include "tests/support/drawn/nearest_crowns.h"

namespace oro {
namespace {

constexpr auto grown_over = static_cast<double>(gpu::site_rule::trees_grow_in);

struct CrownCounts {
    std::size_t crowns{}, seen_crowns{}, crown_px{}, bare_px{}, doubtful_px{};
    std::size_t lost_crowns{}, wrong_px{}, invented_px{};
    void add(const CrownCounts& more) {
        crowns += more.crowns;
        seen_crowns += more.seen_crowns;
        crown_px += more.crown_px;
        bare_px += more.bare_px;
        doubtful_px += more.doubtful_px;
        lost_crowns += more.lost_crowns;
        wrong_px += more.wrong_px;
        invented_px += more.invented_px;
    }
};

// Every tree within reach of the frame's eye, nearest first.
std::vector<test::ReferenceCrown> all_crowns(const test::GrownFrame& frame, const RegionPages& pages,
                                             const test::GrownCover& cover) {
    namespace rule = gpu::site_rule;
    const GridPlan& plan = frame.plan.grids[0];
    const gpu::FrameConstants& constants = plan.constants;
    const Camera& camera = frame.plan.view.camera;
    const glm::dvec3 up_view(constants.up_view), pole = camera.view_from_ecef() * glm::dvec3(0.0, 0.0, 1.0);
    const double centre_m =
                     static_cast<double>(constants.earth_radius_m) + static_cast<double>(constants.eye_h_m),
                 per_tangent = static_cast<double>(constants.pixels_per_tangent),
                 reach_m = static_cast<double>(plan.growth.reach_m);
    test::FrameGround ground(pages, plan, camera);
    std::vector<test::ReferenceCrown> crowns;
    test::for_each_site_around(test::tree_lattice(), camera.eye, reach_m, [&](const test::LatticeSite& site) {
        const double rank = static_cast<double>(rule::site_rank(site.hash));
        if (rank >= static_cast<double>(rule::stocked_sites)) return;
        if (cover.stands < 1.0 && static_cast<double>(rule::site_number(site.hash, 11U)) >= cover.stands)
            return;
        const auto place = ground.at(site.lat_deg, site.lon_deg);
        if (!place) return;
        const double distance_m = glm::length(place->view);
        if (distance_m < 3.0 || distance_m > reach_m) return;
        const double kept =
            static_cast<double>(rule::trees_at(static_cast<float>(distance_m), plan.growth.reach_m)) *
            (static_cast<double>(rule::stocked_sites) + grown_over);
        const double grown = std::clamp((kept - rank) / grown_over, 0.0, 1.0);
        const double size =
            grown * grown * (3.0 - 2.0 * grown) *
            (cover.is_alone ? 0.3 + 0.5 * static_cast<double>(rule::site_number(site.hash, 10U)) : 1.0);
        const double code = std::floor(255.0 * size + 0.5),
                     between = std::abs(255.0 * size + 0.5 - std::round(255.0 * size + 0.5));
        if (code < 19.0) return;
        test::ReferenceCrown crown =
            test::reference_crown({site.hash, cover.is_needle, cover.is_alone, code / 255.0}, place->view,
                                  glm::normalize(place->view + centre_m * up_view), pole,
                                  -place->view.z / per_tangent, static_cast<double>(constants.exaggeration));
        crown.is_doubtful = between < 5.0e-3 || code < 20.0 || std::abs(distance_m - 3.0) < 1.0e-3;
        crown.row = site.row;
        crown.column = site.column;
        crowns.push_back(crown);
    });
    std::ranges::sort(crowns, {}, [](const test::ReferenceCrown& one) { return -one.middle.z; });
    return crowns;
}

CrownCounts compare(const test::GrownFrame& frame, const RegionPages& pages, const test::GrownCover& cover) {
    const Camera& camera = frame.plan.view.camera;
    const std::vector<test::ReferenceCrown> crowns = all_crowns(frame, pages, cover);
    test::NearestCrowns nearest(projection_of_tile(camera, frame.plan.view.tile), camera.width_px,
                                camera.height_px, frame.ground_m);
    for (std::size_t i = 0; i < crowns.size(); ++i) nearest.add(crowns[i], static_cast<int>(i));
    CrownCounts counts;
    counts.crowns = crowns.size();
    std::set<std::pair<std::uint32_t, std::uint32_t>> drawn;
    for (const std::uint32_t id : frame.ids)
        if (const auto site = frame.tree_of(id)) drawn.insert(*site);
    std::set<int> seen;
    for (int y = 0; y < camera.height_px; ++y) {
        for (int x = 0; x < camera.width_px; ++x) {
            const int shown = nearest.shown(x, y);
            const auto site = frame.tree_of(frame.ids[static_cast<std::size_t>(y * camera.width_px + x)]);
            if (shown == test::is_doubtful_pixel) {
                ++counts.doubtful_px;
            } else if (shown == test::shows_no_crown) {
                ++counts.bare_px;
                counts.invented_px += site ? 1U : 0U;
            } else {
                const test::ReferenceCrown& crown = crowns[static_cast<std::size_t>(shown)];
                ++counts.crown_px;
                seen.insert(shown);
                counts.wrong_px += site == std::pair(crown.row, crown.column) ? 0U : 1U;
            }
        }
    }
    counts.seen_crowns = seen.size();
    for (const int number : seen) {
        const test::ReferenceCrown& crown = crowns[static_cast<std::size_t>(number)];
        counts.lost_crowns += drawn.contains({crown.row, crown.column}) ? 0U : 1U;
    }
    return counts;
}

using test::CulledGrowth;

constexpr std::array all_covers{test::needle_cover, test::broad_cover, test::shrub_cover};

// Eyes over a field with each kind of forest.
CrownCounts crowns_over(CulledGrowth& frames, const HeightField& field, const test::GrownEyes& eyes,
                        std::span<const test::GrownCover> covers, double exaggeration = 1.0) {
    CrownCounts all;
    const gpu::FrameStyle style = CulledGrowth::natural_style(field, gpu::materials_with_trees);
    for (const test::GrownCover& cover : covers) {
        auto scene = frames.grown_scene(field, cover, gpu::materials_with_trees, exaggeration);
        if (!scene) return all;
        for (const test::GrownEye& eye : CulledGrowth::random_eyes(field, eyes, cover.number, exaggeration)) {
            const auto frame = frames.draw(*scene, eye, style);
            if (!frame) return all;
            const CrownCounts counts = compare(*frame, scene->grids()[0].pages(), cover);
            EXPECT_EQ(counts.lost_crowns, 0U) << eye.words();
            all.add(counts);
        }
    }
    std::printf(
        "%zu eyes, seed %u, exaggeration %g: %zu trees within reach, %zu cover a pixel; %zu px of trees, %zu "
        "of none, "
        "%zu doubtful; lost: %zu trees, %zu px wrong, %zu px invented\n",
        covers.size() * static_cast<std::size_t>(eyes.count), eyes.seed, exaggeration, all.crowns,
        all.seen_crowns, all.crown_px, all.bare_px, all.doubtful_px, all.lost_crowns, all.wrong_px,
        all.invented_px);
    // Rays step through the leaves of near crowns, and each step makes more of what was rounded before it: of
    // some that is not noticed.
    EXPECT_LE(all.wrong_px + all.invented_px, all.crown_px / 50000U) << "seed " << eyes.seed;
    return all;
}

TEST_F(CulledGrowth, IsNoTreeThatShows) {
    const CrownCounts counts = crowns_over(
        *this, made_hills(), {1, 20261129, {96, 54}, 40.0, 65.0, 30.0, 60.0}, std::span(all_covers).first(1));
    EXPECT_GT(counts.crown_px, 2000U);
    EXPECT_GT(counts.seen_crowns, 50U);
}

TEST_F(CulledGrowth, IsNoTreeThatShowsFromAHundredEyes) {
    const int eyes = test::asked_count("OROGRAPH_CROWN_EYES", 102);
    const auto real = real_mountains();
    std::printf("%s\n", real ? "real data" : "made terrain: there are no real data");
    const CrownCounts counts = crowns_over(*this, real ? *real : made_hills(),
                                           {(eyes + 2) / 3, 20261130, {256, 144}, 15.0, 70.0}, all_covers);
    EXPECT_GT(counts.crown_px, std::size_t{5000} * static_cast<std::size_t>(eyes));
    EXPECT_GT(counts.seen_crowns, std::size_t{200} * static_cast<std::size_t>(eyes));
    // Most are leaves of near crowns, where chance decides; all others decide this test.
    EXPECT_LT(2 * counts.doubtful_px, counts.crown_px);
}

// Trees are exaggerated with the ground.
TEST_F(CulledGrowth, IsNoExaggeratedTreeThatShows) {
    for (const double exaggeration : {0.4, 2.5, 20.0}) {
        const int eyes = test::asked_count("OROGRAPH_CROWN_EYES", 18);
        EXPECT_GT(crowns_over(*this, made_hills(), {(eyes + 2) / 3, 20261201, {128, 72}, 12.0, 65.0},
                              all_covers, exaggeration)
                      .crown_px,
                  4000U)
            << exaggeration;
    }
}

// What would be lost is noticed: by a plan without the tile of the trees in the most pixels.
TEST_F(CulledGrowth, OfTreesIsNoticed) {
    const HeightField field = made_hills();
    auto scene = grown_scene(field, test::broad_cover, gpu::materials_with_trees, 1.0);
    ASSERT_TRUE(scene);
    const gpu::FrameStyle style = natural_style(field, gpu::materials_with_trees);
    const test::GrownEye eye =
        random_eyes(field, {1, 20261129, {96, 54}, 40.0, 65.0}, test::broad_cover.number, 1.0).front();
    auto frame = draw(*scene, eye, style);
    ASSERT_TRUE(frame);
    const RegionPages& pages = scene->grids()[0].pages();
    EXPECT_EQ(compare(*frame, pages, test::broad_cover).wrong_px, 0U);
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> tiles;
    for (const std::uint32_t id : frame->ids)
        if (const auto site = frame->tree_of(id))
            ++tiles[{site->first / gpu::sites_per_side, site->second / gpu::sites_per_side}];
    ASSERT_FALSE(tiles.empty());
    const auto most = std::ranges::max_element(tiles, {}, [](const auto& one) { return one.second; })->first;
    const auto without = draw(*scene, eye, style, [&](FramePlan& plan) {
        std::erase_if(plan.grids[0].growth.tiles,
                      [&](const gpu::GrowthTile& tile) { return std::pair(tile.row, tile.column) == most; });
    });
    ASSERT_TRUE(without);
    const CrownCounts lost = compare(*without, pages, test::broad_cover);
    std::printf("without a tile: %zu trees lost, %zu px wrong\n", lost.lost_crowns, lost.wrong_px);
    EXPECT_GT(lost.lost_crowns, 0U);
}

}  // namespace
}  // namespace oro
