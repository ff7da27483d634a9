#include "core/truth/true_mesh.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <numeric>
#include <utility>

#include "core/base/parallel.h"
#include "core/truth/box_walk.h"
#include "core/truth/line_in_air.h"
#include "core/truth/line_meets.h"
#include "core/truth/nearest_place.h"
#include "core/truth/true_mesh_parts.h"

namespace oro {
namespace {

constexpr std::uint32_t most_in_leaf = 6;

// Of a tree over so many triangles.
std::uint32_t nodes_over(std::uint32_t triangles) {
    if (triangles <= most_in_leaf) return 1;
    return 1 + nodes_over(triangles / 2) + nodes_over(triangles - triangles / 2);
}

float below(double value) {
    const auto rounded = static_cast<float>(value);
    return rounded <= value ? rounded : std::nextafter(rounded, -std::numeric_limits<float>::infinity());
}
float above(double value) {
    return -below(-value);
}

}  // namespace

TrueMesh::TrueMesh(MeshTriangles mesh, std::uint32_t number, int threads)
    : mesh_(std::move(mesh)), number_(number) {
    if (mesh_.triangles.empty()) return;
    glm::dvec3 low(HUGE_VAL), high(-HUGE_VAL);
    for (const glm::dvec3& vertex : mesh_.vertices_m)
        low = glm::min(low, vertex), high = glm::max(high, vertex);
    origin_m_ = 0.5 * (low + high);
    const Geodetic middle = geodetic_from_ecef({origin_m_});
    frame_from_ecef_ = glm::transpose(ecef_from_enu(middle.lat_deg, middle.lon_deg));
    const auto count = static_cast<std::uint32_t>(mesh_.triangles.size());
    std::vector<glm::vec3> middles(count);
    order_.resize(count);
    std::iota(order_.begin(), order_.end(), 0U);
    for (std::uint32_t i = 0; i < count; ++i) {
        const auto [a, b, c] = corners_m(i);
        middles[i] = glm::vec3(frame_from_ecef_ * ((a + b + c) / 3.0 - origin_m_));
    }
    nodes_.resize(nodes_over(count));
    // The upper part here, and what is below it on all threads.
    constexpr std::uint32_t parts_wanted = 256, worth_a_thread = 4096;
    const std::uint32_t small = std::max(count / parts_wanted, worth_a_thread);
    std::vector<Part> parts{{0, 0, count}};
    std::vector<std::uint32_t> joined;
    for (std::size_t i = 0; i < parts.size();) {
        if (parts[i].last - parts[i].first <= small) {
            ++i;
            continue;
        }
        joined.push_back(parts[i].node);
        Part other;
        parts[i] = halve(parts[i], middles, other);
        parts.push_back(other);
    }
    in_parallel(static_cast<int>(parts.size()), threads,
                [&](int i) { build(parts[static_cast<std::size_t>(i)], middles); });
    std::ranges::sort(joined, std::greater<>());  // those below first
    for (const std::uint32_t node : joined) join(node);
}

// Halves a part along the longest side of the box around its triangles' middles.
TrueMesh::Part TrueMesh::halve(const Part& part, const std::vector<glm::vec3>& middles, Part& other) {
    glm::vec3 least(HUGE_VALF), most(-HUGE_VALF);
    for (std::uint32_t i = part.first; i < part.last; ++i) {
        least = glm::min(least, middles[order_[i]]);
        most = glm::max(most, middles[order_[i]]);
    }
    const glm::vec3 size = most - least;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const std::uint32_t half = part.first + (part.last - part.first) / 2;
    const auto at = [&](std::uint32_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(part.first), at(half), at(part.last), [&](std::uint32_t a, std::uint32_t b) {
        const float one = middles[a][axis], two = middles[b][axis];
        return one != two ? one < two : a < b;
    });
    const std::uint32_t second = part.node + 1 + nodes_over(half - part.first);
    nodes_[part.node].first = second;
    other = {second, half, part.last};
    return {part.node + 1, part.first, half};
}

void TrueMesh::build(const Part& part, const std::vector<glm::vec3>& middles) {
    if (part.last - part.first <= most_in_leaf) {
        bound(part);
        return;
    }
    Part other;
    build(halve(part, middles, other), middles);
    build(other, middles);
    join(part.node);
}

void TrueMesh::bound(const Part& part) {
    glm::dvec3 low(HUGE_VAL), high(-HUGE_VAL);
    for (std::uint32_t i = part.first; i < part.last; ++i)
        for (const glm::dvec3& corner : corners_m(order_[i])) {
            const glm::dvec3 at = frame_from_ecef_ * (corner - origin_m_);
            low = glm::min(low, at), high = glm::max(high, at);
        }
    Node& node = nodes_[part.node];
    node.first = part.first, node.count = part.last - part.first;
    for (int axis = 0; axis < 3; ++axis) {
        node.low[static_cast<std::size_t>(axis)] = below(low[axis] - LineInAir::rounded_m);
        node.high[static_cast<std::size_t>(axis)] = above(high[axis] + LineInAir::rounded_m);
    }
}

void TrueMesh::join(std::uint32_t node) {
    const Node &one = nodes_[node + 1], &other = nodes_[nodes_[node].first];
    for (std::size_t axis = 0; axis < 3; ++axis) {
        nodes_[node].low[axis] = std::min(one.low[axis], other.low[axis]);
        nodes_[node].high[axis] = std::max(one.high[axis], other.high[axis]);
    }
}

TrueMesh::TrueMesh(std::shared_ptr<const TriangleSource> source, std::uint32_t number, int threads,
                   std::uint64_t most_bytes)
    : number_(number),
      parts_(std::make_shared<const TrueMeshParts>(std::move(source), number, threads, most_bytes)) {}

const TrueMesh& TrueMesh::whole() const {
    return parts_ ? parts_->whole() : *this;
}

std::size_t TrueMesh::size() const {
    return parts_ ? parts_->triangles() : mesh_.triangles.size();
}

Result<void> TrueMesh::health() const {
    return parts_ ? parts_->health() : Result<void>();
}

std::optional<TrueMesh::Hit> TrueMesh::first_hit(const Ecef& eye, const Refraction& refraction,
                                                 const glm::dvec3& start_m, const glm::dvec3& direction,
                                                 double reach_m) const {
    if (parts_) return parts_->first_hit(eye, refraction, start_m, direction, reach_m);
    if (nodes_.empty()) return std::nullopt;
    const LineInAir line(frame_from_ecef_, frame_from_ecef_ * (eye.m - origin_m_), refraction, start_m,
                         direction);
    std::optional<Hit> nearest;
    double most_m = reach_m;
    const auto begin_of = [&](std::uint32_t number) {
        const Node& node = nodes_[number];
        return line.box_begin_m({node.low[0], node.low[1], node.low[2]},
                                {node.high[0], node.high[1], node.high[2]}, most_m);
    };
    const auto below_of = below_in_order(
        [&](std::uint32_t number) { return nodes_[number].count == 0 ? nodes_[number].first : 0U; });
    walk_boxes(most_m, begin_of, below_of, [&](std::uint32_t number) {
        const Node& node = nodes_[number];
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
            std::array<glm::dvec3, 3> seen = corners_m(order_[i]);
            for (glm::dvec3& corner : seen) corner = refraction.apparent_m(corner - eye.m);
            const auto at_m = triangle_along_m(seen, start_m, direction);
            if (!at_m || *at_m < 0.0 || *at_m >= most_m) continue;
            most_m = *at_m;
            nearest = Hit{most_m, order_[i], feature(order_[i])};
        }
    });
    return nearest;
}

std::optional<glm::dvec3> TrueMesh::nearest_m(const glm::dvec3& at_m, double reach_m) const {
    if (parts_) return parts_->nearest_m(at_m, reach_m);
    if (nodes_.empty()) return std::nullopt;
    const glm::dvec3 at = frame_from_ecef_ * (at_m - origin_m_);
    std::optional<glm::dvec3> nearest;
    double most_m = reach_m;
    const auto begin_of = [&](std::uint32_t number) {
        const Node& node = nodes_[number];
        return box_away_m({node.low[0], node.low[1], node.low[2]}, {node.high[0], node.high[1], node.high[2]},
                          at);
    };
    const auto below_of = below_in_order(
        [&](std::uint32_t number) { return nodes_[number].count == 0 ? nodes_[number].first : 0U; });
    walk_boxes(most_m, begin_of, below_of, [&](std::uint32_t number) {
        const Node& node = nodes_[number];
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
            const glm::dvec3 place = nearest_place(corners_m(order_[i]), at_m);
            if (const double away_m = glm::distance(place, at_m); away_m < most_m)
                most_m = away_m, nearest = place;
        }
    });
    return nearest;
}

}  // namespace oro
