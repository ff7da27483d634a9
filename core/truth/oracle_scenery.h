// What the oracle's sight lines go through. Within core.
#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "core/truth/oracle.h"

namespace oro {

// What all sight lines of a picture share: the surface in a frame whose z is up in the middle of the region,
// so that boxes along its axes lie close around the ground.
class Oracle::Scenery {
  public:
    // A row's posts are at ((N + h) cos lat cos lon, (N + h) cos lat sin lon, (N (1 - e2) + h) sin lat).
    struct RowTerms {
        double normal_m;
        double cosine;
        double sine;
    };

    // `ground` outlives it.
    Scenery(const TrueGround& ground, std::size_t grid, const Sight& sight);

    const TrueGround& ground;
    const std::size_t grid;  // of the ground's
    const TrueSurface& surface;
    const Sight sight;
    glm::dmat3 frame_from_ecef;
    // Of the grid, each block_cells-th and the last; on a net TrueSurface::corners() are instead of them.
    std::vector<RowTerms> rows;
    std::vector<SineCosine> columns;
    // Of the flat Earth instead: metres north and east of the eye.
    std::vector<double> rows_north_m, columns_east_m;

    // Where a point of the grid is seen from the eye, in the frame; on a round Earth.
    [[nodiscard]] glm::dvec3 seen(int row, int column, double h_m) const;
    // A block's corners among `rows` and `columns`.
    struct Patch {
        int north, south, west, east;
    };
    // What holds a block on the flat Earth, metres east and north of the eye.
    struct PlaneBox {
        double west_m, south_m, east_m, north_m;
    };
    [[nodiscard]] PlaneBox on_plane(const Patch& patch) const;
    [[nodiscard]] PlaneBox net_on_plane(const Patch& patch) const;
    // Corners of a box around a block on the flat Earth.
    void flat_box(const Patch& patch, const TrueSurface::Layer& layer, glm::dvec3& low,
                  glm::dvec3& high) const;
    // Corners of a box around all of a block that can be seen; false when there is nothing in it.
    [[nodiscard]] bool box(const TrueSurface::Block& block, glm::dvec3& low, glm::dvec3& high) const;

    // Of box(), as a thread remembers it.
    struct Box {
        std::uint64_t scenery{0};  // 0: none
        TrueSurface::Block block{};
        bool holds_ground{};
        glm::dvec3 low{}, high{};
    };
    // The box of a block, remembered: neighbouring sight lines meet the same blocks. Good until this thread
    // asks again.
    [[nodiscard]] const Box& remembered_box(const TrueSurface::Block& block) const;

  private:
    std::uint64_t number_;  // of all sceneries that there ever were
};

}  // namespace oro
