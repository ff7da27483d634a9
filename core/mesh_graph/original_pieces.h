// What of the mesh a group of its graph answers for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/mesh_graph/distance_cover.h"
#include "core/mesh_graph/nearest_triangles.h"

namespace oro {

// Pieces of the mesh: whole triangles, blocks and nodes of its tree, and parts of triangles.
struct OriginalPieces {
    std::vector<std::uint32_t> whole;  // WholePiece numbers
    std::vector<OriginalPart> parts;
};

// A number for what is handed on whole.
class WholePiece {
  public:
    static std::uint32_t triangle(std::uint32_t place) { return place; }
    static std::uint32_t block(std::uint32_t block) { return block | 1U << 30U; }
    static std::uint32_t node(std::uint32_t node) { return node | 2U << 30U; }
    explicit WholePiece(std::uint32_t number) : index(number & ((1U << 30U) - 1)), kind(number >> 30U) {}
    [[nodiscard]] bool is_triangle() const { return kind == 0; }
    [[nodiscard]] bool is_block() const { return kind == 1; }

    std::uint32_t index;
    std::uint32_t kind;
};

// Pieces that went to a user.
struct HandedPieces {
    struct Whole {
        std::uint32_t piece;
        int user;
    };
    std::vector<Whole> whole;
    std::vector<DistanceCover::Taken> parts;
    double bound_m{};  // of the distance of all of them from the set
};

// Takes pieces one by one as they go to users.
class PieceTaker {
  public:
    virtual ~PieceTaker() = default;
    virtual void take_whole(std::uint32_t piece, int user) = 0;
    virtual void take_part(const OriginalPart& part, int user) = 0;
};

// Joins pieces that are all that a block or a node has.
void join_whole_pieces(const NearestTriangles& mesh, std::vector<std::uint32_t>& whole);

// Calls take(place) for each triangle of a piece.
template <class Take>
void each_triangle(const NearestTriangles& mesh, std::uint32_t piece, const Take& take) {
    const WholePiece whole(piece);
    if (whole.is_triangle()) {
        take(whole.index);
    } else if (whole.is_block()) {
        for (std::uint32_t i = 0; i < mesh.blocks()[whole.index].count; ++i) take(4 * whole.index + i);
    } else {
        const NearestTriangles::Node& node = mesh.nodes()[whole.index];
        for (std::size_t i = 0; i < node.count; ++i)
            each_triangle(mesh,
                          node.is_block ? WholePiece::block(node.below[i]) : WholePiece::node(node.below[i]),
                          take);
    }
}

// Covers pieces of the mesh by the triangles of a set, and gives each to the user of its triangle.
// places: of each triangle of the mesh's tree one that is followed (MeshPlaceChains); empty: none is.
HandedPieces hand_on(const NearestTriangles& mesh, const OriginalPieces& pieces, DistanceCover& cover,
                     std::span<const glm::dvec3> places);
// The same of parts that are asked for one by one, part(0) to part(parts - 1), so that neither they nor what
// becomes of them is in memory. Gives the bound.
double hand_on(const NearestTriangles& mesh, std::span<const std::uint32_t> whole, std::size_t parts,
               const std::function<OriginalPart(std::size_t)>& part, DistanceCover& cover,
               std::span<const glm::dvec3> places, PieceTaker& taker);

}  // namespace oro
