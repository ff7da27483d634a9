#include "core/seam/mesh_casters.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/common.hpp>
#include <limits>

namespace oro {
namespace {

using Corners = std::array<glm::vec3, 3>;

struct CasterBox {
    glm::vec3 low, high;
    [[nodiscard]] glm::vec3 middle() const { return 0.5F * (low + high); }
};

CasterBox box_around(const Corners& at) {
    return {glm::min(at[0], glm::min(at[1], at[2])), glm::max(at[0], glm::max(at[1], at[2]))};
}

class CasterTree {
  public:
    CasterTree(std::vector<Corners> triangles, const std::vector<std::uint8_t>& looks, MeshCasters& casters)
        : triangles_(std::move(triangles)), casters_(casters) {
        for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
            boxes_.push_back(box_around(triangles_[i]));
            order_.push_back(i);
        }
        casters_.nodes.emplace_back();
        split(0, 0, static_cast<std::uint32_t>(order_.size()));
        for (const std::uint32_t i : order_) {
            const Corners& at = triangles_[i];
            casters_.triangles.push_back({at[0], at[1] - at[0], at[2] - at[0]});
            casters_.looks.push_back(looks[i]);
        }
    }

  private:
    // In halves by number, across the longest side of the boxes' middles: as deep as the logarithm.
    void split(std::uint32_t node, std::uint32_t first, std::uint32_t last) {
        constexpr float infinite = std::numeric_limits<float>::infinity();
        CasterBox all{glm::vec3(infinite), glm::vec3(-infinite)}, middles = all;
        for (std::uint32_t i = first; i < last; ++i) {
            const CasterBox& box = boxes_[order_[i]];
            all = {glm::min(all.low, box.low), glm::max(all.high, box.high)};
            middles = {glm::min(middles.low, box.middle()), glm::max(middles.high, box.middle())};
        }
        constexpr std::uint32_t most_in_leaf = 4;
        if (last - first <= most_in_leaf) {
            casters_.nodes[node] = {all.low, first, all.high, last - first};
            return;
        }
        const glm::vec3 wide = middles.high - middles.low;
        const int axis = wide.x >= wide.y && wide.x >= wide.z ? 0 : wide.y >= wide.z ? 1 : 2;
        const std::uint32_t half = first + (last - first) / 2;
        std::nth_element(order_.begin() + first, order_.begin() + half, order_.begin() + last,
                         [&](std::uint32_t a, std::uint32_t b) {
                             const float one = boxes_[a].middle()[axis], other = boxes_[b].middle()[axis];
                             return one != other ? one < other : a < b;
                         });
        const auto below = static_cast<std::uint32_t>(casters_.nodes.size());
        casters_.nodes[node] = {all.low, below, all.high, 0};
        casters_.nodes.resize(casters_.nodes.size() + 2);
        split(below, first, half);
        split(below + 1, half, last);
    }

    const std::vector<Corners> triangles_;
    MeshCasters& casters_;
    std::vector<CasterBox> boxes_;
    std::vector<std::uint32_t> order_;
};

}  // namespace

MeshCasters mesh_casters_of(const Seam& seam) {
    MeshCasters casters;
    constexpr double infinite = std::numeric_limits<double>::infinity();
    glm::dvec3 low(infinite), high(-infinite);
    for (const SeamPiece& piece : seam.pieces) {
        if (!piece.two_sided) continue;
        for (const SeamCorner& corner : piece.corners)
            low = glm::min(low, corner.at.m), high = glm::max(high, corner.at.m);
    }
    if (!(low.x <= high.x)) return casters;
    casters.origin_m = 0.5 * (low + high);
    std::vector<Corners> triangles;
    std::vector<std::uint8_t> looks;
    const auto add = [&](const SeamCorner& a, const SeamCorner& b, const SeamCorner& c, std::uint32_t look) {
        looks.push_back(static_cast<std::uint8_t>(look));
        triangles.push_back({glm::vec3(a.at.m - casters.origin_m), glm::vec3(b.at.m - casters.origin_m),
                             glm::vec3(c.at.m - casters.origin_m)});
    };
    for (const SeamPiece& piece : seam.pieces)
        if (piece.two_sided) add(piece.corners[0], piece.corners[1], piece.corners[2], piece.look);
    for (const SeamSkirt& skirt : seam.skirts) {
        if (!skirt.of_mesh) continue;
        const std::array<SeamCorner, 2>&top = skirt.top, &foot = skirt.foot;
        for (std::size_t end = 0; end < 2; ++end)
            if (foot[end].at.m != top[end].at.m)
                add(top[end], foot[end], end == 0 ? foot[1] : top[0], gpu::mesh_look_ground);
    }
    const CasterTree tree(std::move(triangles), looks, casters);
    return casters;
}

}  // namespace oro
