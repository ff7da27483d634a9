// A window's frames while the eye moves: the device chooses their pages, and what they lack is known a frame
// later; where it may not choose, the processor does.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <random>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "render/pipelines/plan_pass.h"
#include "tests/support/drawn/drawn_scene.h"
#include "tests/support/rough_terrain.h"

namespace oro {
namespace {

constexpr std::uint32_t widest_px = 96, highest_px = 54;

// A flight over the fields of the test: it drifts, and now and then is elsewhere at once; the picture's size
// changes; and now and then it rests.
class Flight {
  public:
    explicit Flight(std::uint64_t seed) : random_(seed) {}
    struct Eye {
        FrameView view;
        bool moves{true}, is_resized{false};
    };
    Eye next() {
        if (count_ % 25 == 0) begin_elsewhere();
        Eye eye;
        if (eye.is_resized = count_ % 40 == 39; eye.is_resized) {
            camera_.width_px = static_cast<int>(between(40.0, widest_px));
            camera_.height_px = static_cast<int>(between(30.0, highest_px));
        }
        eye.moves = count_ % 30 < 27;
        if (eye.moves) drift();
        ++count_;
        eye.view = {camera_, test::whole_picture(camera_), tau_px_, {}};
        return eye;
    }

  private:
    double between(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random_);
    }
    void begin_elsewhere() {
        camera_.vertical_fov_deg = between(20.0, 70.0);
        camera_.eye = {between(46.7, 46.95), between(8.05, 8.5), 3500.0 * std::exp(between(0.0, 2.0))};
        camera_.attitude = {between(0.0, 360.0), between(-80.0, -15.0), between(-10.0, 10.0)};
        tau_px_ = std::exp(between(-1.5, 0.5));
        if (count_ > 0) return;
        camera_.width_px = widest_px;
        camera_.height_px = highest_px;
    }
    void drift() {
        const double step_deg = camera_.eye.h_m * 1.0e-6;
        camera_.eye.lat_deg += step_deg * between(-1.0, 1.0);
        camera_.eye.lon_deg += step_deg * between(-1.0, 1.0);
        camera_.eye.h_m *= 1.0 + between(-0.02, 0.02);
        camera_.attitude.heading_deg += between(-4.0, 4.0);
    }
    std::mt19937_64 random_;
    Camera camera_;
    double tau_px_{1.0};
    int count_{};
};

// What apps/window/frames.cpp does with a scene: a report is taken after the next frame is planned.
class WindowsScene {
  public:
    explicit WindowsScene(Scene& scene) : scene_(scene) {}

    [[nodiscard]] bool is_missing() const { return is_missing_; }
    Result<bool> advance() { return is_missing_ ? scene_.advance(NextPlan::anyway) : Result<bool>(false); }
    Result<FramePlan> plan(const FrameView& view, bool moves) {
        scene_.leave_choice(moves && scene_.has_coarsest_pages());
        Result<FramePlan> plan = scene_.plan(view);
        scene_.leave_choice(false);
        if (plan.ok()) is_missing_ = !plan->is_settled();
        return plan;
    }
    // Of the frame that was planned last.
    void drawn(bool chosen, FrameReport report, bool moves) {
        take();
        under_way_ = {chosen, std::move(report)};
        if (!moves) take();
    }
    void take() {
        if (!under_way_) return;
        const auto [chosen, report] = *std::exchange(under_way_, std::nullopt);
        scene_.apply_feedback(report.feedback);
        if (chosen) is_missing_ = scene_.lacks_pages();
    }

  private:
    Scene& scene_;
    bool is_missing_{};
    std::optional<std::pair<bool, FrameReport>> under_way_;
};

class MovingChoice : public test::GpuTest {
  protected:
    void SetUp() override {
        test::GpuTest::SetUp();
        if (!IsSkipped() && !PlanPass::can_run(*gpu_)) GTEST_SKIP() << "the device has no doubles";
    }
    // Grids side by side, each of so many posts.
    [[nodiscard]] Scene scene_of(int grids, int rows, int columns, std::size_t pages) const {
        const auto grid_scene = [&](int grid) {
            const double west_deg = 8.0 + grid * (columns - 6) / 1200.0;
            auto scene = Scene::create(
                *gpu_, pages_in_memory(test::rough_field(47.0, west_deg, rows, columns), 1.0, 2),
                {pages * page_bytes({}), 0}, heights_);
            EXPECT_TRUE(scene.ok()) << scene.error().line();
            return std::move(scene).value();
        };
        Scene scene = grid_scene(0);
        for (int grid = 1; grid < grids; ++grid) scene.add(grid_scene(grid));
        return scene;
    }
    [[nodiscard]] FrameRenderer renderer() const {
        FrameRendererOptions options;
        options.extent = {widest_px, highest_px};
        options.path = path_;
        return test::made_renderer(*gpu_, options);
    }
    static FramePlan processors(Scene& scene, const FramePlan& like) {
        FramePlan plan{like.view, {}};
        for (std::size_t i = 0; i < scene.grids().size(); ++i) {
            GridScene& grid = scene.grids()[i];
            PageStore& store = grid.store();
            std::vector<std::pair<PageIndex, std::uint64_t>> here;
            store.for_each(
                [&](const PageIndex& page, std::uint64_t address) { here.emplace_back(page, address); });
            std::ranges::sort(here);
            const auto address = [&](const PageIndex& page) -> std::uint64_t {
                const auto at =
                    std::ranges::lower_bound(here, page, {}, [](const auto& one) { return one.first; });
                return at != here.end() && at->first == page ? at->second : 0;
            };
            auto one = plan_grid(grid.pages(), address, like.view, store.coding());
            EXPECT_TRUE(one.ok()) << one.error().line();
            one->constants.undulation.N_m = like.grids[i].constants.undulation.N_m;
            plan.grids.push_back(std::move(one).value());
        }
        return plan;
    }
    static std::vector<std::uint32_t> ids(FrameRenderer& renderer, FramePlan plan, FrameReport& report) {
        const std::uint32_t picture_width_px = plan.view.width_px(),
                            picture_height_px = plan.view.height_px();
        auto made = renderer.draw(std::move(plan), {});
        EXPECT_TRUE(made.ok()) << made.error().line();
        report = std::move(made).value();
        auto read = renderer.read_ids(picture_width_px, picture_height_px);
        EXPECT_TRUE(read.ok()) << read.error().line();
        return std::move(read).value();
    }
    static void resize(FrameRenderer& renderer, const FrameView& view) {
        const auto resized = renderer.resize({view.width_px(), view.height_px()});
        ASSERT_TRUE(resized.ok()) << resized.error().line();
    }
    // The pages that a plan of the processor uses, of each grid.
    static void expect_here(const Scene& scene, const std::optional<FramePlan>& plan) {
        for (std::size_t i = 0; plan && i < plan->grids.size(); ++i)
            for (const PageIndex& page : plan->grids[i].page_indices)
                EXPECT_TRUE(scene.grids()[i].store().has(page)) << "gave way in the middle of a motion";
    }

    struct Seen {
        int by_device{}, by_processor{}, not_whole{};
        std::size_t triangles{};
    };
    RasterPath path_{RasterPath::compute};
    HeightStorage heights_{test::asked_heights()};
    // Flies, and compares each frame whose pages the device has chosen.
    void fly(Scene& scene, int eyes, std::uint64_t seed, Seen& seen);
    // Then rests, until nothing is missing: false where that is never so.
    static bool settles(WindowsScene& window, FrameRenderer& renderer, const FrameView& view,
                        std::vector<std::uint32_t>& shown);
};

void MovingChoice::fly(Scene& scene, int eyes, std::uint64_t seed, Seen& seen) {
    FrameRenderer device = renderer(), processor = renderer();
    WindowsScene window(scene);
    Flight flight(seed);
    std::optional<FramePlan> before;  // of the last frame, where the device has chosen its pages
    for (int i = 0; i < eyes; ++i) {
        const Flight::Eye eye = flight.next();
        if (eye.is_resized) {
            window.take();
            resize(device, eye.view);
            resize(processor, eye.view);
        }
        const bool had_ground = scene.has_coarsest_pages();
        ASSERT_TRUE(window.advance().ok());
        ASSERT_TRUE(scene.has_coarsest_pages() || !had_ground) << "eye " << i;
        expect_here(scene, before);
        auto plan = window.plan(eye.view, eye.moves);
        ASSERT_TRUE(plan.ok()) << plan.error().line();
        const bool chosen = plan->grids.front().device.chooses;
        ASSERT_FALSE(chosen && !eye.moves);
        ++(chosen ? seen.by_device : seen.by_processor);
        FramePlan expected = processors(scene, *plan);
        before.reset();
        if (chosen) before = expected;
        seen.not_whole += expected.is_settled() ? 0 : 1;
        FrameReport report, expected_report;
        const auto shown = ids(device, std::move(plan).value(), report);
        if (chosen) {
            ASSERT_EQ(shown, ids(processor, std::move(expected), expected_report)) << "eye " << i;
            ASSERT_EQ(report.pages, expected_report.pages);
            seen.triangles += report.counts.triangles_drawn;
        }
        window.drawn(chosen, std::move(report), eye.moves);
    }
    // The eye stops: what the last frames lack is known, and comes.
    Flight::Eye last = flight.next();
    last.view.camera.width_px = static_cast<int>(device.extent().width);
    last.view.camera.height_px = static_cast<int>(device.extent().height);
    last.view.tile = test::whole_picture(last.view.camera);
    auto plan = window.plan(last.view, true);
    ASSERT_TRUE(plan.ok());
    const bool chosen = plan->grids.front().device.chooses;
    const FramePlan expected = processors(scene, *plan);
    FrameReport report;
    ids(device, std::move(plan).value(), report);
    window.drawn(chosen, std::move(report), false);
    EXPECT_EQ(window.is_missing(), !expected.is_settled()) << (chosen ? "by the device" : "by the processor");
    std::vector<std::uint32_t> shown;
    EXPECT_TRUE(settles(window, device, last.view, shown)) << "or the window says that it loads for ever";
}

bool MovingChoice::settles(WindowsScene& window, FrameRenderer& renderer, const FrameView& view,
                           std::vector<std::uint32_t>& shown) {
    constexpr std::chrono::seconds longest(20);
    const auto start = std::chrono::steady_clock::now();
    while (window.is_missing()) {
        if (std::chrono::steady_clock::now() - start > longest) return false;
        const auto better = window.advance();
        EXPECT_TRUE(better.ok()) << better.error().line();
        if (!*better) continue;
        auto plan = window.plan(view, false);
        EXPECT_TRUE(plan.ok()) << plan.error().line();
        FrameReport report;
        shown = ids(renderer, std::move(plan).value(), report);
        window.drawn(false, std::move(report), false);
    }
    return true;
}

void print(const char* what, int eyes, std::uint64_t seed, int by_device, int by_processor, int not_whole) {
    std::printf(
        "%s: %d eyes, seed %llu: pages of %d frames chosen by the device, of %d by the processor; "
        "%d frames lack pages\n",
        what, eyes, static_cast<unsigned long long>(seed), by_device, by_processor, not_whole);
}

TEST_F(MovingChoice, HasTheFramesOfTheProcessor) {
    Scene scene = scene_of(1, 500, 600, 400);
    ASSERT_TRUE(*scene.choose_on_device(*gpu_));
    Seen seen;
    ASSERT_NO_FATAL_FAILURE(fly(scene, 200, 91, seen));
    print("one grid", 200, 91, seen.by_device, seen.by_processor, seen.not_whole);
    EXPECT_GT(seen.by_device, 150);
    EXPECT_GT(seen.not_whole, 2);
    EXPECT_GT(seen.triangles, 2000U) << "or the eyes see nothing";
}

TEST_F(MovingChoice, HasTheFramesOfTheProcessorOfSeveralGrids) {
    Scene scene = scene_of(2, 400, 300, 400);
    ASSERT_TRUE(*scene.choose_on_device(*gpu_));
    Seen seen;
    ASSERT_NO_FATAL_FAILURE(fly(scene, 60, 92, seen));
    print("two grids", 60, 92, seen.by_device, seen.by_processor, seen.not_whole);
    EXPECT_GT(seen.by_device, 40);
}

// By both ways of drawing, with heights of each kind, of one grid and of two, in less than 32 MB.
class MovingChoiceLong : public MovingChoice,
                         public ::testing::WithParamInterface<std::tuple<RasterPath, HeightStorage, int>> {};
TEST_P(MovingChoiceLong, HasTheFramesOfTheProcessorAt500Eyes) {
    int grids = 0;
    std::tie(path_, heights_, grids) = GetParam();
    constexpr std::size_t pages = 380;
    ASSERT_LT(pages * page_bytes({}), 32'000'000U);
    Scene scene = grids == 1 ? scene_of(1, 500, 600, pages) : scene_of(2, 400, 300, pages);
    ASSERT_TRUE(*scene.choose_on_device(*gpu_));
    Seen seen;
    ASSERT_NO_FATAL_FAILURE(fly(scene, 500, 94, seen));
    print(path_ == RasterPath::mesh ? "mesh shaders" : "compute", 500, 94, seen.by_device, seen.by_processor,
          seen.not_whole);
    EXPECT_GT(seen.by_device, 350);
    EXPECT_GT(seen.not_whole, 2);
    EXPECT_GT(seen.triangles, 2000U) << "or the eyes see nothing";
}
std::string name_of(const ::testing::TestParamInfo<MovingChoiceLong::ParamType>& info) {
    const auto [path, heights, grids] = info.param;
    const char* const kept = heights == HeightStorage::f32   ? "f32"
                             : heights == HeightStorage::i16 ? "i16"
                                                             : "packed";
    return std::string(path == RasterPath::mesh ? "mesh" : "compute") + "_" + kept + "_" +
           std::to_string(grids);
}
INSTANTIATE_TEST_SUITE_P(Ways, MovingChoiceLong,
                         ::testing::Combine(::testing::Values(RasterPath::compute, RasterPath::mesh),
                                            ::testing::Values(HeightStorage::f32, HeightStorage::i16,
                                                              HeightStorage::packed),
                                            ::testing::Values(1, 2)),
                         name_of);

// In memory that is full the device chooses again where the eye stays over ground that is there.
TEST_F(MovingChoice, GoesOnInFullMemoryWhereNothingIsMissing) {
    Scene scene = scene_of(1, 500, 600, 12);
    ASSERT_TRUE(*scene.choose_on_device(*gpu_));
    FrameRenderer device = renderer(), processor = renderer();
    WindowsScene window(scene);
    Camera camera;
    camera.width_px = widest_px;
    camera.height_px = highest_px;
    // First near the ground, where frames want more than there is room for, then so high up that a few pages
    // are enough.
    camera.eye = {46.8, 8.25, 5000.0};
    camera.attitude = {0.0, -80.0, 0.0};
    int near_ground = 0, chosen_frames = 0;
    for (; scene.grids()[0].store().has_capacity(); ++near_ground) {
        ASSERT_LT(near_ground, 2000) << "memory is never full";
        ASSERT_TRUE(window.advance().ok());
        ASSERT_TRUE(window.plan({camera, test::whole_picture(camera), 0.3, {}}, false).ok());
    }
    camera.eye.h_m = 60000.0;
    for (int i = 0; i < 120; ++i) {
        camera.attitude.heading_deg += 0.5;
        ASSERT_TRUE(window.advance().ok());
        auto plan = window.plan({camera, test::whole_picture(camera), 4.0, {}}, true);
        ASSERT_TRUE(plan.ok());
        const bool chosen = plan->grids.front().device.chooses;
        chosen_frames += chosen ? 1 : 0;
        FramePlan expected = processors(scene, *plan);
        FrameReport report, expected_report;
        const auto shown = ids(device, std::move(plan).value(), report);
        const auto wanted = ids(processor, std::move(expected), expected_report);
        ASSERT_TRUE(!chosen || shown == wanted) << "frame " << i;
        window.drawn(chosen, std::move(report), true);
    }
    std::printf("%d of 120 frames in full memory chosen by the device\n", chosen_frames);
    EXPECT_FALSE(scene.grids()[0].store().has_capacity());
    EXPECT_GT(chosen_frames, 50);
    EXPECT_LT(chosen_frames, 120);
}

// Memory is full again and again: the processor then says what may give way.
TEST_F(MovingChoice, KeepsWhatIsShownWhereMemoryIsFull) {
    Scene scene = scene_of(1, 500, 600, 20);
    ASSERT_TRUE(*scene.choose_on_device(*gpu_));
    Seen seen;
    ASSERT_NO_FATAL_FAILURE(fly(scene, 200, 93, seen));
    print("room for 20 pages", 200, 93, seen.by_device, seen.by_processor, seen.not_whole);
    EXPECT_GT(seen.by_device, 5);
    EXPECT_GT(seen.by_processor, 40);
}

// Frames with shadows have the processor's plan, and those after them the device's again.
TEST_F(MovingChoice, IsLeftToTheProcessorWhereFramesHaveShadows) {
    Scene scene = scene_of(1, 300, 300, 400);
    ASSERT_TRUE(*scene.choose_on_device(*gpu_));
    FrameRenderer drawing = renderer();
    WindowsScene window(scene);
    Flight flight(94);
    const FrameView view = flight.next().view;
    std::vector<std::uint32_t> shown;
    ASSERT_TRUE(window.plan(view, false).ok());
    ASSERT_TRUE(settles(window, drawing, view, shown));
    for (int i = 0; i < 6; ++i) {
        const bool has_shadows = i % 2 == 1;
        scene.set_shadow_request(
            {has_shadows ? std::optional(glm::dvec3(0.6, 0.0, 0.8)) : std::nullopt, false});
        EXPECT_EQ(scene.may_leave_choice(), !has_shadows);
        auto plan = window.plan(view, true);
        ASSERT_TRUE(plan.ok());
        EXPECT_EQ(plan->grids.front().device.chooses, !has_shadows);
        FrameReport report;
        const bool chosen = plan->grids.front().device.chooses;
        ASSERT_EQ(ids(drawing, std::move(plan).value(), report), shown) << "frame " << i;
        window.drawn(chosen, std::move(report), true);
    }
}

// The last frame before the eye stops is of another place than the one before: what it lacks it tells itself.
TEST_F(MovingChoice, TellsAnEyeThatStopsWhatItsFrameLacks) {
    Scene scene = scene_of(1, 500, 600, 400);
    ASSERT_TRUE(*scene.choose_on_device(*gpu_));
    FrameRenderer drawing = renderer();
    WindowsScene window(scene);
    Flight flight(96);
    FrameView view = flight.next().view;
    int lacking = 0, whole = 0;
    for (int i = 0; i < 8; ++i) {
        std::vector<std::uint32_t> shown;
        // Each place twice: it lacks something, then nothing.
        if (i % 2 == 0)
            for (int skipped = 0; i > 0 && skipped < 25; ++skipped) view = flight.next().view;
        view.camera.width_px = widest_px;
        view.camera.height_px = highest_px;
        view.tile = test::whole_picture(view.camera);
        auto plan = window.plan(view, true);
        ASSERT_TRUE(plan.ok());
        const bool chosen = plan->grids.front().device.chooses;
        ASSERT_EQ(chosen, i > 0);
        const FramePlan expected = processors(scene, *plan);
        FrameReport report;
        ids(drawing, std::move(plan).value(), report);
        window.drawn(chosen, std::move(report), false);
        ASSERT_EQ(window.is_missing(), !expected.is_settled()) << "frame " << i;
        ++(window.is_missing() ? lacking : whole);
        ASSERT_TRUE(settles(window, drawing, view, shown)) << "frame " << i;
        ASSERT_FALSE(scene.lacks_pages());
    }
    EXPECT_GE(lacking, 3);
    EXPECT_GE(whole, 3);
}

// A grid that was never in view has nothing here, and nobody knows yet whether the next frame sees it.
TEST_F(MovingChoice, HasTheCoarsestPagesOfGridsOutOfView) {
    Scene scene = scene_of(1, 300, 300, 400);
    auto far = Scene::create(*gpu_, pages_in_memory(test::rough_field(7.0, 8.0, 300, 300), 1.0, 2), {},
                             test::asked_heights());
    ASSERT_TRUE(far.ok()) << far.error().line();
    scene.add(std::move(far).value());
    ASSERT_TRUE(*scene.choose_on_device(*gpu_));
    FrameRenderer drawing = renderer();
    WindowsScene window(scene);
    Flight flight(98);
    const FrameView view = flight.next().view;
    std::vector<std::uint32_t> shown;
    ASSERT_TRUE(window.plan(view, false).ok());
    ASSERT_TRUE(settles(window, drawing, view, shown));
    EXPECT_EQ(scene.grids()[1].store().size(), 0U);
    EXPECT_FALSE(scene.has_coarsest_pages());
    ASSERT_TRUE(scene.load_coarsest_pages().ok());
    EXPECT_EQ(scene.grids()[1].store().size(), 1U);
    EXPECT_TRUE(scene.has_coarsest_pages());
    auto plan = window.plan(view, true);
    ASSERT_TRUE(plan.ok());
    EXPECT_TRUE(plan->grids[0].device.chooses && plan->grids[1].device.chooses);
    FrameReport report;
    EXPECT_EQ(ids(drawing, std::move(plan).value(), report), shown);
}

// 500 x 600 posts have 4 x 5, 2 x 3, 1 x 2 and 1 x 1 pages: 29, and so has each of two grids.
TEST_F(MovingChoice, HasItsRecordsReadInTurns) {
    const Scene scene = scene_of(2, 500, 600, 400);
    std::uint64_t next = 0;
    int turns = 0;
    for (Result<bool> all = false; !*all; ++turns) {
        ASSERT_LT(turns, 1000);
        all = scene.read_records(next, 0.0, 1'000'000);
        ASSERT_TRUE(all.ok()) << all.error().line();
    }
    EXPECT_EQ(next, 58U);
    EXPECT_EQ(turns, 59);
    EXPECT_TRUE(*scene.read_records(next, 0.0, 1'000'000));
    // Of grids whose records would take more nothing is read.
    next = 0;
    EXPECT_TRUE(*scene.read_records(next, 0.0, 1000));
    EXPECT_EQ(next, 0U);
}

// Frames are under way while the next ones are planned, as a window has them.
TEST_F(MovingChoice, ChangesNothingWhereFramesAreUnderWay) {
    Scene scene = scene_of(1, 500, 600, 400);
    ASSERT_TRUE(*scene.choose_on_device(*gpu_));
    FrameRenderer device = renderer(), processor = renderer();
    ASSERT_TRUE(device.prepare_choice().ok());
    Flight flight(95);
    bool is_missing = false;
    int compared = 0;
    for (int i = 0; i < 39; ++i) {
        const Flight::Eye eye = flight.next();
        while (device.under_way() > frames_in_flight - 1) {
            const auto report = device.finish();
            ASSERT_TRUE(report.ok());
            scene.apply_feedback(report->feedback);
            is_missing = scene.lacks_pages();
        }
        const auto better = is_missing ? scene.advance(NextPlan::anyway) : Result<bool>(false);
        ASSERT_TRUE(better.ok());
        scene.leave_choice(scene.has_coarsest_pages());
        auto plan = scene.plan(eye.view);
        ASSERT_TRUE(plan.ok());
        is_missing = is_missing || !plan->is_settled();
        FramePlan expected = processors(scene, *plan);
        ASSERT_TRUE(device.submit(std::move(plan).value(), {}).ok());
        if (i % 4 != 3) continue;
        while (device.under_way() > 0) {
            const auto report = device.finish();
            ASSERT_TRUE(report.ok());
            scene.apply_feedback(report->feedback);
        }
        is_missing = scene.lacks_pages();
        EXPECT_EQ(is_missing, !expected.is_settled());
        FrameReport report;
        const auto wanted = ids(processor, std::move(expected), report);
        auto shown = device.read_ids(eye.view.width_px(), eye.view.height_px());
        ASSERT_TRUE(shown.ok());
        ASSERT_EQ(*shown, wanted) << "eye " << i;
        ++compared;
    }
    EXPECT_EQ(compared, 9);
}

}  // namespace
}  // namespace oro
