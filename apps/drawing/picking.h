// What is seen at a point of a picture: asked by the viewer's right button, and by every picture of its
// middle.
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <string>

#include "apps/view/view.h"
#include "core/base/result.h"
#include "geo/together/region_ground.h"

namespace oro {

// A place of the ground that is seen from an eye.
struct SeenPlace {
    double lat_deg{};
    double lon_deg{};
    // Of the ground itself, however much the view exaggerates it: above the geoid, and above the ellipsoid.
    double H_m{};
    double h_m{};
    double bearing_deg{};      // true, at the eye, [0, 360)
    double distance_m{};       // along the ellipsoid
    double seen_distance_m{};  // along the sight line, to where the view has the place
    int row{};                 // north-west post of its cell in its grid
    int column{};
    struct Cover {
        int code{};
        std::string name;  // of its class: "tree cover"
    };
    // How high the canopy's top is over the ground there, where the view has a canopy: then that is what is
    // seen, and the heights above are the ground's below it.
    std::optional<double> canopy_m;
    bool canopy_invented{};              // by classes of land cover
    std::optional<Cover> cover;          // its land cover, where the view has some and the files know any
    bool on_mesh{};                      // the place is on a mesh, and `source` is its file
    std::optional<MeshFeature> feature;  // of that mesh: the building, say
    std::string source;  // path of the source that it comes from; empty where no source's box holds it
};

// What a view sees at a point of its picture (pixels from the top left corner, (0.5, 0.5) is the centre of
// the first); nothing where the sight line meets no ground. Asked of the full resolution, with the view's
// exaggeration and refraction; views of another Earth than WGS84 are drawn elsewhere than this looks.
// `ground`: of the view's region, with its exaggeration. Exact as Oracle::first_hit is. Errors: a post that
// could not be read, now or earlier; a file of land cover that cannot be read.
Result<std::optional<SeenPlace>> place_seen(const View& view, const RegionGround& ground,
                                            glm::dvec2 point_px);
// The place that is seen at the picture's middle, as place_seen().
Result<std::optional<SeenPlace>> place_in_middle(const View& view, const RegionGround& ground);

// On one line for people: latitude and longitude with 6 decimals, both heights, distance along the sight
// line, bearing, cell, the source's file name, land cover and canopy; or that there is nothing.
std::string line_of(const std::optional<SeenPlace>& place);

}  // namespace oro
