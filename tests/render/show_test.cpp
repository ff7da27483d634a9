// Pictures that explain a frame: each pixel has the colour of what draws it.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>

#include "core/frame/frame_colours.h"
#include "core/terrain/ground.h"
#include "render/frame/frame_renderer.h"
#include "render/scene/scene.h"
#include "tests/support/drawn/cluster_scene.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/rough_terrain.h"

namespace oro {
namespace {

constexpr std::uint32_t shown_side_px = 96;

class ShownParts : public test::GpuTest, public ::testing::WithParamInterface<RasterPath> {
  protected:
    Result<FrameRenderer> renderer_showing(gpu::uint show) {
        FrameRendererOptions options;
        options.extent = {shown_side_px, shown_side_px};
        options.path = GetParam();
        options.show = show;
        return FrameRenderer::create(*gpu_, options);
    }
};

// Of a pixel's triangle, by its id.
gpu::vec3 expected_colour(gpu::uint show, std::uint32_t id, const FramePlan& plan) {
    const std::uint32_t triangle = id - 1, node = triangle / gpu::meshlet_triangles;
    if (show == gpu::show_triangles) return colour_of_number(triangle);
    if (show == gpu::show_meshlets) return colour_of_number(node);
    const float light = 0.85F + 0.15F * colour_of_number(node).x;
    return light * colour_of_level(plan.grids[0].pages[node / gpu::meshlets_per_page].level);
}

Camera camera_over(const HeightField& field) {
    Camera camera;
    camera.eye = {46.75, 8.2, *ground_h_m(field, 46.75, 8.2) + 300.0};
    camera.attitude = {40.0, -5.0, 0.0};
    camera.width_px = camera.height_px = shown_side_px;
    return camera;
}

// Whether a pixel has that colour, as nearly as a byte tells it.
bool is_colour(const gpu::vec3& colour, const std::uint8_t* pixel) {
    for (int c = 0; c < 3; ++c)
        if (std::abs(255.0F * colour[c] - static_cast<float>(pixel[c])) > 1.0F) return false;
    return true;
}

TEST_P(ShownParts, HaveTheColoursOfTheirNumbersAndLevels) {
    const HeightField field = test::rough_field(47.0, 8.0, 500, 500);
    auto scene = Scene::create(*gpu_, pages_in_memory(field, 1.0, 2), {std::uint64_t{64} << 20U, 0});
    ASSERT_TRUE(scene.ok()) << scene.error().line();
    const Camera camera = camera_over(field);
    for (const gpu::uint show :
         {gpu::show_visible, gpu::show_levels, gpu::show_meshlets, gpu::show_triangles}) {
        auto renderer = renderer_showing(show);
        ASSERT_TRUE(renderer.ok()) << renderer.error().line();
        auto plan = scene->settled_plan({camera, {0, 0, shown_side_px, shown_side_px, {0.5, 0.5}}, 1.0});
        ASSERT_TRUE(plan.ok()) << plan.error().line();
        ASSERT_TRUE(renderer->draw(*plan, {}).ok());
        const std::vector<std::uint32_t> ids = *renderer->read_ids(shown_side_px, shown_side_px);
        const std::vector<std::uint8_t> rgba = *renderer->read_picture(shown_side_px, shown_side_px);
        std::size_t ground = 0, wrong = 0, orange = 0;
        for (std::size_t i = 0; i < ids.size(); ++i) {
            wrong += (rgba[4 * i + 3] != 0) != (ids[i] != 0);
            if (ids[i] == 0) continue;
            ++ground;
            orange += rgba[4 * i] > rgba[4 * i + 1];
            if (show == gpu::show_visible) continue;
            wrong += is_colour(expected_colour(show, ids[i], *plan), &rgba[4 * i]) ? 0 : 1;
        }
        EXPECT_GT(ground, ids.size() / 4);
        EXPECT_EQ(wrong, 0U) << "show " << show;
        // Of a first frame some ground is near, and some is not.
        if (show == gpu::show_visible) {
            EXPECT_GT(orange, 0U);
            EXPECT_LT(orange, ground);
        }
    }
}

// Of a pixel's triangle where clusters are drawn: by numbers of the graph.
gpu::vec3 expected_on_clusters(gpu::uint show, std::uint32_t id, const FramePlan& plan) {
    const std::uint32_t triangle = (id - 1) % gpu::cluster_triangles;
    const gpu::DrawnCluster& drawn = plan.grids[0].clusters.drawn[(id - 1) / gpu::cluster_triangles];
    const float light = 0.85F + 0.15F * colour_of_number(drawn.number).x;
    if (show == gpu::show_levels) return light * colour_of_level(drawn.counts >> 16U);
    if (show == gpu::show_groups) return light * colour_of_number(drawn.group);
    if (show == gpu::show_triangles)
        return colour_of_number(drawn.number * gpu::cluster_triangles + triangle);
    return colour_of_number(drawn.number);
}

TEST_P(ShownParts, OfClustersHaveTheColoursOfTheGraph) {
    const test::ClusterTerrain terrain(test::rough_field(47.0, 8.0, 260, 310));
    auto scene = Scene::create(*gpu_, pages_in_memory(terrain.field, 1.0, 2), {std::uint64_t{64} << 20U, 0});
    ASSERT_TRUE(scene.ok()) << scene.error().line();
    test::draw_by_clusters(*gpu_, terrain, *scene);
    Camera camera;
    camera.eye = {46.85, 8.12, *ground_h_m(terrain.field, 46.85, 8.12) + 900.0};
    camera.attitude = {40.0, -12.0, 0.0};
    camera.width_px = camera.height_px = shown_side_px;
    std::set<gpu::uint> levels;
    for (const gpu::uint show :
         {gpu::show_levels, gpu::show_meshlets, gpu::show_triangles, gpu::show_clusters, gpu::show_groups}) {
        auto renderer = renderer_showing(show);
        ASSERT_TRUE(renderer.ok()) << renderer.error().line();
        auto plan = scene->settled_plan({camera, {0, 0, shown_side_px, shown_side_px, {0.5, 0.5}}, 2.0});
        ASSERT_TRUE(plan.ok()) << plan.error().line();
        ASSERT_TRUE(renderer->draw(*plan, {}).ok());
        const std::vector<std::uint32_t> ids = *renderer->read_ids(shown_side_px, shown_side_px);
        const std::vector<std::uint8_t> rgba = *renderer->read_picture(shown_side_px, shown_side_px);
        std::size_t ground = 0, wrong = 0;
        for (std::size_t i = 0; i < ids.size(); ++i) {
            if (ids[i] == 0) continue;
            ++ground;
            wrong += is_colour(expected_on_clusters(show, ids[i], *plan), &rgba[4 * i]) ? 0 : 1;
            levels.insert(plan->grids[0].clusters.drawn[(ids[i] - 1) / gpu::cluster_triangles].counts >> 16U);
        }
        EXPECT_GT(ground, ids.size() / 4);
        EXPECT_EQ(wrong, 0U) << "show " << show;
    }
    EXPECT_GT(levels.size(), 2U);
}

// Rounds of clusters: each pixel has one of two colours, and of a first frame there are both.
TEST_P(ShownParts, OfClustersTellOfRounds) {
    const test::ClusterTerrain terrain(test::rough_field(47.0, 8.0, 260, 310));
    auto scene = Scene::create(*gpu_, pages_in_memory(terrain.field, 1.0, 2), {std::uint64_t{64} << 20U, 0});
    ASSERT_TRUE(scene.ok()) << scene.error().line();
    test::draw_by_clusters(*gpu_, terrain, *scene);
    Camera camera;
    camera.eye = {46.85, 8.12, *ground_h_m(terrain.field, 46.85, 8.12) + 900.0};
    camera.attitude = {40.0, -12.0, 0.0};
    camera.width_px = camera.height_px = shown_side_px;
    auto renderer = renderer_showing(gpu::show_visible);
    ASSERT_TRUE(renderer.ok()) << renderer.error().line();
    auto plan = scene->settled_plan({camera, {0, 0, shown_side_px, shown_side_px, {0.5, 0.5}}, 1.0});
    ASSERT_TRUE(plan.ok()) << plan.error().line();
    ASSERT_TRUE(renderer->draw(*plan, {}).ok());
    const std::vector<std::uint32_t> ids = *renderer->read_ids(shown_side_px, shown_side_px);
    const std::vector<std::uint8_t> rgba = *renderer->read_picture(shown_side_px, shown_side_px);
    std::size_t before = 0, last = 0, wrong = 0;
    for (std::size_t i = 0; i < ids.size(); ++i) {
        if (ids[i] == 0) continue;
        const gpu::uint number = plan->grids[0].clusters.drawn[(ids[i] - 1) / gpu::cluster_triangles].number;
        const float light = 0.85F + 0.15F * colour_of_number(number).x;
        if (is_colour(light * colour_of_round(true), &rgba[4 * i]))
            ++before;
        else if (is_colour(light * colour_of_round(false), &rgba[4 * i]))
            ++last;
        else
            ++wrong;
    }
    EXPECT_EQ(wrong, 0U);
    EXPECT_GT(before, 0U);
    EXPECT_GT(last, 0U);
}

// Of one level, whatever the eye: what the plan says is what is drawn, without a hole.
TEST_P(ShownParts, ALevelOfClustersIsDrawnAlone) {
    const test::ClusterTerrain terrain(test::rough_field(47.0, 8.0, 260, 310));
    auto scene = Scene::create(*gpu_, pages_in_memory(terrain.field, 1.0, 2), {std::uint64_t{64} << 20U, 0});
    ASSERT_TRUE(scene.ok()) << scene.error().line();
    Camera camera;
    camera.eye = {46.89, 8.13, 12000.0};
    camera.attitude.pitch_deg = -90.0;
    camera.vertical_fov_deg = 30.0;
    camera.width_px = camera.height_px = shown_side_px;
    std::uint64_t last = ~std::uint64_t{0};
    for (const std::uint32_t level : {0U, 2U, 6U, 80U}) {
        test::draw_by_clusters(*gpu_, terrain, *scene, std::uint64_t{64} << 20U, level);
        auto renderer = renderer_showing(gpu::show_colours);
        ASSERT_TRUE(renderer.ok()) << renderer.error().line();
        auto plan = scene->settled_plan({camera, {0, 0, shown_side_px, shown_side_px, {0.5, 0.5}}, 1.0});
        ASSERT_TRUE(plan.ok()) << plan.error().line();
        const auto drawn = renderer->draw(*plan, {});
        ASSERT_TRUE(drawn.ok()) << drawn.error().line();
        const std::vector<std::uint32_t> ids = *renderer->read_ids(shown_side_px, shown_side_px);
        EXPECT_EQ(std::ranges::count(ids, 0U), 0) << "level " << level;
        for (const gpu::DrawnCluster& cluster : plan->grids[0].clusters.drawn)
            EXPECT_EQ(cluster.counts >> 16U,
                      std::min(level, static_cast<std::uint32_t>(terrain.graph.levels.size())));
        EXPECT_LT(drawn->counts.triangles_drawn, last);
        last = drawn->counts.triangles_drawn;
    }
}

// Over level ground, from straight above, one triangle covers each pixel, wherever triangles meet; behind a
// ridge more do. Both ways of drawing count the same, but where their grids put an edge through another
// pixel's middle.
TEST_P(ShownParts, OverdrawCountsTriangles) {
    const auto picture_of = [&](const HeightField& field, const Camera& camera, RasterPath path) {
        auto scene = Scene::create(*gpu_, pages_in_memory(field, 1.0, 2), {std::uint64_t{64} << 20U, 0});
        FrameRendererOptions options;
        options.extent = {shown_side_px, shown_side_px};
        options.path = path;
        options.show = gpu::show_overdraw;
        options.occlusion = OcclusionUse::off;
        auto renderer = FrameRenderer::create(*gpu_, options);
        EXPECT_TRUE(renderer.ok()) << renderer.error().line();
        auto plan = scene->settled_plan({camera, {0, 0, shown_side_px, shown_side_px, {0.5, 0.5}}, 1.0});
        for (int frame = 0; frame < 2; ++frame) EXPECT_TRUE(renderer->draw(*plan, {}).ok());
        return *renderer->read_picture(shown_side_px, shown_side_px);
    };
    const auto code = [](gpu::uint triangles) {
        return static_cast<int>(std::lround(255.0F * colour_of_overdraw(triangles).x));
    };
    HeightField level = test::rough_field(47.0, 8.0, 300, 300);
    std::ranges::fill(level.H_m, 500.0F);
    Camera camera;
    camera.eye = {46.88, 8.12, 3000.0};
    camera.attitude = {10.0, -90.0, 0.0};
    camera.width_px = camera.height_px = shown_side_px;
    const std::vector<std::uint8_t> even = picture_of(level, camera, GetParam());
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < even.size(); i += 4) wrong += std::abs(even[i] - code(1)) > 1;
    EXPECT_EQ(wrong, 0U);
    const HeightField rough = test::rough_field(47.0, 8.0, 500, 500);
    camera.eye = {46.75, 8.2, *ground_h_m(rough, 46.75, 8.2) + 300.0};
    camera.attitude = {40.0, -5.0, 0.0};
    const std::vector<std::uint8_t> one = picture_of(rough, camera, RasterPath::mesh),
                                    other = picture_of(rough, camera, RasterPath::compute);
    std::size_t differ = 0, several = 0;
    for (std::size_t i = 0; i < one.size(); i += 4) {
        differ += one[i] != other[i];
        several += one[i + 3] != 0 && std::abs(one[i] - code(1)) > 1;
    }
    EXPECT_LT(differ, std::size_t{shown_side_px} * shown_side_px / 50);
    EXPECT_GT(several, std::size_t{shown_side_px} * shown_side_px / 8);
}

INSTANTIATE_TEST_SUITE_P(Paths, ShownParts, ::testing::Values(RasterPath::mesh, RasterPath::compute),
                         [](const auto& path) {
                             return std::string(path.param == RasterPath::mesh ? "mesh" : "compute");
                         });

}  // namespace
}  // namespace oro
