// The triangles of one group while they are made fewer: half-edges, so that a vertex knows what is around it.
#pragma once

#include <span>
#include <vector>

#include "core/surface/original_surface.h"

namespace oro {

// Vertices are numbered anew, 0 .. vertices() - 1. Half-edge 3 t + i of triangle t runs from its corner i to
// the next. Kept for many groups one after another, so that nothing is allocated in between.
class GroupMesh {
  public:
    static constexpr int none = -1;

    // The triangles cover each place at most once. is_locked(number): whether a vertex must stay. Vertices
    // where triangles meet at a point alone are locked, too.
    template <class IsLocked>
    void start(const OriginalSurface& surface, std::span<const VertexTriangle> triangles,
               const IsLocked& is_locked) {
        clear(triangles);
        for (const VertexTriangle& triangle : triangles) {
            for (const VertexNumber number : triangle) {
                const int vertex = local_vertex(number);
                if (vertex == vertices()) add_vertex(number, surface.vertex(number), is_locked(number));
                origin_.push_back(vertex);
            }
        }
        join_twins();
    }

    [[nodiscard]] int vertices() const { return static_cast<int>(places_.size()); }
    [[nodiscard]] int triangles() const { return triangles_; }
    [[nodiscard]] int locked_vertices() const;
    [[nodiscard]] bool is_locked(int vertex) const { return locked_[at(vertex)]; }
    [[nodiscard]] const SurfaceVertex& place(int vertex) const { return places_[at(vertex)]; }
    // What is left, in the order of the triangles that it was made of.
    void copy_to(std::vector<VertexTriangle>& triangles) const;
    // Largest difference from the original over all that is left.
    [[nodiscard]] double difference(const OriginalSurface& surface) const;

    // The vertices around one that is not locked, clockwise. A vertex on the rim has no triangle between the
    // last of them and the first.
    struct Ring {
        std::vector<int> vertices;
        std::vector<int> edges;  // half-edges from the middle to them; of the rim's last one none
        bool on_rim{};

        [[nodiscard]] int count() const { return static_cast<int>(vertices.size()); }
        [[nodiscard]] int triangles() const { return static_cast<int>(edges.size()); }
    };
    void ring_of(int vertex, Ring& ring) const;
    // Moves a vertex onto the one with number `target` of its ring. On the rim the first and the last are
    // possible, if they are on a straight line with it. The triangles left in the ring must have an area.
    void collapse(int vertex, const Ring& ring, int target);

  private:
    static std::size_t at(int number) { return static_cast<std::size_t>(number); }
    static int next(int edge) { return edge % 3 == 2 ? edge - 2 : edge + 1; }
    static int before(int edge) { return edge % 3 == 0 ? edge + 2 : edge - 1; }
    [[nodiscard]] int end(int edge) const { return origin_[at(next(edge))]; }
    void clear(std::span<const VertexTriangle> triangles);
    [[nodiscard]] int local_vertex(VertexNumber number);
    void add_vertex(VertexNumber number, const SurfaceVertex& place, bool locked);
    void join_twins();
    void link(int edge, int twin);
    void remove_triangle(int edge);

    struct Slot {
        VertexNumber number;
        int vertex;  // none: free
    };
    std::vector<Slot> slots_;  // from numbers to vertices: a power of two, at most half full
    std::vector<VertexNumber> numbers_;
    std::vector<SurfaceVertex> places_;
    std::vector<char> locked_;
    std::vector<int> first_edge_;  // one from each vertex; of one on the rim the one that is on the rim
    std::vector<int> origin_;      // none: the triangle is gone
    std::vector<int> twin_;        // none: on the rim of the group
    std::vector<int> next_of_origin_;
    int triangles_{};
};

}  // namespace oro
