// The true ground of a region: all its grids, the steps between them, and its meshes.
#pragma once

#include <deque>
#include <memory>
#include <vector>

#include "core/truth/oracle.h"
#include "core/truth/true_ground.h"
#include "geo/meshes/placed_mesh.h"
#include "geo/region/region.h"
#include "geo/together/cut_regions.h"

namespace oro {

// Above which surface a view has its heights: its own, or WGS84 though it goes without a geoid.
enum class GroundHeights { as_pictured, true_ones };

// The true ground holds the region's meshes, too. Holds on to the region, which outlives it. Its ground
// numbers the grids as the region does.
class RegionGround {
  public:
    // cuts: cut_regions(). Reads every post once where they are in memory; of a baked region with
    // GroundHeights::true_ones into memory. Errors: damage in it.
    static Result<std::unique_ptr<const RegionGround>> of(const Region& region, const RegionCuts& cuts,
                                                          double exaggeration,
                                                          GroundHeights heights = GroundHeights::as_pictured);
    // The same, cutting the grids itself. Errors: those of cut_regions() as well.
    static Result<std::unique_ptr<const RegionGround>> of(const Region& region, double exaggeration,
                                                          GroundHeights heights = GroundHeights::as_pictured);
    RegionGround(const RegionGround&) = delete;
    RegionGround& operator=(const RegionGround&) = delete;

    [[nodiscard]] const TrueGround& ground() const { return *ground_; }
    // A mesh by SightHit::mesh, from 1.
    [[nodiscard]] const PlacedMesh& mesh(std::uint32_t number) const {
        return (*region_->meshes)[number - 1];
    }
    // The thing of a mesh that a hit is on; nothing where the mesh tells none apart.
    [[nodiscard]] const MeshFeature* feature(const SightHit& hit) const {
        return hit.mesh > 0 && hit.feature > 0 ? &mesh(hit.mesh).features[hit.feature - 1] : nullptr;
    }
    [[nodiscard]] const Region& region() const { return *region_; }
    [[nodiscard]] const RegionGrid& grid(std::size_t number) const { return region_->grids[number]; }

  private:
    explicit RegionGround(const Region& region) : region_(&region) {}
    const Region* region_;
    std::deque<HeightField> fields_;        // where they are not the grids' own
    std::deque<std::vector<char>> masked_;  // of grids that are cut
    std::deque<TrueSurface> surfaces_;
    std::optional<TrueGround> ground_;
};

}  // namespace oro
