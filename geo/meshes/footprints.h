// Buildings out of the polygons that they stand on.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/terrain/post_grid.h"
#include "geo/meshes/source_mesh.h"
#include "geo/sources/region_request.h"
#include "geo/vectors/vector_crs.h"
#include "geo/vectors/vector_file.h"

namespace oro {

// How far walls reach below the lowest ground under a footprint.
inline constexpr double wall_below_ground_m = 0.5;
// A height field of so much and more stands for none, in metres or feet: 9999 and the like.
inline constexpr double least_height_of_none = 9999.0;

// Fields of a vector file that say how high its buildings are.
struct FootprintFields {
    std::string height;  // over the base: "12.5" in the units below, "12.5 m" in metres
    std::string base;    // height of the base; "": the lowest ground under the footprint
    double height_unit_m{1.0};
    double base_unit_m{1.0};  // negative where it counts downwards
};

// Whether a file of a request is one of footprints: fields of heights are asked, and it is no mesh by itself.
[[nodiscard]] bool is_of_footprints(const MeshRequest& request, const std::string& file);

// Turns the H of bases into those above the region's geoid. `bases`: by footprint, with a place of each.
using BaseLift =
    std::function<Result<void>(std::span<const VectorPlace> places, std::span<double> bases_H_m)>;

// A mesh of the buildings on the polygons of a vector file: x and y are longitude and latitude of WGS84, z is
// H in metres, and each building is a feature with all fields of its polygon. A roof is flat and `height`
// over the base; walls go down to the lowest ground under the footprint, less wall_below_ground_m, or to the
// base where that is lower. asked: the CRS and the unit of coordinates, in the place of the file's. Holes are
// courtyards. Polygons that cross themselves are made valid (GEOS). Left out, and counted in notes: those
// without a height, or one that is 0, below it, or 9,999 and more; those without ground below; those that
// cannot be made valid. Heights above 1,000 m are told. ground: the best first. Errors: a file that
// read_vectors_in() refuses; without polygons; a field that no layer has, or that says nothing of any polygon
// (usage); nothing left.
Result<SourceMesh> buildings_on_footprints(const std::string& path, const FootprintFields& fields,
                                           std::span<const HeightField* const> ground, const BaseLift& lift,
                                           const VectorCrs& asked = {});

}  // namespace oro
