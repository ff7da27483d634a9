// How high the horizon stands around the posts of a grid, and how much of the sky is seen from them.
#pragma once

#include <functional>
#include <optional>
#include <stop_token>
#include <vector>

#include "core/earth/world_model.h"
#include "core/terrain/grid_part.h"
#include "core/truth/true_ground.h"

namespace oro {

struct PostHorizonsRequest {
    GridPart part;  // the posts; none outside the grid, but for columns past a turn (GridPart)
    Air air;
    double above_m{};   // of eyes over the ground; least_above_m at least
    int directions{};   // azimuths, evenly spaced from north clockwise; 1 or more
    double radius_m{};  // ground farther away, across the plane that is level at the eye, does not count;
                        // 500 km at most
    int threads{1};
    std::stop_token stop{};  // asked to stop, what comes back is not whole, and comes soon
};

struct PostHorizons {
    // The value of a void post, and of an azimuth in which there is no ground.
    static constexpr float unknown = -9999.0F;

    GridPart part;
    // By azimuth, and in it by post of the part: the horizon's elevation over the level plane of the eye,
    // degrees, -90 .. 90. Straight below an eye over flat ground it is the dip, below 0.
    std::vector<std::vector<float>> elevation_deg;
    // By post: the sky-view factor, 0 .. 1; unknown where an azimuth is.
    std::vector<float> sky_view;
};

// Told how far it is, 0 .. 1; from any thread, one at a time.
using PostHorizonsProgress = std::function<void(double share)>;

// The horizons around posts of one of the ground's grids. Azimuths are from true north. The answer does not
// depend on `threads`.
//
// Of ground that is one grid, by HorizonGround: as exact as its edges are straight (1.2e-3 degree on posts of
// 3 seconds, against the oracle). Of several, by bisection with sight lines of the oracle, to 1e-5 degree:
// some thousand times as long.
PostHorizons post_horizons(const TrueGround& ground, std::size_t grid, const PostHorizonsRequest& request,
                           const PostHorizonsProgress& progress = {});

// The lowest elevation in degrees from which on a sight line in an azimuth (degrees, clockwise from north)
// meets no ground within the radius, by bisection with the oracle, to 1e-5 degree; nothing where there is no
// ground. Where ground ends on the way a line may pass below it: then this may be lower than post_horizons().
std::optional<double> horizon_by_lines_deg(const TrueGround& ground, const Geodetic& eye, const Air& air,
                                           double azimuth_deg, double radius_m);

// The share of the hemisphere over a level plane that is sky, each direction weighted by the cosine of its
// angle from the zenith: the mean of cos^2 of the horizon's elevation over even azimuths. A horizon below
// level counts as level.
// Source: J. Dozier, J. Frew, Rapid calculation of terrain parameters for radiation modeling from digital
// elevation data, IEEE Trans. Geosci. Remote Sensing 28(5), 1990: the sky view factor of a slope of 0.
double sky_view_factor(const std::vector<double>& elevations_deg);

}  // namespace oro
