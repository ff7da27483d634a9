// Means of the ground over squares of posts: what a pixel that covers many posts is coloured from, instead of
// the few that happen to lie under it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/terrain/drawn_heights.h"
#include "core/terrain/page.h"
#include "shaders/shared.h"

namespace oro {

// Normals of the drawn surface at its posts (slopes from the posts around, one-sided beside a void), and
// heights above the ellipsoid without the exaggeration. A square of level k has 2^k x 2^k posts, those that
// are void left out; how much its normals differ, and in which direction, their covariance tells. Moments add
// up from square to square. Source: M. Olano, D. Baker, LEAN mapping, I3D 2010.
class GroundMeans {
  public:
    // The work is shared between `threads` (at least 1), with one result for any number. Keeps 1 byte a
    // post, 4 round the Earth, and works in bands of rows. `grid` and `heights` must outlive it.
    GroundMeans(const PostGrid& grid, const DrawnHeights& heights, double exaggeration, int threads);

    // Puts the means of a page into `means`; squares without a post have 0. Those of the finest levels are
    // made of the page's posts at each call.
    void page(const PageIndex& index, gpu::PageMeans& means) const;
    // How many squares it keeps, of all levels.
    [[nodiscard]] std::size_t kept_squares() const;

  private:
    struct Sums;
    struct Level {
        int rows{};
        int columns{};
        std::vector<gpu::MeansSquare> squares;  // none of levels that are not kept
    };
    static gpu::MeansSquare packed(const Sums& sums);
    static std::uint32_t packed_spread(const Sums& sums);
    [[nodiscard]] float rise(int row, int column, int rows, int columns) const;
    // neighbour_share: weight of the slopes of the posts beside it.
    [[nodiscard]] Sums post(int row, int column, float neighbour_share) const;
    [[nodiscard]] std::int32_t steps(int row, int column) const;
    struct PostRow;
    struct Bands;

    const PostGrid& grid_;
    const DrawnHeights& heights_;
    float exaggeration_;
    bool wraps_longitude_;
    int first_kept_;  // level; those below it are made page by page
    struct RowScale {
        float down_per_m;   // 1 / metres from a post to the next one south, times the height step
        float right_per_m;  // ... east
    };
    std::vector<RowScale> rows_;
    // The scale on a net: of every scale_posts-th post each way, bilinear between.
    struct NetScale {
        float down_per_m;
        float right_per_m;
        float turn_cosine;  // of rows, from east towards north
        float turn_sine;
    };
    static constexpr int scale_posts = 32;
    void measure_net();
    [[nodiscard]] NetScale scale_on_net(int row, int column) const;
    int net_columns_{};
    std::vector<NetScale> net_scales_;
    std::vector<Level> levels_;
};

// Whether a style colours pixels by these.
inline bool asks_for_means(const gpu::FrameStyle& style) {
    return style.footprint != gpu::footprint_point;
}
// How large the squares are at most that it takes, px on the screen: small ones where contrasts are strong.
inline double means_spacing_px(const gpu::FrameStyle& style) {
    const bool of_slopes = style.colour_by == gpu::colour_by_slope && style.air.on == 0;
    return of_slopes ? gpu::slope_means_px : gpu::means_spacing_px;
}

}  // namespace oro
