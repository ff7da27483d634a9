// The cells of a cast map, and what of them does not depend on the eye or the sun: kept from frame to frame.
#pragma once

#include <bit>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <unordered_map>

#include "core/earth/ellipsoid.h"
#include "core/frame/region_pages.h"

namespace oro {

// Cells of pages of one level over a region. For one thread at a time.
class CastCells {
  public:
    // The pages outlive it.
    CastCells(const RegionPages& pages, int level);
    // The finest level of which a region has at most 128 pages along a side.
    [[nodiscard]] static int level_of_whole(const RegionPages& pages);

    // How the posts lie around one of them.
    struct Frame {
        PostPlace place;
        double row_m, column_m;  // from one to the next
        SineCosine turn;         // of rows, from east towards north
        double bend;  // how far a line strays from a straight one among them, of a great circle's stray
    };
    // Of a cell, around its middle: east, north and up there, too.
    struct Cell {
        Frame frame;
        glm::dmat3 enu_from_ecef;
        double half_rad;  // half its diagonal, at the Earth's centre
    };
    [[nodiscard]] const Cell& cell(int row, int column);
    // Of a post; reckoned anew each time.
    [[nodiscard]] Frame frame_of_post(std::int64_t row, std::int64_t column) const;

    [[nodiscard]] const PostGrid& grid() const { return grid_; }
    [[nodiscard]] int level() const {
        return std::countr_zero(static_cast<std::uint64_t>(posts_) / gpu::page_quads);
    }
    [[nodiscard]] const PageLayout& layout() const { return layout_; }
    [[nodiscard]] std::int64_t posts() const { return posts_; }  // along a cell
    // All of the region's ground lies in this sphere, but for heights.
    [[nodiscard]] const Ecef& middle() const { return middle_; }
    [[nodiscard]] double reach_m() const { return reach_m_; }

  private:
    const PostGrid& grid_;
    PageLayout layout_;
    std::int64_t posts_{};
    Ecef middle_;
    double reach_m_{};
    std::unordered_map<std::uint64_t, Cell> cells_;  // that were asked for, by number
};

}  // namespace oro
