// The oracle: where a sight line meets the true surface, in double precision and without a GPU. Pictures are
// held against it, and whatever must know what is seen in a direction asks it.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "core/earth/camera.h"
#include "core/earth/ellipsoid.h"
#include "core/earth/world_model.h"
#include "core/truth/true_ground.h"

namespace oro {

class TriangleBvh;

// From where and through what air one looks, and at what Earth: the true one is the ellipsoid; on others the
// oracle sees what a picture of them shows.
struct Sight {
    Ecef eye;               // on that Earth
    Refraction refraction;  // default: straight
    Earth earth{Earth::ellipsoid};
    Geodetic place{};  // of the eye; for other Earths than the ellipsoid
};
Sight sight_from(const Geodetic& eye, const Air& air = {});
Sight sight_of(const WorldModel& model, const Geodetic& eye);

// Where a sight line meets the surface.
struct SightHit {
    Geodetic point;       // h above the ellipsoid
    double distance_m{};  // from the eye to where the point is seen: along the ray
    int row{};            // north-west post of its cell
    int column{};
    bool west{};          // of the cell's two triangles (core/terrain/cell_diagonal.h)
    bool from_below{};    // it is met from beneath: through a hole, or over the data's rim
    double residual_m{};  // of the root: height of the point above its triangle
    std::size_t grid{};   // of the ground's: whose cell it is
    // On a step between two grids, or on a mesh: the cell is the first grid's that the place is on.
    bool between_grids{};
    std::uint32_t mesh{};     // on one of the region's meshes: its number, from 1
    std::uint32_t feature{};  // of that mesh: its number, from 1; 0: none
};

// Sight lines from one eye: tells where each truly meets the ground. Safe to ask from several threads.
//     const TrueSurface surface(region.grids[0].field, 1.0, thread_count());
//     const Oracle oracle(surface, sight_from(camera.eye));
//     const auto hit = oracle.first_hit(camera.ecef_direction_at({160.5, 180.5}), 1.0e6);
//     if (hit) std::printf("%f %f\n", hit->point.lat_deg, hit->point.lon_deg);
class Oracle {
  public:
    // What `ground` is made of outlives the oracle. Costs a sine and a cosine for each fourth row and column
    // of posts, and a tree of the pieces between grids; of meshes, too, on other Earths than the ellipsoid,
    // where their own trees do not hold.
    Oracle(const TrueGround& ground, const Sight& sight);
    ~Oracle();
    Oracle(const Oracle&) = delete;
    Oracle& operator=(const Oracle&) = delete;

    // First crossing of a sight line (unit ECEF direction at the eye) with the surface, from either side;
    // nothing when it meets none within reach_m. Exact: the nearest root over all cells, its residual below
    // 1e-8 m within 1,000 km (1e-4 m at worst, from the Moon's distance and beyond). Touches narrower than
    // 1 cm over cells of kilometres, or 1e-6 m over cells of metres, may be missed. Of several grids that is
    // met which is the ground there. Steps between grids are flat, where cells are as curved as the
    // ellipsoid: they reach out over their rims by as much, 0.2 mm of edges of 100 m, and no line slips
    // through.
    [[nodiscard]] std::optional<SightHit> first_hit(const glm::dvec3& direction, double reach_m) const;

    // The first hit of a straight line that begins elsewhere; for an oracle of straight light over the
    // ellipsoid. So lines from many places, towards the sun say, share what an oracle has to work out.
    [[nodiscard]] std::optional<SightHit> first_hit_from(const Ecef& from, const glm::dvec3& direction,
                                                         double reach_m) const;

    // What each pixel of a picture sees at its centre, row by row; shared between `threads`.
    [[nodiscard]] std::vector<std::optional<SightHit>> cast_picture(const Camera& camera, int threads) const;

  private:
    class Scenery;
    class Search;
    [[nodiscard]] std::optional<SightHit> first_hit_after(const glm::dvec3& start_m,
                                                          const glm::dvec3& direction, double reach_m) const;
    // Of which mesh a hit is, and of which thing in it.
    struct OfMesh {
        std::uint32_t mesh{}, feature{};
    };
    // number: as the tree has it: of the pieces, then of the triangles of the meshes.
    [[nodiscard]] OfMesh of_piece(std::size_t number) const;
    [[nodiscard]] SightHit hit_beside(const glm::dvec3& apparent_m, double t_m, const OfMesh& of) const;

    TrueGround ground_;
    Sight sight_;
    std::vector<std::unique_ptr<const Scenery>> sceneries_;  // of each grid
    std::unique_ptr<const TriangleBvh> pieces_;              // null: there are none
};

// For one sight line.
std::optional<SightHit> first_hit(const TrueGround& ground, const Sight& sight, const glm::dvec3& direction,
                                  double reach_m);

// Farther than any sight line over the Earth from this height.
double sight_reach_m(double eye_h_m);

}  // namespace oro
