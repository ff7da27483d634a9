// A vertex as the cluster graph knows it: a place in the plane and a height, whatever source it comes from.
#pragma once

#include <array>
#include <cstdint>

namespace oro {

// A place in the plane, in whole units of the source's own lattice (for a grid: its posts' rows and columns),
// and a height in steps of height_step_m. Rows run south, columns east.
struct SurfaceVertex {
    std::int32_t row{};
    std::int32_t column{};
    std::int32_t steps{};
};

// Number of a vertex in its source.
using VertexNumber = std::uint32_t;
// Corners clockwise on the map: twice_area() is positive.
using VertexTriangle = std::array<VertexNumber, 3>;

// Twice the area of a triangle in the plane; negative when it runs the other way round, 0 for three in a
// line. Exact for places within 2^30 of 0.
[[nodiscard]] constexpr std::int64_t twice_area(const SurfaceVertex& a, const SurfaceVertex& b,
                                                const SurfaceVertex& c) {
    return (static_cast<std::int64_t>(b.column) - a.column) * (static_cast<std::int64_t>(c.row) - a.row) -
           (static_cast<std::int64_t>(b.row) - a.row) * (static_cast<std::int64_t>(c.column) - a.column);
}

}  // namespace oro
