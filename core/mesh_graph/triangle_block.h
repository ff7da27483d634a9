// Four triangles in space, and how far a place is from them: four at a time.
#pragma once

#include <array>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "core/base/wide.h"

namespace oro {

// Vectors of four numbers each, for they are what a processor takes at a time.
struct alignas(32) FourVectors {
    FourDoubles x, y, z;
};

// The distance to a triangle is that to its plane over it, and that to the nearest of its sides elsewhere. A
// triangle that is less than a millionth as high as it is long has sides alone: its plane would be rounding,
// and its sides are nowhere farther apart than that. So the distance is never too small by more than 1e-9 of
// the triangle's length.
struct alignas(32) TriangleBlock {
    FourVectors a, ab, ac;
    FourVectors along_ab, along_ac;   // dot products with these, from a, are a place's shares of ab and ac
    FourVectors normal;               // unit
    FourDoubles by_ab, by_ac, by_bc;  // one over squared lengths
    FourDoubles least_share;          // 0; 2 where the plane is not to be used

    TriangleBlock() = default;
    // triangles: 1 to 4; the last stands in for those that are missing.
    TriangleBlock(const std::array<glm::dvec3, 3>* triangles, int count);

    // The squared distances of a place from all four.
    [[gnu::always_inline]] inline void distances2(const glm::dvec3& place, FourDoubles& squared) const;
    // The same of one, 0 .. 3, to the bit.
    [[nodiscard]] double distance2(int lane, const glm::dvec3& place) const;
    [[nodiscard]] std::array<glm::dvec3, 3> triangle(int lane) const;
};

namespace four {

// By reference, for vectors that are handed over would be in other registers where AVX is.
[[gnu::always_inline]] inline void dot(const FourVectors& a, const FourVectors& b, FourDoubles& product) {
    product = a.x * b.x + a.y * b.y + a.z * b.z;
}
// Lowers squared distances to those from a side, whose start is `from` away.
[[gnu::always_inline]] inline void to_side(const FourVectors& from, const FourVectors& side,
                                           const FourDoubles& by_length2, FourDoubles& squared) {
    const FourDoubles zero{}, one = zero + 1.0;
    FourDoubles t, d2;
    dot(from, side, t);
    t *= by_length2;
    t = t > zero ? t : zero;
    t = t < one ? t : one;
    const FourVectors rest{from.x - t * side.x, from.y - t * side.y, from.z - t * side.z};
    dot(rest, rest, d2);
    squared = d2 < squared ? d2 : squared;
}

}  // namespace four

inline void TriangleBlock::distances2(const glm::dvec3& place, FourDoubles& squared) const {
    const FourVectors from{place.x - a.x, place.y - a.y, place.z - a.z};
    const FourVectors from_b{from.x - ab.x, from.y - ab.y, from.z - ab.z},
        bc{ac.x - ab.x, ac.y - ab.y, ac.z - ab.z};
    four::dot(from, from, squared);
    four::to_side(from, ab, by_ab, squared);
    four::to_side(from, ac, by_ac, squared);
    four::to_side(from_b, bc, by_bc, squared);
    FourDoubles s, t, up;
    four::dot(from, along_ab, s), four::dot(from, along_ac, t), four::dot(from, normal, up);
    const FourDoubles sum = s + t, one = FourDoubles{} + 1.0, plane = up * up;
    const auto over = (s >= least_share) & (t >= least_share) & (sum <= one);
    squared = over ? plane : squared;
}

}  // namespace oro
