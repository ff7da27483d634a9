#include "geo/tilesets/clipped_triangle.h"

#include <cmath>
#include <cstddef>

namespace oro {
namespace {

// How far a place is inside of a line; lines are those of TilesetLayout::Lines, in their order.
double inside(int line, int at, double row, double column) {
    switch (line) {
        case 0:
            return row - at;
        case 1:
            return at - column;
        case 2:
            return at - row;
        default:
            return column - at;
    }
}

}  // namespace

// Source: I. Sutherland, G. Hodgman, Reentrant polygon clipping, 1974.
void TriangleClip::cut_off(int line, int at, const std::array<SurfaceVertex, 3>& corners,
                           const VertexTriangle& numbers) {
    const bool is_row = line % 2 == 0;
    const auto crossing = [&](const Corner& from, const Corner& to, int edge) {
        ClippedCorner corner;
        if (edge < 0) {
            const double d_from = inside(line, at, from.corner.row, from.corner.column),
                         d_to = inside(line, at, to.corner.row, to.corner.column);
            const double share = d_from / (d_from - d_to);
            corner.row = std::lerp(from.corner.row, to.corner.row, share);
            corner.column = std::lerp(from.corner.column, to.corner.column, share);
            corner.line = ClippedCorner::inner;
        } else {
            int a = edge, b = (edge + 1) % 3;
            if (numbers[static_cast<std::size_t>(a)] > numbers[static_cast<std::size_t>(b)]) std::swap(a, b);
            const SurfaceVertex &first = corners[static_cast<std::size_t>(a)],
                                &last = corners[static_cast<std::size_t>(b)];
            corner.share = is_row ? static_cast<double>(at - first.row) / (last.row - first.row)
                                  : static_cast<double>(at - first.column) / (last.column - first.column);
            corner.row = std::lerp<double>(first.row, last.row, corner.share);
            corner.column = std::lerp<double>(first.column, last.column, corner.share);
            corner.a = static_cast<std::int8_t>(a);
            corner.b = static_cast<std::int8_t>(b);
            corner.line = static_cast<std::int8_t>(line);
        }
        (is_row ? corner.row : corner.column) = at;
        return corner;
    };
    next_.clear();
    for (std::size_t i = 0; i < polygon_.size(); ++i) {
        const Corner &from = polygon_[i], &to = polygon_[(i + 1) % polygon_.size()];
        const double d_from = inside(line, at, from.corner.row, from.corner.column),
                     d_to = inside(line, at, to.corner.row, to.corner.column);
        if (d_from >= 0.0) next_.push_back(from);
        if (d_from >= 0.0 && d_to < 0.0) {
            if (d_from > 0.0)
                next_.push_back({crossing(from, to, from.edge), -1});
            else
                next_.back().edge = -1;
        }
        if (d_from < 0.0 && d_to > 0.0) next_.push_back({crossing(from, to, from.edge), from.edge});
    }
    std::swap(polygon_, next_);
}

const std::vector<ClippedCorner>& TriangleClip::clip(const std::array<SurfaceVertex, 3>& corners,
                                                     const VertexTriangle& numbers,
                                                     const TilesetLayout::Lines& lines) {
    polygon_.clear();
    for (std::int8_t i = 0; i < 3; ++i) {
        const SurfaceVertex& corner = corners[static_cast<std::size_t>(i)];
        polygon_.push_back({{static_cast<double>(corner.row), static_cast<double>(corner.column), i, i,
                             ClippedCorner::post, 0.0},
                            i});
    }
    cut_off(0, lines.north, corners, numbers);
    cut_off(1, lines.east, corners, numbers);
    cut_off(2, lines.south, corners, numbers);
    cut_off(3, lines.west, corners, numbers);
    result_.clear();
    if (polygon_.size() < 3) return result_;
    for (const Corner& corner : polygon_) result_.push_back(corner.corner);
    return result_;
}

}  // namespace oro
