// The one place where a vertex of a cluster graph is a post: a grid of heights as its original surface.
#pragma once

#include "core/surface/original_surface.h"
#include "core/terrain/drawn_heights.h"
#include "core/terrain/post_grid.h"

namespace oro {

// Which part of a region's grid some heights are, and on which sides the region goes on beyond them.
struct GridWindow {
    int first_row{};     // in the region; a whole number of leaves
    int first_column{};  // likewise
    bool north_open{};
    bool east_open{};
    bool south_open{};
    bool west_open{};
    // The first and the last column are one meridian: their posts stay, so that both sides have the same.
    bool wraps_longitude{};
};

// Vertex number row * columns + column, counted within the heights; places are those in the region. A cell is
// two triangles (core/terrain/cell_diagonal.h); a triangle with a void post is not there,
// so that cells with void posts are holes. Leaves are the nodes of level 0: 8 x 8 quads. Reads `heights`
// where it is.
class GridSurface final : public OriginalSurface {
  public:
    explicit GridSurface(const DrawnHeights& heights, const GridWindow& window = {});

    [[nodiscard]] std::size_t vertex_count() const override { return heights_.steps.size(); }
    [[nodiscard]] SurfaceVertex vertex(VertexNumber number) const override;
    [[nodiscard]] bool is_open(VertexNumber number) const override;
    [[nodiscard]] bool is_window() const override;
    [[nodiscard]] bool must_stay(VertexNumber number) const override;
    [[nodiscard]] std::vector<std::vector<VertexTriangle>> leaves() const override;
    // Which nodes of level 0 have a triangle, numbered row by row; and the triangles of one. For regions
    // whose leaves are too many to be kept.
    [[nodiscard]] std::vector<std::uint32_t> leaf_nodes() const;
    [[nodiscard]] std::vector<VertexTriangle> leaf(std::uint32_t node) const;
    [[nodiscard]] double edge_difference(const SurfaceVertex& from, const SurfaceVertex& to,
                                         double limit) const override;
    [[nodiscard]] double inner_difference(const SurfaceVertex& a, const SurfaceVertex& b,
                                          const SurfaceVertex& c, double limit) const override;

  private:
    // A step from line to line of the grid that an edge crosses, and the way along such a line from a post to
    // the next.
    struct Lines {
        int count;             // crossings, both ends left out: 1 .. count - 1
        std::ptrdiff_t along;  // posts, in memory
        // Of diagonals: where a cell's north-west post is from the one passed, and whether it must rise.
        std::ptrdiff_t cell{};
        char sw_ne{};
        bool diagonals{};
    };
    // Gives each triangle of a node to `take` until it says false.
    template <class Take>
    void each_of_leaf(std::uint32_t node, const Take& take) const;
    [[nodiscard]] std::uint32_t nodes_across() const;
    [[nodiscard]] VertexTriangle triangle_of(int row, int column, int side) const;
    [[nodiscard]] bool triangle_there(const VertexTriangle& triangle) const;
    [[nodiscard]] double crossing_difference(const SurfaceVertex& from, const SurfaceVertex& to,
                                             const Lines& lines, double limit) const;

    // Points to the height of a post, in steps, by its row and column in the region.
    [[nodiscard]] const std::int32_t* post(int row, int column) const {
        return heights_.row(row - window_.first_row) + (column - window_.first_column);
    }

    [[nodiscard]] char sw_ne(const std::int32_t* north_west) const {
        return sw_ne_[static_cast<std::size_t>(north_west - heights_.steps.data())];
    }

    const DrawnHeights& heights_;
    GridWindow window_;
    std::vector<char> sw_ne_;  // of the cell south-east of each post
};

}  // namespace oro
