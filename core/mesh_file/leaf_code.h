// The mesh itself in few bits: its triangles leaf by leaf, and where its vertices are.
#pragma once

#include <array>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "core/cluster_file/number_code.h"
#include "core/mesh_file/open_sides.h"
#include "core/mesh_file/written_mesh.h"

namespace oro {

// A leaf that an encoder is given, by the numbers that the graph had before it was told.
struct LeafSource {
    std::span<const std::array<std::uint32_t, 3>> triangles;
    std::span<const std::uint32_t> labels;  // of these; empty: there are none
};

// A leaf is told from side to side: whether another triangle hangs at the last open side, and which vertex it
// has beyond. That is a new one, one that an open side leads to from there, or any other.
class LeafCode {
  public:
    using Triangle = std::array<std::uint32_t, 3>;

    // least: no place has a smaller coordinate; none is 2^32 steps and more above it. memory: for what is of
    // the mesh's size.
    LeafCode(const LatticeSteps& least, std::uint32_t vertices, std::uint32_t label_count,
             std::pmr::memory_resource* memory = std::pmr::new_delete_resource())
        : least_(least),
          vertex_count_(vertices),
          label_count_(label_count),
          sides_of_all_(memory),
          number_of_(memory),
          source_of_(memory) {}

    // An encoder's are in `source`, with places by its numbers. Appends `count` triangles to those of the
    // mesh, and to its labels and places what they have. False where a decoder's bytes tell none such.
    template <class Coder>
    bool code(Coder& coder, std::uint32_t count, const LeafSource& source,
              std::span<const LatticeSteps> source_places, CodedMesh<Coder>& mesh);
    // There will be no leaves of more triangles: room for the sides of so many.
    void expect(std::size_t triangles) { sides_of_all_.expect(triangles); }
    // There are no more leaves: gives memory back. Of an encoder: the number that each vertex had before.
    std::pmr::vector<std::uint32_t> end() {
        sides_of_all_ = OpenSides(source_of_.get_allocator().resource());
        return std::move(source_of_);
    }
    // Of what an encoder was given: the number in the source of each triangle told of the last leaf.
    [[nodiscard]] std::span<const std::uint32_t> recorded() const { return recorded_; }
    // Of an encoder: by the source's numbers of vertices those of the file.
    [[nodiscard]] std::uint32_t number_of(std::uint32_t source_vertex) const {
        return number_of_[source_vertex];
    }

  private:
    static constexpr std::uint32_t none = ~std::uint32_t{0};
    struct Side {
        std::uint32_t from, to;  // as the triangle goes round
        std::uint32_t third;     // its other vertex
        std::uint32_t label;
    };
    struct Recorded {
        Triangle corners{};  // of the source, in the order in which they are told
        std::uint32_t number{none};
        bool is_turned{};
    };
    void begin(std::uint32_t count, const LeafSource& source);
    [[nodiscard]] Recorded at_side(const LeafSource& source, const Side& side) const;
    [[nodiscard]] Recorded first_left(const LeafSource& source) const;
    template <class Coder>
    std::uint32_t vertex(Coder& coder, std::span<const std::uint32_t> known, std::uint32_t source_vertex,
                         std::span<const LatticeSteps> source_places, const Side* side,
                         CodedMesh<Coder>& mesh);
    template <class Coder>
    void place(Coder& coder, const Side* side, const LatticeSteps* value, CodedMesh<Coder>& mesh);
    void add_sides(const Triangle& corners, std::uint32_t label, bool has_first);

    LatticeSteps least_;
    std::uint32_t vertex_count_, label_count_;
    OpenSides sides_of_all_;
    std::vector<Side> open_;
    std::vector<std::uint32_t> ends_, recorded_;
    std::vector<char> is_recorded_;              // of the source's triangles
    std::pmr::vector<std::uint32_t> number_of_;  // an encoder's
    std::pmr::vector<std::uint32_t> source_of_;  // the inverse
    std::vector<std::uint32_t> local_;           // vertices of the leaf
    AdaptiveBit more_, turned_, same_label_, local_known_;
    std::array<AdaptiveBit, 8> is_new_;
    std::array<AdaptiveBit, 4> is_end_;
    SmallNumber which_end_;
    std::array<std::array<NearZero, 3>, 2> away_;
};

}  // namespace oro
