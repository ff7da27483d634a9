// One group made of fewer triangles, by half-edge collapses whose largest difference is least.
#pragma once

#include <cstdint>
#include <vector>

#include "core/clusters/group_mesh.h"
#include "core/clusters/group_tiling.h"
#include "core/clusters/known_differences.h"

namespace oro {

// Kept for many groups one after another.
class GroupSimplifier {
  public:
    explicit GroupSimplifier(const OriginalSurface& surface) : surface_(surface) {}

    struct Aim {
        int triangles{};  // to go on until so many are left
        double most_share{
            1.0};  // of the vertices that may go: no more of them go for the sake of `triangles`
        double free_difference{};                 // steps: what costs no more goes in any case
        double limit{OriginalSurface::no_limit};  // steps: what costs more stays
        EdgeLimit edges{};                        // no longer ones are made
    };
    // Collapses vertices that are not locked, always the one next whose new triangles have the least largest
    // difference from the original, over every place; in the end also what costs no more than what went
    // before.
    void simplify(GroupMesh& mesh, const Aim& aim);

  private:
    static constexpr int none = -1;
    struct Choice {
        double difference;
        int target;  // in the vertex's ring
    };
    // Where a trial stands before its edges are asked: what it costs at the vertex itself.
    struct Trial {
        double least;
        int target;
        bool operator<(const Trial& other) const {
            return least != other.least ? least < other.least : target < other.target;
        }
    };

    // The best of a vertex's collapses, if it costs less than `below`; leaves its ring in ring_.
    [[nodiscard]] Choice best_choice(const GroupMesh& mesh, int vertex, double below);
    // Takes a vertex's ring, and what all trials at it have in common.
    void look_around(const GroupMesh& mesh, int vertex);
    [[nodiscard]] bool makes_long_edge(const SurfaceVertex& to) const;
    void add_trial(int target, double below);
    [[nodiscard]] double trial_difference(int target, double limit);
    [[nodiscard]] double chord_difference(int from, int to, double limit);

    // The queue: a heap of vertices by difference, then by number.
    [[nodiscard]] bool sooner(int a, int b) const {
        const double of_a = cost_[static_cast<std::size_t>(a)], of_b = cost_[static_cast<std::size_t>(b)];
        return of_a != of_b ? of_a < of_b : a < b;
    }
    void fill_queue(const GroupMesh& mesh);
    void sift_up(int slot);
    void sift_down(int slot);
    void take_first();
    void change_cost(int vertex, double cost);

    const OriginalSurface& surface_;
    EdgeLimit edges_;
    std::vector<double> cost_;    // by vertex
    std::vector<int> target_;     // by vertex, in its ring: of the collapse with that cost, unless outdated
    std::vector<char> outdated_;  // by vertex: it may cost more by now
    std::vector<int> touched_;
    std::vector<int> queue_;
    std::vector<int> slot_;  // of a vertex in the queue; none: it is not there
    GroupMesh::Ring ring_;
    std::vector<SurfaceVertex> around_;   // places of the ring
    std::vector<SurfaceVertex> offsets_;  // of these from the middle, heights too
    // Twice the area of the middle, a vertex of the ring and the next; and the rows and columns that the
    // ring's offsets are within.
    std::vector<std::int64_t> areas_;
    SurfaceVertex least_{}, most_{};
    double middle_steps_{};
    std::vector<Trial> trials_;
    KnownDifferences chords_;  // of this group's rings: half of them are asked for again
};

}  // namespace oro
