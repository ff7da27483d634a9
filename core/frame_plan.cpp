#include "core/frame_plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "core/high_low.h"

namespace oro {
namespace {

// A page that passed the tests, with what its frame needs.
struct SeenPage {
    std::size_t number;
    glm::dmat3 view_from_page;
    glm::dvec3 origin_view;
    double distance_m;
    bool cut_by_frustum;
};

bool inside_all(std::span<const Plane> planes, const glm::dvec3& centre, double radius) {
    return std::all_of(planes.begin(), planes.end(), [&](const Plane& plane) {
        return glm::dot(glm::dvec3(plane), centre) + plane.w > radius;
    });
}

gpu::FramePage frame_page(const PageSummary& page, const SeenPage& seen, std::span<const Plane> planes_view,
                          const HorizonEye& eye) {
    gpu::FramePage frame{};
    frame.view_from_page = gpu::mat3(seen.view_from_page);
    frame.origin_view = gpu::vec3(seen.origin_view);
    for (std::size_t i = 0; i < planes_view.size(); ++i) {
        const glm::dvec3 normal(planes_view[i]);
        frame.planes[i] =
            gpu::vec4(gpu::vec3(glm::transpose(seen.view_from_page) * normal),
                      static_cast<float>(glm::dot(normal, seen.origin_view) + planes_view[i].w));
    }
    frame.horizon_direction = gpu::vec3(eye.direction - page.horizon.direction);
    frame.cull = (seen.cut_by_frustum ? gpu::cull_by_frustum : 0U) |
                 (eye.angle_rad < std::numbers::pi ? gpu::cull_by_horizon : 0U);
    return frame;
}

gpu::FrameConstants frame_constants(const Camera& camera, const Tile& tile, const Projection& projection,
                                    const HorizonEye& eye) {
    gpu::FrameConstants constants{};
    const glm::dmat3 view_from_ecef = camera.view_from_ecef();
    constants.view_from_ecef = gpu::mat3(view_from_ecef);
    split_high_low(camera.eye_ecef().m, constants.eye_high, constants.eye_low);
    constants.projection_scale = gpu::vec2(projection.scale);
    constants.projection_shift = gpu::vec2(projection.shift);
    constants.near_m = static_cast<float>(projection.near_m);
    constants.horizon_angle_rad = static_cast<float>(eye.angle_rad);
    const glm::dvec3 up = ecef_from_enu(camera.eye.lat_deg, camera.eye.lon_deg)[2];
    constants.up_view = gpu::vec3(view_from_ecef * up);
    constants.eye_h_m = static_cast<float>(camera.eye.h_m);
    constants.earth_radius_m = static_cast<float>(
        std::sqrt(prime_vertical_radius_m(camera.eye.lat_deg) * meridian_radius_m(camera.eye.lat_deg)));
    constants.width_px = static_cast<gpu::uint>(tile.width_px);
    constants.height_px = static_cast<gpu::uint>(tile.height_px);
    constants.sample_count = 1;
    return constants;
}

}  // namespace

FramePlan plan_frame(std::span<const PageSummary> pages, const RegionShape& shape, const Camera& camera,
                     const Tile& tile) {
    const Projection projection = projection_of_tile(camera, tile);
    const std::array<Plane, 5> planes_view = frustum_planes_view(projection);
    const glm::dmat3 view_from_ecef = camera.view_from_ecef();
    const Ecef eye = camera.eye_ecef();
    const HorizonEye horizon = horizon_eye(shape.occluder, eye);

    FramePlan plan;
    plan.constants = frame_constants(camera, tile, projection, horizon);
    std::vector<SeenPage> seen;
    for (std::size_t i = 0; i < pages.size(); ++i) {
        const PageSummary& page = pages[i];
        const glm::dmat3 view_from_page = view_from_ecef * page.ecef_from_page;
        const glm::dvec3 origin_view = view_from_ecef * (page.origin_ecef.m - eye.m);
        const glm::dvec3 centre_view = origin_view + view_from_page * page.centre_m;
        if (beyond_frustum(planes_view, centre_view, page.radius_m)) {
            ++plan.pages_beyond_frustum;
        } else if (beyond_horizon(horizon, page.horizon)) {
            ++plan.pages_beyond_horizon;
        } else {
            const double distance_m = std::max(0.0, glm::length(centre_view) - page.radius_m);
            seen.push_back({i, view_from_page, origin_view, distance_m,
                            !inside_all(planes_view, centre_view, page.radius_m)});
        }
    }
    // Near pages first: what they hide fails the depth test before it is shaded. Ties by number: one order
    // for one input.
    std::sort(seen.begin(), seen.end(), [](const SeenPage& a, const SeenPage& b) {
        return a.distance_m != b.distance_m ? a.distance_m < b.distance_m : a.number < b.number;
    });
    for (const SeenPage& page : seen) {
        plan.pages.push_back(frame_page(pages[page.number], page, planes_view, horizon));
        plan.page_numbers.push_back(page.number);
    }
    plan.constants.page_count = static_cast<gpu::uint>(plan.pages.size());
    return plan;
}

}  // namespace oro
