// The part of a triangle between four lines of posts.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/surface/surface_vertex.h"
#include "geo/tilesets/tileset_layout.h"

namespace oro {

// A corner of what is left. Corners of neighbouring triangles with the same `edge` and `line` are the same,
// to the bit.
struct ClippedCorner {
    static constexpr std::int8_t post = 4, inner = 5;  // beside the four lines: north, east, south, west

    double row{}, column{};
    // It is the corner a = b of the triangle (line: post), or divides its edge from a to b, or is some place
    // of the triangle (inner). Numbers of corners, 0 .. 2.
    std::int8_t a{}, b{}, line{post};
    double share{};  // of the way from a to b
};

// What is left of a triangle between the lines of a tile: a convex polygon with the triangle's sense of
// turning, or nothing (fewer than three corners). numbers: of the corners; they decide from which end an edge
// is divided. Kept for many triangles one after another.
class TriangleClip {
  public:
    const std::vector<ClippedCorner>& clip(const std::array<SurfaceVertex, 3>& corners,
                                           const VertexTriangle& numbers, const TilesetLayout::Lines& lines);

  private:
    struct Corner {
        ClippedCorner corner;
        int edge;  // of the triangle, on which what follows the corner lies; -1: along a line
    };
    void cut_off(int line, int at, const std::array<SurfaceVertex, 3>& corners,
                 const VertexTriangle& numbers);

    std::vector<Corner> polygon_, next_;
    std::vector<ClippedCorner> result_;
};

}  // namespace oro
