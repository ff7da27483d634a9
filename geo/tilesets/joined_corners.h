// The vertices of a tile of meshes: corners of triangles that are alike are one.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <map>

#include "geo/tilesets/glb.h"
#include "geo/tilesets/ground_mesh.h"

namespace oro {

class JoinedCorners {
  public:
    // Adds to both, which outlive it. mesh: with its axes and steps, and no triangle.
    JoinedCorners(GroundMesh& mesh, VertexFacts& facts, bool has_normals)
        : mesh_(mesh), facts_(facts), has_normals_(has_normals) {}

    // The next corner, three a triangle. at: steps from the mesh's centre. normal: along the mesh's axes,
    // unit or zero. feature: a row of the tile's table. colour: linear light.
    void add(const glm::ivec3& at, const glm::vec3& normal, std::uint16_t feature,
             const std::array<double, 3>& colour);

  private:
    GroundMesh& mesh_;
    VertexFacts& facts_;
    bool has_normals_;
    std::map<std::array<int, 8>, std::uint32_t> known_;
};

}  // namespace oro
