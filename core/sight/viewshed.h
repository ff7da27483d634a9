// What an eye sees of all the posts around it.
#pragma once

#include <functional>
#include <optional>
#include <stop_token>
#include <vector>

#include "core/sight/observer.h"
#include "core/terrain/grid_part.h"

namespace oro {

// The posts within a radius around a place, and a few beyond; empty where there are none.
GridPart window_around(const PostGrid& grid, const Geodetic& place, double radius_m);

// What is looked at over a post of a window: target_m over its ground, least_above_m at least.
Geodetic target_over_post(const TrueSurface& surface, int row, int column, double target_m);

struct Viewshed {
    // The value of a post that is void, or farther than the radius.
    static constexpr float unknown = -9999.0F;

    GridPart window;
    // For each post of the window: 0 where a target over it is seen, else how much higher (metres) it would
    // have to be, infinite where no height would do; or unknown.
    std::vector<float> clearance_deficit_m;
    std::size_t asked{};  // targets that were so close to the edge of sight that the oracle was asked
};

struct ViewshedRequest {
    Geodetic eye;
    Air air;
    double target_m{};  // height of targets over the ground of each post, at least least_above_m
    double radius_m{};  // over the ground, 1,000 km at most; of a post that is seen at its edge to 1e-5 of it
    int threads{1};
    std::stop_token stop{};  // asked to stop, what comes back is not whole, and comes soon
    // What targets stand on, where that is not what hides them: the ground under a canopy. Its grids have the
    // posts of those that hide, which are as high or higher; it outlives the request. null: on what hides.
    const TrueGround* footing{nullptr};
    // Where something stands over the ground that targets are to stand on, a roof say: its height above the
    // ellipsoid there; nothing elsewhere. Asked from several threads. None: targets stand on the ground.
    std::function<std::optional<double>(double lat_deg, double lon_deg)> top_h_m{};
};

// Told how far it is, 0..1; from any thread, one at a time.
using ViewshedProgress = std::function<void(double share)>;

// What is seen at the posts of one of the ground's grids: a target stands on what is the ground at the post's
// place, whichever grid that is. Whether it is seen is what Observer::sees() says of it, for all posts. The
// answer does not depend on `threads`.
//
// Where no other grid comes within the radius, posts are swept; where one does, each post takes a line of
// sight, and a hidden one some thirty, and clearance_deficit_m is as exact as Observer. Of a sweep it is that
// of edges that are straight but for the ellipsoid's curvature: off by less than a millimetre, on posts of 3
// seconds, times how much farther away the target is than what hides it. (Measured: 0.12 m 2 m over hills,
// out to 12 km; 0.305 m over real mountains. There is no bound.) A sweep takes 70 bytes for each post of the
// window.
//
// Meshes on the ground hide, too: what is behind one (MeshSilhouette), and targets on a top, are asked of the
// Observer one by one after the sweep, 15 microseconds each, and thirty times that where they are hidden.
//
// The sweep: in the plane that is level at the eye all sight lines are straight, and posts are the corners of
// a net of triangles. Posts are taken by their distance. For narrow ranges of azimuth those edges of the net
// are kept that may be the highest seen so far anywhere in the range; so what hides a target are the few
// edges of its own range that are nearer, and those just before it, found by walking from triangle to
// triangle. What lies within the error of taking edges for straight is asked of the oracle.
Viewshed viewshed(const TrueGround& ground, std::size_t grid, const ViewshedRequest& request,
                  const ViewshedProgress& progress = {});

// The grid whose posts cover most of the circles around the eyes; of several that cover as much, that which
// is the ground in most of it. By 1,536 places a circle. Nothing: none has ground there.
std::optional<std::size_t> grid_of_most(const TrueGround& ground, const std::vector<Geodetic>& eyes,
                                        double radius_m);

}  // namespace oro
