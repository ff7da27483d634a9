// Makes a group of triangles in space coarser, its border as it is.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "core/mesh_graph/mesh_ground.h"
#include "core/mesh_graph/nearest_triangles.h"

namespace oro {

// A triangle of a level, while a graph is built.
struct LevelTriangle {
    std::array<std::uint32_t, 3> corners{};  // vertices of the mesh
    std::uint32_t original{};                // the triangle of the mesh that it began as
    std::uint32_t made_by{};                 // group; no_group: it is one of the mesh
    double from_original_m{-1.0};            // bound of its distance from the mesh; negative: not known
    std::vector<glm::dvec3> samples;         // places of the mesh that it stands for, some of them
};

struct SimplifierLimits {
    double free_m{};     // what costs no more is done in any case
    double most_m{};     // what costs more is not done
    double noise_m{};    // smaller distances from the mesh are alike
    double spacing_m{};  // of the mesh's vertices
    // Parts may be dropped onto the ground; null: it is not known.
    const NearestTriangles* ground{};
    double ground_off_m{};  // MeshGround::off_m
};

// Collapses edges onto one of their ends: the next is always the one whose new triangles are least far from
// the mesh, by samples, both ways (largest distance). A collapse must leave the surface a surface: a vertex
// with one fan of triangles, the link condition, no triangle turned over, no new edge between two vertices of
// the border, which a neighbour may have too. Where sheets or fans meet, all that meets in a vertex goes with
// it, and no edge gets more triangles than one of those that it is made of has. Parts that hang together with
// nothing and are small are dropped when that costs less: what they cost is how far they reach from what
// stays, or above or below the ground. A part that lies on the ground costs a quarter of its diagonal at
// least, for a roof is seen from above, however low it is. The last part stays. Nothing here is a bound:
// DistanceCover measures what came out.
class SpaceSimplifier {
  public:
    // mesh: what distances to the mesh are measured against. Both outlive this.
    SpaceSimplifier(std::span<const glm::dvec3> vertices, const NearestTriangles& mesh,
                    const SimplifierLimits& limits)
        : positions_(vertices), mesh_(mesh), limits_(limits) {}

    // Until there are `aim` triangles, or the limits stop it. is_border: whether a vertex of the mesh stays.
    template <class IsBorder>
    void simplify(std::vector<LevelTriangle> triangles, const IsBorder& is_border, std::size_t aim) {
        begin(std::move(triangles));
        for (std::size_t i = 0; i < vertices_.size(); ++i) stays_[i] = is_border(vertices_[i]) ? 1 : 0;
        if (limits_.ground != nullptr) find_drops();
        run(aim);
        drop_parts(aim);
    }
    [[nodiscard]] std::vector<LevelTriangle> take();
    // The largest distance that the order believes in.
    [[nodiscard]] double reached_m() const { return reached_m_; }
    // The least error that what was dropped onto the ground is to have.
    [[nodiscard]] double least_error_m() const { return least_error_m_; }

  private:
    static constexpr std::size_t most_samples = 24;
    // Neighbours of a vertex, and the triangles that it has in common with each.
    struct Ring {
        std::vector<std::uint32_t> neighbours;
        std::vector<int> shared;
        bool is_fan{};  // one fan of triangles
        [[nodiscard]] bool is_rim() const;
    };
    struct Queued {
        double cost_m;
        std::uint32_t vertex;
        bool operator<(const Queued& other) const {
            return cost_m != other.cost_m ? cost_m > other.cost_m : vertex > other.vertex;
        }
    };

    void begin(std::vector<LevelTriangle> triangles);
    void run(std::size_t aim);
    // Triangles that hang together, by a vertex: the least of theirs.
    struct Parts {
        std::vector<std::uint32_t> of_vertex;
        std::vector<std::vector<std::uint32_t>> triangles;
        std::vector<char> is_held;  // it has a vertex on the border
    };
    // A part that may be dropped onto the ground.
    struct GroundDrop {
        double cost_m{};
        std::uint32_t part{};
        double least_m{};  // error that it is to have, for its breadth
    };
    [[nodiscard]] Parts parts();
    void find_drops();
    [[nodiscard]] double height_over_ground(std::span<const std::uint32_t> part) const;
    // Drops what costs no more than the next collapse.
    void drop_onto_ground(double next_m, std::size_t aim);
    void drop_parts(std::size_t aim);
    [[nodiscard]] double cost_of_dropping(std::span<const std::uint32_t> part,
                                          const std::vector<std::uint32_t>& part_of,
                                          std::uint32_t number) const;
    [[nodiscard]] const glm::dvec3& at(std::uint32_t vertex) const { return positions_[vertices_[vertex]]; }
    void ring_of(std::uint32_t vertex, Ring& ring);
    [[nodiscard]] bool is_one_fan(std::uint32_t vertex);
    [[nodiscard]] bool are_adjacent(std::uint32_t a, std::uint32_t b) const;
    [[nodiscard]] bool may_collapse(std::uint32_t vertex, std::uint32_t onto, const Ring& ring) const;
    [[nodiscard]] bool may_collapse_fans(std::uint32_t vertex, std::uint32_t onto, const Ring& ring) const;
    // The triangles that a collapse leaves, into fan_; false where one would turn over, or none is left.
    bool make_fan(std::uint32_t vertex, std::uint32_t onto);
    // The largest distance of samples from the fan; at `stop` and above just something above.
    [[nodiscard]] double cost_to_new(std::uint32_t vertex, double stop_m) const;
    // Likewise of places of the new triangles from the mesh, at least `from`.
    [[nodiscard]] double cost_to_mesh(std::uint32_t vertex, std::uint32_t onto, double from_m, double stop_m);
    void evaluate(std::uint32_t vertex);
    // Measures the vertex's targets both ways; false where the queue has to decide again.
    bool check_both_ways(std::uint32_t vertex, double most_m);
    void collapse(std::uint32_t vertex, std::uint32_t onto);
    void share_samples(std::vector<glm::dvec3>& samples, std::span<const std::uint32_t> among);

    std::span<const glm::dvec3> positions_;
    const NearestTriangles& mesh_;
    SimplifierLimits limits_;
    double reached_m_{};
    std::vector<std::uint32_t> vertices_;  // of the mesh, by the numbers here
    std::vector<char> stays_, gone_, stale_, checked_;
    std::vector<LevelTriangle> triangles_;
    std::vector<char> alive_;
    std::size_t count_{};
    std::vector<std::vector<std::uint32_t>> around_;  // triangles of each vertex
    std::vector<double> cost_m_;
    std::vector<std::uint32_t> target_;
    std::vector<Queued> queue_;
    void push(std::uint32_t vertex);
    Ring ring_;
    std::vector<std::array<glm::dvec3, 3>> fan_;
    std::vector<TriangleBlock> fan_blocks_;
    Parts parts_;                    // where there is ground, as they were at first
    std::vector<GroundDrop> drops_;  // the dearest first
    std::size_t parts_left_{};
    double least_error_m_{};
};

}  // namespace oro
