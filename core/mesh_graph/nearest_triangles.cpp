#include "core/mesh_graph/nearest_triangles.h"

#include <algorithm>
#include <glm/common.hpp>
#include <limits>
#include <numeric>

namespace oro {
namespace {

constexpr double endless = std::numeric_limits<double>::infinity();
// Whose pages are given back once their boxes are made.
constexpr std::uint32_t many_triangles = 1U << 16U;

struct Corners {
    glm::dvec3 low{endless}, high{-endless};
    void hold(const glm::dvec3& at) { low = glm::min(low, at), high = glm::max(high, at); }
};

bool is_less(const glm::dvec3& one, const glm::dvec3& other) {
    return one.x != other.x ? one.x < other.x : one.y != other.y ? one.y < other.y : one.z < other.z;
}

int longest_axis(const glm::dvec3& size) {
    return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
}

}  // namespace

struct NearestTriangles::Making {
    std::span<const std::array<glm::dvec3, 3>> triangles;  // or, where there are none, these:
    std::span<const glm::dvec3> vertices;
    std::span<const std::array<std::uint32_t, 3>> by_vertices;
    std::pmr::vector<glm::dvec3> middles;
    std::pmr::vector<std::uint32_t> order;
    ScratchMemory* scratch{};

    // Its least corner first.
    [[nodiscard]] std::array<glm::dvec3, 3> triangle(std::uint32_t number) const {
        std::array<glm::dvec3, 3> corners;
        if (by_vertices.empty()) {
            corners = triangles[number];
        } else {
            const auto& [a, b, c] = by_vertices[number];
            corners = {vertices[a], vertices[b], vertices[c]};
        }
        std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end(), is_less),
                    corners.end());
        return corners;
    }

    // By middles, then by corners; by numbers where two triangles lie in one place.
    [[nodiscard]] bool is_before(std::uint32_t a, std::uint32_t b) const {
        if (middles[a] != middles[b]) return is_less(middles[a], middles[b]);
        const std::array<glm::dvec3, 3> one = triangle(a), other = triangle(b);
        for (std::size_t i = 0; i < 3; ++i)
            if (one[i] != other[i]) return is_less(one[i], other[i]);
        return a < b;
    }

    // Halves what lies between two numbers of the order, at a whole block.
    std::uint32_t halve(std::uint32_t first, std::uint32_t last) {
        Corners corners;
        for (std::uint32_t i = first; i < last; ++i) corners.hold(middles[order[i]]);
        const int axis = longest_axis(corners.high - corners.low);
        const std::uint32_t half = first + ((last - first) / 2 + 3) / 4 * 4;
        std::nth_element(order.begin() + first, order.begin() + half, order.begin() + last,
                         [&](std::uint32_t a, std::uint32_t b) {
                             const double one = middles[a][axis], other = middles[b][axis];
                             return one != other ? one < other : is_before(a, b);
                         });
        return half;
    }
    [[nodiscard]] Corners corners_of(std::uint32_t first, std::uint32_t last) const {
        Corners corners;
        for (std::uint32_t i = first; i < last; ++i)
            for (const glm::dvec3& corner : triangle(order[i])) corners.hold(corner);
        return corners;
    }
    [[nodiscard]] double radius_of(std::uint32_t first, std::uint32_t last, const glm::dvec3& middle) const {
        double most2 = 0.0;
        for (std::uint32_t i = first; i < last; ++i)
            for (const glm::dvec3& corner : triangle(order[i]))
                most2 = std::max(most2, glm::dot(corner - middle, corner - middle));
        return std::sqrt(most2) * (1.0 + 1.0e-12);
    }
};

NearestTriangles::NearestTriangles(std::span<const std::array<glm::dvec3, 3>> triangles) {
    Making making{triangles, {}, {}, {}, {}, {}};
    making.order.resize(triangles.size());
    make(making);
}

NearestTriangles::NearestTriangles(std::span<const glm::dvec3> vertices,
                                   std::span<const std::array<std::uint32_t, 3>> triangles,
                                   ScratchMemory* scratch)
    : nodes_(array_memory(scratch)), blocks_(array_memory(scratch)) {
    std::pmr::memory_resource* const memory = array_memory(scratch);
    Making making{{},
                  vertices,
                  triangles,
                  std::pmr::vector<glm::dvec3>(memory),
                  std::pmr::vector<std::uint32_t>(triangles.size(), memory),
                  scratch};
    make(making);
}

void NearestTriangles::make(Making& making) {
    const auto count = static_cast<std::uint32_t>(making.order.size());
    making.middles.reserve(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        const auto [a, b, c] = making.triangle(i);
        making.middles.push_back((a + b + c) / 3.0);
    }
    std::iota(making.order.begin(), making.order.end(), 0U);
    blocks_.reserve((count + 3) / 4);
    make_node(making, 0, count, nothing);
}

std::uint32_t NearestTriangles::make_node(Making& making, std::uint32_t first, std::uint32_t last,
                                          std::uint32_t parent) {
    const auto self = static_cast<std::uint32_t>(nodes_.size());
    nodes_.emplace_back();
    std::array<std::uint32_t, 5> ends{first, last, last, last, last};
    int count = 1;
    const bool is_block = last - first <= 16;
    const auto cut = [&](std::uint32_t from, std::uint32_t to) {
        return to - from > 4 ? making.halve(from, to) : to;
    };
    const std::uint32_t half = cut(first, last);
    for (const auto& [from, to] : {std::pair{first, half}, std::pair{half, last}}) {
        if (from == to) continue;
        const std::uint32_t middle = cut(from, to);
        for (const std::uint32_t end : {middle, to})
            if (end > ends[static_cast<std::size_t>(count) - 1])
                ends[static_cast<std::size_t>(count++)] = end;
    }
    Node node;
    node.count = static_cast<std::uint8_t>(count - 1);
    node.is_block = is_block, node.parent = parent;
    for (int i = 0; i < 4; ++i) {
        const auto k = static_cast<std::size_t>(std::min(i, count - 2));
        const Corners corners = making.corners_of(ends[k], ends[k + 1]);
        node.low.x[i] = corners.low.x, node.low.y[i] = corners.low.y, node.low.z[i] = corners.low.z;
        node.high.x[i] = corners.high.x, node.high.y[i] = corners.high.y, node.high.z[i] = corners.high.z;
        if (i < count - 1)
            node.below[k] = is_block ? make_block(making, ends[k], ends[k + 1], self)
                                     : make_node(making, ends[k], ends[k + 1], self);
    }
    const Corners all = making.corners_of(first, last);
    node.middle = 0.5 * (all.low + all.high);
    node.radius = making.radius_of(first, last, node.middle);
    nodes_[self] = node;
    if (making.scratch != nullptr && last - first >= many_triangles) making.scratch->drop_pages();
    return self;
}

std::uint32_t NearestTriangles::make_block(Making& making, std::uint32_t first, std::uint32_t last,
                                           std::uint32_t parent) {
    std::array<std::uint32_t, 4> numbers{};
    const auto count = static_cast<int>(last - first);
    std::sort(making.order.begin() + first, making.order.begin() + last,
              [&](std::uint32_t a, std::uint32_t b) { return making.is_before(a, b); });
    std::copy(making.order.begin() + first, making.order.begin() + last, numbers.begin());
    std::array<std::array<glm::dvec3, 3>, 4> triangles{};
    for (int i = 0; i < count; ++i)
        triangles[static_cast<std::size_t>(i)] = making.triangle(numbers[static_cast<std::size_t>(i)]);
    Block block{TriangleBlock(triangles.data(), count), numbers, static_cast<std::uint8_t>(count), parent};
    const Corners all = making.corners_of(first, last);
    block.middle = 0.5 * (all.low + all.high);
    block.radius = making.radius_of(first, last, block.middle);
    blocks_.push_back(block);
    return static_cast<std::uint32_t>(blocks_.size() - 1);
}

// The tree is walked near boxes first.
ORO_WIDE NearestTriangles::Near NearestTriangles::within(const glm::dvec3& at, double good2, double reach2,
                                                         std::uint32_t hint) const {
    Near best{reach2, nothing};
    if (hint != nothing) {
        const double d2 = distance2(hint, at);
        if (d2 <= reach2) best = {d2, hint};
        if (d2 <= good2) return best;
    }
    struct Open {
        std::uint32_t number;
        bool is_block;
        double distance2;
    };
    std::array<Open, 128> open;
    int count = 0;
    open[0] = {0, false, 0.0}, count = 1;
    const FourDoubles zero{};
    while (count > 0) {
        const Open next = open[static_cast<std::size_t>(--count)];
        if (next.distance2 > best.distance2) continue;
        if (next.is_block) {
            const Block& block = blocks_[next.number];
            FourDoubles d2;
            block.triangles.distances2(at, d2);
            for (int i = 0; i < block.count; ++i)
                if (d2[i] < best.distance2 || (best.place == nothing && d2[i] <= best.distance2))
                    best = {d2[i], 4 * next.number + static_cast<std::uint32_t>(i)};
            if (best.place != nothing && best.distance2 <= good2) return best;
            continue;
        }
        const Node& node = nodes_[next.number];
        FourDoubles dx = node.low.x - at.x, dy = node.low.y - at.y, dz = node.low.z - at.z;
        const FourDoubles ex = at.x - node.high.x, ey = at.y - node.high.y, ez = at.z - node.high.z;
        dx = dx > ex ? dx : ex, dy = dy > ey ? dy : ey, dz = dz > ez ? dz : ez;
        dx = dx > zero ? dx : zero, dy = dy > zero ? dy : zero, dz = dz > zero ? dz : zero;
        const FourDoubles d2 = dx * dx + dy * dy + dz * dz;
        const int begin = count;
        for (int i = 0; i < node.count; ++i) {
            if (d2[i] > best.distance2) continue;
            int k = count++;
            for (; k > begin && open[static_cast<std::size_t>(k) - 1].distance2 < d2[i]; --k)
                open[static_cast<std::size_t>(k)] = open[static_cast<std::size_t>(k) - 1];
            open[static_cast<std::size_t>(k)] = {node.below[static_cast<std::size_t>(i)], node.is_block,
                                                 d2[i]};
        }
    }
    return best;
}

NearestTriangles::Near NearestTriangles::nearest(const glm::dvec3& at, std::uint32_t hint) const {
    return within(at, 0.0, endless, hint);
}

}  // namespace oro
