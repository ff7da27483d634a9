// What each pixel of a picture shows, as numbers: place, heights, distance, slope, source, sunlight.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "apps/view/style.h"
#include "apps/view/view.h"
#include "geo/files/whole_file.h"
#include "geo/together/region_ground.h"
#include "render/frame/picture_renderer.h"

namespace oro {

// Row by row from the top, of the middle of each pixel; NaN where it shows no ground.
struct PictureLayers {
    std::vector<double> longitude_deg;  // WGS84, (-180, 180]
    std::vector<double> latitude_deg;
    std::vector<float> H_m;         // of the ground itself, however much the view exaggerates it
    std::vector<float> h_m;         // the same above the ellipsoid
    std::vector<float> distance_m;  // along the sight line, to where the view has the place
    std::vector<float> slope_deg;   // horn_slope_deg()
    std::vector<float> source;      // number among the sources of all grids, from 0
    std::vector<float>
        shadow;                // share of the sun's light that comes past the terrain: 0 in shadow, 1 without
    std::vector<float> cover;  // code of the land cover, NaN where there is none; of views with some
    // Number of the thing of a mesh, in the order of the meshes' files, from 1; NaN elsewhere. Of views with
    // meshes.
    std::vector<float> feature;
    std::uint64_t ground_px{};
    std::uint64_t missed_px{};  // whose rays pass beside what was drawn there (ShownPlaces)
};

// Errors (usage): a picture of too many pixels for them; to be asked before it is drawn.
Result<void> check_layers(const Camera& camera);

// The layers of a view whose picture is drawn with `path`. A pixel's place is where its own ray meets the
// triangle that the picture shows there, in double (ShownPlaces). ground: of the view's region and
// exaggeration. Errors: those of the device and of pages; posts that cannot be read.
Result<PictureLayers> picture_layers(const Gpu& gpu, Scene& scene, const View& view,
                                     const RegionGround& ground, const Style& style, RasterPath path,
                                     const RenderProgress& progress);

// The files beside a picture: NAME.longitude.tif, and so on. Names differ by more than the case of letters,
// for there are file systems that see none: height is H, ellipsoidal-height is h.
inline constexpr std::array layer_names{"longitude", "latitude", "height", "ellipsoidal-height",
                                        "distance",  "slope",    "source", "shadow"};
// Those of a view, in their order: with land cover, the layer cover is the last of all; with meshes, feature
// comes before it.
std::vector<const char*> layers_of_view(bool covers, bool meshes);
// Whether a view of a region has the layer feature: baked regions have meshes that no view names.
bool has_meshes(const View& view, const Region& region);
std::string layer_path(const std::string& picture, const std::string& layer);

// One file a layer, in the order of the names; whole, without their names yet. Errors: the files'.
Result<std::vector<WholeFile>> layer_files(const std::string& picture, bool overwrite, const View& view,
                                           const Region& region, const PictureLayers& layers);

}  // namespace oro
