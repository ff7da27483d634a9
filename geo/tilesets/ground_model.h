// The ground of a grid as one mesh that is within some metres of it everywhere.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/frame/region_pages.h"
#include "geo/tilesets/glb.h"
#include "geo/tilesets/model_mesh.h"

namespace oro {

struct GroundModel {
    Geodetic origin;  // on the ellipsoid, in the middle of the grid
    // East, up and south of the origin, metres, rounded to float.
    std::vector<glm::vec3> positions_m;
    std::vector<glm::vec3> normals;
    std::vector<PageIndex> posts;  // of each vertex its post, and the level of a patch that it is a corner of
    std::vector<std::uint32_t> indices;  // three a triangle, anticlockwise, seen from above
    double error_m{};  // no point of the surface is farther from what the model has at its row and column
};

// The patches (core/lod) whose certificates are at most so many metres and whose parents' are not, stitched
// where neighbours are of different levels: without gaps. 0 takes every post. error_m is the largest of the
// certificates, the surface's own sag, and rounding; it may so be somewhat larger. Errors: pages that cannot
// be read; more triangles than most_model_triangles (usage, of --max-error); none (no_data).
inline constexpr std::uint64_t most_model_triangles = 20000000;
Result<GroundModel> ground_model(const RegionPages& pages, double largest_error_m);

// The model as a .glb without extensions, y up, with normals: one node for the ground and one for each mesh
// on it, by its name. asset.extras.origin says where it is. colours: of the vertices of the ground, linear
// light, 0 .. 1; none: it has that of `look`.
std::vector<std::uint8_t> model_glb_bytes(const GroundModel& model,
                                          std::span<const std::array<double, 3>> colours,
                                          std::span<const ModelMesh> meshes, const GlbLook& look);

}  // namespace oro
