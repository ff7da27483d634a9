#include "core/cluster_file/sound_graph.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace oro {
namespace {

// Spreads a number over all 64 bits. Source: G. Steele, D. Lea, C. Flood, Fast splittable pseudorandom number
// generators, OOPSLA 2014 (its mixing function).
std::uint64_t mixed(std::uint64_t number) {
    number += 0x9e3779b97f4a7c15U;
    number = (number ^ (number >> 30U)) * 0xbf58476d1ce4e5b9U;
    number = (number ^ (number >> 27U)) * 0x94d049bb133111ebU;
    return number ^ (number >> 31U);
}

// An end of an edge on the straight line that the edge lies on: +1 where it begins, -1 where it ends. On a
// line edges one after another add up to their first begin and their last end.
struct End {
    std::int64_t down, right;  // the line's direction, without a common divisor, of two opposite ones the one
    std::int64_t across;       // where it lies
    VertexNumber vertex;
    int sign;
    [[nodiscard]] auto place() const { return std::tie(down, right, across, vertex); }
};

void add_ends(const OriginalSurface& surface, std::span<const BorderEdge> edges, int sign,
              std::vector<End>& ends) {
    for (const BorderEdge& edge : edges) {
        const SurfaceVertex from = surface.vertex(edge.from), to = surface.vertex(edge.to);
        std::int64_t down = std::int64_t{to.row} - from.row, right = std::int64_t{to.column} - from.column;
        const std::int64_t common = std::gcd(down, right);
        down /= common;
        right /= common;
        if (down < 0 || (down == 0 && right < 0)) {
            down = -down;
            right = -right;
        }
        const std::int64_t across = down * from.column - right * from.row;
        ends.push_back({down, right, across, edge.from, sign});
        ends.push_back({down, right, across, edge.to, -sign});
    }
}

}  // namespace

std::uint64_t border_sum(std::span<const VertexTriangle> triangles) {
    std::uint64_t sum = 0;
    for (const VertexTriangle& triangle : triangles) {
        for (std::size_t i = 0; i < 3; ++i) {
            const VertexNumber from = triangle[i], to = triangle[(i + 1) % 3];
            const std::uint64_t one = mixed(std::uint64_t{std::min(from, to)} << 32U | std::max(from, to));
            sum += from < to ? one : -one;
        }
    }
    return sum;
}

std::vector<BorderEdge> border_of(std::span<const VertexTriangle> triangles) {
    std::vector<BorderEdge> edges;
    for (const VertexTriangle& triangle : triangles) {
        for (std::size_t i = 0; i < 3; ++i) edges.push_back({triangle[i], triangle[(i + 1) % 3]});
    }
    std::sort(edges.begin(), edges.end());
    std::vector<BorderEdge> border;
    for (const BorderEdge& edge : edges) {
        if (!std::binary_search(edges.begin(), edges.end(), BorderEdge{edge.to, edge.from}))
            border.push_back(edge);
    }
    return border;
}

bool same_but_straight(const OriginalSurface& surface, std::span<const BorderEdge> a,
                       std::span<const BorderEdge> b) {
    std::vector<End> ends;
    add_ends(surface, a, 1, ends);
    add_ends(surface, b, -1, ends);
    std::sort(ends.begin(), ends.end(), [](const End& x, const End& y) { return x.place() < y.place(); });
    for (std::size_t first = 0, last = 0; first < ends.size(); first = last) {
        int sum = 0;
        for (; last < ends.size() && ends[last].place() == ends[first].place(); ++last)
            sum += ends[last].sign;
        if (sum != 0) return false;
    }
    return true;
}

}  // namespace oro
