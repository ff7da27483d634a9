// The ground around many posts as triangles, with bounds that tell how high parts of it can be seen. Within
// core.
#pragma once

#include <array>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <vector>

#include "core/earth/world_model.h"
#include "core/terrain/grid_part.h"
#include "core/truth/true_surface.h"

namespace oro {

// An eye over the ground, and the plane that is level there.
struct PostEye {
    PostEye(const Geodetic& place, const Air& air, double radius_m);

    Ecef ecef;
    glm::dmat3 enu_from_ecef;
    double h_m;
    double bend_per_m;   // light lifts what is seen by this times the square of the distance
    double bulge_per_m;  // as EyePlane::bulge_m
    double radius_m;     // ground farther away, across the plane, does not count
};

// The posts of a window in ECEF, the diagonals of its cells, and a quadtree of blocks of cells: each knows a
// sphere around its posts and the highest of them. Takes 25 bytes for each post of the window, and 4 for the
// blocks. Safe to ask from several threads.
class HorizonGround {
  public:
    static constexpr double none = -std::numeric_limits<double>::infinity();

    // `window`: its columns may run on past a turn (GridPart).
    HorizonGround(const TrueSurface& surface, const GridPart& window, int threads);

    // The largest tangent, of how high over level ground is seen in one azimuth (clockwise from north, by its
    // sine and cosine); `none` where there is no ground. Between its posts ground is taken as EyePlane takes
    // it: edges straight but for the curvature of the ellipsoid. `leaf`: where to look first, below 0 where
    // nothing is known; set to the block that has the largest. It changes how long this takes, not what
    // comes back.
    [[nodiscard]] double most_tangent(const PostEye& eye, double sine, double cosine,
                                      std::int64_t& leaf) const;

  private:
    // A square of cells, block_cells * 2^level along each side.
    static constexpr int block_cells = 4;
    struct Block {
        glm::dvec3 middle{0.0};  // of a sphere around its posts
        double radius_m{-1.0};   // below 0: it has none
        double highest_h_m{};
    };
    struct Level {
        int rows{}, columns{};
        std::vector<Block> blocks;
    };
    // A post as an eye sees it, in the upright plane of an azimuth: to the right of it, along it, and up.
    struct SeenPost {
        double right_m, along_m, up_m;
    };
    struct Search;

    void place_row(const TrueSurface& surface, int row);
    [[nodiscard]] Block block_of_posts(const TrueSurface& surface, int row, int column) const;
    void join_blocks(const Level& below, Level& level) const;
    [[nodiscard]] double bound(const Block& block, const Search& search, double& near_m) const;
    void search_leaf(std::int64_t number, Search& search) const;
    void take_triangle(const std::array<const SeenPost*, 3>& corners, Search& search) const;

    GridPart window_;
    std::vector<glm::dvec3> posts_;  // NaN where void
    std::vector<char> sw_ne_;        // of the cell south-east of each
    std::vector<Level> levels_;      // the first has the smallest blocks, the last one block
    double largest_radius_m_{};      // of curvature, of all the ground
};

}  // namespace oro
