// A mesh of right triangles that are cut in half again and again, with exact errors: what a finer choice than
// that of square blocks would take.
#pragma once

#include <vector>

#include "apps/bench/bench_mesh.h"

namespace oro {

// A square of 2^k + 1 posts; a triangle is cut at the middle of its longest edge, together with the one
// beyond that edge. Each such middle has the largest vertical error, at posts, of its two triangles and of
// all that they are cut into, so that no crack can open and no post is farther than it was told.
// Source: W. Evans, D. Kirkpatrick, G. Townsend, Right-Triangulated Irregular Networks, Algorithmica 30,
// 2001.
class BisectionMesh {
  public:
    // 2^k + 1 posts along both axes, k >= 1, none void. Reads heights where it is, only here.
    explicit BisectionMesh(const DrawnHeights& heights);

    // The fewest of these triangles with no post farther than error_m (metres) from them.
    [[nodiscard]] std::vector<MeshTriangle> mesh(double error_m) const;

  private:
    // Corners: two ends of the longest edge, then the right angle.
    template <class Visit>
    static void visit_at(const MeshTriangle& triangle, int depth, const Visit& visit);
    [[nodiscard]] std::array<MeshTriangle, 2> roots() const;
    [[nodiscard]] std::size_t middle(const MeshTriangle& triangle) const;
    void collect(const MeshTriangle& triangle, double error_m, std::vector<MeshTriangle>& mesh) const;

    int quads_;
    std::vector<double> error_m_;  // by middle, as posts are numbered
};

}  // namespace oro
