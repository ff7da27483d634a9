// What casts shadows into a frame: pages that are drawn, and others between them and the sun.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "core/frame/region_pages.h"
#include "core/frame/shadow_receiver.h"
#include "shaders/shared.h"

namespace oro {

struct FrameView;
struct GridPlan;

// What a style asks of the terrain around its ground.
struct ShadowRequest {
    std::optional<glm::dvec3> sun_enu;  // where shadows come from: unit vector, east, north, up at the eye
    bool sky_openness{};                // how much of the sky a place sees
    [[nodiscard]] bool any() const { return sun_enu || sky_openness; }
};
// By night there are no shadows.
ShadowRequest shadow_request(const gpu::FrameStyle& style);

// Ready for the GPU but for the addresses of its buffers.
struct CasterPlan {
    gpu::Casters frame{};
    bool for_shadows{};
    bool for_openness{};
    std::vector<gpu::CasterPage> pages;  // first those of the frame, in its order
    std::vector<gpu::uint> table;
};

// A shadow's edge may be off by so many pixels because coarser levels cast it.
inline constexpr double caster_error_px = 0.1;
// Casters may be off by so much for each metre from the eye to what they shade, times the slope of the light
// there.
inline double caster_error_per_metre(float pixels_per_tangent) {
    return caster_error_px / static_cast<double>(pixels_per_tangent);
}

// Height above the ellipsoid that nothing in the region is above, as drawn. Reads the records of some pages.
Result<double> region_top_m(const RegionPages& pages);

// The ground that a plan of these pages shows, for plan_casters() of other grids of the frame. Errors: a
// page's record that cannot be read.
Result<std::vector<ShadowReceiver>> shadow_receivers(const RegionPages& pages, const FrameView& view,
                                                     const GridPlan& plan);

// Chooses the pages of all levels that are needed around a plan's own. For shadows those that a line from any
// place of the plan's pages towards the sun may pass below the top of, no coarser than `caster_error_px` asks
// for; light is parallel and straight. For the sky's openness those beside the plan's. Adds what is not on
// the GPU to plan.missing. residency: as for plan_grid(). others: ground of other grids that is seen in the
// frame; a plan without pages of its own may cast on that alone. Errors: a page's record that cannot be read.
Result<void> plan_casters(const RegionPages& pages,
                          const std::function<std::uint64_t(const PageIndex&)>& residency,
                          const FrameView& view, const ShadowRequest& request, double top_m, GridPlan& plan,
                          std::span<const ShadowReceiver> others = {});

}  // namespace oro
