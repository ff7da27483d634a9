// A triangulated irregular network by greedy insertion: about the fewest triangles that an error can be had
// with, as a lower reference for meshes that are made for a GPU.
#pragma once

#include <cstddef>
#include <queue>
#include <vector>

#include "apps/bench/bench_mesh.h"

namespace oro {

// Begins with the region's four corners, then takes the post farthest from the mesh again and again, the
// triangulation being Delaunay's in (row, column) all the time. Errors are vertical and at posts: the sag of
// flat triangles below the ellipsoid is not in them, nor are places between posts, so that a mesh with a
// certificate has to do more.
// Source: M. Garland, P. S. Heckbert, Fast Polygonal Approximation of Terrains and Height Fields,
// CMU-CS-95-181, 1995, "greedy insertion" (sequential, with a heap of each triangle's candidate).
class GreedyTin {
  public:
    // 2 to most_mesh_posts posts along each axis, none void. Reads heights where it is.
    explicit GreedyTin(const DrawnHeights& heights);

    // Inserts posts until none is farther than error_m (metres, >= 0) from the mesh. Going on to a smaller
    // error gives what the smaller one alone would.
    void refine(double error_m);

    [[nodiscard]] std::size_t triangles() const { return worst_.size(); }
    [[nodiscard]] std::vector<MeshTriangle> mesh() const;

  private:
    // Half-edge 3 t + i of triangle t runs from origin_[3 t + i] to the next corner; twin_ is the same edge
    // seen from the other side.
    static constexpr int none = -1;
    struct Candidate {
        double error_m;
        int triangle;
        unsigned version;  // of the triangle: it has changed since when this is not its version now
        bool operator<(const Candidate& other) const {
            return error_m != other.error_m ? error_m < other.error_m : triangle > other.triangle;
        }
    };

    static int next(int edge) { return edge % 3 == 2 ? edge - 2 : edge + 1; }
    static int apex(int edge) { return next(next(edge)); }
    [[nodiscard]] MeshTriangle corners(int triangle) const;
    int add_triangle();
    void set_triangle(int triangle, const MeshPost& a, const MeshPost& b, const MeshPost& c);
    void link(int edge, int twin);
    void insert_worst_of(int triangle);
    void split_triangle(int triangle, const MeshPost& post);
    void split_edge(int edge, const MeshPost& post);
    void flip_until_delaunay();
    void look_for_candidates();

    const DrawnHeights& heights_;
    std::vector<MeshPost> origin_;
    std::vector<int> twin_;  // none: the region ends there
    std::vector<WorstPost> worst_;
    std::vector<unsigned> version_;
    std::priority_queue<Candidate> candidates_;
    std::vector<int> to_test_;  // edges opposite the new post
    std::vector<int> changed_;  // triangles since the last look
};

}  // namespace oro
