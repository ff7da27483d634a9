// A scene that a window will show: shown once all is there, or all that fits.
#include "apps/window/coming_scene.h"

#include <chrono>
#include <optional>
#include <thread>
#include <utility>

#include "render/scene/page_store.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/rough_terrain.h"

namespace oro {
namespace {

class ComingScene : public test::GpuTest {
  protected:
    struct Ready {
        bool is_settled{};
        std::size_t pages{};
        double after_s{};
    };
    // Asked as a window asks that draws another scene meanwhile, for 20 s at most.
    [[nodiscard]] std::optional<Ready> ready_with(std::uint64_t memory) const {
        const HeightField field = test::rough_field(47.0, 8.0, 900, 900);
        auto scene = Scene::create(*gpu_, pages_in_memory(field, 1.0, 2), {memory, 0});
        EXPECT_TRUE(scene.ok()) << scene.error().line();
        Camera camera;
        camera.eye = {46.5, 8.5, 3000.0};
        camera.attitude = {30.0, -10.0, 0.0};
        camera.width_px = 320, camera.height_px = 240;
        const auto since = Clock::now();
        while (seconds_since(since) < 20.0) {
            const auto plan = scene->plan({camera, {0, 0, 320, 240, {0.5, 0.5}}, 1.0});
            EXPECT_TRUE(plan.ok()) << plan.error().line();
            const auto ready = has_what_fits(*scene, *plan, since);
            EXPECT_TRUE(ready.ok()) << ready.error().line();
            if (*ready)
                return Ready{plan->is_settled(), scene->grids().front().store().size(), seconds_since(since)};
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        return std::nullopt;
    }
};

TEST_F(ComingScene, IsReadyOnceItHasAllThatFits) {
    const auto whole = ready_with(std::uint64_t{256} << 20U);
    ASSERT_TRUE(whole);
    EXPECT_TRUE(whole->is_settled);
    // A window once waited for 10 s for what never came. It has what fits: pages of the frame alone, and no
    // fewer.
    const std::size_t room = whole->pages / 2;
    const auto part = ready_with(room * page_bytes({}));
    ASSERT_TRUE(part);
    EXPECT_FALSE(part->is_settled);
    EXPECT_GE(part->pages, room * 3 / 4) << "of " << whole->pages;
    EXPECT_LT(part->after_s, 5.0);
    std::printf("%zu pages after %.2f s, with room for %zu: %zu after %.2f s\n", whole->pages, whole->after_s,
                room, part->pages, part->after_s);
}

}  // namespace
}  // namespace oro
