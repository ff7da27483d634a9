#include "apps/window/show_legend.h"

#include <algorithm>
#include <span>

namespace oro {

Result<void> ShowLegend::lay_over(const View& view, const Region& region, const Style& style, int every,
                                  FrameRenderer& renderer) {
    if (!view.show) return {};
    if (view.camera.width_px != made_for_px_ || every != made_for_every_) {
        ORO_TRY(const KeyPanel panel,
                names_panel(colour_key(view, region, style, every), view.camera.width_px));
        width_px_ = static_cast<std::uint32_t>(panel.width_px);
        height_px_ = static_cast<std::uint32_t>(panel.height_px);
        rgba_.assign(std::size_t{4} * width_px_ * height_px_, 255);
        for (std::size_t i = 0; i < panel.rgb.size() / 3; ++i)
            std::copy_n(panel.rgb.begin() + static_cast<std::ptrdiff_t>(3 * i), 3,
                        rgba_.begin() + static_cast<std::ptrdiff_t>(4 * i));
        made_for_px_ = view.camera.width_px;
        made_for_every_ = every;
    }
    const std::uint32_t rows = std::min(height_px_, static_cast<std::uint32_t>(view.camera.height_px));
    return renderer.replace_picture(std::span(rgba_).first(std::size_t{4} * width_px_ * rows), width_px_,
                                    rows);
}

}  // namespace oro
