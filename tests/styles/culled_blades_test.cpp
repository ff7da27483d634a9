// Must hold: no blade of grass is left out that covers a pixel. A picture's ids are held against every clump
// of the lattice within reach, each blade asked for each pixel in double
// (tests/support/drawn/nearest_blades.h). All of the ground is meadow by a map of land cover.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "tests/styles/grown_frame.h"
#include "tests/support/asked_count.h"
#include "tests/support/drawn/frame_ground.h"
#include "tests/support/drawn/lattice_sites.h"
#include "tests/support/drawn/nearest_blades.h"

namespace oro {
namespace patch_rule {
namespace {
using glm::floor;
using glm::ivec3;
using glm::mix;
using glm::uint;
using glm::uintBitsToFloat;
using glm::uvec3;
using glm::vec2;
using glm::vec3;
#define ORO_FUNCTION [[maybe_unused]]
#include "shaders/shade/lattice_noise.glsl"
#undef ORO_FUNCTION
}  // namespace
}  // namespace patch_rule

namespace {

double blade_smooth(double low, double high, double x) {
    const double share = std::clamp((x - low) / (high - low), 0.0, 1.0);
    return share * share * (3.0 - 2.0 * share);
}

struct BladeCounts {
    std::size_t blades{}, seen_blades{}, blade_px{}, bare_px{}, doubtful_px{};
    std::size_t lost_blades{}, wrong_px{}, invented_px{};
    void add(const BladeCounts& more) {
        blades += more.blades;
        seen_blades += more.seen_blades;
        blade_px += more.blade_px;
        bare_px += more.bare_px;
        doubtful_px += more.doubtful_px;
        lost_blades += more.lost_blades;
        wrong_px += more.wrong_px;
        invented_px += more.invented_px;
    }
};

// Every clump that stands within reach of a frame's eye: as shaders/growth/grow_meadow.comp decides.
class MeadowOfFrame {
  public:
    MeadowOfFrame(const test::GrownFrame& frame, const RegionPages& pages,
                  const gpu::MaterialTable& materials)
        : camera_(frame.plan.view.camera),
          constants_(frame.plan.grids[0].constants),
          materials_(materials),
          ground_(pages, frame.plan.grids[0], camera_),
          ecef_from_view_(glm::transpose(camera_.view_from_ecef())),
          per_tangent_(static_cast<double>(constants_.pixels_per_tangent)) {}

    std::vector<test::ReferenceClump> clumps() {
        std::vector<test::ReferenceClump> all;
        const test::SiteLattice lattice{
            gpu::meadow_tiles_per_side, gpu::clumps_per_side, [](std::uint32_t hash) {
                return glm::dvec2(0.2 + 0.6 * static_cast<double>(gpu::grass_rule::site_number(hash, 1U)),
                                  0.2 + 0.6 * static_cast<double>(gpu::grass_rule::site_number(hash, 2U)));
            }};
        test::for_each_site_around(lattice, camera_.eye, static_cast<double>(gpu::meadow_reach_m) + 1.0,
                                   [&](const test::LatticeSite& site) { add(site, all); });
        return all;
    }

  private:
    void add(const test::LatticeSite& site, std::vector<test::ReferenceClump>& all) {
        namespace rule = gpu::grass_rule;
        const auto place = ground_.at(site.lat_deg, site.lon_deg);
        if (!place) return;
        const double distance_m = glm::length(place->view),
                     exaggeration = static_cast<double>(constants_.exaggeration);
        double kept = static_cast<double>(rule::meadow_at(static_cast<float>(distance_m)) *
                                          rule::blades_kept(static_cast<float>(distance_m / per_tangent_)));
        const double steep_deg =
            std::atan2(std::hypot(place->normal.x, place->normal.y), exaggeration * place->normal.z) * 180.0 /
            std::numbers::pi;
        kept *= 1.0 - blade_smooth(34.0, 52.0, steep_deg);
        if (kept <= 0.02) return;
        const glm::dmat3 axes = axes_at(place->view);
        const glm::dvec3 normal =
            glm::cross(place->corners[1] - place->corners[0], place->corners[2] - place->corners[0]) * axes;
        test::ReferenceClump clump;
        clump.row = site.row;
        clump.column = site.column;
        clump.hash = site.hash;
        clump.foot = place->view;
        clump.axes = axes;
        clump.axes[2] *= exaggeration;
        clump.slope = glm::clamp(-glm::dvec2(normal) / (normal.z * exaggeration), -3.0, 3.0);
        clump.kept = std::floor(std::min(kept, 32.0) * 1024.0 + 0.5) / 1024.0;
        clump.size = std::clamp(0.75 + 0.5 * static_cast<double>(rule::site_number(site.hash, 8U)) +
                                    0.12 * patches_at(*place, axes),
                                0.55, static_cast<double>(rule::clump_size_most));
        clump.wind =
            glm::dvec2(rule::wind_on_clump(site.hash, site.tile_row, site.tile_column,
                                           gpu::vec2(site.in_tile), materials_.wind, materials_.wind_time_s));
        clump.is_doubtful = place->least_share < 1.0e-5 || kept < 0.021;
        all.push_back(clump);
    }

    [[nodiscard]] glm::dmat3 axes_at(const glm::dvec3& view) const {
        const glm::dvec3 up = glm::normalize(view + (static_cast<double>(constants_.earth_radius_m) +
                                                     static_cast<double>(constants_.eye_h_m)) *
                                                        glm::dvec3(constants_.up_view));
        const glm::dvec3 pole = camera_.view_from_ecef() * glm::dvec3(0.0, 0.0, 1.0),
                         east = glm::normalize(glm::cross(pole, up));
        return {east, glm::cross(up, east), up};
    }

    // The noise that clumps have their size by: shaders/shade/ground_noise.glsl, as fine as
    // find_pixel_materials() asks for it.
    [[nodiscard]] double patches_at(const test::FramePlace& place, const glm::dmat3& axes) const {
        const glm::dvec3 to_eye = glm::normalize(-place.view) * axes;
        const double facing = std::max(glm::dot(place.normal, to_eye), 0.15),
                     foot_m = glm::length(place.view) / std::sqrt(facing) / per_tangent_,
                     finest_m = foot_m * (1.0 - 0.42 * blade_smooth(0.15, 0.6, facing));
        const gpu::NoiseOctave* const octaves = &constants_.noise[0];
        glm::dvec3 at = ecef_from_view_ * place.view / static_cast<double>(octaves[0].cell_m);
        double sum = 0.0;
        for (std::uint32_t i = 0; i < gpu::noise_octaves; ++i) {
            const double kept = std::min(static_cast<double>(octaves[i].cell_m) / finest_m - 2.0, 1.0);
            if (kept <= 0.0) break;
            const glm::dvec3 from_cell = at + glm::dvec3(octaves[i].part), whole = glm::floor(from_cell);
            const glm::uvec3 cell = glm::uvec3(octaves[i].cell) + glm::uvec3(glm::ivec3(whole));
            const glm::vec3 part(from_cell - whole);
            const glm::vec2 both = i == 0 ? patch_rule::two_lattices_noise(cell, part, i)
                                          : patch_rule::lattice_noise(cell, part, i);
            sum += kept * static_cast<double>(octaves[i].patches) * static_cast<double>(both.y);
            at = static_cast<double>(gpu::noise_lacunarity) / 3.0 *
                 glm::dvec3(2.0 * at.x - 2.0 * at.y + at.z, at.x + 2.0 * at.y + 2.0 * at.z,
                            2.0 * at.x + at.y - 2.0 * at.z);
        }
        return sum;
    }

    const Camera& camera_;
    const gpu::FrameConstants& constants_;
    const gpu::MaterialTable& materials_;
    test::FrameGround ground_;
    glm::dmat3 ecef_from_view_;
    double per_tangent_;
};

BladeCounts compare_blades(const test::GrownFrame& frame, const RegionPages& pages,
                           const gpu::MaterialTable& materials) {
    const Camera& camera = frame.plan.view.camera;
    const test::BladePicture picture(projection_of_tile(camera, frame.plan.view.tile), camera.width_px,
                                     camera.height_px,
                                     static_cast<double>(frame.plan.grids[0].constants.pixels_per_tangent));
    const std::vector<test::ReferenceClump> clumps = MeadowOfFrame(frame, pages, materials).clumps();
    test::NearestBlades nearest(camera.width_px, camera.height_px, frame.ground_m);
    BladeCounts counts;
    for (std::size_t i = 0; i < clumps.size(); ++i) {
        for (std::uint32_t number = 0; number < clumps[i].kept; ++number) {
            const auto blade = picture.blade(clumps[i], number);
            if (!blade) continue;
            ++counts.blades;
            nearest.add(*blade, static_cast<std::int64_t>(i * gpu::blades_per_clump + number));
        }
    }
    using BladeName = std::array<std::uint32_t, 3>;
    const auto drawn_at = [&](std::size_t pixel) -> std::optional<BladeName> {
        const std::uint32_t id = frame.ids[pixel];
        const auto clump = frame.clump_of(id);
        if (!clump) return std::nullopt;
        return BladeName{clump->first, clump->second, test::GrownFrame::blade_of(id)};
    };
    std::set<BladeName> drawn, seen;
    for (std::size_t i = 0; i < frame.ids.size(); ++i)
        if (const auto blade = drawn_at(i)) drawn.insert(*blade);
    for (int y = 0; y < camera.height_px; ++y) {
        for (int x = 0; x < camera.width_px; ++x) {
            const std::int64_t shown = nearest.shown(x, y);
            const auto got = drawn_at(static_cast<std::size_t>(y * camera.width_px + x));
            if (shown == test::is_doubtful_sample) {
                ++counts.doubtful_px;
            } else if (shown == test::shows_no_blade) {
                ++counts.bare_px;
                counts.invented_px += got ? 1U : 0U;
            } else {
                const test::ReferenceClump& clump =
                    clumps[static_cast<std::size_t>(shown) / gpu::blades_per_clump];
                const BladeName wanted{clump.row, clump.column,
                                       static_cast<std::uint32_t>(shown) % gpu::blades_per_clump};
                ++counts.blade_px;
                seen.insert(wanted);
                counts.wrong_px += got == wanted ? 0U : 1U;
            }
        }
    }
    counts.seen_blades = seen.size();
    for (const BladeName& one : seen) counts.lost_blades += drawn.contains(one) ? 0U : 1U;
    return counts;
}

using test::CulledGrowth;

BladeCounts blades_over(CulledGrowth& frames, const HeightField& field, const test::GrownEyes& eyes,
                        double exaggeration = 1.0) {
    BladeCounts all;
    auto scene = frames.grown_scene(field, test::meadow_cover, gpu::materials_with_grass, exaggeration);
    if (!scene) return all;
    gpu::FrameStyle style = CulledGrowth::natural_style(field, gpu::materials_with_grass);
    style.materials.wind = 1.0F;
    style.materials.wind_time_s = 43'200.0F;
    for (const test::GrownEye& eye :
         CulledGrowth::random_eyes(field, eyes, test::meadow_cover.number, exaggeration)) {
        const auto frame = frames.draw(*scene, eye, style);
        if (!frame) return all;
        const BladeCounts counts = compare_blades(*frame, scene->grids()[0].pages(), style.materials);
        EXPECT_EQ(counts.lost_blades, 0U) << eye.words();
        EXPECT_EQ(counts.wrong_px, 0U) << eye.words();
        EXPECT_EQ(counts.invented_px, 0U) << eye.words();
        all.add(counts);
    }
    std::printf(
        "%d eyes, seed %u, exaggeration %g: %zu blades within reach, %zu cover a pixel; %zu px of blades, "
        "%zu of none, %zu "
        "doubtful; lost: %zu blades, %zu px wrong, %zu px invented\n",
        eyes.count, eyes.seed, exaggeration, all.blades, all.seen_blades, all.blade_px, all.bare_px,
        all.doubtful_px, all.lost_blades, all.wrong_px, all.invented_px);
    return all;
}

TEST_F(CulledGrowth, IsNoBladeThatShows) {
    EXPECT_GT(blades_over(*this, made_hills(), {1, 20261129, {96, 54}, 30.0, 60.0, 0.6, 8.0}).blade_px, 500U);
}

TEST_F(CulledGrowth, IsNoBladeThatShowsFromAHundredEyes) {
    const int eyes = test::asked_count("OROGRAPH_BLADE_EYES", 100);
    const auto real = real_mountains();
    std::printf("%s\n", real ? "real data" : "made terrain: there are no real data");
    const BladeCounts counts =
        blades_over(*this, real ? *real : made_hills(), {eyes, 20261130, {256, 144}, 15.0, 70.0, 0.6, 12.0});
    EXPECT_GT(counts.blade_px, std::size_t{1500} * static_cast<std::size_t>(eyes));
}

// Blades are exaggerated with the ground.
TEST_F(CulledGrowth, IsNoExaggeratedBladeThatShows) {
    for (const double exaggeration : {0.4, 2.5, 20.0}) {
        const int eyes = test::asked_count("OROGRAPH_BLADE_EYES", 10);
        EXPECT_GT(
            blades_over(*this, made_hills(), {eyes, 20261201, {128, 72}, 15.0, 60.0, 0.6, 8.0}, exaggeration)
                .blade_px,
            500U);
    }
}

// Where the tile of the blade in the most pixels is not in a plan.
TEST_F(CulledGrowth, OfBladesIsNoticed) {
    const HeightField field = made_hills();
    auto scene = grown_scene(field, test::meadow_cover, gpu::materials_with_grass, 1.0);
    ASSERT_TRUE(scene);
    const gpu::FrameStyle style = natural_style(field, gpu::materials_with_grass);
    const test::GrownEye eye =
        random_eyes(field, {1, 20261129, {96, 54}, 30.0, 60.0, 0.6, 8.0}, test::meadow_cover.number, 1.0)
            .front();
    const auto frame = draw(*scene, eye, style);
    ASSERT_TRUE(frame);
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> tiles;
    for (const std::uint32_t id : frame->ids)
        if (const auto clump = frame->clump_of(id))
            ++tiles[{clump->first / gpu::clumps_per_side, clump->second / gpu::clumps_per_side}];
    ASSERT_FALSE(tiles.empty());
    const auto most = std::ranges::max_element(tiles, {}, [](const auto& one) { return one.second; })->first;
    const auto without = draw(*scene, eye, style, [&](FramePlan& plan) {
        std::erase_if(plan.grids[0].meadow.tiles,
                      [&](const gpu::GrowthTile& tile) { return std::pair(tile.row, tile.column) == most; });
    });
    ASSERT_TRUE(without);
    const BladeCounts lost = compare_blades(*without, scene->grids()[0].pages(), style.materials);
    std::printf("without a tile: %zu blades lost, %zu px wrong\n", lost.lost_blades, lost.wrong_px);
    EXPECT_GT(lost.lost_blades, 0U);
}

}  // namespace
}  // namespace oro
