#include "apps/bench/bench_rtin.h"

#include <algorithm>
#include <bit>
#include <cassert>

namespace oro {
namespace {

MeshPost between(const MeshPost& a, const MeshPost& b) {
    return {(a.row + b.row) / 2, (a.column + b.column) / 2};
}

// Half a cell: the middle of its longest edge is no post.
bool is_smallest(const MeshTriangle& triangle) {
    return (triangle[0].row + triangle[1].row) % 2 != 0 || (triangle[0].column + triangle[1].column) % 2 != 0;
}

std::array<MeshTriangle, 2> halves(const MeshTriangle& triangle) {
    const auto& [a, b, c] = triangle;
    const MeshPost m = between(a, b);
    return {MeshTriangle{c, a, m}, MeshTriangle{b, c, m}};
}

}  // namespace

template <class Visit>
void BisectionMesh::visit_at(const MeshTriangle& triangle, int depth, const Visit& visit) {
    if (depth == 0) return visit(triangle);
    for (const MeshTriangle& half : halves(triangle)) visit_at(half, depth - 1, visit);
}

BisectionMesh::BisectionMesh(const DrawnHeights& heights)
    : quads_(heights.rows - 1), error_m_(heights.steps.size()) {
    assert(heights.rows == heights.columns && quads_ >= 2 && std::has_single_bit(unsigned(quads_)));
    // From the smallest up, so that an error is complete, from both sides of its edge, when it is asked for.
    for (int depth = 2 * std::countr_zero(unsigned(quads_)) - 1; depth >= 0; --depth) {
        for (const MeshTriangle& root : roots()) {
            visit_at(root, depth, [&](const MeshTriangle& triangle) {
                double& error_m = error_m_[middle(triangle)];
                error_m = std::max(error_m, worst_post(heights, triangle).error_m);
                for (const MeshTriangle& half : halves(triangle)) {
                    if (!is_smallest(half)) error_m = std::max(error_m, error_m_[middle(half)]);
                }
            });
        }
    }
}

std::vector<MeshTriangle> BisectionMesh::mesh(double error_m) const {
    std::vector<MeshTriangle> mesh;
    for (const MeshTriangle& root : roots()) collect(root, error_m, mesh);
    return mesh;
}

std::array<MeshTriangle, 2> BisectionMesh::roots() const {
    const MeshPost nw{0, 0}, ne{0, quads_}, se{quads_, quads_}, sw{quads_, 0};
    return {MeshTriangle{nw, se, sw}, MeshTriangle{se, nw, ne}};
}

std::size_t BisectionMesh::middle(const MeshTriangle& triangle) const {
    const MeshPost m = between(triangle[0], triangle[1]);
    return static_cast<std::size_t>(m.row) * static_cast<std::size_t>(quads_ + 1) +
           static_cast<std::size_t>(m.column);
}

void BisectionMesh::collect(const MeshTriangle& triangle, double error_m,
                            std::vector<MeshTriangle>& mesh) const {
    if (is_smallest(triangle) || error_m_[middle(triangle)] <= error_m) {
        mesh.push_back(triangle);
        return;
    }
    for (const MeshTriangle& half : halves(triangle)) collect(half, error_m, mesh);
}

}  // namespace oro
