// What a plumb line meets first of a region's meshes: roofs.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/terrain/post_grid.h"
#include "core/truth/true_ground.h"
#include "geo/region/region.h"

namespace oro {

// The roofs of a region's meshes. Safe to ask from several threads. It takes some 120 bytes a triangle.
class MeshRoofs {
  public:
    struct Top {
        double h_m{};             // above the ellipsoid, exaggerated as the view is
        std::uint32_t mesh{};     // its number in the region, from 1
        std::uint32_t feature{};  // of that mesh: its number, from 1; 0: none
    };

    // Of the region's meshes; none: nothing has a top.
    MeshRoofs(const Region& region, double exaggeration);

    [[nodiscard]] bool any() const { return !pieces_.empty(); }
    // The highest place of a mesh on the normal of the ellipsoid through a place; nothing where there is
    // none. As exact as the oracle: the triangles are the same. An upright triangle has no top; its
    // neighbours do.
    [[nodiscard]] std::optional<Top> at(double lat_deg, double lon_deg) const;

    // Where the way from one place to another, straight in latitude and longitude, passes over a side of a
    // triangle: shares of the way, 0 to 1, ascending. Places are some 100 m apart at most.
    [[nodiscard]] std::vector<double> sides_crossed(const PostPlace& from, const PostPlace& to) const;

  private:
    [[nodiscard]] std::size_t cell_of(double lat_deg, double lon_deg) const;

    std::vector<SurfaceTriangle> pieces_;
    // Triangles by the cells of latitude and longitude that their boxes touch.
    double south_deg_{}, west_deg_{}, step_deg_{1.0};
    std::size_t rows_{}, columns_{};
    std::vector<std::uint32_t> first_, listed_;
};

}  // namespace oro
