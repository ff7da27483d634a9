// Which casters a frame's light needs, and how fine: a map over a region of the lines from all ground that is
// seen towards the sun.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <vector>

#include "core/earth/ellipsoid.h"
#include "core/frame/cast_cells.h"
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

    // cells: of the region's pages, which outlive it. sun_ecef: unit vector; top_m: height that nothing in
    // the region is above.
    CastMap(const RegionPages& pages, CastCells& cells, const glm::dvec3& sun_ecef, double top_m)
        : grid_(pages.facts().grid),
          cells_(cells),
          sun_ecef_(sun_ecef),
          top_m_(top_m),
          layout_(cells.layout()),
          posts_(cells.posts()),
          needs_(static_cast<std::size_t>(layout_.count())),
          receivers_(needs_.size()) {}

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
    void cast_from(int row, int column);
    void mark(double north, double south, double west, double east, const Need& need);

    const PostGrid& grid_;
    CastCells& cells_;
    glm::dvec3 sun_ecef_;
    double top_m_;
    PageLayout layout_;
    std::int64_t posts_;  // along a cell
    bool any_{false};
    std::vector<Need> needs_, receivers_;
};

}  // namespace oro
