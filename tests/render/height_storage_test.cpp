// Heights in 16 bits on the GPU: half the bytes, half a step at most, the same on every level, voids stay
// voids.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <random>
#include <tuple>

#include "core/frame/casters.h"
#include "core/frame/height_quantization.h"
#include "tests/support/drawn/drawn_scene.h"
#include "tests/support/drawn/made_renderer.h"
#include "tests/support/rough_terrain.h"

namespace oro {
namespace {

constexpr int side_px = 128;

gpu::FrameStyle lit_style(bool casts) {
    gpu::FrameStyle style{};
    style.tint_count = 1;
    style.tints[0].colour = gpu::vec3(0.8F);
    style.sun_enu = glm::normalize(gpu::vec3(0.7F, 0.4F, 0.3F));
    style.ambient = 0.2F;
    style.relief = 1.0F;
    style.haze_distance_m = 1e9F;
    style.sky_scale_height_m = 8000.0F;
    style.shadows = style.sky_openness = casts ? 1U : 0U;
    return style;
}

class HeightsOnGpu : public test::GpuTest {
  protected:
    void SetUp() override {
        GpuTest::SetUp();
        field_ = test::rough_field(46.9, 8.1, 600, 500);
        for (int row = 300; row < 340; ++row)
            std::fill_n(field_.H_m.begin() + row * 500 + 200, 40, void_height_m);
    }

    [[nodiscard]] Scene scene(HeightStorage heights) const {
        auto made =
            Scene::create(*gpu_, pages_in_memory(field_, 1.0, 2), {std::uint64_t{64} << 20U, 0}, heights);
        EXPECT_TRUE(made.ok()) << made.error().line();
        return std::move(made).value();
    }
    [[nodiscard]] FrameRenderer renderer(RasterPath path, bool records = false) const {
        FrameRendererOptions options;
        options.extent = {side_px, side_px};
        options.path = path;
        options.keep_depths = true;
        options.record_positions = records;
        return test::made_renderer(*gpu_, options);
    }

    // Over the void part, heading and pitch as given.
    static Camera camera(double above_m, double heading_deg, double pitch_deg) {
        Camera camera;
        camera.eye = {46.9 - 320.0 / 1200.0, 8.1 + 220.0 / 1200.0, 3000.0 + above_m};
        camera.attitude = {heading_deg, pitch_deg, 0.0};
        camera.vertical_fov_deg = 50.0;
        camera.width_px = camera.height_px = side_px;
        return camera;
    }
    static FramePlan plan(Scene& scene, const Camera& camera, double tau_px) {
        auto made = scene.settled_plan({camera, test::whole_picture(camera), tau_px});
        EXPECT_TRUE(made.ok()) << made.error().line();
        return std::move(made).value();
    }

    HeightField field_;
    std::mt19937 random_{76};
};

TEST_F(HeightsOnGpu, TakeHalfTheBytes) {
    const HeightQuantization sixteen = sixteen_bits(0, 100);
    const std::size_t others = sizeof(gpu::PageBlock) - 4U * gpu::page_heights;
    EXPECT_EQ(page_bytes({}), others + 4U * 17161U);
    EXPECT_EQ(page_bytes(sixteen), others + 2U * 17162U);
    Scene whole = scene(HeightStorage::f32), half = scene(HeightStorage::i16);
    const Camera eye = camera(20000.0, 0.0, -90.0);
    plan(whole, eye, 0.0);
    plan(half, eye, 0.0);
    ASSERT_EQ(whole.grids()[0].store().size(), half.grids()[0].store().size());
    const auto ratio = [](std::uint64_t a, std::uint64_t b) {
        return static_cast<double>(a) / static_cast<double>(b);
    };
    const double expected = ratio(page_bytes(sixteen), sizeof(gpu::PageBlock));
    EXPECT_NEAR(expected, 0.581, 0.001);  // spheres, cones, boxes and diagonals of nodes stay
    EXPECT_NEAR(ratio(half.grids()[0].store().bytes_sent(), whole.grids()[0].store().bytes_sent()), expected,
                1e-9);
    EXPECT_NEAR(ratio(half.grids()[0].store().bytes(), whole.grids()[0].store().bytes()), expected, 1e-9);
    EXPECT_GT(half.grids()[0].store().capacity(),
              1.7 * static_cast<double>(whole.grids()[0].store().capacity()));
    EXPECT_EQ(whole.height_step_m(), 1.0 / 2048.0);
    EXPECT_EQ(half.height_step_m(), 0.0625);  // some 3,500 m of heights; 65,534 / 32 = 2,048 m
}

TEST_F(HeightsOnGpu, AreWithinHalfAStep) {
    Scene whole = scene(HeightStorage::f32), half = scene(HeightStorage::i16);
    FrameRenderer recorder = renderer(RasterPath::mesh, true);
    const Camera eye = camera(20000.0, 0.0, -90.0);
    const auto recorded = [&](Scene& from) {
        FramePlan drawn = plan(from, eye, 0.0);
        for (gpu::FramePage& page : drawn.grids[0].pages) page.cull = 0;
        EXPECT_TRUE(recorder.draw(drawn, {}).ok());
        return std::pair(recorder.recorded(), drawn.grids[0].page_indices);
    };
    const auto [at, pages] = recorded(whole);
    const auto [coded, coded_pages] = recorded(half);
    ASSERT_EQ(pages.size(), coded_pages.size());
    double worst_m = 0.0;
    std::size_t posts = 0, moved = 0;
    for (std::size_t n = 0; n < pages.size(); ++n) {
        ASSERT_EQ(pages[n].level, coded_pages[n].level);
        ASSERT_EQ(pages[n].row, coded_pages[n].row);
        ASSERT_EQ(pages[n].column, coded_pages[n].column);
        if (pages[n].level != 0) continue;
        for (std::size_t i = n * 129 * 129; i < (n + 1) * 129 * 129; ++i) {
            const double off_m = static_cast<double>(glm::length(coded[i] - at[i]));
            worst_m = std::max(worst_m, off_m);
            moved += off_m > 0.0 ? 1U : 0U;
            ++posts;
        }
    }
    std::printf("%zu posts, %zu moved, by at most %.4f m; a step is %.4f m\n", posts, moved, worst_m,
                half.height_step_m());
    EXPECT_GT(moved, posts / 2);
    EXPECT_LE(worst_m, 0.5 * half.height_step_m() + 0.01);  // floats 23 km away
}

TEST_F(HeightsOnGpu, BothPathsDrawTheSame) {
    Scene half = scene(HeightStorage::i16);
    FrameRenderer mesh = renderer(RasterPath::mesh), compute = renderer(RasterPath::compute);
    std::size_t different = 0, pixels = 0, background = 0;
    for (int i = 0; i < 24; ++i) {
        const Camera eye = camera(std::pow(1.5, i), 37.0 * i, i % 3 == 0 ? -90.0 : -20.0);
        const double tau_px = i % 2 ? 1.0 : 0.0;
        ASSERT_TRUE(mesh.draw(plan(half, eye, tau_px), {}).ok());
        ASSERT_TRUE(compute.draw(plan(half, eye, tau_px), {}).ok());
        const auto one = *mesh.read_ids(side_px, side_px), other = *compute.read_ids(side_px, side_px);
        for (std::size_t at = 0; at < one.size(); ++at) different += one[at] != other[at] ? 1U : 0U;
        pixels += one.size();
        background += static_cast<std::size_t>(std::count(one.begin(), one.end(), 0U));
    }
    std::printf("%zu of %zu pixels differ\n", different, pixels);
    EXPECT_LE(different, pixels / 1000);
    EXPECT_LT(background, pixels / 2);
}

// Packed ones are those of 32 bits: not one pixel's triangle, depth or colour is another, by either path.
// Half of the views have shadows and the sky's openness, which read heights in ways of their own.
TEST_F(HeightsOnGpu, PackedDrawTheSamePictures) {
    for (float& H_m : field_.H_m)
        if (!is_void(H_m) && random_() % 5 != 0) H_m = std::round(H_m);
    Scene whole = scene(HeightStorage::f32), packed = scene(HeightStorage::packed);
    std::ptrdiff_t background = 0;
    for (const RasterPath path : {RasterPath::mesh, RasterPath::compute}) {
        FrameRenderer renderer = this->renderer(path);
        for (int i = 0; i < 24; ++i) {
            const Camera eye = camera(std::pow(1.5, i), 37.0 * i, i % 3 == 0 ? -90.0 : -20.0);
            const gpu::FrameStyle style = lit_style(i % 4 >= 2);
            const auto drawn = [&](Scene& from) {
                from.set_shadow_request(shadow_request(style));
                EXPECT_TRUE(renderer.draw(plan(from, eye, i % 2 ? 1.0 : 0.0), style).ok());
                return std::tuple(*renderer.read_ids(side_px, side_px),
                                  *renderer.read_depths(side_px, side_px),
                                  *renderer.read_picture(side_px, side_px));
            };
            const auto [ids, depths, colours] = drawn(whole);
            const auto [packed_ids, packed_depths, packed_colours] = drawn(packed);
            EXPECT_EQ(ids, packed_ids) << "eye " << i;
            EXPECT_EQ(depths, packed_depths) << "eye " << i;
            EXPECT_EQ(colours, packed_colours) << "eye " << i;
            background += std::count(ids.begin(), ids.end(), 0U);
        }
    }
    EXPECT_LT(background, 48 * side_px * side_px / 2);
    EXPECT_LT(packed.grids()[0].store().bytes_a_post(), 2.6) << "a fifth of the posts have no whole metres";
    EXPECT_EQ(whole.grids()[0].store().bytes_a_post(), 4.0 * 17161 / 16384);
    EXPECT_EQ(packed.height_step_m(), 1.0 / 2048.0);
}

TEST_F(HeightsOnGpu, VoidsStayVoid) {
    Scene whole = scene(HeightStorage::f32), half = scene(HeightStorage::i16);
    FrameRenderer mesh = renderer(RasterPath::mesh);
    const Camera eye = camera(2000.0, 0.0, -90.0);
    const auto ids_of = [&](Scene& from) {
        EXPECT_TRUE(mesh.draw(plan(from, eye, 1.0), {}).ok());
        return *mesh.read_ids(side_px, side_px);
    };
    const auto one = ids_of(whole), other = ids_of(half);
    const auto holes = std::count(one.begin(), one.end(), 0U);
    EXPECT_GT(holes, 500);
    EXPECT_EQ(one[side_px / 2 * side_px + side_px / 2], 0U);
    EXPECT_NEAR(static_cast<double>(std::count(other.begin(), other.end(), 0U)), static_cast<double>(holes),
                0.01 * static_cast<double>(holes));
}

}  // namespace
}  // namespace oro
