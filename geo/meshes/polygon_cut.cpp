#include "geo/meshes/polygon_cut.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <optional>

namespace oro {
namespace {

// A corner of a ring, and where it lies in the polygon's plane.
struct FlatCorner {
    std::uint32_t vertex;
    glm::dvec2 at;
};
using FlatRing = std::vector<FlatCorner>;

// The normal of a ring's area, twice as long as the area is large.
// Source: I. Sutherland, R. Sproull, R. Schumacker, A characterization of ten hidden-surface algorithms, ACM
// Computing Surveys 6(1), 1974 (M. Newell).
glm::dvec3 area_normal(std::span<const glm::dvec3> vertices, const std::vector<std::uint32_t>& ring) {
    glm::dvec3 sum(0.0);
    const glm::dvec3 first = vertices[ring.front()];
    for (std::size_t i = 2; i < ring.size(); ++i)
        sum += glm::cross(vertices[ring[i - 1]] - first, vertices[ring[i]] - first);
    return sum;
}

// Twice the area of a triangle; positive where it turns anticlockwise.
double turn(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

double area_of(const FlatRing& ring) {
    double sum = 0.0;
    for (std::size_t i = 2; i < ring.size(); ++i) sum += turn(ring[0].at, ring[i - 1].at, ring[i].at);
    return sum;
}

// Whether two sides have a point in common that is not an end of both.
bool sides_cross(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c, const glm::dvec2& d) {
    const auto opposite = [](double one, double other) {
        return (one > 0.0 && other < 0.0) || (one < 0.0 && other > 0.0);
    };
    return opposite(turn(a, b, c), turn(a, b, d)) && opposite(turn(c, d, a), turn(c, d, b));
}

bool side_is_free(const FlatCorner& from, const FlatCorner& to, const FlatRing& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const FlatCorner &a = ring[i], &b = ring[(i + 1) % ring.size()];
        if (a.at == from.at || b.at == from.at || a.at == to.at || b.at == to.at) continue;
        if (sides_cross(from.at, to.at, a.at, b.at)) return false;
    }
    return true;
}

// Whether a side from a corner of an anticlockwise ring begins inside of it.
bool goes_inside(const FlatRing& ring, std::size_t corner, const glm::dvec2& to) {
    const glm::dvec2 &before = ring[(corner + ring.size() - 1) % ring.size()].at, &here = ring[corner].at,
                     &after = ring[(corner + 1) % ring.size()].at;
    const bool left_of_after = turn(here, after, to) > 0.0, left_of_before = turn(before, here, to) > 0.0;
    return turn(before, here, after) >= 0.0 ? left_of_after && left_of_before
                                            : left_of_after || left_of_before;
}

// Joins holes to the outer ring by a side that goes there and back, from each hole's rightmost corner.
bool join_holes(FlatRing& outer, std::vector<FlatRing>& holes) {
    const auto rightmost = [](const FlatRing& ring) {
        return std::max_element(ring.cbegin(), ring.cend(),
                                [](const FlatCorner& a, const FlatCorner& b) { return a.at.x < b.at.x; });
    };
    std::ranges::sort(holes, std::greater<>(), [&](const FlatRing& hole) { return rightmost(hole)->at.x; });
    bool all = true;
    for (std::size_t number = 0; number < holes.size(); ++number) {
        FlatRing& hole = holes[number];
        std::rotate(hole.begin(), hole.begin() + (rightmost(hole) - hole.cbegin()), hole.end());
        std::optional<std::size_t> best;
        double best_length = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < outer.size(); ++i) {
            const double length = glm::distance(outer[i].at, hole.front().at);
            if (!(length < best_length) || !goes_inside(outer, i, hole.front().at)) continue;
            bool is_free = side_is_free(outer[i], hole.front(), outer);
            for (std::size_t other = number; is_free && other < holes.size(); ++other)
                is_free = side_is_free(outer[i], hole.front(), holes[other]);
            if (is_free) best = i, best_length = length;
        }
        if (!best) {
            all = false;
            continue;
        }
        FlatRing joined(hole.begin(), hole.end());
        joined.push_back(hole.front());
        joined.push_back(outer[*best]);
        outer.insert(outer.begin() + static_cast<std::ptrdiff_t>(*best) + 1, joined.begin(), joined.end());
    }
    return all;
}

bool within(const glm::dvec2& at, const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return turn(a, b, at) >= 0.0 && turn(b, c, at) >= 0.0 && turn(c, a, at) >= 0.0;
}

// Cuts ears off an anticlockwise ring until a triangle is left. False: once there was none.
class EarCut {
  public:
    EarCut(FlatRing ring, ScratchVector<SourceTriangle>& triangles)
        : ring_(std::move(ring)), triangles_(triangles), before_(ring_.size()), after_(ring_.size()) {
        for (std::size_t i = 0; i < ring_.size(); ++i) {
            before_[i] = (i + ring_.size() - 1) % ring_.size();
            after_[i] = (i + 1) % ring_.size();
        }
    }

    bool run() {
        bool sound = true;
        std::size_t left = ring_.size(), here = 0, looked = 0;
        while (left > 3) {
            const bool gives_up = looked == left;  // no ear: the ring crosses itself
            if (gives_up) sound = false;
            if (gives_up || is_ear(here)) {
                add(here);
                after_[before_[here]] = after_[here];
                before_[after_[here]] = before_[here];
                here = after_[here];  // not twice at one corner: fans would have slivers
                --left, looked = 0;
            } else {
                ++looked;
            }
            here = after_[here];
        }
        add(here);
        return sound;
    }

  private:
    void add(std::size_t corner) {
        triangles_.push_back(
            {ring_[before_[corner]].vertex, ring_[corner].vertex, ring_[after_[corner]].vertex});
    }
    // Corners at one place with the triangle's own are those of a hole's joint. A corner on a line between
    // its neighbours is an ear where nothing else lies there: a triangle without an area.
    [[nodiscard]] bool is_ear(std::size_t corner) const {
        const glm::dvec2 &a = ring_[before_[corner]].at, &b = ring_[corner].at, &c = ring_[after_[corner]].at;
        if (!(turn(a, b, c) >= 0.0)) return false;
        for (std::size_t i = after_[after_[corner]]; i != before_[corner]; i = after_[i]) {
            const glm::dvec2& at = ring_[i].at;
            if (at == a || at == b || at == c) continue;
            if (within(at, a, b, c)) return false;
        }
        return true;
    }

    FlatRing ring_;
    ScratchVector<SourceTriangle>& triangles_;
    std::vector<std::size_t> before_, after_;
};

}  // namespace

bool cut_polygon(std::span<const glm::dvec3> vertices, const PolygonRings& rings,
                 ScratchVector<SourceTriangle>& triangles) {
    const std::vector<std::uint32_t>& corners = rings.front();
    if (rings.size() == 1 && corners.size() == 3) {
        triangles.push_back({corners[0], corners[1], corners[2]});
        return true;
    }
    const glm::dvec3 normal = area_normal(vertices, corners);
    const double length = glm::length(normal);
    if (!(length > 0.0) || !std::isfinite(length)) {
        for (std::size_t i = 2; i < corners.size(); ++i)
            triangles.push_back({corners[0], corners[i - 1], corners[i]});
        return false;
    }
    const glm::dvec3 up = normal / length;
    const glm::dvec3 other = std::abs(up.z) < 0.9 ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(1.0, 0.0, 0.0);
    const glm::dvec3 along = glm::normalize(glm::cross(other, up)), across = glm::cross(up, along);
    const glm::dvec3 origin = vertices[corners.front()];
    const auto flat = [&](const std::vector<std::uint32_t>& ring) {
        FlatRing made;
        for (const std::uint32_t vertex : ring) {
            const glm::dvec3 at = vertices[vertex] - origin;
            made.push_back({vertex, {glm::dot(at, along), glm::dot(at, across)}});
        }
        return made;
    };
    FlatRing outer = flat(corners);
    std::vector<FlatRing> holes;
    for (std::size_t i = 1; i < rings.size(); ++i) {
        holes.push_back(flat(rings[i]));
        if (area_of(holes.back()) > 0.0) std::ranges::reverse(holes.back());
    }
    const bool joined = join_holes(outer, holes);
    return EarCut(std::move(outer), triangles).run() && joined;
}

}  // namespace oro
