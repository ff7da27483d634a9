// What a region is asked for: which files, which part of them, and what is told of them.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "geo/places/bounding_box.h"

namespace oro {

// Files of triangle meshes that lie on a region's ground (geo/meshes).
struct MeshRequest {
    std::vector<std::string> files;
    std::string crs;  // where they lie, and with a vertical part what their heights refer to; "": as they say
    std::string unit;  // "", or one that metres_in() knows: overrides what the files say
    std::string lod;   // of CityJSON: the level of detail; "": the highest that an object has
    // Of vector files whose polygons are the footprints of buildings: fields of a building's height over its
    // base, and of the base's own height. No height: files are meshes. No base: it is the lowest ground.
    std::string building_height, building_base;
    std::string look;       // "ground", "built", "plain"; "": by what a file is of
    bool cut_under{false};  // the terrain is cut out under meshes that are ground
    // Where triangles meet at a smaller angle they share their light, 0 to 180; nothing: PlacedMesh's own.
    std::optional<double> crease_deg{};
    // Triangles that a mesh may have once its long sides are cut.
    std::size_t most_triangles{5'000'000};
    bool operator==(const MeshRequest&) const = default;
};

// The files that a region is made of, the part of them that is wanted, and how they become one surface.
struct RegionRequest {
    std::vector<std::string>
        paths;  // files, folders (recursive), .zip, .gz, VRT: what GDAL or the .hgt reader opens; or one .oro
    std::optional<BoundingBox> box;  // nothing: all that the sources cover
    bool strict_datum{false};        // refuse instead of letting another geoid stand in
    bool fill_voids{
        false};            // fill void posts from their neighbours (GDALFillNodata) instead of leaving holes
    bool resample{false};  // bring the posts of files in a CRS of their own onto latitudes and longitudes,
                           // instead of keeping them where they are
    // Where several have ground for a place, the one named first wins (of a folder by the byte order of
    // names), not the finest.
    bool listed_first{false};
    // Of several grids: heights go over to those of the coarser within so many metres of a finer one's rim;
    // 0: they do not.
    double feather_m{0.0};
    std::string height_unit;  // "", or "m", "ft", "us-ft", "cm": overrides what the files say
    // For files that do not say themselves: where they lie ("EPSG:2056", or whatever PROJ knows), and what
    // their heights refer to (a vertical CRS, or one of ellipsoidal heights: "EPSG:5728", "EPSG:4979"). ""
    // for nothing told.
    std::string source_crs, source_vertical;
    // Files that lie far apart (disjoint_sources.h), or whose posts are not each other's, become a grid
    // each. Otherwise one grid holds them all, with what lies between, as views of one grid had it.
    bool allow_multiple_grids{false};
    MeshRequest meshes{};
};

// What becomes of void posts: they are left out of the terrain, or filled from their neighbours.
enum class VoidMethod { holes, filled };

}  // namespace oro
