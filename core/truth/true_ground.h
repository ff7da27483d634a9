// The ground of one grid or of several: what sight lines are held against.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/earth/ellipsoid.h"
#include "core/truth/true_mesh.h"
#include "core/truth/true_surface.h"

namespace oro {

// A triangle of ground that belongs to no grid: an upright step along the rim of one that lies over another,
// or along the rim of what a mesh cuts out of the terrain.
// Straight between its corners.
struct SurfaceTriangle {
    std::array<Geodetic, 3> corners;  // h above the ellipsoid, exaggerated as the surfaces are
    // Of a mesh: its number, from 1. 0: a step, which is made longer by what it may lack beside its grids.
    std::uint32_t mesh{};
    std::uint32_t feature{};  // of that mesh: its number, from 1; 0: none
};

// What there is beside grids.
struct GroundBeside {
    std::vector<SurfaceTriangle> pieces;
    std::vector<TrueMesh> meshes;
};

// The surfaces of grids, the pieces between them, and meshes. Where several have ground for a place, that
// with the smallest rank is the ground. A surface alone is ground too. Cheap to copy; what it is made of
// outlives it.
class TrueGround {
  public:
    TrueGround(const TrueSurface& surface) : grids_{{&surface, 0}}, by_rank_{0} {}  // NOLINT: is ground
    struct Grid {
        const TrueSurface* surface;
        int rank;
        bool is_invented{};  // its posts lie between those of data (--detail)
    };
    // At least one grid, all with the same exaggeration. They are numbered as they are given.
    TrueGround(std::vector<Grid> grids, std::shared_ptr<const GroundBeside> beside);

    [[nodiscard]] std::size_t grids() const { return grids_.size(); }
    [[nodiscard]] const TrueSurface& surface(std::size_t grid) const { return *grids_[grid].surface; }
    [[nodiscard]] double exaggeration() const { return grids_.front().surface->exaggeration(); }
    [[nodiscard]] const std::vector<SurfaceTriangle>& pieces() const;
    [[nodiscard]] std::span<const TrueMesh> meshes() const;

    // Which grid is the ground at a place; nothing where there is none.
    [[nodiscard]] std::optional<std::size_t> grid_at(double lat_deg, double lon_deg) const;
    // That grid, or `otherwise` where there is none. One that is alone is given without a look.
    [[nodiscard]] std::size_t grid_at(double lat_deg, double lon_deg, std::size_t otherwise) const {
        return grids_.size() == 1 ? 0 : grid_at(lat_deg, lon_deg).value_or(otherwise);
    }
    // The same of grids whose posts are data.
    [[nodiscard]] std::optional<std::size_t> data_grid_at(double lat_deg, double lon_deg) const;
    // Whether none of a smaller rank has ground there.
    [[nodiscard]] bool shows(std::size_t grid, double lat_deg, double lon_deg) const;
    // Height above the ellipsoid, as TrueSurface::h_m. On a step that of the smaller rank.
    [[nodiscard]] std::optional<double> h_m(double lat_deg, double lon_deg) const;
    // N at a place: as the grid has it that is the ground there, or else the first.
    [[nodiscard]] double N_m(double lat_deg, double lon_deg) const;
    // Errors: posts, and triangles of meshes, that could not be read, and so counted as void.
    [[nodiscard]] Result<void> health() const;

  private:
    std::vector<Grid> grids_;
    std::vector<std::size_t> by_rank_;
    std::shared_ptr<const GroundBeside> beside_;
};

}  // namespace oro
