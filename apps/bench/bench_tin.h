// A triangulated irregular network by greedy insertion: about the fewest triangles that an error can be had
// with, as a lower reference for meshes that are made for a GPU.
#pragma once

#include <cstddef>
#include <queue>
#include <vector>

#include "apps/bench/bench_mesh.h"

namespace oro {

// Begins with the region's four corners, then takes the post farthest from the mesh again and again, the
// triangulation being Delaunay's in (row, column) all the time. Errors are vertical: the sag of flat
// triangles below the ellipsoid is not in them. They are those at posts, so that a mesh with a certificate
// has to do more; or those at every place, as a certificate's are. There the farthest place may be a crossing
// of two edges: then that end of the grid's edge is taken that is farther from the mesh. Where both are
// vertices the edge is the diagonal of a cell, and the mesh takes it (it is as good for Delaunay). Source: M.
// Garland, P. S. Heckbert, Fast Polygonal Approximation of Terrains and Height Fields, CMU-CS-95-181, 1995,
// "greedy insertion" (sequential, with a heap of each triangle's candidate).
class GreedyTin {
  public:
    // 2 to most_mesh_posts posts along each axis, none void. Reads heights where it is.
    explicit GreedyTin(const DrawnHeights& heights, bool every_place = false);

    // Inserts posts until none (or no place) is farther than error_m (metres, >= 0) from the mesh. Going on
    // to a smaller error gives what the smaller one alone would.
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
    void mend_worst_of(int triangle);
    void insert(int triangle, const MeshPost& post);
    [[nodiscard]] int triangle_at(int start, const MeshPost& post) const;
    [[nodiscard]] double distance(int triangle, const MeshPost& post) const;
    void flip(int edge);
    void split_triangle(int triangle, const MeshPost& post);
    void split_edge(int edge, const MeshPost& post);
    void flip_until_delaunay();
    void look_for_candidates();

    const DrawnHeights& heights_;
    std::vector<MeshPost> origin_;
    std::vector<int> twin_;  // none: the region ends there
    bool every_place_;
    std::vector<WorstPlace> worst_;
    std::vector<unsigned> version_;
    std::priority_queue<Candidate> candidates_;
    std::vector<int> to_test_;  // edges opposite the new post
    std::vector<int> changed_;  // triangles since the last look
};

}  // namespace oro
