// What a frame shows against what is there: rays cast on the CPU, no gaps, and culling that changes nothing.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

#include "core/terrain/ground.h"
#include "core/truth/oracle.h"
#include "render/frame/picture_renderer.h"
#include "tests/support/drawn/plain_style.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/rough_terrain.h"

namespace oro {
namespace {

// Pages that nothing can hide.
class UnhiddenPages : public RegionPages {
  public:
    explicit UnhiddenPages(std::unique_ptr<RegionPages> pages)
        : RegionPages(pages->facts()), pages_(std::move(pages)) {}
    [[nodiscard]] Result<PageRecord> record(const PageIndex& page) const override {
        ORO_TRY(PageRecord record, pages_->record(page));
        record.reach_m = 1e12;
        record.horizon.angle_rad = std::numbers::pi;
        return record;
    }
    Result<void> load(const PageIndex& page, gpu::PageBlock& block) const override {
        return pages_->load(page, block);
    }

  private:
    std::unique_ptr<RegionPages> pages_;
};

class Frame : public test::GpuTest, public ::testing::WithParamInterface<RasterPath> {
  protected:
    static constexpr int side_px = 96;

    void SetUp() override {
        GpuTest::SetUp();
        field_ = test::rough_field(46.9, 8.1, 400, 400);
        auto scene = Scene::create(*gpu_, pages_in_memory(field_, 1.0, 2));
        ASSERT_TRUE(scene.ok()) << scene.error().line();
        scene_.emplace(std::move(scene).value());
        auto unhidden = Scene::create(*gpu_, std::make_unique<UnhiddenPages>(pages_in_memory(field_, 1.0, 2)),
                                      SceneMemory{std::uint64_t{64} << 20U, 0});
        ASSERT_TRUE(unhidden.ok()) << unhidden.error().line();
        unhidden_.emplace(std::move(unhidden).value());
        FrameRendererOptions options;
        options.extent = {side_px, side_px};
        options.path = GetParam();
        options.keep_depths = true;
        auto renderer = FrameRenderer::create(*gpu_, options);
        ASSERT_TRUE(renderer.ok()) << renderer.error().line();
        renderer_.emplace(std::move(renderer).value());
    }

    void TearDown() override {
        renderer_.reset();
        scene_.reset();
        unhidden_.reset();
        GpuTest::TearDown();
    }

    // An eye over the middle of the region; above_m over its ground.
    Camera random_camera(std::mt19937& random, double lowest_m, double highest_m, double pitch_low_deg,
                         double pitch_high_deg) {
        const auto between = [&](double a, double b) {
            return std::uniform_real_distribution<double>(a, b)(random);
        };
        Camera camera;
        const double lat_deg = between(46.7, 46.8), lon_deg = between(8.22, 8.32);
        const double above_m = std::exp(between(std::log(lowest_m), std::log(highest_m)));
        camera.eye = {lat_deg, lon_deg, *ground_h_m(field_, lat_deg, lon_deg) + above_m};
        camera.attitude = {between(0, 360), between(pitch_low_deg, pitch_high_deg), between(-180, 180)};
        camera.vertical_fov_deg = 40.0;
        camera.width_px = camera.height_px = side_px;
        return camera;
    }

    FramePlan plan(const Camera& camera, double tau_px = 0.0) {
        auto made = scene_->settled_plan({camera, {0, 0, side_px, side_px, {0.5, 0.5}}, tau_px});
        EXPECT_TRUE(made.ok()) << made.error().line();
        EXPECT_TRUE(made->grids[0].missing.empty());
        return std::move(made).value();
    }

    std::vector<std::uint32_t> drawn_ids(FramePlan frame_plan) {
        auto drawn = renderer_->draw(std::move(frame_plan), {});
        EXPECT_TRUE(drawn.ok()) << drawn.error().line();
        auto ids = renderer_->read_ids(side_px, side_px);
        EXPECT_TRUE(ids.ok()) << ids.error().line();
        return *ids;
    }

    std::vector<float> drawn_depths() {
        auto depths = renderer_->read_depths(side_px, side_px);
        EXPECT_TRUE(depths.ok()) << depths.error().line();
        return *depths;
    }

    HeightField field_;
    std::optional<Scene> scene_;
    std::optional<Scene> unhidden_;
    std::optional<FrameRenderer> renderer_;
};

// The distance of each pixel against a ray on the CPU: placement, camera, projection and rasteriser together.
// Along a ray that grazes the ground the crossing is uncertain by the rasteriser's own grain (1/256 px), so
// the difference is measured across the ray: the distance error times the sine between ray and surface is not
// known here, and 1 px of it is allowed for.
TEST_P(Frame, DistancesAgreeWithRaysOnTheCpu) {
    constexpr unsigned seed = 41;
    std::mt19937 random(seed);
    const TrueSurface surface(field_, 1.0, 1);
    int compared = 0, far_off = 0, missed = 0;
    double worst_share = 0.0;
    for (int i = 0; i < 12; ++i) {
        const Camera camera = random_camera(random, 2.0, 4000.0, -70.0, -10.0);
        const auto ids = drawn_ids(plan(camera));
        const auto depths = drawn_depths();
        for (int y = 3; y < side_px; y += 7) {
            for (int x = 3; x < side_px; x += 7) {
                const glm::dvec3 ray = camera.ecef_direction_at({x + 0.5, y + 0.5});
                const auto hit = first_hit(surface, sight_from(camera.eye), ray, 1e5);
                const std::size_t at = static_cast<std::size_t>(y * side_px + x);
                if (!hit || ids[at] == 0) {
                    missed += hit.has_value() != (ids[at] != 0) ? 1 : 0;
                    continue;
                }
                const glm::dvec3 view = camera.view_from_ecef() * ray;
                const double drawn_m = near_plane_m / static_cast<double>(depths[at]) / -view.z;
                const double share = std::abs(drawn_m - hit->distance_m) / hit->distance_m;
                ++compared;
                if (share > 0.01)
                    ++far_off;
                else
                    worst_share = std::max(worst_share, share);
            }
        }
    }
    std::printf(
        "seed %u: %d pixels compared, %d on other surfaces or grazing, %d seen by one side only, worst other "
        "%.2g of the distance\n",
        seed, compared, far_off, missed, worst_share);
    EXPECT_GT(compared, 1500);
    EXPECT_LE(far_off, compared / 50);  // skylines within the picture
    EXPECT_LE(missed, compared / 100);
}

TEST_P(Frame, LookingDownShowsNoGap) {
    constexpr unsigned seed = 42;
    std::mt19937 random(seed);
    std::printf("seed %u\n", seed);
    for (int i = 0; i < 150; ++i) {
        const Camera camera = random_camera(random, 30.0, 6000.0, -90.0, -75.0);
        const auto ids = drawn_ids(plan(camera));
        ASSERT_EQ(std::count(ids.begin(), ids.end(), 0U), 0)
            << "camera " << i << " at " << camera.eye.lat_deg << "," << camera.eye.lon_deg << " h "
            << camera.eye.h_m;
    }
}

TEST_P(Frame, CullingChangesNoPixel) {
    constexpr unsigned seed = 43;
    std::mt19937 random(seed);
    std::printf("seed %u\n", seed);
    for (int i = 0; i < 40; ++i) {
        const Camera camera = random_camera(random, 2.0, 200000.0, -90.0, 20.0);
        drawn_ids(plan(camera));
        const auto culled = drawn_depths();
        // Every page and every meshlet: pages made so large and so high that no test drops them, and no test
        // on the GPU.
        auto all = unhidden_->settled_plan({camera, {0, 0, side_px, side_px, {0.5, 0.5}}, 0.0});
        ASSERT_TRUE(all.ok()) << all.error().line();
        ASSERT_EQ(all->grids[0].pages.size(), 16U + 4U + 1U);
        for (gpu::FramePage& page : all->grids[0].pages) page.cull = 0;
        drawn_ids(std::move(all).value());
        ASSERT_EQ(culled, drawn_depths()) << "camera " << i;
    }
}

TEST_P(Frame, SameInputGivesSameBytes) {
    std::mt19937 random(44);
    const Camera camera = random_camera(random, 100.0, 1000.0, -40.0, -10.0);
    const gpu::FrameStyle style = test::plain_style();
    std::vector<std::uint8_t> first;
    for (int i = 0; i < 3; ++i) {
        ASSERT_TRUE(renderer_->draw(plan(camera), style).ok());
        auto picture = renderer_->read_picture(side_px, side_px);
        ASSERT_TRUE(picture.ok());
        if (i == 0) first = *picture;
        EXPECT_EQ(*picture, first) << "run " << i;
    }
}

TEST_P(Frame, TilesJoinIntoTheSamePicture) {
    std::mt19937 random(45);
    Camera camera = random_camera(random, 300.0, 1000.0, -30.0, -10.0);
    camera.width_px = 150;
    camera.height_px = 100;
    const gpu::FrameStyle style = test::plain_style();
    const auto picture = [&](int tile_px, int samples) {
        std::vector<std::uint8_t> rows;
        PictureOptions options;
        options.largest_tile_px = tile_px;
        options.samples = samples;
        options.path = GetParam();
        const auto report = render_picture(*gpu_, *scene_, camera, style, options,
                                           [&](std::span<const std::uint8_t> rgb) -> Result<void> {
                                               rows.insert(rows.end(), rgb.begin(), rgb.end());
                                               return {};
                                           });
        EXPECT_TRUE(report.ok()) << report.error().line();
        return rows;
    };
    for (const int samples : {1, 4}) {
        const auto whole = picture(0, samples), tiled = picture(37, samples);
        ASSERT_EQ(whole.size(), tiled.size());
        std::size_t different = 0;
        for (std::size_t i = 0; i < whole.size(); ++i)
            different += std::abs(int{whole[i]} - int{tiled[i]}) > 2 ? 1U : 0U;
        // A tile's projection rounds on its own: a pixel on a skyline may fall to the other side.
        EXPECT_LE(different, whole.size() / 500) << samples << " samples";
    }
}

// A part of a picture has its bytes and depths, whatever tiles it is drawn in, with edges that depend on the
// pixels beside it.
TEST_P(Frame, PartsHaveThePicturesPixels) {
    constexpr unsigned seed = 20261129;
    std::printf("seed %u\n", seed);
    std::mt19937 random(seed);
    Camera camera = random_camera(random, 100.0, 400.0, -25.0, -10.0);
    camera.width_px = 150;
    camera.height_px = 100;
    gpu::FrameStyle style = test::plain_style();
    style.smooth_edges = 1;
    for (const int tile_px : {0, 64}) {
        PictureOptions options;
        options.largest_tile_px = tile_px;
        options.path = GetParam();
        options.keep_depths = true;
        auto renderer = PictureRenderer::create(*gpu_, camera, style, options);
        ASSERT_TRUE(renderer.ok()) << renderer.error().line();
        const auto pixels = [&](const Tile& part) {
            std::vector<std::uint8_t> rows;
            const auto report =
                renderer->draw_part(*scene_, camera, part, style, [&](std::span<const std::uint8_t> rgb) {
                    EXPECT_EQ(rgb.size(), 3 * static_cast<std::size_t>(part.width_px));
                    rows.insert(rows.end(), rgb.begin(), rgb.end());
                    return Result<void>();
                });
            EXPECT_TRUE(report.ok()) << report.error().line();
            return rows;
        };
        const Tile all{0, 0, camera.width_px, camera.height_px};
        const std::vector<std::uint8_t> whole = pixels(all);
        const std::vector<float> depths = renderer->depths();
        const auto [darkest, lightest] = std::ranges::minmax(whole);
        ASSERT_GT(lightest - darkest, 30) << "a picture of something";
        for (int i = 0; i < 8; ++i) {
            const auto any = [&](int most) {
                return static_cast<int>(random() % static_cast<unsigned>(most + 1));
            };
            Tile part{any(140), any(90)};
            part.width_px = i == 0 ? 1 : 1 + any(149 - part.x_px);
            part.height_px = 1 + any(99 - part.y_px);
            const std::vector<std::uint8_t> rows = pixels(part);
            ASSERT_EQ(rows.size(), std::size_t{3} * static_cast<std::size_t>(part.width_px) *
                                       static_cast<std::size_t>(part.height_px));
            std::size_t at = 0, different = 0;
            for (int y = part.y_px; y < part.y_px + part.height_px; ++y) {
                for (int x = part.x_px; x < part.x_px + part.width_px; ++x) {
                    const auto pixel = static_cast<std::size_t>(y * camera.width_px + x);
                    for (std::size_t k = 0; k < 3; ++k) different += rows[at++] != whole[3 * pixel + k];
                    different += renderer->depths()[pixel] != depths[pixel];
                }
            }
            EXPECT_EQ(different, 0U) << part.x_px << ", " << part.y_px << ": " << part.width_px << " x "
                                     << part.height_px << ", tiles of " << tile_px;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Paths, Frame, ::testing::Values(RasterPath::mesh, RasterPath::compute),
                         [](const auto& path) {
                             return path.param == RasterPath::mesh ? "mesh" : "compute";
                         });

// The two ways of drawing are each other's test: the same triangle in at least 99.9 % of pixels, the others
// within a pixel of an edge, and the same depth to 2 units in the last place where the triangle is the same.
class TwoPaths : public Frame {};

TEST_P(TwoPaths, DrawTheSameTriangles) {
    FrameRendererOptions options;
    options.extent = {side_px, side_px};
    options.path = RasterPath::mesh;
    options.keep_depths = true;
    auto other = FrameRenderer::create(*gpu_, options);
    ASSERT_TRUE(other.ok()) << other.error().line();
    constexpr unsigned seed = 46;
    std::mt19937 random(seed);
    std::size_t pixels = 0, different = 0, not_at_an_edge = 0, far_depths = 0;
    for (int i = 0; i < 50; ++i) {
        const Camera camera = i % 2 ? random_camera(random, 0.02, 50.0, -90.0, 30.0)
                                    : random_camera(random, 10.0, 100000.0, -90.0, 10.0);
        const double tau_px = i % 3 == 0 ? 0.0 : 1.0;
        const auto ids = drawn_ids(plan(camera, tau_px));
        const auto depths = drawn_depths();
        ASSERT_TRUE(other->draw(plan(camera, tau_px), {}).ok());
        const auto other_ids = *other->read_ids(side_px, side_px);
        const auto other_depths = *other->read_depths(side_px, side_px);
        pixels += ids.size();
        for (int at = 0; at < side_px * side_px; ++at) {
            const auto k = static_cast<std::size_t>(at);
            if (ids[k] == other_ids[k]) {
                std::int32_t one = 0, two = 0;  // positive floats: their bits count their places
                std::memcpy(&one, &depths[k], sizeof one);
                std::memcpy(&two, &other_depths[k], sizeof two);
                far_depths += std::abs(one - two) > 2 ? 1U : 0U;
                continue;
            }
            ++different;
            // An edge of what either path shows here runs within a pixel.
            bool near = false;
            for (int dy = -1; dy <= 1; ++dy) {
                for (int dx = -1; dx <= 1; ++dx) {
                    const int x = std::clamp(at % side_px + dx, 0, side_px - 1),
                              y = std::clamp(at / side_px + dy, 0, side_px - 1);
                    const auto neighbour = static_cast<std::size_t>(y * side_px + x);
                    near = near || ids[neighbour] != ids[k] || other_ids[neighbour] != other_ids[k];
                }
            }
            not_at_an_edge += near ? 0U : 1U;
        }
    }
    std::printf(
        "seed %u: %zu of %zu pixels differ (%.4f %%), %zu of them farther than a pixel from an edge; %zu "
        "depths differ by more than 2 units in the last place\n",
        seed, different, pixels, 100.0 * static_cast<double>(different) / static_cast<double>(pixels),
        not_at_an_edge, far_depths);
    EXPECT_LE(different, pixels / 1000);
    EXPECT_EQ(not_at_an_edge, 0U);
    EXPECT_EQ(far_depths, 0U);
}

INSTANTIATE_TEST_SUITE_P(Compute, TwoPaths, ::testing::Values(RasterPath::compute),
                         [](const auto&) { return "mesh"; });

}  // namespace
}  // namespace oro
