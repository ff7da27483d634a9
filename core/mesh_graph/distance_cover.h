// How far polygons may be from a set of triangles: a bound, by a cover.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <span>
#include <vector>

#include "core/mesh_graph/nearest_triangles.h"

namespace oro {

// A convex polygon: a part of a triangle of the original.
struct OriginalPart {
    static constexpr std::size_t most_corners = 12;
    std::array<glm::dvec3, most_corners> corners{};
    std::uint32_t count{};
    std::uint32_t triangle{};  // its place in the original's tree
    bool has_marked{};         // it holds the place that its triangle's chain is told of
};

// Bounds the largest distance of any place of what is added from a set of triangles.
//
// The distance to one triangle is a convex function, and over a convex polygon it is largest at a corner. So
// any cover by convex polygons, each with any triangle of the set, gives a bound: the largest distance of a
// polygon's corners from its own triangle. A polygon whose bound is above what is accepted is cut, along the
// upright plane through the side of its triangle over which it reaches out, or across its longest reach. A
// ball is as far as its middle, and its radius more. Source: docs/MESHES.md, "The bound".
//
// Each triangle of the set has a user, a number of 0 or more. A polygon, or a part of it, goes to the user of
// its triangle.
class DistanceCover {
  public:
    static constexpr int in_parts = -2;  // to several users
    static constexpr int none = -1;
    // accepted_m: what need not be known better; it grows to 2 % or 1 mm above the largest distance found.
    // users: of the set's triangles, by their numbers; empty: 0 for all.
    DistanceCover(const NearestTriangles& set, double accepted_m, std::span<const int> users = {})
        : set_(set), users_(users), found_m_(accepted_m) {}

    // What is near enough to the ground goes to on_ground (core/mesh_graph/mesh_ground.h): whole polygons,
    // and parts that the set is not near enough to. The rest goes to the user of the nearest triangle, not of
    // any that is near enough, so that what belongs together stays together. ground outlives this.
    void put_on_ground_first(const NearestTriangles& ground) { ground_ = &ground; }

    // For who asks only whether a bound is above this: once a place is farther nothing is cut any more, and
    // the bound is as far as that place.
    void end_above(double enough_m) { enough_m_ = enough_m; }

    // Covers a polygon. Gives its user; or in_parts, when take(part, user) was called for each part.
    int cover(const OriginalPart& polygon);
    // The user of a ball with all that is in it, where it is accepted; else none, and nothing is covered.
    int cover_ball(const glm::dvec3& middle, double radius_m);

    // Polygons that went to users in parts, since the last call.
    struct Taken {
        OriginalPart part;
        int user{};
    };
    [[nodiscard]] std::vector<Taken>& taken() { return taken_; }
    // Where the marked place of the polygon being covered is.
    void mark(const glm::dvec3& place) { marked_ = place; }

    [[nodiscard]] double bound_m() const { return bound_m_; }
    // Of all that is added from now on.
    void begin_bound() { bound_m_ = 0.0; }

  private:
    struct Corner {
        glm::dvec3 at{};
        double distance2{};
        std::uint32_t place{};
        bool is_exact{};
        double ground2{std::numeric_limits<double>::infinity()};  // where the set is not near enough
    };
    struct Polygon {
        std::array<Corner, OriginalPart::most_corners> corners;
        std::size_t count{};
        bool has_marked{};
    };
    // The triangle that gives the least bound of some, the bound, and the corner where it is.
    struct Best {
        double distance2{};
        std::uint32_t place{};
        std::size_t worst{};
    };
    struct Plane {
        glm::dvec3 at{}, normal{};
    };
    struct Reach {
        glm::dvec3 middle{};
        double radius_m{};
        std::size_t farthest{};
    };

    [[nodiscard]] double accepted_m() const;
    [[nodiscard]] int user_of(std::uint32_t place) const;
    [[nodiscard]] Corner exact_corner(const glm::dvec3& at, std::uint32_t hint) const;
    [[nodiscard]] Corner corner(const glm::dvec3& at, std::uint32_t hint) const;
    // The least bound by one triangle of the ground; endless where some corner is farther than is accepted.
    [[nodiscard]] Best best_on_ground(const Polygon& polygon) const;
    int accept_on_ground(double bound_m);
    int end(const Best& best, const Corner& middle, double radius_m);
    void note(const Corner& corner);
    void make_exact(Polygon& polygon) const;
    [[nodiscard]] Best by_triangle(const Polygon& polygon, std::uint32_t place, double stop2) const;
    [[nodiscard]] Best best_of_corners(const Polygon& polygon) const;
    [[nodiscard]] static Reach reach_of(const Polygon& polygon);
    [[nodiscard]] int accept(double bound_m, std::uint32_t place);
    [[nodiscard]] static Plane where_to_cut(const Polygon& polygon, const std::array<glm::dvec3, 3>& sides,
                                            std::size_t worst, const Reach& reach, int depth);
    void cut(const Polygon& polygon, const Plane& plane, std::uint32_t hint, Polygon& inside,
             Polygon& outside) const;
    int cover(Polygon& polygon, int depth, std::uint32_t triangle);
    void take(const Polygon& polygon, std::uint32_t triangle, int user);

    const NearestTriangles& set_;
    std::span<const int> users_;
    const NearestTriangles* ground_{};
    double found_m_;
    double enough_m_{std::numeric_limits<double>::infinity()};
    double bound_m_{};
    std::uint32_t hint_{NearestTriangles::nothing};
    glm::dvec3 marked_{};
    std::vector<Taken> taken_;
};

}  // namespace oro
