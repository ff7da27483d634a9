#include "render/grass/grass_scene.h"

#include <cassert>
#include <cmath>
#include <numbers>

namespace oro {
namespace {

// Between clumps, of the field of 871,264 blades. With grass_published_margin_m it gives Table 1's blades
// within 2 %, where the dissertation tells no density.
constexpr double published_spacing_m = 0.597;
constexpr double field_of_view_deg = 45.0;

}  // namespace

gpu::GrassField grass_field(std::uint32_t blades) {
    assert(blades >= gpu::blades_per_clump && blades <= grass_blades_max);
    gpu::GrassField field{};
    field.clumps = (blades + gpu::blades_per_clump - 1) / gpu::blades_per_clump;
    const double across = static_cast<double>(grass_width_px) / grass_height_px;
    field.columns = static_cast<std::uint32_t>(std::ceil(std::sqrt(field.clumps * across)));
    field.rows = (field.clumps + field.columns - 1) / field.columns;
    const double published_clumps =
        grass_published_blades.back() / static_cast<double>(gpu::blades_per_clump);
    field.spacing_m = static_cast<float>(published_spacing_m * std::sqrt(published_clumps / field.clumps));
    return field;
}

gpu::GrassView grass_view_down(float eye_height_m, std::uint32_t width_px, std::uint32_t height_px) {
    const double tangent = std::tan(0.5 * field_of_view_deg * std::numbers::pi / 180.0);
    gpu::GrassView view{};
    view.eye = {0.0F, 0.0F, eye_height_m};
    view.right = {1.0F, 0.0F, 0.0F};
    view.up = {0.0F, 1.0F, 0.0F};
    view.forward = {0.0F, 0.0F, -1.0F};
    view.scale = {static_cast<float>(height_px / (tangent * width_px)), static_cast<float>(1.0 / tangent)};
    return view;
}

}  // namespace oro
