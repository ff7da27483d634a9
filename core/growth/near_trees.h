// Which pixels of a frame show trees that stand near its eye: from low inside a forest these hide the view.
#pragma once

#include <cstdint>

#include "core/earth/ellipsoid.h"
#include "core/growth/growth_plan.h"

namespace oro {

// Trees are at most so high, metres, without the exaggeration: an eye higher over the ground has none beside
// it.
inline constexpr double highest_tree_m = 30.0;
// Trees within so much of the eye, metres along level ground, are near it.
inline constexpr double near_trees_m = 100.0;

class NearTrees {
  public:
    // plan: whose ids are numbered; it outlives this.
    NearTrees(const GrowthPlan& plan, const Geodetic& eye) : plan_(plan), eye_(eye) {}
    // Whether an id of the frame is that of such a tree.
    [[nodiscard]] bool has(std::uint32_t id);

  private:
    [[nodiscard]] bool is_near(const gpu::GrowthTile& tile, std::uint32_t site) const;
    const GrowthPlan& plan_;
    Geodetic eye_;
    std::uint32_t last_id_{};  // that was asked for: pixels beside each other show one tree
    bool last_is_near_{};
};

}  // namespace oro
