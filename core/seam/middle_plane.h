// Where what is drawn beside grids lies: a plane over all of it, a grid for its pages, an order of
// neighbours.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/seam/seam.h"
#include "core/terrain/page.h"
#include "core/terrain/post_grid.h"

namespace oro {

// The plane that touches the Earth's normals in the middle of some places, and the box that holds them on it.
struct MiddlePlane {
    glm::dvec3 middle, east, north;
    glm::dvec2 low{1.0e30}, high{-1.0e30};

    [[nodiscard]] glm::dvec2 at(const glm::dvec3& normal) const;
    [[nodiscard]] glm::dvec3 normal(const glm::dvec2& point) const;
    // A place in the box, 0 to 1 along both of its sides.
    [[nodiscard]] glm::dvec2 share(const SeamCorner& corner) const;
};

// The ellipsoid's normal below a place, to what heights are beside the Earth.
glm::dvec3 up_at(const SeamCorner& corner);

// Errors: they reach over more than 60 degrees. what: that is drawn, for the message.
Result<MiddlePlane> middle_plane_of(std::span<const SeamCorner* const> corners, const char* what);

// A net over so many pages in a row, whose posts stand for nothing: it says where in the region a place is.
Result<PostGrid> grid_over(const MiddlePlane& plane, int pages);

// The order in which neighbours on the ground are near each other, so that pages and meshlets are small: of
// each place in a plane's box its number. Places at one point keep their order.
std::vector<std::uint32_t> order_of_places(std::span<const glm::dvec2> shares);

// The sphere around points, with slack for their rounding.
class PointsAround {
  public:
    void hold(const glm::dvec3& point);
    [[nodiscard]] glm::dvec3 centre() const { return 0.5 * (low_ + high_); }
    [[nodiscard]] double radius() const;

  private:
    glm::dvec3 low_{1.0e300}, high_{-1.0e300};
};

// Sets what a page's places lie in: its frame, its sphere, and a horizon that never hides it. around: of
// them, ECEF. The page's heights are known.
void set_page_around(const PointsAround& around, PageSummary& summary);
// The bounds of a node of such a page, of its places in the page's frame; of one without places: it has no
// triangle.
gpu::MeshletBounds bounds_around(std::span<const glm::dvec3> points);

}  // namespace oro
