#include "core/clusters/group_mesh.h"

#include <algorithm>
#include <bit>
#include <cassert>

namespace oro {

void GroupMesh::clear(std::span<const VertexTriangle> triangles) {
    numbers_.clear();
    places_.clear();
    locked_.clear();
    first_edge_.clear();
    origin_.clear();
    slots_.assign(std::bit_ceil(std::max<std::size_t>(16, 3 * triangles.size())), {0, none});
    triangles_ = static_cast<int>(triangles.size());
}

// vertices() for a number that has none yet: its slot is then taken for it.
int GroupMesh::local_vertex(VertexNumber number) {
    const std::size_t mask = slots_.size() - 1;
    std::size_t i = (number * 2654435761U) & mask;
    while (slots_[i].vertex != none && slots_[i].number != number) i = (i + 1) & mask;
    if (slots_[i].vertex == none) slots_[i] = {number, vertices()};
    return slots_[i].vertex;
}

void GroupMesh::add_vertex(VertexNumber number, const SurfaceVertex& place, bool locked) {
    numbers_.push_back(number);
    places_.push_back(place);
    locked_.push_back(locked ? 1 : 0);
    first_edge_.push_back(none);
}

void GroupMesh::link(int edge, int twin) {
    twin_[at(edge)] = twin;
    if (twin != none) twin_[at(twin)] = edge;
}

void GroupMesh::join_twins() {
    const int edges = static_cast<int>(origin_.size());
    twin_.assign(origin_.size(), none);
    next_of_origin_.resize(origin_.size());
    for (int edge = 0; edge < edges; ++edge) {
        int& first = first_edge_[at(origin_[at(edge)])];
        next_of_origin_[at(edge)] = first;
        first = edge;
    }
    for (int edge = 0; edge < edges; ++edge) {
        if (twin_[at(edge)] != none) continue;
        const int from = origin_[at(edge)];
        int back = first_edge_[at(end(edge))];
        while (back != none && end(back) != from) back = next_of_origin_[at(back)];
        link(edge, back);
    }
    // The rim leaves a vertex once; where it does so twice, two parts meet at that point alone.
    std::vector<char> on_rim(places_.size(), 0);
    for (int edge = 0; edge < edges; ++edge) {
        if (twin_[at(edge)] != none) continue;
        const int from = origin_[at(edge)];
        if (on_rim[at(from)] != 0) locked_[at(from)] = 1;
        on_rim[at(from)] = 1;
        first_edge_[at(from)] = edge;
    }
}

int GroupMesh::locked_vertices() const {
    return static_cast<int>(std::count(locked_.begin(), locked_.end(), 1));
}

void GroupMesh::copy_to(std::vector<VertexTriangle>& triangles) const {
    for (std::size_t edge = 0; edge < origin_.size(); edge += 3) {
        if (origin_[edge] == none) continue;
        triangles.push_back(
            {numbers_[at(origin_[edge])], numbers_[at(origin_[edge + 1])], numbers_[at(origin_[edge + 2])]});
    }
}

double GroupMesh::difference(const OriginalSurface& surface) const {
    double largest = 0.0;
    for (int edge = 0; edge < static_cast<int>(origin_.size()); ++edge) {
        if (origin_[at(edge)] == none) continue;
        const SurfaceVertex &a = place(origin_[at(edge)]), &b = place(end(edge));
        if (twin_[at(edge)] < edge)
            largest = std::max(largest, surface.edge_difference(a, b, OriginalSurface::no_limit));
        if (edge % 3 == 0)
            largest = std::max(largest, surface.inner_difference(a, b, place(origin_[at(edge + 2)]),
                                                                 OriginalSurface::no_limit));
    }
    return largest;
}

void GroupMesh::ring_of(int vertex, Ring& ring) const {
    ring.vertices.clear();
    ring.edges.clear();
    const int first = first_edge_[at(vertex)];
    int edge = first;
    do {
        ring.vertices.push_back(end(edge));
        ring.edges.push_back(edge);
        const int back = before(edge);
        edge = twin_[at(back)];
        if (edge == none) ring.vertices.push_back(origin_[at(back)]);
    } while (edge != none && edge != first);
    ring.on_rim = edge == none;
}

void GroupMesh::remove_triangle(int edge) {
    const int first = edge - edge % 3;
    for (int i = 0; i < 3; ++i) origin_[at(first + i)] = none;
    --triangles_;
}

// The triangles on both sides of the edge from the vertex to its target go. What was beyond them meets the
// triangles that stay.
void GroupMesh::collapse(int vertex, const Ring& ring, int target) {
    assert(!is_locked(vertex));
    const int count = ring.triangles();
    const int to = ring.vertices[at(target)];
    const int after =
        target < count ? target : none;  // the triangle from the target on, by its edge's number
    const int ahead = target > 0 ? target - 1 : ring.on_rim ? none : count - 1;
    for (const int edge : ring.edges) origin_[at(edge)] = to;
    if (after != none) {
        const int gone = ring.edges[at(after)];
        const int neighbour = ring.vertices[at((target + 1) % ring.count())];
        const int kept = ring.edges[at((after + 1) % count)];  // from the vertex to `neighbour`
        if (first_edge_[at(to)] == next(gone)) first_edge_[at(to)] = kept;
        if (first_edge_[at(neighbour)] == before(gone)) first_edge_[at(neighbour)] = next(kept);
        link(kept, twin_[at(next(gone))]);
        remove_triangle(gone);
    }
    if (ahead != none) {
        const int gone = ring.edges[at(ahead)];
        const int neighbour = ring.vertices[at(ahead)];
        const int kept =
            before(ring.edges[at((ahead + count - 1) % count)]);  // from `neighbour` to the vertex
        if (first_edge_[at(to)] == before(gone))
            first_edge_[at(to)] = ring.on_rim ? ring.edges[0] : ring.edges[at((target + 1) % count)];
        if (first_edge_[at(neighbour)] == next(gone)) first_edge_[at(neighbour)] = kept;
        link(kept, twin_[at(next(gone))]);
        remove_triangle(gone);
    }
    locked_[at(vertex)] = 1;
}

}  // namespace oro
