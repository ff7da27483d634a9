#include "core/mesh_graph/mesh_ground.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace oro {
namespace {

// Marks blocks of the ground that may be within a reach of a box.
class BlocksNear {
  public:
    explicit BlocksNear(const NearestTriangles& ground)
        : ground_(ground), is_near_(ground.blocks().size(), 0) {}

    void add(const PartBox& box, double reach_m) { node(0, box, reach_m); }
    [[nodiscard]] const std::vector<char>& is_near() const { return is_near_; }

  private:
    static bool meet(const PartBox& box, const glm::dvec3& middle, double reach_m) {
        const glm::dvec3 way = middle - glm::clamp(middle, box.low, box.high);
        return glm::dot(way, way) <= reach_m * reach_m;
    }
    void node(std::uint32_t number, const PartBox& box, double reach_m) {
        const NearestTriangles::Node& here = ground_.nodes()[number];
        if (!meet(box, here.middle, reach_m + here.radius)) return;
        for (std::size_t i = 0; i < here.count; ++i) {
            const std::uint32_t below = here.below[i];
            if (!here.is_block) {
                node(below, box, reach_m);
                continue;
            }
            const NearestTriangles::Block& block = ground_.blocks()[below];
            if (meet(box, block.middle, reach_m + block.radius)) is_near_[below] = 1;
        }
    }

    const NearestTriangles& ground_;
    std::vector<char> is_near_;
};

}  // namespace

void PartBox::add(const glm::dvec3& place) {
    low = glm::min(low, place), high = glm::max(high, place);
}

double PartBox::diagonal_m() const {
    return glm::distance(low, high);
}

void add_ground_near(const NearestTriangles& ground, std::span<const PartBox> boxes, double reach_m,
                     std::vector<std::array<glm::dvec3, 3>>& made, std::vector<int>& users) {
    BlocksNear blocks(ground);
    for (const PartBox& box : boxes) blocks.add(box, reach_m);
    for (std::uint32_t block = 0; block < ground.blocks().size(); ++block) {
        if (blocks.is_near()[block] == 0) continue;
        for (std::uint32_t i = 0; i < ground.blocks()[block].count; ++i)
            made.push_back(ground.triangle(4 * block + i)), users.push_back(on_ground);
    }
}

}  // namespace oro
