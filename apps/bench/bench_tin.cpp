#include "apps/bench/bench_tin.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>

namespace oro {
namespace {

// Does d lie inside the circle through a, b, c (clockwise on the map)? Exact: the determinant is below 2^59
// for most_mesh_posts.
bool in_circle(const MeshPost& a, const MeshPost& b, const MeshPost& c, const MeshPost& d) {
    const auto squared = [&](const MeshPost& p) {
        const std::int64_t down = p.row - d.row, right = p.column - d.column;
        return down * down + right * right;
    };
    return squared(a) * twice_area(d, b, c) + squared(b) * twice_area(d, c, a) +
               squared(c) * twice_area(d, a, b) >
           0;
}

}  // namespace

GreedyTin::GreedyTin(const DrawnHeights& heights, bool every_place)
    : heights_(heights), every_place_(every_place) {
    assert(heights.rows >= 2 && heights.rows <= most_mesh_posts);
    assert(heights.columns >= 2 && heights.columns <= most_mesh_posts);
    const int south = heights.rows - 1, east = heights.columns - 1;
    const int first = add_triangle(), second = add_triangle();
    set_triangle(first, {0, 0}, {0, east}, {south, east});
    set_triangle(second, {south, east}, {south, 0}, {0, 0});
    for (int edge = 0; edge < 6; ++edge) link(edge, none);
    link(3 * first + 2, 3 * second + 2);
    look_for_candidates();
}

void GreedyTin::refine(double error_m) {
    while (!candidates_.empty() && candidates_.top().error_m > error_m) {
        const Candidate worst = candidates_.top();
        candidates_.pop();
        if (worst.version != version_[static_cast<std::size_t>(worst.triangle)]) continue;
        insert_worst_of(worst.triangle);
    }
}

std::vector<MeshTriangle> GreedyTin::mesh() const {
    std::vector<MeshTriangle> mesh;
    mesh.reserve(triangles());
    for (int i = 0; i < static_cast<int>(triangles()); ++i) mesh.push_back(corners(i));
    return mesh;
}

MeshTriangle GreedyTin::corners(int triangle) const {
    const auto first = 3 * static_cast<std::size_t>(triangle);
    return {origin_[first], origin_[first + 1], origin_[first + 2]};
}

int GreedyTin::add_triangle() {
    const int triangle = static_cast<int>(triangles());
    worst_.emplace_back();
    version_.push_back(0);
    origin_.resize(origin_.size() + 3);
    twin_.resize(twin_.size() + 3, none);
    return triangle;
}

void GreedyTin::set_triangle(int triangle, const MeshPost& a, const MeshPost& b, const MeshPost& c) {
    assert(twice_area(a, b, c) > 0);
    const auto first = 3 * static_cast<std::size_t>(triangle);
    origin_[first] = a;
    origin_[first + 1] = b;
    origin_[first + 2] = c;
    changed_.push_back(triangle);
}

void GreedyTin::link(int edge, int twin) {
    twin_[static_cast<std::size_t>(edge)] = twin;
    if (twin != none) twin_[static_cast<std::size_t>(twin)] = edge;
}

void GreedyTin::insert_worst_of(int triangle) {
    const WorstPlace worst = worst_[static_cast<std::size_t>(triangle)];
    if (worst.from == worst.to)
        insert(triangle, worst.from);
    else
        mend_worst_of(triangle);
    flip_until_delaunay();
    look_for_candidates();
}

// The worst place is where an edge of the triangle crosses one of the grid.
void GreedyTin::mend_worst_of(int triangle) {
    const WorstPlace worst = worst_[static_cast<std::size_t>(triangle)];
    const int at_from = triangle_at(triangle, worst.from), at_to = triangle_at(triangle, worst.to);
    const auto is_vertex = [&](int at, const MeshPost& post) {
        const MeshTriangle posts = corners(at);
        return std::find(posts.begin(), posts.end(), post) != posts.end();
    };
    const bool has_from = is_vertex(at_from, worst.from), has_to = is_vertex(at_to, worst.to);
    if (has_from && has_to) {
        for (int edge = 3 * triangle; edge < 3 * triangle + 3; ++edge) {
            const MeshPost a = origin_[static_cast<std::size_t>(edge)];
            const MeshPost b = origin_[static_cast<std::size_t>(next(edge))];
            if (a.row + b.row == worst.from.row + worst.to.row &&
                a.column + b.column == worst.from.column + worst.to.column)
                return flip(edge);
        }
        assert(false);
    }
    const bool take_from =
        !has_from && (has_to || distance(at_from, worst.from) >= distance(at_to, worst.to));
    insert(take_from ? at_from : at_to, take_from ? worst.from : worst.to);
    changed_.push_back(triangle);  // its worst place is as it was where the post lies apart from it
}

// A triangle that holds a post, found by going towards it.
int GreedyTin::triangle_at(int start, const MeshPost& post) const {
    for (int triangle = start, edge = 3 * start; edge < 3 * triangle + 3;) {
        const MeshPost a = origin_[static_cast<std::size_t>(edge)];
        const MeshPost b = origin_[static_cast<std::size_t>(next(edge))];
        if (twice_area(a, b, post) < 0) {
            triangle = twin_[static_cast<std::size_t>(edge)] / 3;
            edge = 3 * triangle;
        } else if (++edge == 3 * triangle + 3) {
            return triangle;
        }
    }
    return start;
}

// Of a post that lies in it, times a constant: vertically.
double GreedyTin::distance(int triangle, const MeshPost& post) const {
    const auto [a, b, c] = corners(triangle);
    const double h = heights_.at(post.row, post.column);
    const auto part = [&](const MeshPost& from, const MeshPost& to, const MeshPost& across) {
        return static_cast<double>(twice_area(from, to, post)) * (heights_.at(across.row, across.column) - h);
    };
    return std::abs(part(a, b, c) + part(b, c, a) + part(c, a, b)) / static_cast<double>(twice_area(a, b, c));
}

void GreedyTin::insert(int triangle, const MeshPost& post) {
    const MeshTriangle at = corners(triangle);
    int on_edge = none;
    for (int i = 0; i < 3; ++i) {
        const auto from = static_cast<std::size_t>(i);
        if (twice_area(at[from], at[(from + 1) % 3], post) == 0) on_edge = 3 * triangle + i;
    }
    if (on_edge == none)
        split_triangle(triangle, post);
    else
        split_edge(on_edge, post);
}

// The triangles around a new post have it as their last corner, so that their first edge is opposite to it.
void GreedyTin::split_triangle(int triangle, const MeshPost& post) {
    const auto [a, b, c] = corners(triangle);
    const auto first = 3 * static_cast<std::size_t>(triangle);
    const int beyond_ab = twin_[first], beyond_bc = twin_[first + 1], beyond_ca = twin_[first + 2];
    const int ab = triangle, bc = add_triangle(), ca = add_triangle();
    set_triangle(ab, a, b, post);
    set_triangle(bc, b, c, post);
    set_triangle(ca, c, a, post);
    link(3 * ab, beyond_ab);
    link(3 * bc, beyond_bc);
    link(3 * ca, beyond_ca);
    link(3 * ab + 1, 3 * bc + 2);
    link(3 * bc + 1, 3 * ca + 2);
    link(3 * ca + 1, 3 * ab + 2);
    to_test_ = {3 * ab, 3 * bc, 3 * ca};
}

void GreedyTin::split_edge(int edge, const MeshPost& post) {
    const auto half = [&](int whole, int keep) {
        const MeshPost a = origin_[static_cast<std::size_t>(whole)];
        const MeshPost b = origin_[static_cast<std::size_t>(next(whole))];
        const MeshPost c = origin_[static_cast<std::size_t>(apex(whole))];
        const int beyond_bc = twin_[static_cast<std::size_t>(next(whole))];
        const int beyond_ca = twin_[static_cast<std::size_t>(apex(whole))];
        const int added = add_triangle();
        set_triangle(keep, b, c, post);
        set_triangle(added, c, a, post);
        link(3 * keep, beyond_bc);
        link(3 * added, beyond_ca);
        link(3 * keep + 1, 3 * added + 2);
        link(3 * keep + 2, none);
        link(3 * added + 1, none);
        to_test_.push_back(3 * keep);
        to_test_.push_back(3 * added);
        return added;
    };
    const int other_edge = twin_[static_cast<std::size_t>(edge)];
    const int near_b = edge / 3;
    const int near_a = half(edge, near_b);
    if (other_edge == none) return;
    const int other_near_a = other_edge / 3;  // the edge runs from b to a there
    const int other_near_b = half(other_edge, other_near_a);
    link(3 * near_b + 2, 3 * other_near_b + 1);
    link(3 * near_a + 1, 3 * other_near_a + 2);
}

void GreedyTin::flip_until_delaunay() {
    while (!to_test_.empty()) {
        const int edge = to_test_.back();
        to_test_.pop_back();
        const int other_edge = twin_[static_cast<std::size_t>(edge)];
        if (other_edge == none) continue;
        const auto [a, b, post] = corners(edge / 3);
        const MeshPost d = origin_[static_cast<std::size_t>(apex(other_edge))];
        if (!in_circle(a, b, post, d)) continue;
        const int ours = edge / 3, theirs = other_edge / 3;
        flip(edge);
        to_test_.push_back(3 * ours);
        to_test_.push_back(3 * theirs);
    }
}

// Afterwards the apex is the last corner of both triangles.
void GreedyTin::flip(int edge) {
    const int other_edge = twin_[static_cast<std::size_t>(edge)];
    const int ours = edge / 3, theirs = other_edge / 3;
    const MeshPost a = origin_[static_cast<std::size_t>(edge)];
    const MeshPost b = origin_[static_cast<std::size_t>(next(edge))];
    const MeshPost post = origin_[static_cast<std::size_t>(apex(edge))];
    const MeshPost d = origin_[static_cast<std::size_t>(apex(other_edge))];
    const int beyond_ad = twin_[static_cast<std::size_t>(next(other_edge))];
    const int beyond_db = twin_[static_cast<std::size_t>(apex(other_edge))];
    const int beyond_bp = twin_[static_cast<std::size_t>(next(edge))];
    const int beyond_pa = twin_[static_cast<std::size_t>(apex(edge))];
    set_triangle(ours, a, d, post);
    set_triangle(theirs, d, b, post);
    link(3 * ours, beyond_ad);
    link(3 * ours + 2, beyond_pa);
    link(3 * theirs, beyond_db);
    link(3 * theirs + 1, beyond_bp);
    link(3 * ours + 1, 3 * theirs + 2);
}

void GreedyTin::look_for_candidates() {
    std::sort(changed_.begin(), changed_.end());
    changed_.erase(std::unique(changed_.begin(), changed_.end()), changed_.end());
    for (const int triangle : changed_) {
        const auto i = static_cast<std::size_t>(triangle);
        if (every_place_) {
            worst_[i] = worst_place(heights_, corners(triangle));
        } else {
            const WorstPost worst = worst_post(heights_, corners(triangle));
            worst_[i] = {worst.error_m, worst.post, worst.post};
        }
        ++version_[i];
        if (worst_[i].error_m > 0.0) candidates_.push({worst_[i].error_m, triangle, version_[i]});
    }
    changed_.clear();
}

}  // namespace oro
