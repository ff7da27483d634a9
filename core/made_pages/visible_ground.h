// Which ground of made terrain a picture may show over the ground before it.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/frame/frame_plan.h"
#include "core/frame/picture_culling.h"
#include "core/made_pages/coarse_ground.h"

namespace oro {

// Conservative: ground that it drops is hidden by nearer ground, wherever in a pixel is sampled, as long as
// what is drawn of the nearer ground keeps the view's tolerance. Any thread.
class VisibleGround {
  public:
    // Null where too much ground may show for it to be worth while, or where places are not those of WGS84.
    // culling: of the same picture. lowest_h_m, highest_h_m: of any ground. ground outlives it.
    static std::unique_ptr<VisibleGround> of(const CoarseGround& ground, const FrameView& view,
                                             const PictureCulling& culling, double lowest_h_m,
                                             double highest_h_m, int threads);

    // Whether anything over a node may show, whichever of its levels is drawn there. node_level: 3 or more;
    // true for what is wider than 6.
    [[nodiscard]] bool may_show(int node_level, int row, int column) const;

    // Nodes of level 3 that may show, with how far they are from the eye at least and at most, and a height
    // that no ground of them is below.
    struct Node {
        int row{}, column{};
        double nearest_m{}, farthest_m{}, lowest_h_m{};
    };
    [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }
    // Tiles of which posts were made.
    [[nodiscard]] std::size_t tiles() const { return tiles_; }

  private:
    friend class VisibleGroundSearch;
    // How far up a node of level 3 reaches, and where.
    struct Reach {
        float tangent;           // no ground is seen higher; infinite: nothing is known
        float from_rad, to_rad;  // azimuths
        float nearest_m;         // across the eye's vertical
    };
    [[nodiscard]] Reach reach_of(int row, int column) const;
    [[nodiscard]] bool is_hidden(const Reach& reach) const;
    [[nodiscard]] bool shows_of(int row, int column) const;

    explicit VisibleGround(const CoarseGround& ground) : ground_(ground) {}

    const CoarseGround& ground_;
    std::shared_ptr<const class PolarHorizon> horizon_;
    double margin_per_m_{}, margin_m_{};                     // of tangents at the horizon
    int first_row_{}, first_column_{}, rows_{}, columns_{};  // nodes of level 3
    std::vector<Reach> reaches_;
    std::vector<char> shows_;
    std::vector<Node> nodes_;
    std::size_t tiles_{};
};

}  // namespace oro
