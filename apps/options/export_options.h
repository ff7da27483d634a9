// What the command line says of `orograph export`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/options/options.h"

namespace oro {

struct ExportOptions {
    RegionOptions region;
    std::optional<std::string> to;        // cog, terrain-rgb, 3dtiles, quantized-mesh, gltf
    std::optional<std::string> layer;     // H, slope, canopy: of a GeoTIFF
    std::string out;                      // a file of cog and gltf, a folder of the others
    std::optional<std::string> zoom;      // LOW:HIGH
    std::optional<double> hole_height_m;  // what places without ground hold
    std::optional<double> max_error_m;    // of a model, or of the finest tiles
    bool no_normals{false};               // of 3D Tiles
    std::optional<int> detail;            // halvings of the way between posts
    std::vector<std::string> drape;       // images that colour 3D Tiles or a model
    std::vector<std::string> landcover;   // rasters of classes: colours, as drape, or a canopy's
    std::vector<std::string> canopy;      // rasters of canopy heights, or "class" alone
    std::string shard;                    // "", or "2/4": makes that part of 3D Tiles alone
    bool overwrite{false};
    bool json{false};
    bool quiet{false};
};

}  // namespace oro
