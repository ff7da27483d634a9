#include "core/lod/pyramid.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>

#include "core/base/parallel.h"
#include "core/lod/levels_gpu.h"
#include "core/lod/node_deviations.h"
#include "core/lod/page_sums.h"
#include "core/lod/row_deviations.h"

namespace oro {
namespace {

constexpr int side = static_cast<int>(gpu::meshlets_per_side);
// A node's stitched edges among those of its level: by its page, and its number there.
std::array<float, 4>& of_node(std::vector<StitchedDeviations>& deviations, const LevelGrid& grid, int row,
                              int column) {
    const std::uint64_t page = grid.pages().number(row / side, column / side);
    return deviations[page][static_cast<std::size_t>(row % side * side + column % side)];
}

glm::dvec3 ecef_of(const PageSummary& page, const glm::dvec3& in_page_m) {
    return page.origin_ecef.m + page.ecef_from_page * in_page_m;
}

// Builds one level's pages upon those of the level before.
class LevelBuilder {
  public:
    LevelBuilder(const PostGrid& region, const RegionShape& shape, const DrawnHeights& heights,
                 const LevelPyramid& pyramid, int level, std::vector<StitchedDeviations> stitched_below_m,
                 const KnownDeviations& known)
        : region_(region),
          known_(known),
          shape_(shape),
          heights_(heights),
          wraps_longitude_(pyramid.wraps_longitude),
          level_(level),
          grid_(level_grid(region, level)),
          below_(level > 0 ? &pyramid.levels[static_cast<std::size_t>(level - 1)] : nullptr),
          deviations_(region, heights, level),
          stitched_m_(grid_.pages().count()),
          stitched_below_m_(std::move(stitched_below_m)) {}

    // Page `number` of the level, row by row, with what was measured of it before, if anything; by so many
    // threads. Safe to call from several threads, once for each page.
    void build(std::size_t number, const PyramidHooks& hooks, int threads, PyramidPage& page,
               gpu::PageBlock& block);
    [[nodiscard]] const StitchedDeviations& stitched(std::size_t number) const { return stitched_m_[number]; }
    // Of all pages of the level, once they are built.
    std::vector<StitchedDeviations> take_stitched() { return std::move(stitched_m_); }

  private:
    [[nodiscard]] RowDeviations deviations_of(const PageIndex& page, int row) const;
    void finish_node(int node_row, int node_column, const PageSummary& page, const RowDeviations& measured,
                     gpu::MeshletBounds& bounds);
    void hold_pages_below(PyramidPage& page) const;
    template <class Visit>
    void visit_nodes_below(int node_row, int node_column, const Visit& visit) const;

    const PostGrid& region_;
    const KnownDeviations& known_;
    const RegionShape& shape_;
    const DrawnHeights& heights_;
    bool wraps_longitude_;
    int level_;
    LevelGrid grid_;
    const PyramidLevel* below_;
    NodeDeviations deviations_;
    std::vector<StitchedDeviations> stitched_m_;
    std::vector<StitchedDeviations> stitched_below_m_;
};

constexpr std::size_t north_edge = 0, east_edge = 1, south_edge = 2, west_edge = 3, no_edge = 4;

// The up to four nodes below a node and those that share an edge with them from outside; of these, the edge
// that faces the node.
template <class Visit>
void LevelBuilder::visit_nodes_below(int node_row, int node_column, const Visit& visit) const {
    if (below_ == nullptr) return;
    const int rows = below_->grid.row.nodes();
    const int columns = below_->grid.column.nodes();
    const int north = 2 * node_row, south = std::min(north + 2, rows);  // the ends are beyond
    const int west = 2 * node_column, east = std::min(west + 2, columns);
    for (int row = north; row < south; ++row) {
        for (int column = west; column < east; ++column) visit(row, column, no_edge);
        if (west > 0 || wraps_longitude_) visit(row, (west + columns - 1) % columns, east_edge);
        if (east < columns || wraps_longitude_) visit(row, east % columns, west_edge);
    }
    for (int column = west; column < east; ++column) {
        if (north > 0) visit(north - 1, column, south_edge);
        if (south < rows) visit(south, column, north_edge);
    }
}

RowDeviations LevelBuilder::deviations_of(const PageIndex& page, int row) const {
    RowDeviations measured;
    if (known_ && known_(page, row, measured)) return measured;
    return measured_row(deviations_, grid_, page, row);
}

// Error and lod sphere of a node. What is drawn around it one level finer is stitched to it, and good enough
// by its word alone: its error is at least that of their stitched triangles.
void LevelBuilder::finish_node(int node_row, int node_column, const PageSummary& page,
                               const RowDeviations& measured, gpu::MeshletBounds& bounds) {
    const auto in_row = static_cast<std::size_t>(node_column % side);
    of_node(stitched_m_, grid_, node_row, node_column) = measured.stitched_m[in_row];
    double error_m = measured.own_m[in_row];
    const bool fits = error_m < gpu::unfit_error_m;
    if (bounds.radius < 0.0F) {
        // Nothing is drawn for it; it is unfit when there is something that should be.
        bounds.error_m = fits ? 0.0F : gpu::unfit_error_m;
        return;
    }
    const glm::dvec3 centre = ecef_of(page, bounds.centre);
    double radius_m = bounds.radius;
    visit_nodes_below(node_row, node_column, [&](int row, int column, std::size_t edge) {
        const gpu::MeshletBounds& other = below_->node(row, column);
        error_m = std::max(error_m, error_growth * static_cast<double>(other.error_m));
        if (edge != no_edge)
            error_m = std::max<double>(error_m, of_node(stitched_below_m_, below_->grid, row, column)[edge]);
        if (other.radius < 0.0F) return;
        const glm::dvec3 other_centre = ecef_of(below_->page_of_node(row, column).summary, other.centre);
        radius_m =
            std::max(radius_m, glm::distance(centre, other_centre) + static_cast<double>(other.lod_radius));
    });
    bounds.error_m = std::min(rounded_up(error_m), gpu::unfit_error_m);
    bounds.lod_radius = rounded_up(level_ == 0 ? radius_m : radius_growth * radius_m);
}

void LevelBuilder::hold_pages_below(PyramidPage& page) const {
    const PageSummary& summary = page.summary;
    const bool drawn = summary.triangles > 0;
    page.reach_m = drawn ? summary.radius_m : -1.0;
    page.horizon = drawn ? summary.horizon
                         : HorizonCone{glm::normalize(shape_.occluder.scaled(summary.origin_ecef)), 0.0};
    if (below_ == nullptr) return;
    const PageLayout& layout = below_->layout;
    const glm::dvec3 centre = ecef_of(summary, summary.centre_m);
    for (int i = 0; i < 4; ++i) {
        const int row = 2 * summary.index.row + i / 2;
        const int column = 2 * summary.index.column + i % 2;
        if (row >= layout.rows || column >= layout.columns) continue;
        const PyramidPage& other = below_->page(row, column);
        if (other.reach_m < 0.0) continue;
        const glm::dvec3 other_centre = ecef_of(other.summary, other.summary.centre_m);
        page.reach_m = std::max(page.reach_m, glm::distance(centre, other_centre) + other.reach_m);
        const double between_rad =
            std::atan2(glm::length(glm::cross(page.horizon.direction, other.horizon.direction)),
                       glm::dot(page.horizon.direction, other.horizon.direction));
        page.horizon.angle_rad = std::max(page.horizon.angle_rad, between_rad + other.horizon.angle_rad);
    }
}

void LevelBuilder::build(std::size_t number, const PyramidHooks& hooks, int threads, PyramidPage& page,
                         gpu::PageBlock& block) {
    const auto columns = static_cast<std::size_t>(grid_.pages().columns);
    const PageIndex index{static_cast<int>(number / columns), static_cast<int>(number % columns), level_};
    page.summary =
        build_page(region_, shape_, page_heights(region_, heights_, index), index, block, hooks.bounding);
    PyramidHooks::Measured measured;
    const bool known = hooks.recall && hooks.recall(index, measured);
    if (known) stitched_m_[number] = measured.stitched;
    in_parallel(side, threads, [&](int row) {
        const RowDeviations measured_of_row = known ? RowDeviations{} : deviations_of(index, row);
        for (int i = row * side; i < (row + 1) * side; ++i) {
            const int node_row = index.row * side + row;
            const int node_column = index.column * side + i % side;
            if (known) {
                block.meshlets[i].error_m = measured.error_m[static_cast<std::size_t>(i)];
                block.meshlets[i].lod_radius = measured.lod_radius_m[static_cast<std::size_t>(i)];
            } else if (node_row < grid_.row.nodes() && node_column < grid_.column.nodes()) {
                finish_node(node_row, node_column, page.summary, measured_of_row, block.meshlets[i]);
            }
        }
    });
    std::copy(std::begin(block.meshlets), std::end(block.meshlets), page.nodes.begin());
    std::copy(std::begin(block.boxes), std::end(block.boxes), page.boxes.begin());
    sum_up_nodes(page);
    hold_pages_below(page);
}

// All pages of a level, some at a time: built and worked on in parallel, then handed on in order.
Result<void> build_level(LevelBuilder& builder, PyramidLevel& level, int threads, const PyramidHooks& hooks,
                         std::vector<gpu::PageBlock>& blocks) {
    constexpr std::size_t at_a_time = PyramidHooks::pages_at_a_time;
    const std::size_t count = level.layout.count();
    level.pages.resize(count);
    for (std::size_t first = 0; first < count; first += at_a_time) {
        const auto some = static_cast<int>(std::min(at_a_time, count - first));
        // The coarsest levels have few pages, each over as many posts as all of a finer level.
        const bool few = some < 4 * threads;
        in_parallel(some, few ? 1 : threads, [&](int slot) {
            const auto i = static_cast<std::size_t>(slot);
            builder.build(first + i, hooks, few ? threads : 1, level.pages[first + i], blocks[i]);
            if (hooks.work) hooks.work(slot, level.pages[first + i], blocks[i]);
        });
        for (int slot = 0; hooks.sink && slot < some; ++slot) {
            const auto i = static_cast<std::size_t>(slot);
            ORO_CHECK(hooks.sink(slot, level.pages[first + i], blocks[i], builder.stitched(first + i)));
        }
    }
    return {};
}

}  // namespace

LevelPyramid build_pyramid(const HeightField& field, const RegionShape& shape, int threads,
                           const PageSink& sink) {
    return build_pyramid(field.grid, shape, drawn_heights(field, shape.exaggeration, threads), threads, sink);
}

LevelPyramid build_pyramid(const PostGrid& grid, const RegionShape& shape, const DrawnHeights& heights,
                           int threads, const PageSink& sink) {
    PyramidHooks hooks;
    if (sink) {
        hooks.sink = [&](int, const PyramidPage& page, const gpu::PageBlock& block,
                         const StitchedDeviations&) -> Result<void> {
            sink(page, block);
            return {};
        };
    }
    return build_pyramid_with(grid, shape, heights, threads, hooks).value();  // such a sink has no errors
}

RowDeviations measured_row(const NodeDeviations& deviations, const LevelGrid& level, const PageIndex& page,
                           int row) {
    RowDeviations measured;
    const int node_row = page.row * side + row;
    if (node_row >= level.row.nodes()) return measured;
    for (int i = 0; i < side && page.column * side + i < level.column.nodes(); ++i) {
        const auto at = static_cast<std::size_t>(i);
        const NodeDeviation deviation = deviations.deviation(node_row, page.column * side + i);
        measured.own_m[at] = std::min<double>(deviation.own_m, gpu::unfit_error_m);
        for (std::size_t edge = 0; edge < 4; ++edge)
            measured.stitched_m[at][edge] = std::min(static_cast<float>(rounded_up(std::min<double>(
                                                         deviation.stitched_m[edge], gpu::unfit_error_m))),
                                                     gpu::unfit_error_m);
    }
    return measured;
}

Result<LevelPyramid> build_pyramid_with(const PostGrid& grid, const RegionShape& shape,
                                        const DrawnHeights& heights, int threads, const PyramidHooks& hooks,
                                        bool keep_levels) {
    return build_pyramid_from(grid, shape, heights, threads, hooks, keep_levels, {});
}

Result<LevelPyramid> build_pyramid_from(const PostGrid& grid, const RegionShape& shape,
                                        const DrawnHeights& heights, int threads, const PyramidHooks& hooks,
                                        bool keep_levels, const KnownDeviations& known) {
    assert(threads >= 1);
    LevelPyramid pyramid{shape, grid.wraps_longitude(), {}};
    std::vector<gpu::PageBlock> blocks(PyramidHooks::pages_at_a_time);
    const int levels = level_count(grid);
    pyramid.levels.reserve(static_cast<std::size_t>(levels));
    std::vector<StitchedDeviations> stitched_m;
    for (int k = 0; k < levels; ++k) {
        LevelBuilder builder(grid, shape, heights, pyramid, k, std::move(stitched_m), known);
        PyramidLevel& level = pyramid.levels.emplace_back();
        level.grid = level_grid(grid, k);
        level.layout = level.grid.pages();
        ORO_CHECK(build_level(builder, level, threads, hooks, blocks));
        stitched_m = builder.take_stitched();
        if (k > 0 && !keep_levels) pyramid.levels[static_cast<std::size_t>(k - 1)].pages = {};
    }
    return pyramid;
}

}  // namespace oro
