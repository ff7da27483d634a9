// How far levels of made terrain can be from its full resolution at most, wherever they are: proven from its
// rule, not measured.
#pragma once

#include <vector>

#include "core/made/made_terrain.h"
#include "core/terrain/post_grid.h"

namespace oro {

// Largest values of the noise of one octave (shaders/made/made_heights.glsl) for any gradients at the corners
// of a cell, a cell being 1 wide: of itself, of its slope along a line, and of its second derivative along a
// line. tests/core/made_pages proves them by interval arithmetic.
inline constexpr double noise_most = 1.06;
inline constexpr double noise_slope_most = 4.3;
inline constexpr double noise_bend_most = 19.0;
// The same of a term of `ridged`, per metre of its octave's amplitude: w (s - 0.66), with the square s of 1
// less the noise, 0 to 1, and w = 0.35 + 0.65 s of the octave before, whose cells are twice as wide. The
// slope is most at a crest below a crest: 2 x 4.3 of s, and 0.65 x 4.3 x 0.34 of w.
inline constexpr double ridged_reach_most = 0.66001;
inline constexpr double ridged_spread_most = 1.00001;
inline constexpr double ridged_slope_most = 9.56;

// Of one level, metres. Each of the two holds where no height is cut off at the terrain's lowest or highest
// one (`free`), and where some may be (`cut`).
struct MadeLevelBound {
    struct Of {
        double free{};
        double cut{};
        [[nodiscard]] double where(bool may_cut) const { return may_cut ? cut : free; }
    };
    Of rule;       // between H by the rule and H of the level's triangles, at any place
    Of triangles;  // in space, between the level's flat triangles and those of level 0
    // ... the same of triangles that are drawn as they are, and of all levels below; grows as the next;
    Of own;
    // ... the same of triangles that are drawn, stitched to a coarser level or not; grows from level to level
    // by more than 1e-4 of itself.
    Of drawn;
    // The first octaves, which are nearer to this level's triangles between posts than the noise of finer
    // ones reaches; and, where no height is cut off, between these octaves over such triangles (by either
    // diagonal of a cell) and the triangles of level 0, all octaves of them.
    std::uint32_t coarse_octaves{};
    double coarse{};
    double flat{};  // what is between flat triangles of this level and those linear in latitude and longitude
};

// Bounds of the levels of an fbm or ridged terrain on a grid of latitudes and longitudes, finest first, for
// ground from each whole degree from the equator on polewards: number 0 holds everywhere, and none is smaller
// than the next. Levels share their coarse octaves. The grid has the terrain's spacing. Source: the error of
// linear interpolation over a triangle is at most a half of the bound of second derivatives times the mean
// square distance to its corners (S. Waldron, SIAM J. Numer. Anal. 35, 1998).
std::vector<std::vector<MadeLevelBound>> made_level_bounds(const MadeTerrain& terrain, const PostGrid& grid,
                                                           const UndulationField& undulation);

}  // namespace oro
