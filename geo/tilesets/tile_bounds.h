// How far the ground of a tile is from the surface, at most, and how deep the walls around it must reach.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "core/base/result.h"
#include "core/frame/region_pages.h"

namespace oro {

// What cannot be told in metres: the page's triangles do not cover the same area as the surface does.
inline constexpr double unbounded_m = std::numeric_limits<double>::infinity();

// The walls of a page along its northern, eastern, southern and western edge: so far they reach down from the
// edge, and so far outwards at their foot. 0 where there is no neighbour, and so no wall.
struct TileWalls {
    std::array<double, 4> down_m{};
    std::array<double, 4> out_m{};
};

// How far a flat triangle between posts of a level lies from the one that is linear in row, column and
// height, at most, in metres. dh_m: how much higher one of its posts is than another.
double flat_triangle_sag_m(const PostGrid& grid, int level, double highest_h_m, double dh_m);

// The bounds of the pages of a grid, each drawn alone with all its quads by flat triangles between posts that
// are rounded to steps around a centre. Read once, of what the certificates say; 64 bytes a page.
class TileBounds {
  public:
    // `pages` outlive them. Errors: a file that cannot be read.
    static Result<TileBounds> of(const RegionPages& pages);

    // Whether the page has a triangle.
    [[nodiscard]] bool drawn(const PageIndex& page) const { return at(page).drawn; }
    // Upper bound, metres, of the distance in space between a point of the surface (TrueSurface: height
    // linear in row and column over each triangle) and the point of the tile at the same row and column: the
    // page's certificate, the sag of the surface's own triangles, the steps of drawn heights, and the
    // rounding of positions to float. unbounded_m where the page cannot stand for what it covers, and never
    // on level 0.
    [[nodiscard]] double error_m(const PageIndex& page) const { return at(page).error_m; }
    // The step that positions of the page are rounded to, along each axis: a power of two, a thousandth of
    // the error or of the way between posts, 2^-11 m at least, and as large as the page takes with 23 bits.
    [[nodiscard]] double step_m(const PageIndex& page) const { return at(page).step_m; }
    // Walls that close what may open to any neighbour that a viewer can draw beside this page: a page of the
    // same level, one below that, or one of a coarser level that does not cover this page. Two edges are off
    // the surface by their pages' errors at most, so their sum is deep enough where both lie above one line.
    // They are beside each other by their sags; walls lean outwards by twice as much, and reach as much
    // deeper as ground of the neighbour's steepness falls on that way, but not below all of it.
    [[nodiscard]] TileWalls walls(const PageIndex& page) const;

  private:
    struct Bound {
        double error_m{};
        double shown_error_m{-1.0};  // the largest of what is drawn of it or, in its stead, below it; or none
        // Between which heights above the ellipsoid posts of it and of all below it lie; lowest > highest:
        // none.
        double lowest_h_m{std::numeric_limits<double>::infinity()};
        double highest_h_m{-std::numeric_limits<double>::infinity()};
        double post_m{};    // from a post of level 0 to the next, at least
        double beside_m{};  // how far edges may be beside each other: sag and step
        double step_m{};
        bool drawn{};
    };
    explicit TileBounds(const RegionPages& pages) : pages_(&pages) {}
    [[nodiscard]] const Bound& at(const PageIndex& page) const;
    [[nodiscard]] Result<Bound> bound_of(const PageIndex& page) const;
    // The page across an edge of what covers `page` on a level at or above its own; nothing where none is.
    [[nodiscard]] std::optional<PageIndex> across(const PageIndex& page, int level, std::size_t edge) const;

    const RegionPages* pages_;
    std::vector<std::vector<Bound>> levels_;
};

}  // namespace oro
