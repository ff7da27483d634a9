// Frames that are begun before the last one is done are those that are drawn one after the other, while pages
// give way to others between them: the same counts and feedback of each, and the same pictures.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <vector>

#include "render/frame/frame_renderer.h"
#include "render/scene/scene.h"
#include "tests/support/drawn/drawn_scene.h"
#include "tests/support/rough_terrain.h"

namespace oro {
namespace {

constexpr int flown_width_px = 203, flown_height_px = 117;

// Of an eye that flies over the ground and turns.
Camera flown_camera(int frame) {
    Camera camera;
    camera.width_px = flown_width_px;
    camera.height_px = flown_height_px;
    camera.vertical_fov_deg = 50.0;
    camera.eye = {46.70 + 0.006 * frame, 8.25 + 0.004 * frame, 4500.0};
    camera.attitude = {40.0 + 9.0 * frame, -12.0, 0.0};
    return camera;
}

// What a frame tells, and its picture where that was read.
struct Drawn {
    FrameReport report;
    std::vector<std::uint8_t> rgba;
};

class FramesInFlight : public test::GpuTest, public ::testing::WithParamInterface<RasterPath> {
  protected:
    // So many pages have room.
    Scene scene_of(const HeightField& field, std::size_t pages) {
        auto scene = Scene::create(*gpu_, pages_in_memory(field, 1.0, 2), {pages * page_bytes({}), 0});
        EXPECT_TRUE(scene.ok()) << scene.error().line();
        return std::move(scene).value();
    }
    FrameRenderer renderer_of(OcclusionUse occlusion) {
        FrameRendererOptions options;
        options.extent = {flown_width_px, flown_height_px};
        options.path = GetParam();
        options.occlusion = occlusion;
        return test::made_renderer(*gpu_, options);
    }
    static FramePlan plan_of(Scene& scene, int frame) {
        const Camera camera = flown_camera(frame);
        auto plan = scene.settled_plan({camera, test::whole_picture(camera), 1.0});
        EXPECT_TRUE(plan.ok()) << plan.error().line();
        EXPECT_TRUE(plan->is_settled());  // or it would depend on the order in which pages come
        return std::move(plan).value();
    }
    // The most pages that a frame needs.
    std::size_t most_pages(const HeightField& field, int frames) {
        Scene scene = scene_of(field, 400);
        std::size_t most = 0;
        for (int frame = 0; frame < frames; ++frame)
            most = std::max(most, plan_of(scene, frame).grids[0].pages.size());
        EXPECT_GT(scene.grids()[0].store().size(), most + 4) << "or nothing gives way";
        return most;
    }
    static std::vector<std::uint8_t> picture_of(FrameRenderer& renderer) {
        auto rgba = renderer.read_picture(flown_width_px, flown_height_px);
        EXPECT_TRUE(rgba.ok()) << rgba.error().line();
        return std::move(rgba).value();
    }

    std::vector<Drawn> draw_in_turn(const HeightField& field, std::size_t pages, OcclusionUse occlusion,
                                   int frames) {
        Scene scene = scene_of(field, pages);
        FrameRenderer renderer = renderer_of(occlusion);
        std::vector<Drawn> drawn;
        for (int frame = 0; frame < frames; ++frame) {
            const auto report = renderer.draw(plan_of(scene, frame), {});
            EXPECT_TRUE(report.ok()) << report.error().line();
            drawn.push_back({*report, picture_of(renderer)});
        }
        return drawn;
    }
    // The picture of the last one alone is read: what reads it waits for all.
    std::vector<Drawn> draw_in_flight(const HeightField& field, std::size_t pages, OcclusionUse occlusion,
                                     int frames) {
        Scene scene = scene_of(field, pages);
        FrameRenderer renderer = renderer_of(occlusion);
        std::vector<Drawn> drawn;
        const auto finish = [&] {
            const auto report = renderer.finish();
            EXPECT_TRUE(report.ok()) << report.error().line();
            drawn.push_back({*report, {}});
        };
        for (int frame = 0; frame < frames; ++frame) {
            FramePlan plan = plan_of(scene, frame);
            if (renderer.under_way() == frames_in_flight) finish();
            const auto begun = renderer.submit(std::move(plan), {});
            EXPECT_TRUE(begun.ok()) << begun.error().line();
        }
        while (renderer.under_way() > 0) finish();
        drawn.back().rgba = picture_of(renderer);
        return drawn;
    }
};

void expect_same(const Drawn& in_flight, const Drawn& in_turn, std::size_t frame) {
    EXPECT_EQ(std::memcmp(&in_flight.report.counts, &in_turn.report.counts, sizeof(gpu::FrameCounts)), 0)
        << "frame " << frame;
    EXPECT_GT(in_turn.report.counts.triangles_drawn, 0U);
    EXPECT_EQ(in_flight.report.pages, in_turn.report.pages);
    ASSERT_EQ(in_flight.report.feedback.size(), in_turn.report.feedback.size());
    for (std::size_t grid = 0; grid < in_turn.report.feedback.size(); ++grid)
        EXPECT_EQ(in_flight.report.feedback[grid].words, in_turn.report.feedback[grid].words)
            << "frame " << frame;
}

TEST_P(FramesInFlight, AreThoseThatAreDrawnInTurn) {
    const HeightField field = test::rough_field(47.0, 8.0, 700, 900);
    constexpr int frames = 12;
    const std::size_t pages = most_pages(field, frames);
    for (const OcclusionUse occlusion : {OcclusionUse::off, OcclusionUse::on}) {
        const std::vector<Drawn> in_turn = draw_in_turn(field, pages, occlusion, frames);
        for (const int count : {3, frames}) {
            const std::vector<Drawn> in_flight = draw_in_flight(field, pages, occlusion, count);
            ASSERT_EQ(in_flight.size(), static_cast<std::size_t>(count));
            for (std::size_t i = 0; i < in_flight.size(); ++i) expect_same(in_flight[i], in_turn[i], i);
            EXPECT_EQ(in_flight.back().rgba, in_turn[in_flight.size() - 1].rgba) << count << " frames";
        }
    }
}

// A renderer that goes while its frames are under way waits for them: the validation layer would tell.
TEST_P(FramesInFlight, EndBeforeTheirRenderer) {
    const HeightField field = test::rough_field(47.0, 8.0, 500, 700);
    Scene scene = scene_of(field, 400);
    FrameRenderer renderer = renderer_of(OcclusionUse::on);
    for (int frame = 0; frame < 2; ++frame) ASSERT_TRUE(renderer.submit(plan_of(scene, frame), {}).ok());
}

INSTANTIATE_TEST_SUITE_P(Paths, FramesInFlight, testing::Values(RasterPath::mesh, RasterPath::compute),
                         [](const auto& path) { return name_of(path.param); });

}  // namespace
}  // namespace oro
