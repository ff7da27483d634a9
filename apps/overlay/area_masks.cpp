#include "apps/overlay/area_masks.h"

#include <cmath>
#include <map>
#include <string>

#include "apps/options/view_limits.h"
#include "apps/overlay/ground_area.h"
#include "apps/overlay/line_masks.h"
#include "apps/styles/colours.h"
#include "apps/vectors/named_points.h"
#include "core/measure/shown_place.h"
#include "render/frame/shown_ground.h"

namespace oro {
namespace {

struct Fill {
    InkedText::Colour colour;
    double opacity;
};

Fill fill_of(const VectorLayer& layer, const VectorShape& shape, const VectorChoices& choices) {
    // Source: simplestyle-spec 1.1.0: a feature that says `fill` and no more is filled to 0.6.
    constexpr double simplestyle_opacity = 0.6;
    Fill fill{ink_of(choices.overlay_colour), choices.overlay_fill};
    if (const auto colour = colour_from(std::string(layer.text(shape, "fill"))))
        fill = {ink_of(*colour), simplestyle_opacity};
    const auto opacity = metres_from(layer.text(shape, "fill-opacity"));  // a number
    if (opacity && view_limits::overlay_fill.hold(*opacity)) fill.opacity = *opacity;
    return fill;
}

// take(shape, fill) for each polygon that is filled.
template <class Take>
void for_filled(const View& view, const Take& take) {
    for (const VectorFile& file : view.vectors_read->overlay) {
        for (const VectorLayer& layer : file.layers) {
            for (const VectorShape& shape : layer.shapes) {
                if (shape.kind != VectorKind::polygon) continue;
                const Fill fill = fill_of(layer, shape, view.vectors);
                if (fill.opacity > 0.0) take(shape, fill);
            }
        }
    }
}

}  // namespace

bool has_areas(const View& view) {
    bool any = false;
    if (view.vectors_read) for_filled(view, [&](const VectorShape&, const Fill&) { any = true; });
    return any;
}

Result<std::vector<InkedText>> area_masks(const Gpu& gpu, Scene& scene, const View& view,
                                          const TrueGround& ground, const PictureOptions& options) {
    struct Filled {
        GroundArea area;
        std::uint8_t cover;
        std::size_t mask;
    };
    std::vector<Filled> filled;
    std::vector<InkedText::Colour> colours;
    std::vector<LineMask> masks;
    std::map<InkedText::Colour, std::size_t> mask_of;
    for_filled(view, [&](const VectorShape& shape, const Fill& fill) {
        GroundArea area(shape);
        if (area.is_empty()) return;
        const auto [found, is_new] = mask_of.try_emplace(fill.colour, masks.size());
        if (is_new) {
            masks.emplace_back(view.camera.width_px, view.camera.height_px);
            colours.push_back(fill.colour);
        }
        filled.push_back(
            {std::move(area), static_cast<std::uint8_t>(std::lround(255.0 * fill.opacity)), found->second});
    });
    if (!filled.empty()) {
        const Sight sight = sight_of(options.model, view.camera.eye);
        ORO_CHECK(shown_ground(gpu, scene, view.camera, options, 1,
                               [&](int x_px, int y_px, const DrawnPoint& point) {
                                   if (point.background()) return;
                                   const auto [lat_deg, lon_deg] =
                                       place_of(point, ground, sight, view.camera, {x_px + 0.5, y_px + 0.5});
                                   for (const Filled& one : filled) {
                                       if (one.area.holds(lat_deg, lon_deg))
                                           masks[one.mask].cover(x_px, y_px, one.cover);
                                   }
                               }));
    }
    std::vector<InkedText> inked;
    for (std::size_t i = 0; i < masks.size(); ++i) masks[i].give(colours[i], inked);
    return inked;
}

}  // namespace oro
