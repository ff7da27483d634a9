// What other ground hides is left out, and nothing that shows: from eyes in motion the ids in every pixel are
// those of frames that draw all, on both paths.
#include <chrono>
#include <thread>

#include "core/terrain/ground.h"
#include "render/frame/picture_renderer.h"
#include "tests/support/drawn/drawn_scene.h"
#include "tests/support/drawn/occlusion_pairs.h"
#include "tests/support/drawn/plain_style.h"
#include "tests/support/rough_terrain.h"

namespace oro {
namespace {

// No power of two, and not the same in both directions.
constexpr int width_px = 203, height_px = 117;

class Occluded : public test::GpuTest, public ::testing::WithParamInterface<RasterPath> {
  protected:
    Scene scene_of(const HeightField& field, double exaggeration = 1.0,
                   std::uint64_t memory = std::uint64_t{256} << 20U) {
        auto scene = Scene::create(*gpu_, pages_in_memory(field, exaggeration, 2), {memory, 0});
        EXPECT_TRUE(scene.ok()) << scene.error().line();
        return std::move(scene).value();
    }
    static test::EyeGround over(const HeightField& field, double exaggeration = 1.0) {
        return {46.65, 46.85, 8.2, 8.5, [&field, exaggeration](double lat_deg, double lon_deg) {
                    return exaggeration * *ground_h_m(field, lat_deg, lon_deg);
                }};
    }
};

TEST_P(Occluded, PicturesAreThoseWithout) {
    const HeightField field = test::rough_field(47.0, 8.0, 700, 900);
    Scene scene = scene_of(field);
    test::OcclusionPair renderers(*gpu_, GetParam(), width_px, height_px);
    EXPECT_EQ(
        test::draw_pairs(renderers, scene, over(field), 71, test::occlusion_pairs(60), width_px, height_px),
        0U);
    EXPECT_LT(3 * renderers.drawn_with, 2 * renderers.drawn_without) << "or little was left out";
    EXPECT_GT(renderers.later, 0U);
}

// Bent light lifts the ground; heights may be exaggerated and rounded.
TEST_P(Occluded, PicturesAreThoseWithoutInOtherModels) {
    const HeightField field = test::rough_field(47.0, 8.0, 500, 700);
    unsigned seed = 72;
    for (const double k : {0.13, 0.9, -1.0}) {
        Scene scene = scene_of(field);
        test::OcclusionPair renderers(*gpu_, GetParam(), width_px, height_px);
        WorldModel model;
        model.air.k = k;
        EXPECT_EQ(test::draw_pairs(renderers, scene, over(field), seed++, test::occlusion_pairs(8), width_px,
                                   height_px, model),
                  0U)
            << "refraction " << k;
    }
    Scene tall = scene_of(field, 3.0);
    test::OcclusionPair renderers(*gpu_, GetParam(), width_px, height_px);
    EXPECT_EQ(test::draw_pairs(renderers, tall, over(field, 3.0), seed, test::occlusion_pairs(8), width_px,
                               height_px),
              0U);
    for (const Precision precision : {Precision::rounded_posts, Precision::naive}) {
        WorldModel model;
        model.precision = precision;
        Scene scene = scene_of(field);
        test::OcclusionPair rounded(*gpu_, GetParam(), width_px, height_px);
        EXPECT_EQ(test::draw_pairs(rounded, scene, over(field), ++seed, test::occlusion_pairs(8), width_px,
                                   height_px, model),
                  0U);
    }
}

// The comparison can fail: with the nearest depths instead of the farthest it tells of lost ground.
TEST_P(Occluded, AWrongPyramidIsNoticed) {
    const HeightField field = test::rough_field(47.0, 8.0, 500, 700);
    Scene scene = scene_of(field);
    test::OcclusionPair renderers(*gpu_, GetParam(), width_px, height_px, true);
    EXPECT_GT(test::draw_pairs(renderers, scene, over(field), 79, 16, width_px, height_px), 10U);
}

// Two halves of a region: either hides the other.
TEST_P(Occluded, GridsHideEachOther) {
    const HeightField field = test::rough_field(47.0, 8.0, 500, 700);
    const auto part = [&](int first, int count) {
        HeightField half;
        half.grid = field.grid;
        half.grid.lon.first += first;
        half.grid.lon.count = count;
        half.undulation = field.undulation;
        for (int row = 0; row < field.grid.rows(); ++row)
            for (int column = first; column < first + count; ++column)
                half.H_m.push_back(field.H_at_post_m(row, column));
        return half;
    };
    Scene halves = scene_of(part(0, 421));
    halves.add(scene_of(part(420, 280)));
    test::OcclusionPair renderers(*gpu_, GetParam(), width_px, height_px);
    EXPECT_EQ(
        test::draw_pairs(renderers, halves, over(field), 80, test::occlusion_pairs(25), width_px, height_px),
        0U);
    EXPECT_LT(3 * renderers.drawn_with, 2 * renderers.drawn_without);
}

// A scene with little room beside one with room for all, drawn by eyes one after another.
struct StreamedScenes {
    Scene few, all;
    test::OcclusionPair renderers, whole;
    std::size_t room{};
    int frames{}, unsettled{}, of_terrain_alone{};
    std::vector<PageIndex> drawn;  // by the scene with little room, once settled for the last eye
};

// Draws the frames of an eye while its pages come, and the settled one; each is the one without occlusion.
// Where the eye sees terrain alone none of them has background. The settled one is that with room for all.
void stream_in(StreamedScenes& scenes, const Camera& camera) {
    const Tile tile{0, 0, width_px, height_px, {0.5, 0.5}};
    const auto other = scenes.all.settled_plan({camera, tile, 1.0});
    ASSERT_TRUE(other.ok()) << other.error().line();
    scenes.whole.background = scenes.renderers.background = 0;
    ASSERT_EQ(scenes.whole.differing(*other), 0U);
    bool settled = false;
    for (int step = 0; step < 4000 && !settled; ++step) {
        const auto plan = scenes.few.plan({camera, tile, 1.0});
        ASSERT_TRUE(plan.ok()) << plan.error().line();
        settled = plan->grids[0].missing.empty();
        const auto advanced = scenes.few.advance();
        ASSERT_TRUE(advanced.ok()) << advanced.error().line();
        ASSERT_LE(scenes.few.grids()[0].store().size(), scenes.room);
        if (plan->grids[0].pages.empty() || (!*advanced && !settled && step % 50 != 0)) continue;
        scenes.unsettled += settled ? 0 : 1;
        ++scenes.frames;
        ASSERT_EQ(scenes.renderers.differing(*plan), 0U) << "frame " << scenes.frames;
    }
    ASSERT_TRUE(settled);
    const auto plan = scenes.few.settled_plan({camera, tile, 1.0});
    ASSERT_TRUE(plan.ok()) << plan.error().line();
    ASSERT_TRUE(plan->grids[0].missing.empty());
    ASSERT_EQ(scenes.renderers.differing(*plan), 0U);
    std::printf("%zu pages, %zu in the store\n", plan->grids[0].page_indices.size(),
                scenes.few.grids()[0].store().size());
    // Ids count the pages of a frame: the same ones in the same order, or they could not be compared.
    const auto same = [](const PageIndex& a, const PageIndex& b) {
        return a.level == b.level && a.row == b.row && a.column == b.column;
    };
    ASSERT_TRUE(std::ranges::equal(plan->grids[0].page_indices, other->grids[0].page_indices, same));
    ASSERT_EQ(scenes.renderers.last_ids.size(), std::size_t{width_px * height_px});
    EXPECT_EQ(scenes.renderers.last_ids, scenes.whole.last_ids);
    if (scenes.whole.background == 0) {
        ++scenes.of_terrain_alone;
        EXPECT_EQ(scenes.renderers.background, 0U);
    }
    scenes.drawn = plan->grids[0].page_indices;
}

// With room for the 11 pages that the last eye needs, of the 16 that all of them do.
TEST_P(Occluded, FramesHoldWhileDataStreamIn) {
    const HeightField field = test::rough_field(47.0, 8.0, 700, 900);
    constexpr std::size_t room = 11;
    StreamedScenes scenes{scene_of(field, 1.0, room * page_bytes({})),
                          scene_of(field),
                          test::OcclusionPair(*gpu_, GetParam(), width_px, height_px),
                          test::OcclusionPair(*gpu_, GetParam(), width_px, height_px),
                          room,
                          0,
                          0,
                          0,
                          {}};
    constexpr unsigned seed = 81;
    std::mt19937 random(seed);
    std::vector<PageIndex> early;
    for (int i = 0; i < 6; ++i) {
        Camera camera = test::eyes_in_motion(over(field), random, width_px, height_px).first;
        if (i % 2 == 0) {
            camera.attitude.pitch_deg = -80.0;
            camera.vertical_fov_deg = 20.0;
        }
        SCOPED_TRACE(testing::Message() << "seed " << seed << ", eye " << i);
        ASSERT_NO_FATAL_FAILURE(stream_in(scenes, camera));
        early.insert(early.end(), scenes.drawn.begin(), scenes.drawn.end());
    }
    const auto gone = std::ranges::count_if(
        early, [&](const PageIndex& page) { return scenes.few.grids()[0].store().address(page) == 0; });
    std::printf(
        "seed %u: %d frames, %d of them while pages were missing; %zd pages gone; %d eyes of ground\n", seed,
        scenes.frames, scenes.unsettled, gone, scenes.of_terrain_alone);
    EXPECT_GT(scenes.unsettled, 3);
    EXPECT_GT(gone, 0) << "or there was room for all";
    EXPECT_GE(scenes.of_terrain_alone, 5);
}

// With room for the pages that show, and not for those that other ground hides, a settled picture is that
// with room for all.
TEST_P(Occluded, HiddenPagesNeedNoRoom) {
    const HeightField field = test::rough_field(47.0, 8.0, 900, 900);
    struct Settled {
        std::vector<std::uint8_t> rgb;
        bool settled{};
        std::size_t pages{};
    };
    const auto draw = [&](std::size_t room, const Camera& camera, int samples) {
        Scene scene = scene_of(field, 1.0, room * page_bytes({}));
        PictureOptions options;
        options.path = GetParam();
        options.samples = samples;
        Settled picture;
        const RowSink sink = [&](std::span<const std::uint8_t> row) {
            picture.rgb.insert(picture.rgb.end(), row.begin(), row.end());
            return Result<void>();
        };
        const auto report = render_picture(*gpu_, scene, camera, {}, options, sink);
        EXPECT_TRUE(report.ok()) << report.error().line();
        picture.settled = report->settled;
        picture.pages = scene.grids()[0].store().size();
        return picture;
    };
    int with_fewer = 0;
    for (int i = 0; i < 4; ++i) {
        Camera camera;
        camera.width_px = 3 * width_px;
        camera.height_px = 3 * height_px;
        camera.eye = {46.45 + 0.05 * i, 8.42 + 0.06 * i, 0.0};
        camera.eye.h_m = *ground_h_m(field, camera.eye.lat_deg, camera.eye.lon_deg) + 2.0;
        camera.attitude = {80.0 * i, 0.0, 0.0};
        const int samples = i == 3 ? 3 : 1;
        const Settled whole = draw(1000, camera, samples);
        ASSERT_TRUE(whole.settled);
        std::printf("eye %d: %zu pages", i, whole.pages);
        for (const std::size_t room : {whole.pages * 7 / 8, whole.pages * 5 / 8}) {
            const Settled part = draw(room, camera, samples);
            std::printf(", %s with room for %zu", part.settled ? "settled" : "not settled", room);
            EXPECT_LE(part.pages, room);
            if (!part.settled) break;
            EXPECT_EQ(part.rgb, whole.rgb) << "eye " << i << ", room for " << room;
            ++with_fewer;
        }
        std::printf("\n");
    }
    EXPECT_GE(with_fewer, 5) << "or hidden pages took room";
}

// A window's frames of one eye: another one is planned where there may be something new alone.
struct RestingFrames {
    bool is_settled{}, lacks_memory{}, shows_all{};
    int frames{};
    std::vector<std::uint8_t> rgba;
};
RestingFrames rest(Scene& scene, FrameRenderer& renderer, const Camera& camera) {
    RestingFrames resting;
    const auto is_done = [&] { return resting.is_settled || resting.lacks_memory; };
    bool better = true;
    for (int turn = 0; turn < 20000 && !is_done(); ++turn) {
        if (std::exchange(better, false)) {
            auto plan = scene.plan({camera, test::whole_picture(camera), 1.0});
            EXPECT_TRUE(plan.ok()) << plan.error().line();
            resting.is_settled = plan->is_settled();
            resting.shows_all = plan->shows_all();
            const auto report = renderer.draw(std::move(*plan), test::plain_style());
            EXPECT_TRUE(report.ok()) << report.error().line();
            scene.apply_feedback(report->feedback);
            ++resting.frames;
            continue;
        }
        const auto advanced = scene.advance();
        EXPECT_TRUE(advanced.ok()) << advanced.error().line();
        better = *advanced;
        resting.lacks_memory = !better && scene.lacks_memory();
        if (!better) std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
    auto rgba = renderer.read_picture(static_cast<std::uint32_t>(camera.width_px),
                                      static_cast<std::uint32_t>(camera.height_px));
    EXPECT_TRUE(rgba.ok()) << rgba.error().line();
    resting.rgba = std::move(*rgba);
    return resting;
}

// Whatever an eye saw that moved before, once it rests it comes to an end: all is there, or it is said that
// no more fits. With room for what shows the picture is that with room for all.
TEST_P(Occluded, AnEyeThatRestsHasAllThatFits) {
    const HeightField field = test::rough_field(47.0, 8.0, 900, 900);
    FrameRendererOptions options;
    options.extent = {width_px, height_px};
    options.path = GetParam();
    FrameRenderer renderer = test::made_renderer(*gpu_, options);
    int settled = 0, hidden_left = 0, coarser = 0;
    for (const int i : {1, 2}) {
        Camera camera;
        camera.width_px = width_px;
        camera.height_px = height_px;
        camera.eye = {46.45 + 0.03 * i, 8.42 + 0.04 * i, 0.0};
        camera.eye.h_m = *ground_h_m(field, camera.eye.lat_deg, camera.eye.lon_deg) + 2.0;
        camera.attitude = {60.0 * i, 0.0, 0.0};
        Scene all = scene_of(field);
        const RestingFrames whole = rest(all, renderer, camera);
        ASSERT_TRUE(whole.is_settled);
        const std::size_t pages = all.grids()[0].store().size();
        for (const std::size_t eighths : {8U, 7U, 5U, 2U}) {
            const std::size_t room = std::max<std::size_t>(1, pages * eighths / 8);
            SCOPED_TRACE(testing::Message() << "eye " << i << ", room for " << room << " of " << pages);
            Scene few = scene_of(field, 1.0, room * page_bytes({}));
            for (const double turned_deg : {-70.0, 50.0, -20.0, 10.0, 0.0}) {
                Camera turned = camera;
                turned.attitude.heading_deg += turned_deg;
                const RestingFrames last = rest(few, renderer, turned);
                ASSERT_TRUE(last.is_settled || last.lacks_memory) << "turned by " << turned_deg;
                if (turned_deg != 0.0) continue;
                settled += last.is_settled ? 1 : 0;
                hidden_left += !last.is_settled && last.shows_all ? 1 : 0;
                coarser += last.shows_all ? 0 : 1;
                if (last.shows_all) {
                    EXPECT_TRUE(last.rgba == whole.rgba);
                }
            }
        }
    }
    std::printf("%d with all pages, %d without hidden ones, %d coarser\n", settled, hidden_left, coarser);
    EXPECT_GT(settled, 0);
    EXPECT_GT(hidden_left, 0);
    EXPECT_GT(coarser, 0);
}

INSTANTIATE_TEST_SUITE_P(Paths, Occluded, ::testing::Values(RasterPath::mesh, RasterPath::compute),
                         [](const auto& path) {
                             return std::string(path.param == RasterPath::mesh ? "mesh" : "compute");
                         });

}  // namespace
}  // namespace oro
