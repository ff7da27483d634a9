// The legend in a window that explains its frames (--show).
#pragma once

#include "apps/legend/key_names.h"
#include "apps/view/style.h"
#include "apps/view/view.h"
#include "render/frame/frame_renderer.h"

namespace oro {

// Made once for a width of the window.
class ShowLegend {
  public:
    // Puts it over the top left corner of the frame that was drawn last, which is as large as the view's
    // picture; cut off where that is smaller. Nothing where the view shows the ground. `every` as in
    // colour_key(). Errors: those of text, and of the device.
    Result<void> lay_over(const View& view, const Region& region, const Style& style, int every,
                          FrameRenderer& renderer);

  private:
    int made_for_px_{};
    int made_for_every_{};
    std::uint32_t width_px_{}, height_px_{};
    std::vector<std::uint8_t> rgba_;
};

}  // namespace oro
