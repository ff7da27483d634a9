// What a group of a mesh's graph made of what it uses, in few bits.
#pragma once

#include <array>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "core/cluster_file/number_code.h"

namespace oro {

// A vertex of a group stays, goes to another one, or goes with all its triangles. Of a triangle whose corners
// are three others then is left what they are; of the rest nothing is. Told is, vertex by vertex, to which
// neighbour's place it goes; ways of several steps end where one stays.
class GroupMaps {
  public:
    using Triangle = std::array<std::uint32_t, 3>;
    static constexpr std::uint32_t gone = ~std::uint32_t{0};
    // A triangle that is left, by its number among those that the group uses.
    struct Left {
        std::uint32_t number;
        Triangle corners;
        std::uint32_t cluster;  // of those that the group made, from 0
    };

    // vertices: of the mesh. memory: for what is of their number.
    explicit GroupMaps(std::size_t vertices,
                       std::pmr::memory_resource* memory = std::pmr::new_delete_resource())
        : local_of_(vertices, gone, memory) {}

    // triangles: what the group uses. is_border: of each vertex of the mesh, whether it stays. made: clusters
    // that come out. left: an encoder's are told, a decoder's are replaced. False where a decoder's bytes
    // tell no such group, or where an encoder's triangles are none that this can tell.
    template <class Coder>
    bool code(Coder& coder, std::span<const Triangle> triangles, std::span<const char> is_border,
              std::uint32_t made, std::vector<Left>& left);

  private:
    void begin(std::span<const Triangle> triangles, std::span<const char> is_border);
    void find_ways(std::span<const Triangle> triangles, std::span<const Left> left);
    template <class Coder>
    void code_ways(Coder& coder);
    bool end_ways();
    void apply(std::span<const Triangle> triangles, std::vector<Left>& left) const;
    template <class Coder>
    void code_clusters(Coder& coder, std::uint32_t made, std::vector<Left>& left,
                       std::span<const Left> source);

    std::pmr::vector<std::uint32_t> local_of_;  // by vertex of the mesh; `gone` between calls
    std::vector<std::uint32_t> vertices_;       // of the group, as its triangles meet them
    std::vector<char> stays_;                   // on the border
    std::vector<std::vector<std::uint32_t>> neighbours_;
    // Of each vertex: itself, the neighbour that it goes to, or gone; then where that way ends.
    std::vector<std::uint32_t> way_;
    std::array<AdaptiveBit, 4> goes_;
    std::array<AdaptiveBit, 2> vanishes_;
    SmallNumber which_;
    AdaptiveBit same_cluster_;
};

}  // namespace oro
