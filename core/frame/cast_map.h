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
        double most_error_m{};  // that any of those that are lit over it lets casters have
    };
    // A rectangle of a region's cells.
    struct Window {
        int first_row{}, first_column{}, rows{}, columns{};
    };
    static Window whole(const CastCells& cells) {
        return {0, 0, cells.layout().rows, cells.layout().columns};
    }
    // seen: cells of ground that is seen, no farther than farthest_m from the eye and nowhere lower than
    // lowest_m; with those that light to it may pass below top_m. sun_enu: at the eye.
    static Window window_of(const CastCells& cells, const Window& seen, const glm::dvec3& sun_enu,
                            double farthest_m, double lowest_m, double top_m);

    // cells: of the region's pages, which outlive it. sun_ecef: unit vector; top_m: height that nothing in
    // the region is above. window: what is looked at; nothing outside it needs anything.
    CastMap(const RegionPages& pages, CastCells& cells, const glm::dvec3& sun_ecef, double top_m,
            const Window& window)
        : grid_(pages.facts().grid),
          cells_(cells),
          sun_ecef_(sun_ecef),
          top_m_(top_m),
          window_(window),
          posts_(cells.posts()),
          needs_(static_cast<std::size_t>(window.rows) * static_cast<std::size_t>(window.columns)),
          receivers_(needs_.size()) {}

    // Cells from north to south and from west to east, both among them; of the window. None where one is
    // beyond the other.
    struct Patch {
        int north, south, west, east;
    };
    // The cells of so many rows and columns of posts (of level 0) from there on.
    [[nodiscard]] Patch patch(std::int64_t row, std::int64_t column, std::int64_t posts) const;
    // Ground that is seen (ShadowReceiver says of what), and then what all of it needs.
    void receive(const Patch& patch, double error_per_slope_m, double lowest_m) {
        receive(patch, error_per_slope_m, error_per_slope_m, lowest_m);
    }
    // The same of ground of which parts let casters have more.
    void receive(const Patch& patch, double error_per_slope_m, double most_error_per_slope_m,
                 double lowest_m);
    void cast();
    // Marks what hides the sun from another grid's ground: where lines from there pass over this one.
    void cast_from_other_grid(const ShadowReceiver& receiver);
    // Whether any line passes over the region.
    [[nodiscard]] bool any() const { return any_; }
    // What lines need of the terrain in these cells; infinite where none passes.
    [[nodiscard]] Need need(const Patch& patch) const;

  private:
    [[nodiscard]] std::size_t place(int row, int column) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(window_.columns) +
               static_cast<std::size_t>(column);
    }
    void cast_from(int row, int column);
    void mark(double north, double south, double west, double east, const Need& need);

    const PostGrid& grid_;
    CastCells& cells_;
    glm::dvec3 sun_ecef_;
    double top_m_;
    Window window_;
    std::int64_t posts_;  // along a cell
    bool any_{false};
    std::vector<Need> needs_, receivers_;
};

}  // namespace oro
