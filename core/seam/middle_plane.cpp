#include "core/seam/middle_plane.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <memory>
#include <utility>

#include "core/net/lattice_georeference.h"

namespace oro {

glm::dvec2 MiddlePlane::at(const glm::dvec3& normal) const {
    return glm::dvec2(glm::dot(normal, east), glm::dot(normal, north)) / glm::dot(normal, middle);
}

glm::dvec3 MiddlePlane::normal(const glm::dvec2& point) const {
    return glm::normalize(middle + point.x * east + point.y * north);
}

glm::dvec2 MiddlePlane::share(const SeamCorner& corner) const {
    return (at(up_at(corner)) - low) / (high - low);
}

glm::dvec3 up_at(const SeamCorner& corner) {
    // Heights are small beside the Earth: what is missing is made up for by the slack around.
    return glm::normalize(corner.at.m / glm::dvec3(1.0, 1.0, 1.0 - wgs84_e2));
}

Result<MiddlePlane> middle_plane_of(std::span<const SeamCorner* const> corners, const char* what) {
    MiddlePlane plane;
    glm::dvec3 sum(0.0);
    for (const SeamCorner* const corner : corners) sum += up_at(*corner);
    plane.middle = glm::normalize(sum);
    const glm::dvec3 pole =
        std::abs(plane.middle.z) < 0.9 ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(1.0, 0.0, 0.0);
    plane.east = glm::normalize(glm::cross(pole, plane.middle));
    plane.north = glm::cross(plane.middle, plane.east);
    bool near = glm::length(sum) > 0.0;
    for (const SeamCorner* const corner : corners) {
        const glm::dvec3 up = up_at(*corner);
        near = near && glm::dot(up, plane.middle) > 0.86;
        const glm::dvec2 point = plane.at(up);
        plane.low = glm::min(plane.low, point);
        plane.high = glm::max(plane.high, point);
    }
    if (!near)
        return Error{ErrorKind::failed, what, "what is drawn beside grids reaches over more than 60 degrees"};
    constexpr double slack = 1.0e-5;  // 60 m
    plane.low -= slack;
    plane.high += slack;
    return plane;
}

Result<PostGrid> grid_over(const MiddlePlane& plane, int pages) {
    constexpr int rows = static_cast<int>(gpu::page_posts);
    const int columns = pages * static_cast<int>(gpu::page_quads) + 1;
    ORO_TRY(std::shared_ptr<const LatticeGeoreference> net,
            LatticeGeoreference::fit(
                rows, columns,
                [&](std::span<const PostNumber> asked, std::span<PostPlace> places) -> Result<void> {
                    for (std::size_t i = 0; i < asked.size(); ++i) {
                        const glm::dvec2 share(asked[i].column / (columns - 1.0),
                                               1.0 - asked[i].row / (rows - 1.0));
                        places[i] =
                            place_of_normal(plane.normal(plane.low + share * (plane.high - plane.low)));
                    }
                    return {};
                }));
    return grid_on_net(std::move(net));
}

std::vector<std::uint32_t> order_of_places(std::span<const glm::dvec2> shares) {
    std::vector<std::pair<std::uint64_t, std::uint32_t>> order;
    order.reserve(shares.size());
    for (std::size_t i = 0; i < shares.size(); ++i) {
        const glm::dvec2 share = glm::clamp(shares[i], 0.0, 1.0);
        const auto x = static_cast<std::uint64_t>(share.x * 65535.0),
                   y = static_cast<std::uint64_t>(share.y * 65535.0);
        std::uint64_t key = 0;  // bits of both in turn
        for (unsigned bit = 0; bit < 16; ++bit)
            key |= (x >> bit & 1U) << (2 * bit) | (y >> bit & 1U) << (2 * bit + 1);
        order.emplace_back(key, static_cast<std::uint32_t>(i));
    }
    std::ranges::sort(order);
    std::vector<std::uint32_t> numbers;
    numbers.reserve(order.size());
    for (const auto& [key, number] : order) numbers.push_back(number);
    return numbers;
}

void PointsAround::hold(const glm::dvec3& point) {
    low_ = glm::min(low_, point);
    high_ = glm::max(high_, point);
}

double PointsAround::radius() const {
    return 0.5 * glm::length(high_ - low_) + 1.0e-2 + 1.0e-6 * glm::length(high_);
}

void set_page_around(const PointsAround& around, PageSummary& summary) {
    const PostPlace middle = place_of_normal(up_at({Ecef{around.centre()}, 0.0, {}}));
    summary.origin = {middle.lat_deg, middle.lon_deg, 0.5 * (summary.lowest_h_m + summary.highest_h_m)};
    set_page_frame(summary);
    summary.centre_m = glm::dvec3(
        glm::vec3(glm::transpose(summary.ecef_from_page) * (around.centre() - summary.origin_ecef.m)));
    summary.radius_m = summary.lod_radius_m = around.radius();
    // Never behind the horizon: closers reach out of what bounds them.
    summary.horizon = {glm::normalize(around.centre()), 4.0};
}

gpu::MeshletBounds bounds_around(std::span<const glm::dvec3> points) {
    PointsAround around;
    for (const glm::dvec3& point : points) around.hold(point);
    const bool there = !points.empty();
    const auto radius = there ? static_cast<float>(around.radius()) : -1.0F;
    return {
        there ? gpu::vec3(around.centre()) : gpu::vec3(0.0F), radius, gpu::vec3(0.0F), 4.0F, 0.0F, radius};
}

}  // namespace oro
