// Half a meshlet a workgroup, the mesh path's other split: the ids in all pixels are those of whole meshlets,
// and halves without a triangle are not started.
#include <algorithm>
#include <cstdio>

#include "core/terrain/ground.h"
#include "tests/support/drawn/made_renderer.h"
#include "tests/support/drawn/occlusion_pairs.h"
#include "tests/support/rough_terrain.h"

namespace oro {
namespace {

constexpr int halves_px = 128;
const Tile halves_picture{0, 0, halves_px, halves_px, {0.5, 0.5}};

struct DrawnIds {
    std::vector<std::uint32_t> ids;
    gpu::FrameCounts counts;
};

class Halves : public test::GpuTest {
  protected:
    [[nodiscard]] FrameRenderer renderer_of(MeshletSplit split, RasterPath path = RasterPath::mesh,
                                            gpu::uint show = gpu::show_colours,
                                            OcclusionUse occlusion = OcclusionUse::off) const {
        FrameRendererOptions options;
        options.extent = {halves_px, halves_px};
        options.path = path;
        options.split = split;
        options.show = show;
        options.occlusion = occlusion;
        return test::made_renderer(*gpu_, options);
    }
    [[nodiscard]] Scene scene_of(const HeightField& field, HeightStorage heights = HeightStorage::f32) const {
        auto scene =
            Scene::create(*gpu_, pages_in_memory(field, 1.0, 2), {std::uint64_t{64} << 20U, 0}, heights);
        EXPECT_TRUE(scene.ok()) << scene.error().line();
        return std::move(scene).value();
    }
    static FramePlan plan_of(Scene& scene, const Camera& camera, double tau_px,
                             const WorldModel& model = {}) {
        auto plan = scene.settled_plan({camera, halves_picture, tau_px, model});
        EXPECT_TRUE(plan.ok()) << plan.error().line();
        return std::move(plan).value();
    }
    static DrawnIds draw(FrameRenderer& renderer, const FramePlan& plan) {
        auto drawn = renderer.draw(plan, {});
        EXPECT_TRUE(drawn.ok()) << drawn.error().line();
        auto ids = renderer.read_ids(halves_px, halves_px);
        EXPECT_TRUE(ids.ok()) << ids.error().line();
        return {std::move(ids).value(), drawn->counts};
    }
};

// An eye over a share of the region's rows and columns.
Camera eye_over(const HeightField& field, double south, double east, double above_m, double heading_deg,
                double pitch_deg) {
    const PostPlace place =
        field.grid.place_at(south * (field.grid.rows() - 1), east * (field.grid.columns() - 1));
    Camera camera;
    camera.eye = {place.lat_deg, place.lon_deg, *ground_h_m(field, place.lat_deg, place.lon_deg) + above_m};
    camera.attitude = {heading_deg, pitch_deg, 0.0};
    camera.width_px = camera.height_px = halves_px;
    return camera;
}

// 1 to 8 rows of quads in the last meshlets, and 8 to 1 columns.
TEST_F(Halves, ShowTheTrianglesOfWholeMeshletsAtRims) {
    FrameRenderer whole = renderer_of(MeshletSplit::whole), halves = renderer_of(MeshletSplit::halves),
                  compute = renderer_of(MeshletSplit::by_device, RasterPath::compute);
    std::size_t pixels = 0, background = 0, otherwise = 0, left_out = 0;
    for (int rows = 1; rows <= 8; ++rows) {
        const HeightField field = test::rough_field(47.0, 8.0, 72 + rows + 1, 80 + (9 - rows) + 1);
        Scene scene = scene_of(field, rows % 2 == 0 ? HeightStorage::f32 : HeightStorage::packed);
        const Camera above = eye_over(field, 0.5, 0.5, 30000.0, 0.0, -90.0);
        for (const Camera& camera : {above, eye_over(field, 0.97, 0.96, 400.0, 10.0 * rows, -90.0),
                                     eye_over(field, 0.5, 0.99, 800.0, 175.0, -35.0),
                                     eye_over(field, 0.2, 0.3, 300.0, 130.0, -10.0)}) {
            const bool all = camera.eye.h_m > 25000.0;
            const FramePlan plan = plan_of(scene, camera, all || rows % 3 == 0 ? 0.0 : 1.0);
            const DrawnIds one = draw(whole, plan), other = draw(halves, plan), third = draw(compute, plan);
            EXPECT_EQ(one.ids, other.ids) << rows << " rows";
            EXPECT_EQ(one.counts.triangles_drawn, other.counts.triangles_drawn);
            EXPECT_EQ(one.counts.triangles_drawn, third.counts.triangles_drawn);
            EXPECT_EQ(one.counts.meshlets_drawn, other.counts.meshlets_drawn);
            EXPECT_EQ(one.counts.halves_left_out + third.counts.halves_left_out, 0U);
            EXPECT_EQ(other.counts.mesh_groups,
                      2 * other.counts.meshlets_drawn - other.counts.halves_left_out);
            for (std::size_t i = 0; i < other.ids.size(); ++i) otherwise += other.ids[i] != third.ids[i];
            pixels += other.ids.size();
            background += static_cast<std::size_t>(std::count(other.ids.begin(), other.ids.end(), 0U));
            left_out += other.counts.halves_left_out;
            if (!all) continue;
            // 10 x 11 meshlets; half of the last row's, or of the last column's.
            EXPECT_EQ(other.counts.meshlets_drawn, 110U);
            EXPECT_EQ(other.counts.halves_left_out, rows <= 4 ? 11U : 10U) << rows << " rows";
        }
    }
    std::printf("%zu pixels, %zu of background; %zu differ from the compute path; %zu halves left out\n",
                pixels, background, otherwise, left_out);
    EXPECT_LE(otherwise, pixels / 1000);
    EXPECT_LT(background, pixels / 2);
}

// Rounds, void posts, packed heights, triangles left out that cover no pixel's centre: eyes in motion.
TEST_F(Halves, ShowTheTrianglesOfWholeMeshletsInRounds) {
    HeightField field = test::rough_field(47.0, 8.0, 500, 703);
    std::mt19937 random(93);
    for (int hole = 0; hole < 60; ++hole) {
        const int row = static_cast<int>(random() % 480), column = static_cast<int>(random() % 680);
        const int high = static_cast<int>(random() % 20), wide = static_cast<int>(random() % 20);
        for (int i = row; i < row + high; ++i)
            for (int j = column; j < column + wide; ++j)
                field.H_m[static_cast<std::size_t>(i * 703 + j)] = void_height_m;
    }
    const test::EyeGround where{46.65, 46.85, 8.2, 8.5, [&](double lat_deg, double lon_deg) {
                                    return ground_h_m(field, lat_deg, lon_deg).value_or(1500.0);
                                }};
    unsigned seed = 94;
    for (const HeightStorage heights : {HeightStorage::f32, HeightStorage::packed}) {
        Scene scene = scene_of(field, heights);
        test::OcclusionPair renderers(*gpu_, RasterPath::mesh, 203, 117, false, MeshletSplit::halves);
        EXPECT_EQ(test::draw_pairs(renderers, scene, where, seed++, test::occlusion_pairs(15), 203, 117), 0U);
        EXPECT_LT(renderers.drawn_with, renderers.drawn_without);
        EXPECT_GT(renderers.later, 0U);
    }
}

// Posts 5 cm apart that are rounded to steps of float32 ECEF, half a metre: triangles fold over each other
// and are as near, within a meshlet too. And one grid twice: the first is shown.
TEST_F(Halves, LeaveTheLowerIdWhereTrianglesAreAsNear) {
    const HeightField dense = test::made_field(47.0, 8.0, 2000000.0, 120, 150, test::rough_H_m);
    WorldModel rounded;
    rounded.precision = Precision::rounded_posts;
    Scene folded = scene_of(dense);
    const Camera close = eye_over(dense, 0.5, 0.5, 8.0, 30.0, -90.0);
    const FramePlan fold = plan_of(folded, close, 0.0, rounded);
    const HeightField field = test::rough_field(47.0, 8.0, 150, 150);
    Scene twice = scene_of(field);
    twice.add(scene_of(field));
    const FramePlan same = plan_of(twice, eye_over(field, 0.6, 0.6, 500.0, 30.0, -30.0), 1.0);
    std::size_t ground = 0;
    for (const OcclusionUse occlusion : {OcclusionUse::off, OcclusionUse::on}) {
        FrameRenderer whole =
                          renderer_of(MeshletSplit::whole, RasterPath::mesh, gpu::show_colours, occlusion),
                      halves =
                          renderer_of(MeshletSplit::halves, RasterPath::mesh, gpu::show_colours, occlusion);
        for (int frame = 0; frame < 2; ++frame) {
            const DrawnIds one = draw(whole, fold);
            EXPECT_EQ(one.ids, draw(halves, fold).ids);
            ground +=
                one.ids.size() - static_cast<std::size_t>(std::count(one.ids.begin(), one.ids.end(), 0U));
            const DrawnIds shown = draw(halves, same);
            EXPECT_EQ(draw(whole, same).ids, shown.ids);
            EXPECT_LE(*std::ranges::max_element(shown.ids),
                      same.grids[0].pages.size() * gpu::meshlets_per_page * gpu::meshlet_triangles);
        }
    }
    EXPECT_GT(ground, std::size_t{4} * halves_px * halves_px / 2);
}

// What explains a frame is the same, too.
TEST_F(Halves, ExplainAFrameAsWholeMeshletsDo) {
    const HeightField field = test::rough_field(47.0, 8.0, 300, 299);
    Scene scene = scene_of(field);
    const FramePlan plan = plan_of(scene, eye_over(field, 0.9, 0.2, 300.0, 40.0, -8.0), 1.0);
    for (const gpu::uint show :
         {gpu::show_visible, gpu::show_levels, gpu::show_meshlets, gpu::show_triangles, gpu::show_overdraw}) {
        const OcclusionUse occlusion = show == gpu::show_overdraw ? OcclusionUse::off : OcclusionUse::on;
        FrameRenderer whole = renderer_of(MeshletSplit::whole, RasterPath::mesh, show, occlusion),
                      halves = renderer_of(MeshletSplit::halves, RasterPath::mesh, show, occlusion);
        ASSERT_EQ(draw(whole, plan).ids, draw(halves, plan).ids) << "show " << show;
        const auto one = *whole.read_picture(halves_px, halves_px),
                   other = *halves.read_picture(halves_px, halves_px);
        EXPECT_EQ(one, other) << "show " << show;
        EXPECT_GT(std::ranges::count_if(one, [](std::uint8_t code) { return code != 0 && code != 255; }),
                  halves_px * halves_px / 4);
    }
}

TEST(MeshletSplits, FollowTheDeviceWhereNobodyAsks) {
    DeviceReport device;
    device.subgroup_size = 32;
    for (const MeshletSplit request : {MeshletSplit::by_device, MeshletSplit::whole, MeshletSplit::halves})
        EXPECT_EQ(meshlet_split_for(request, device), MeshletSplit::whole) << "no ballots";
    device.mesh_ballots = true;
    EXPECT_EQ(meshlet_split_for(MeshletSplit::by_device, device), MeshletSplit::halves);
    EXPECT_EQ(meshlet_split_for(MeshletSplit::whole, device), MeshletSplit::whole);
    for (const std::uint32_t size : {4U, 8U, 16U, 64U}) {
        device.subgroup_size = size;
        EXPECT_EQ(meshlet_split_for(MeshletSplit::by_device, device), MeshletSplit::whole);
        EXPECT_EQ(meshlet_split_for(MeshletSplit::halves, device), MeshletSplit::halves);
    }
}

}  // namespace
}  // namespace oro
