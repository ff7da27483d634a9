// Which casters a frame's light needs, and how fine: a map over a region of the lines from all ground that is
// seen towards the sun.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <vector>

#include "core/earth/ellipsoid.h"
#include "core/frame/region_pages.h"
#include "core/frame/shadow_receiver.h"

namespace oro {

// Cells of pages of one level over the region: what the lines from all that is seen towards the sun need.
class CastMap {
  public:
    struct Need {
        double error_m{std::numeric_limits<double>::infinity()};  // that casters there may have
        double low_m{std::numeric_limits<double>::infinity()};    // nothing below this height matters
    };

    // sun_ecef: unit vector; top_m: height that nothing in the region is above. `pages` outlive it.
    CastMap(const RegionPages& pages, const glm::dvec3& sun_ecef, double top_m)
        : grid_(pages.facts().grid), sun_ecef_(sun_ecef), top_m_(top_m) {
        divide(pages);
    }

    // Cells from north to south and from west to east, both among them.
    struct Patch {
        int north, south, west, east;
    };
    // The cells of so many rows and columns of posts (of level 0) from there on.
    [[nodiscard]] Patch patch(std::int64_t row, std::int64_t column, std::int64_t posts) const;
    // Ground that is seen (ShadowReceiver says of what), and then what all of it needs.
    void receive(const Patch& patch, double error_per_slope_m, double lowest_m);
    void cast();
    // Marks what hides the sun from another grid's ground: where lines from there pass over this one.
    void cast_from_other_grid(const ShadowReceiver& receiver);
    // Whether any line passes over the region.
    [[nodiscard]] bool any() const { return any_; }
    // What lines need of the terrain in these cells; infinite where none passes.
    [[nodiscard]] Need need(const Patch& patch) const;

  private:
    [[nodiscard]] std::size_t place(int row, int column) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(layout_.columns) +
               static_cast<std::size_t>(column);
    }
    // How the posts lie around one of them.
    struct CellFrame {
        PostPlace place;
        double row_m, column_m;  // from one to the next
        SineCosine turn;         // of rows, from east towards north
        double bend;  // how far a line strays from a straight one among them, of a great circle's stray
    };
    void divide(const RegionPages& pages);  // into cells
    [[nodiscard]] CellFrame frame_of_cell(std::int64_t row, std::int64_t column) const;
    void cast_from(int row, int column);
    void mark(double north, double south, double west, double east, const Need& need);

    const PostGrid& grid_;
    glm::dvec3 sun_ecef_;
    double top_m_;
    int level_{0};
    PageLayout layout_;
    std::int64_t posts_{};  // along a cell
    bool any_{false};
    std::vector<Need> needs_, receivers_;
    // All of its ground lies in this sphere, but for heights.
    Ecef middle_;
    double reach_m_{};
};

}  // namespace oro
