// A scene with a renderer for one way of drawing, for tests that look at what comes out.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "render/frame/frame_renderer.h"
#include "render/scene/scene.h"
#include "tests/support/drawn/made_renderer.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/height_storage.h"

namespace oro::test {

inline Tile whole_picture(const Camera& camera) {
    return {0, 0, camera.width_px, camera.height_px, {0.5, 0.5}};
}

// Ids of a frame with all that tau asks for.
struct DrawnFrame {
    FramePlan plan;
    FrameReport report;
    std::vector<std::uint32_t> ids;
};

class DrawnScene {
  public:
    DrawnScene(const Gpu& gpu, std::unique_ptr<RegionPages> pages, RasterPath path, int width_px,
               int height_px, std::uint64_t gpu_memory_bytes = std::uint64_t{256} << 20U) {
        auto scene = Scene::create(gpu, std::move(pages), {gpu_memory_bytes, 0}, asked_heights());
        EXPECT_TRUE(scene.ok()) << scene.error().line();
        scene_.emplace(std::move(scene).value());
        FrameRendererOptions options;
        options.extent = {static_cast<std::uint32_t>(width_px), static_cast<std::uint32_t>(height_px)};
        options.path = path;
        options.keep_depths = true;
        renderer_.emplace(test::made_renderer(gpu, options));
    }

    DrawnFrame draw(const Camera& camera, double tau_px, const gpu::FrameStyle& style = {}) {
        return draw(camera, scene_->settled_plan({camera, whole_picture(camera), tau_px}), style);
    }
    // With what is there, as a window does.
    DrawnFrame draw_what_is_here(const Camera& camera, double tau_px, const gpu::FrameStyle& style = {}) {
        return draw(camera, scene_->plan({camera, whole_picture(camera), tau_px}), style);
    }

    Scene& scene() { return *scene_; }
    FrameRenderer& renderer() { return *renderer_; }

  private:
    DrawnFrame draw(const Camera& camera, Result<FramePlan> plan, const gpu::FrameStyle& style) {
        EXPECT_TRUE(plan.ok()) << plan.error().line();
        DrawnFrame frame{*plan, {}, {}};
        auto report = renderer_->draw(std::move(plan).value(), style);
        EXPECT_TRUE(report.ok()) << report.error().line();
        frame.report = *report;
        auto ids = renderer_->read_ids(static_cast<std::uint32_t>(camera.width_px),
                                       static_cast<std::uint32_t>(camera.height_px));
        EXPECT_TRUE(ids.ok()) << ids.error().line();
        frame.ids = std::move(ids).value();
        return frame;
    }

    std::optional<Scene> scene_;
    std::optional<FrameRenderer> renderer_;
};

}  // namespace oro::test
