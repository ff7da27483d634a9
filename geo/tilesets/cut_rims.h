// Where the ground of a level ends beside what another grid has.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <unordered_map>
#include <unordered_set>

#include "geo/tilesets/clustered_ground.h"
#include "geo/tilesets/level_cut.h"

namespace oro {

// The sides of a cut's triangles that no other triangle shares, and that lie on the rim of what another grid
// goes on from. Voids of the data and the data's own end are not among them.
class CutRims {
  public:
    CutRims() = default;
    // beside: by post, 1 where what is between grids touches this one; empty: nowhere. A side is taken where
    // two posts after each other on it are such ones.
    static CutRims of(const ClusteredGround& ground, const LevelCut& cut, std::span<const char> beside);

    // Whether the side of a triangle from a corner to the next, as the triangle runs, is one of them.
    [[nodiscard]] bool has(VertexNumber from, VertexNumber to) const {
        return sides_.contains(key(from, to));
    }
    // Level, away from the ground, ECEF: so long that a wall which leans that way at both ends of a side
    // leans by 1 across it (more in sharp corners, at most 3). 0 where rims touch in a point.
    [[nodiscard]] glm::dvec3 outwards(VertexNumber corner) const {
        const auto found = outwards_.find(corner);
        return found == outwards_.end() ? glm::dvec3(0.0) : found->second;
    }
    static constexpr double longest_outwards = 3.0;

  private:
    static std::uint64_t key(VertexNumber from, VertexNumber to) { return std::uint64_t{from} << 32U | to; }
    std::unordered_set<std::uint64_t> sides_;
    std::unordered_map<VertexNumber, glm::dvec3> outwards_;
};

// Level, of length 1, across the way from one place to another and away from a third, ECEF.
glm::dvec3 level_away(const glm::dvec3& from_m, const glm::dvec3& to_m, const glm::dvec3& third_m);
// From the two sides at a corner the way that is 1 across each of them, at most `longest` long; 0 where they
// face each other.
glm::dvec3 across_both(const glm::dvec3& one, const glm::dvec3& other, double longest);

}  // namespace oro
