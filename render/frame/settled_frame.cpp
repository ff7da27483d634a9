#include "render/frame/settled_frame.h"

#include <utility>

namespace oro {

Result<SettledFrame> draw_settled(Scene& scene, FrameRenderer& renderer, const FrameView& view,
                                  const gpu::FrameStyle& style) {
    for (int frame = 1;; ++frame) {
        ORO_TRY(FramePlan plan, scene.settled_plan(view));
        const bool whole = plan.is_settled(), shows_all = plan.shows_all();
        const std::uint64_t page_bytes = scene.block_bytes(plan);
        ORO_TRY(FrameReport report, renderer.draw(std::move(plan), style));
        const bool is_news = !whole && scene.apply_feedback(report.feedback);
        if (is_news && frame < most_settling_frames) continue;
        return SettledFrame{std::move(report), page_bytes, whole || (shows_all && !is_news)};
    }
}

}  // namespace oro
