#include "core/made_pages/measured_block.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/base/parallel.h"
#include "core/earth/ellipsoid.h"
#include "core/lod/levels_gpu.h"
#include "core/lod/node_deviations.h"
#include "core/lod/page_sums.h"
#include "core/made/made_heights.h"
#include "core/made_pages/coarse_deviations.h"
#include "core/made_pages/steps_of_maker.h"
#include "core/terrain/drawn_heights.h"

namespace oro {
namespace {

constexpr int node_quads = static_cast<int>(gpu::meshlet_quads);
// As levels grow (core/lod/pyramid.cpp), and what heights of two grids' angles may differ by.
constexpr double block_growth = 1.0 + 2.0e-5, height_slack_m = 0.002;
// Larger than the radii of curvature of WGS84 with heights on it.
constexpr double largest_radius_m = 6'412'000.0;

double node_width_m(const MadeRegion& region, int level) {
    return std::ldexp(node_quads * radians_from_deg(region.grid.lat.spacing_deg()).rad * largest_radius_m,
                      level);
}

// How far apart the middles of two nodes are at most of which one is over or beside the other's parent: 1.07
// widths over the ground, `rise_m` in height, and what the ground bends by.
double way_between_m(const MadeRegion& region, int level, double rise_m) {
    const double width_m = node_width_m(region, level);
    return std::hypot(1.07 * width_m, rise_m + width_m * width_m / (2.0 * largest_radius_m));
}
// Of lod spheres: a node's holds those of the nodes below it and beside these, and at last a node's posts.
double lod_radius_of_rise_m(const MadeRegion& region, int level, double rise_m) {
    double radius_m = 0.0;
    for (int k = level; k >= 0; --k) radius_m += way_between_m(region, k, rise_m);
    return radius_m;
}

// Nodes of a block's top level, by their numbers in the region.
struct TopNodes {
    int first_row{}, first_column{}, rows{}, columns{};
    std::vector<char> is_in;  // row by row

    [[nodiscard]] bool has(int row, int column) const {
        const int r = row - first_row, c = column - first_column;
        return r >= 0 && c >= 0 && r < rows && c < columns &&
               is_in[static_cast<std::size_t>(r) * static_cast<std::size_t>(columns) +
                     static_cast<std::size_t>(c)] != 0;
    }
    [[nodiscard]] bool has_beside(int row, int column) const {
        for (int r = row - 1; r <= row + 1; ++r)
            for (int c = column - 1; c <= column + 1; ++c)
                if (has(r, c)) return true;
        return false;
    }
    template <class IsIn>
    void fill(const IsIn& asked) {
        is_in.clear();
        for (int r = 0; r < rows; ++r)
            for (int c = 0; c < columns; ++c) is_in.push_back(asked(first_row + r, first_column + c) ? 1 : 0);
    }
};

// What of a block is measured. A node's error and sphere depend on what is no farther from it than one node
// of the top level: those of levels below and beside it, and what is beside these.
class BlockNodes {
  public:
    // exact: nodes of the region.
    BlockNodes(const MadeRegion& region, int top_level, TopNodes exact) : exact_(std::move(exact)) {
        const LevelGrid level = level_grid(region.grid, top_level);
        const int first_row = std::max(0, exact_.first_row - 1);
        const int first_column = std::max(0, exact_.first_column - 1);
        made_ = {first_row,
                 first_column,
                 std::min(level.row.nodes(), exact_.first_row + exact_.rows + 1) - first_row,
                 std::min(level.column.nodes(), exact_.first_column + exact_.columns + 1) - first_column,
                 {}};
        made_.fill([&](int row, int column) { return exact_.has_beside(row, column); });
        find_span();
    }

    [[nodiscard]] bool empty() const { return last_row_ < first_row_; }
    // Those that are what they would be if all were wanted.
    [[nodiscard]] const TopNodes& exact() const { return exact_; }
    // Those whose posts are made.
    [[nodiscard]] const TopNodes& made() const { return made_; }
    // The smallest rectangle that holds these.
    [[nodiscard]] int first_row() const { return first_row_; }
    [[nodiscard]] int last_row() const { return last_row_; }
    [[nodiscard]] int first_column() const { return first_column_; }
    [[nodiscard]] int last_column() const { return last_column_; }

  private:
    void find_span() {
        first_row_ = first_column_ = std::numeric_limits<int>::max();
        last_row_ = last_column_ = -1;
        for (int row = made_.first_row; row < made_.first_row + made_.rows; ++row)
            for (int column = made_.first_column; column < made_.first_column + made_.columns; ++column) {
                if (!made_.has(row, column)) continue;
                first_row_ = std::min(first_row_, row);
                last_row_ = std::max(last_row_, row);
                first_column_ = std::min(first_column_, column);
                last_column_ = std::max(last_column_, column);
            }
    }

    TopNodes exact_, made_;
    int first_row_{}, last_row_{}, first_column_{}, last_column_{};
};

// The part of a region's posts that a block is measured on: every 2^base-th, over so many nodes of the top
// level.
struct PartAxis {
    int base{};
    int start{}, last{};  // posts of the region; last: of the region itself
    int count{};          // posts of the part
    bool goes_on_before{}, goes_on_after{};

    PartAxis(int top_level, int base_level, int first_top_node, int last_top_node, int posts, bool wraps)
        : base(base_level), last(posts - 1) {
        const std::int64_t node_posts = std::int64_t{node_quads} << top_level;
        start = static_cast<int>(first_top_node * node_posts);
        const auto end = static_cast<int>(std::min<std::int64_t>(last, (last_top_node + 1) * node_posts));
        count = ((end - start + (1 << base) - 1) >> base) + 1;
        goes_on_before = start > 0 || wraps;
        goes_on_after = end < last || wraps;
    }
    [[nodiscard]] int region_post(int i) const {
        return static_cast<int>(std::min<std::int64_t>(last, start + (std::int64_t{i} << base)));
    }
    // Of a level: the number in the region of the part's first node.
    [[nodiscard]] int first_node(int level) const { return start / (node_quads << level); }
};

// Whether a level's last quad is narrower than the others: then the part's posts are not evenly apart there.
bool ends_within_quad(int last, int level) {
    return (last & ((1 << level) - 1)) != 0;
}

// Heights over a node's ground: H, and what is drawn.
struct NodeRange {
    float lowest_H_m{std::numeric_limits<float>::infinity()};
    float highest_H_m{-std::numeric_limits<float>::infinity()};
    std::int32_t lowest{std::numeric_limits<std::int32_t>::max()};
    std::int32_t highest{std::numeric_limits<std::int32_t>::min()};
    // H of the coarse octaves alone.
    float lowest_coarse_m{std::numeric_limits<float>::infinity()};
    float highest_coarse_m{-std::numeric_limits<float>::infinity()};

    void take(const NodeRange& other) {
        lowest_H_m = std::min(lowest_H_m, other.lowest_H_m);
        highest_H_m = std::max(highest_H_m, other.highest_H_m);
        lowest = std::min(lowest, other.lowest);
        highest = std::max(highest, other.highest);
        lowest_coarse_m = std::min(lowest_coarse_m, other.lowest_coarse_m);
        highest_coarse_m = std::max(highest_coarse_m, other.highest_coarse_m);
    }
};

// The nodes of one level of the part.
struct PartLevel {
    int rows{}, columns{};
    std::vector<NodeRange> ranges;
    std::vector<double> error_m;
    std::vector<std::array<double, 4>> stitched_m;  // of its triangles that are stitched
    std::vector<char> may_cut;                      // heights may be cut off there, or beside it
    std::vector<double> rise_m;
    std::vector<double> lod_radius_m;
    std::vector<char> is_measured;  // others are not asked for
    std::vector<std::size_t>
        from_deg;  // of each row: nothing of it or its neighbours is nearer to the equator

    [[nodiscard]] std::size_t at(int row, int column) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
               static_cast<std::size_t>(column);
    }
    [[nodiscard]] bool has(int row, int column) const {
        return row >= 0 && column >= 0 && row < rows && column < columns;
    }
};

class PartMeasurement {
  public:
    // nodes: some. base: the level that is measured against.
    PartMeasurement(const MadeRegion& region, int top_level, int base, const BlockNodes& nodes, int threads)
        : region_(region),
          nodes_(nodes),
          top_level_(top_level),
          base_(base),
          threads_(threads),
          down_(top_level, base, nodes.first_row(), nodes.last_row(), region.grid.rows(), false),
          across_(top_level, base, nodes.first_column(), nodes.last_column(), region.grid.columns(),
                  region.grid.wraps_longitude()) {
        make_posts();
        heights_ = drawn_heights(part_, 1.0, threads);
        // What is curved by it is the same whatever else the part holds.
        heights_.highest_steps = std::max(heights_.highest_steps, region.highest_steps);
        for (std::size_t i = 0; i < coarse_steps_.size(); ++i) coarse_steps_[i] += heights_.steps[i];
        levels_.resize(static_cast<std::size_t>(top_level - base_ + 1));
        choose_nodes();
        for (int i = 0; i <= top_level - base_; ++i) measure_level(i);
    }
    // Number i counts from the level that is measured against.
    [[nodiscard]] const PartLevel& level(int i) const { return levels_[static_cast<std::size_t>(i)]; }
    // A node of a level by its place in the region.
    [[nodiscard]] MadeNode node(int of_level, int row, int column) const {
        const PartLevel& part = level(of_level - base_);
        const std::size_t at =
            part.at(row - down_.first_node(of_level), column - across_.first_node(of_level));
        return {rounded_up(part.error_m[at]), rounded_up(part.lod_radius_m[at])};
    }

  private:
    // First and last post of a row of the part that is made.
    struct MadeSpan {
        std::size_t first{}, count{};
    };
    [[nodiscard]] MadeSpan made_span(int row) const;
    [[nodiscard]] bool is_made(int i, int row, int column) const;
    void make_posts();
    void choose_nodes();
    void measure_level(int i);
    void take_ranges(int i, PartLevel& level) const;
    void take_posts(int row, int column, NodeRange& range) const;
    void look_around(PartLevel& level) const;
    void hold_spheres(int i, PartLevel& level) const;
    void find_latitudes(int i, PartLevel& level) const;
    // What of a node and of its stitched triangles is measured, and what is bounded below that.
    struct Found {
        double own_m{};
        PerEdge stitched_m{};
    };
    [[nodiscard]] Found found_at(int i, const PartLevel& level, int row, int column,
                                 const NodeDeviations& deviations, const CoarseDeviations* coarse) const;
    // Whether the region has a node that the part has not.
    [[nodiscard]] bool goes_on(const PartLevel& level, int row, int column) const {
        return (row < 0 && down_.goes_on_before) || (row >= level.rows && down_.goes_on_after) ||
               (column < 0 && across_.goes_on_before) || (column >= level.columns && across_.goes_on_after);
    }
    [[nodiscard]] double most_cut_off_m(const PartLevel& level, int row, int column) const;
    [[nodiscard]] bool ends_oddly(int i, int row, int column) const;
    [[nodiscard]] double node_error_m(int i, const PartLevel& level, int row, int column, double own_m) const;
    [[nodiscard]] double error_below_m(int i, int row, int column) const;
    // Of level i, where a row of nodes of a level is.
    [[nodiscard]] const MadeLevelBound& bound(int i, const PartLevel& of, int row) const {
        const auto& levels = region_.bounds_from_deg[of.from_deg[static_cast<std::size_t>(row)]];
        return levels[std::min(static_cast<std::size_t>(base_ + i), levels.size() - 1)];
    }

    const MadeRegion& region_;
    const BlockNodes& nodes_;
    int top_level_;
    int base_;
    int threads_;
    PartAxis down_, across_;
    HeightField part_;
    DrawnHeights heights_;
    std::vector<std::int32_t> coarse_steps_;  // drawn heights of the coarse octaves alone, above level 3
    std::vector<PartLevel> levels_;
};

// From the first to the last node that is made, of those that the row touches.
PartMeasurement::MadeSpan PartMeasurement::made_span(int row) const {
    const int side = node_quads << (top_level_ - base_);
    int first = across_.count, last = -1;
    for (const int node_row : {(row - 1) / side, row / side})
        for (int column = nodes_.first_column(); column <= nodes_.last_column(); ++column) {
            if (!nodes_.made().has(nodes_.first_row() + node_row, column)) continue;
            const int part_column = column - nodes_.first_column();
            first = std::min(first, part_column * side);
            last = std::max(last, std::min((part_column + 1) * side, across_.count - 1));
        }
    if (last < first) return {};
    return {static_cast<std::size_t>(first), static_cast<std::size_t>(last - first + 1)};
}

// Of a node of level i of the part.
bool PartMeasurement::is_made(int i, int row, int column) const {
    const int up = top_level_ - base_ - i;
    return nodes_.made().has(nodes_.first_row() + (row >> up), nodes_.first_column() + (column >> up));
}

// Of each level the nodes that those above ask for: below them, and beside these.
void PartMeasurement::choose_nodes() {
    for (int i = top_level_ - base_; i >= 0; --i) {
        PartLevel& level = levels_[static_cast<std::size_t>(i)];
        const LevelGrid nodes = level_grid(part_.grid, i);
        level.rows = nodes.row.nodes();
        level.columns = nodes.column.nodes();
        for (int row = 0; row < level.rows; ++row)
            for (int column = 0; column < level.columns; ++column) {
                bool asked = false;
                if (i == top_level_ - base_) {
                    asked = nodes_.exact().has(nodes_.first_row() + row, nodes_.first_column() + column);
                } else {
                    const PartLevel& above = levels_[static_cast<std::size_t>(i + 1)];
                    for (int r = (row - 1) >> 1; r <= (row + 1) >> 1; ++r)
                        for (int c = (column - 1) >> 1; c <= (column + 1) >> 1; ++c)
                            asked = asked || (above.has(r, c) && above.is_measured[above.at(r, c)] != 0);
                }
                level.is_measured.push_back(asked ? 1 : 0);
            }
    }
}

void PartMeasurement::make_posts() {
    const PostGrid& grid = region_.grid;
    const double per_deg = std::ldexp(grid.lat.posts_per_deg, -base_);
    part_.grid.lat = {per_deg, grid.lat.at_deg(down_.start), 0, -1, down_.count};
    part_.grid.lon = {per_deg, grid.lon.at_deg(across_.start), 0, 1, across_.count};
    part_.undulation = region_.undulation;
    std::vector<MadeColumn> columns;
    for (int i = 0; i < across_.count; ++i)
        columns.push_back(
            made_column(region_.terrain.west + across_.region_post(i), region_.terrain.posts_per_deg));
    part_.H_m.resize(static_cast<std::size_t>(down_.count) * columns.size());
    if (base_ > 0) coarse_steps_.resize(part_.H_m.size());
    const std::size_t base = std::min(static_cast<std::size_t>(base_), region_.bounds().size() - 1);
    const std::uint32_t coarse_octaves =
        base_ > 0 ? region_.bounds()[base].coarse_octaves : no_coarse_octaves;
    std::vector<int> rows;
    for (int row = 0; row < down_.count; ++row) rows.push_back(down_.region_post(row));
    const auto by_maker = steps_of_maker(region_, rows, columns, coarse_octaves);
    in_parallel(down_.count, threads_, [&](int row) {
        const MadeSpan made = made_span(row);
        const std::size_t first = static_cast<std::size_t>(row) * columns.size() + made.first;
        const std::span<float> H_m = std::span(part_.H_m).subspan(first, made.count);
        const auto places = std::span<const MadeColumn>(columns).subspan(made.first, made.count);
        if (base_ == 0 && !by_maker) return made_posts_of_row(region_, down_.region_post(row), places, H_m);
        std::vector<std::int32_t> steps(made.count), coarse(base_ > 0 ? made.count : 0);
        if (by_maker) {
            std::ranges::copy(by_maker->all.subspan(first, steps.size()), steps.begin());
            if (base_ > 0) std::ranges::copy(by_maker->coarse.subspan(first, coarse.size()), coarse.begin());
        } else {
            made_row_coarse_heights(region_.terrain, region_.rule, down_.region_post(row), places,
                                    coarse_octaves, steps, coarse);
        }
        for (std::size_t i = 0; i < steps.size(); ++i) {
            H_m[i] = static_cast<float>(static_cast<double>(steps[i]) * made_step_m);
            // Until heights are drawn: how much higher the coarse octaves are than all.
            if (base_ > 0) coarse_steps_[first + i] = coarse[i] - steps[i];
        }
    });
}

void PartMeasurement::take_ranges(int i, PartLevel& level) const {
    level.ranges.resize(static_cast<std::size_t>(level.rows) * static_cast<std::size_t>(level.columns));
    in_parallel(level.rows, threads_, [&](int row) {
        for (int column = 0; column < level.columns; ++column) {
            if (!is_made(i, row, column)) continue;
            NodeRange& range = level.ranges[level.at(row, column)];
            if (i == 0) {
                take_posts(row, column, range);
                continue;
            }
            const PartLevel& below = levels_[static_cast<std::size_t>(i - 1)];
            for (int r = 2 * row; r < std::min(2 * row + 2, below.rows); ++r)
                for (int c = 2 * column; c < std::min(2 * column + 2, below.columns); ++c)
                    range.take(below.ranges[below.at(r, c)]);
        }
    });
}

// Of a node of the level that is measured against.
void PartMeasurement::take_posts(int row, int column, NodeRange& range) const {
    for (int r = row * node_quads; r <= std::min((row + 1) * node_quads, down_.count - 1); ++r) {
        const std::size_t first = static_cast<std::size_t>(r) * static_cast<std::size_t>(across_.count);
        for (int c = column * node_quads; c <= std::min((column + 1) * node_quads, across_.count - 1); ++c) {
            const std::size_t at = first + static_cast<std::size_t>(c);
            const float H_m = part_.H_m[at];
            const std::int32_t steps = heights_.steps[at];
            const float coarse_m =
                base_ > 0 ? H_m + static_cast<float>(height_step_m * (coarse_steps_[at] - steps)) : H_m;
            range.take({H_m, H_m, steps, steps, coarse_m, coarse_m});
        }
    }
}

// What may be over a node's ground and that of its neighbours, between the part's posts, too.
void PartMeasurement::look_around(PartLevel& level) const {
    level.may_cut.resize(level.ranges.size());
    level.rise_m.resize(level.ranges.size());
    // Of all levels that blocks below are measured against: so that none of these finds more.
    double off_m = 0.0, cut_off_m = 0.0;
    for (int of = base_; of > 0; of -= levels_of_block) {
        const MadeLevelBound& base = region_.bounds()[static_cast<std::size_t>(of)];
        off_m += base.rule.free;
        cut_off_m += base.triangles.cut;
    }
    const double low_m = made_step_m * region_.terrain.low, high_m = made_step_m * region_.terrain.high;
    const double whole_m = high_m - low_m + region_.undulation_range_m;
    for (int row = 0; row < level.rows; ++row) {
        for (int column = 0; column < level.columns; ++column) {
            NodeRange range;
            bool all = true;
            for (int r = row - 1; r <= row + 1; ++r)
                for (int c = column - 1; c <= column + 1; ++c) {
                    if (level.has(r, c))
                        range.take(level.ranges[level.at(r, c)]);
                    else
                        all = all && !goes_on(level, r, c);
                }
            const bool may_cut = !all || static_cast<double>(range.highest_H_m) + off_m >= high_m ||
                                 static_cast<double>(range.lowest_H_m) - off_m <= low_m;
            const double rise_m = height_step_m * (static_cast<double>(range.highest) - range.lowest) +
                                  4.0 * (may_cut ? cut_off_m : 1.2 * off_m);
            level.may_cut[level.at(row, column)] = may_cut ? 1 : 0;
            level.rise_m[level.at(row, column)] = all ? std::min(rise_m, whole_m) : whole_m;
        }
    }
}

// Lod spheres: of the level that is measured against by its rises alone, of the others around those below.
void PartMeasurement::hold_spheres(int i, PartLevel& level) const {
    const double whole_m =
        made_step_m * (region_.terrain.high - region_.terrain.low) + region_.undulation_range_m;
    for (int row = 0; row < level.rows; ++row)
        for (int column = 0; column < level.columns; ++column) {
            const double rise_m = level.rise_m[level.at(row, column)];
            if (i == 0) {
                level.lod_radius_m.push_back(lod_radius_of_rise_m(region_, base_, rise_m));
                continue;
            }
            const PartLevel& below = levels_[static_cast<std::size_t>(i - 1)];
            double largest_m = 0.0;
            for (int r = 2 * row - 1; r <= 2 * row + 2; ++r)
                for (int c = 2 * column - 1; c <= 2 * column + 2; ++c)
                    if (below.has(r, c))
                        largest_m = std::max(largest_m, below.lod_radius_m[below.at(r, c)]);
                    else if (goes_on(below, r, c))
                        largest_m =
                            std::max(largest_m, lod_radius_of_rise_m(region_, base_ + i - 1, whole_m));
            level.lod_radius_m.push_back(largest_m + way_between_m(region_, base_ + i, rise_m));
        }
}

// Of the nodes of the level before that a node must not be better than (LevelBuilder::visit_nodes_below), and
// of their triangles that are stitched to it.
double PartMeasurement::error_below_m(int i, int row, int column) const {
    const PartLevel& below = level(i - 1);
    const double unknown_m = block_growth * bound(i - 1, level(i), row).drawn.cut;
    double error_m = 0.0;
    constexpr std::size_t north_edge = 0, east_edge = 1, south_edge = 2, west_edge = 3, no_edge = 4;
    const auto take = [&](int r, int c, std::size_t edge) {
        if (!below.has(r, c)) {
            if (goes_on(below, r, c)) error_m = std::max(error_m, unknown_m);
            return;
        }
        const std::size_t at = below.at(r, c);
        error_m = std::max(error_m, block_growth * below.error_m[at]);
        if (edge != no_edge) error_m = std::max(error_m, below.stitched_m[at][edge] + height_slack_m);
    };
    for (int r = 2 * row; r < 2 * row + 2; ++r) {
        for (int c = 2 * column; c < 2 * column + 2; ++c) take(r, c, no_edge);
        take(r, 2 * column - 1, east_edge);
        take(r, 2 * column + 2, west_edge);
    }
    for (int c = 2 * column; c < 2 * column + 2; ++c) {
        take(2 * row - 1, c, south_edge);
        take(2 * row + 2, c, north_edge);
    }
    return error_m;
}

// Edges of a node at which other nodes than those of its parent are, as NodeDeviations::edges().
std::uint32_t outer_edges_of(int row, int column) {
    return (row % 2 == 0 ? gpu::edge_north : gpu::edge_south) |
           (column % 2 == 0 ? gpu::edge_west : gpu::edge_east);
}

// The degree from the equator that nothing of a row of nodes, or within a node's width of it, is nearer than.
void PartMeasurement::find_latitudes(int i, PartLevel& level) const {
    const int width = node_quads << i;
    for (int row = 0; row < level.rows; ++row) {
        const auto lat_deg = [&](int post) { return part_.grid.lat.at_deg(post); };
        const double north_deg = lat_deg((row - 1) * width), south_deg = lat_deg((row + 2) * width);
        const double nearest_deg = std::max({0.0, south_deg, -north_deg});
        level.from_deg.push_back(static_cast<std::size_t>(std::clamp(
            std::floor(nearest_deg), 0.0, static_cast<double>(region_.bounds_from_deg.size() - 1))));
    }
}

bool PartMeasurement::ends_oddly(int i, int row, int column) const {
    const int of_level = base_ + i;
    const LevelGrid all = level_grid(region_.grid, of_level);
    return (row + down_.first_node(of_level) == all.row.nodes() - 1 &&
            ends_within_quad(down_.last, of_level)) ||
           (column + across_.first_node(of_level) == all.column.nodes() - 1 &&
            ends_within_quad(across_.last, of_level));
}

// How far heights of a node may be beyond the lowest and the highest one, where they are cut off. Cutting off
// moves neither the triangles nor what they are compared with by more.
double PartMeasurement::most_cut_off_m(const PartLevel& level, int row, int column) const {
    const NodeRange& range = level.ranges[level.at(row, column)];
    const double off_m = bound(0, level, row).coarse + 0.01;
    const double low_m = made_step_m * region_.terrain.low, high_m = made_step_m * region_.terrain.high;
    return std::max(0.0, static_cast<double>(range.highest_coarse_m) + off_m - high_m) +
           std::max(0.0, low_m - static_cast<double>(range.lowest_coarse_m) + off_m);
}

PartMeasurement::Found PartMeasurement::found_at(int i, const PartLevel& level, int row, int column,
                                                 const NodeDeviations& deviations,
                                                 const CoarseDeviations* coarse) const {
    Found least;
    least.own_m = std::numeric_limits<double>::infinity();
    least.stitched_m.fill(least.own_m);
    const auto take = [&least](double own_m, const PerEdge& stitched_m, double rest_m) {
        least.own_m = std::min(least.own_m, own_m + rest_m);
        for (std::size_t edge = 0; edge < 4; ++edge)
            least.stitched_m[edge] = std::min(least.stitched_m[edge], stitched_m[edge] + rest_m);
    };
    // Nodes are stitched to those beside their parents alone, and nobody asks for those of the top level.
    const bool is_top = i + 1 == static_cast<int>(levels_.size());
    const std::uint32_t outer_edges = is_top ? 0U : outer_edges_of(row, column);
    const bool by_coarse = coarse != nullptr && !ends_oddly(i, row, column);
    const double cut_off_m = by_coarse ? most_cut_off_m(level, row, column) : 0.0;
    if (by_coarse)
        take(i > 0 ? coarse->own_m(row, column) : 0.0,
             coarse->stitched_m(row, column, deviations.edges(row, column), outer_edges),
             bound(0, level, row).coarse + bound(i, level, row).flat + cut_off_m);
    if (!by_coarse || cut_off_m > 0.0) {
        const NodeDeviation measured = deviations.deviation(row, column, outer_edges);
        const bool may_cut = level.may_cut[level.at(row, column)] != 0;
        take(measured.own_m, measured.stitched_m, bound(0, level, row).triangles.where(may_cut));
    }
    return least;
}

double PartMeasurement::node_error_m(int i, const PartLevel& level, int row, int column, double own_m) const {
    const bool may_cut = level.may_cut[level.at(row, column)] != 0;
    const MadeLevelBound& here = bound(i, level, row);
    const double most_m = here.drawn.where(may_cut);
    const int of_level = base_ + i;
    if (of_level == 0) return 0.0;
    if (ends_oddly(i, row, column)) return most_m;
    // What the others are measured against is not measured itself.
    if (i == 0) return std::min(here.own.where(may_cut), here.own.free + most_cut_off_m(level, row, column));
    const double measured_m = own_m + of_level * height_slack_m;
    return std::min(std::max(measured_m, error_below_m(i, row, column)), most_m);
}

void PartMeasurement::measure_level(int i) {
    PartLevel& level = levels_[static_cast<std::size_t>(i)];
    take_ranges(i, level);
    look_around(level);
    hold_spheres(i, level);
    find_latitudes(i, level);
    const NodeDeviations deviations(part_.grid, heights_, i);
    std::optional<CoarseDeviations> coarse;
    if (base_ > 0) coarse.emplace(part_.grid, heights_, coarse_steps_, i);
    level.error_m.resize(level.ranges.size());
    level.stitched_m.resize(level.ranges.size());
    in_parallel(level.rows, threads_, [&](int row) {
        for (int column = 0; column < level.columns; ++column) {
            if (level.is_measured[level.at(row, column)] == 0) continue;
            const Found found = found_at(i, level, row, column, deviations, coarse ? &*coarse : nullptr);
            level.stitched_m[level.at(row, column)] = found.stitched_m;
            level.error_m[level.at(row, column)] = node_error_m(i, level, row, column, found.own_m);
        }
    });
}

}  // namespace

MadeRegion made_region(const MadeTerrain& terrain, const PostGrid& grid, const UndulationField& undulation) {
    MadeRegion region{
        terrain, made_rule(terrain), grid, undulation, made_level_bounds(terrain, grid, undulation), 0.0, 0};
    double highest_m = made_step_m * terrain.high;
    if (!undulation.N_m.empty()) {
        const auto [lowest, highest] = std::ranges::minmax(undulation.N_m);
        region.undulation_range_m = static_cast<double>(highest) - static_cast<double>(lowest);
        highest_m += static_cast<double>(highest);
    }
    region.highest_steps = height_steps(highest_m) + 1;
    return region;
}

void made_posts_of_row(const MadeRegion& region, int row, std::span<const MadeColumn> columns,
                       std::span<float> H_m) {
    std::vector<std::int32_t> steps(columns.size());
    made_row_heights(region.terrain, region.rule, row, 0, columns, steps);
    // Exact: heights have at most 24 bits.
    std::ranges::transform(steps, H_m.begin(), [](std::int32_t step) {
        return static_cast<float>(static_cast<double>(step) * made_step_m);
    });
}

MadeNode unmeasured_node(const MadeRegion& region, int level) {
    const double rise_m =
        made_step_m * (region.terrain.high - region.terrain.low) + region.undulation_range_m;
    return {rounded_up(region.bounds()[static_cast<std::size_t>(level)].drawn.cut),
            rounded_up(lod_radius_of_rise_m(region, level, rise_m))};
}

int highest_measured_level(const MadeRegion& region) {
    const double first_cell_m = std::ldexp(1.0, static_cast<int>(region.rule.octave[0].shift)) / 192.0;
    const double spacing_deg = region.grid.lat.spacing_deg();
    int level = 0;
    while (level < static_cast<int>(region.bounds().size())) {
        const int next = level + levels_of_block;
        // Coarser triangles know nothing of the terrain any more; a part is no larger than a quarter turn.
        // The first block is exact, and always worth it.
        if (next > 21 || std::ldexp(spacing_deg * 144.0, next) > 90.0 ||
            (level > 0 && 3.0 * node_width_m(region, next) / node_quads > first_cell_m))
            break;
        level = next;
    }
    return level;
}

namespace {

// Nodes of a page's top level, as far as the region goes.
TopNodes nodes_of_page(const MadeRegion& region, const PageIndex& top) {
    constexpr int side = static_cast<int>(gpu::meshlets_per_side);
    const LevelGrid level = level_grid(region.grid, top.level);
    TopNodes nodes;
    nodes.first_row = top.row * side;
    nodes.first_column = top.column * side;
    nodes.rows = std::min(side, level.row.nodes() - nodes.first_row);
    nodes.columns = std::min(side, level.column.nodes() - nodes.first_column);
    return nodes;
}

// Nodes that may show, and those beside them, whose level decides how these are stitched.
TopNodes shown_nodes(const MadeRegion& region, const PageIndex& top, const BlockPicture& picture) {
    const LevelGrid level = level_grid(region.grid, top.level);
    TopNodes nodes = nodes_of_page(region, top);
    TopNodes shown{nodes.first_row - 1, nodes.first_column - 1, nodes.rows + 2, nodes.columns + 2, {}};
    shown.fill([&](int row, int column) {
        if (row < 0 || row >= level.row.nodes()) return false;
        // Round the Earth the other side is beside.
        if (column < 0 || column >= level.column.nodes()) return region.grid.wraps_longitude();
        return picture.may_show(row, column);
    });
    nodes.fill([&](int row, int column) {
        return shown.has_beside(row, column) || (picture.may_cast && picture.may_cast(row, column));
    });
    return nodes;
}

// The bounds of levels where a page is nearest to a pole: none that holds for a node of it is smaller.
const std::vector<MadeLevelBound>& least_bounds(const MadeRegion& region, const PageIndex& top) {
    const LevelAxis rows = level_grid(region.grid, top.level).row;
    const auto lat_deg = [&](int page_row) {
        return std::abs(
            region.grid.lat.at_deg(rows.region_post(page_row * static_cast<int>(gpu::page_quads))));
    };
    const auto from_deg = static_cast<std::size_t>(std::max(lat_deg(top.row), lat_deg(top.row + 1)));
    return region.bounds_from_deg[std::min(from_deg, region.bounds_from_deg.size() - 1)];
}

// Roughly the least error that a node of a page has by posts of a base level: what is not measured there.
MadeNode least_node(const MadeRegion& region, const PageIndex& top, int base) {
    const auto& levels = least_bounds(region, top);
    return {static_cast<float>(levels[std::min(static_cast<std::size_t>(base), levels.size() - 1)].coarse),
            0.0F};
}

// Nodes of a page that a picture needs exactly: those that are not sure to be bad, and that fewer posts do
// not prove to be good. bad: gets the first. good: gets those that they do prove to be.
template <class Bad, class Good>
TopNodes undecided_nodes(const MadeRegion& region, int threads, const BlockPicture& picture,
                         const PageIndex& top, TopNodes wanted, const Bad& bad, const Good& good) {
    const double least_m = least_error_m(region, top);
    if (least_m > 0.0)
        wanted.fill([&, before = wanted](int row, int column) {
            if (!before.has(row, column)) return false;
            if (!picture.is_bad(row, column, least_m)) return true;
            bad(row, column, least_m);
            return false;
        });
    const int against = measured_against(top.level);
    for (int base = std::min(against + 2, top.level - 1); base > against; --base) {
        // Posts that cannot prove anything are not made.
        const MadeNode least = least_node(region, top, base);
        TopNodes asked = wanted;
        asked.fill([&](int row, int column) {
            return wanted.has(row, column) && picture.is_good(row, column, least);
        });
        const BlockNodes nodes(region, top.level, asked);
        if (nodes.empty()) continue;
        const PartMeasurement measured(region, top.level, base, nodes, threads);
        wanted.fill([&, before = wanted](int row, int column) {
            if (!before.has(row, column)) return false;
            if (!asked.has(row, column)) return true;
            const MadeNode node = measured.node(top.level, row, column);
            if (!picture.is_good(row, column, node)) return true;
            good(row, column, node);
            return false;
        });
    }
    return wanted;
}

}  // namespace

// What no node of a page's block has an error below, whatever is measured: what lies between the posts that
// it is measured against, or what bounds it where less is known (PartMeasurement::found_at()).
double least_error_m(const MadeRegion& region, const PageIndex& top) {
    const int against = measured_against(top.level);
    if (against == 0) return 0.0;
    const auto& levels = least_bounds(region, top);
    const auto of = [&](int level) -> const MadeLevelBound& {
        return levels[std::min(static_cast<std::size_t>(level), levels.size() - 1)];
    };
    const MadeLevelBound& base = of(against);
    const MadeLevelBound& lowest = of(top.level - levels_of_block + 1);
    return 0.9999 * std::min({base.coarse, base.triangles.free, base.triangles.cut, lowest.drawn.free,
                              lowest.drawn.cut});
}

void MeasuredBlock::make_levels(const MadeRegion& region) {
    for (int level = top_.level; level > top_.level - levels_of_block; --level) {
        Level& kept = levels_.emplace_back();
        const int side = static_cast<int>(gpu::meshlets_per_side) << (top_.level - level);
        const LevelGrid all = level_grid(region.grid, level);
        kept.first_row = top_.row * side;
        kept.first_column = top_.column * side;
        kept.rows = std::min(side, all.row.nodes() - kept.first_row);
        kept.columns = std::min(side, all.column.nodes() - kept.first_column);
        kept.nodes.resize(static_cast<std::size_t>(kept.rows) * static_cast<std::size_t>(kept.columns));
    }
    is_exact_.resize(levels_.front().nodes.size());
}

template <class Asked>
void MeasuredBlock::set_below(int top_row, int top_column, const Asked& asked) {
    for (std::size_t down = 0; down < levels_.size(); ++down) {
        Level& level = levels_[down];
        const int side = 1 << down;
        const int last_row = std::min((top_row + 1) * side, level.first_row + level.rows);
        const int last_column = std::min((top_column + 1) * side, level.first_column + level.columns);
        for (int row = top_row * side; row < last_row; ++row)
            for (int column = top_column * side; column < last_column; ++column)
                level.at(row, column) = asked(top_.level - static_cast<int>(down), row, column);
    }
}

template <class Asked>
void MeasuredBlock::set_exact(int top_row, int top_column, const Asked& asked) {
    is_exact_[levels_.front().number_of(top_row, top_column)] = 1;
    set_below(top_row, top_column, asked);
}

MeasuredBlock::MeasuredBlock(const MadeRegion& region, const PageIndex& top, int threads,
                             const BlockPicture* picture, const MeasuredBlock* known)
    : top_(top) {
    make_levels(region);
    TopNodes exact = nodes_of_page(region, top);
    exact.fill([](int, int) { return true; });
    if (picture != nullptr) exact = shown_nodes(region, top, *picture);
    if (known != nullptr)
        exact.fill([&, wanted = exact](int row, int column) {
            if (!known->is_exact(row, column)) return wanted.has(row, column);
            set_exact(row, column, [known](int level, int r, int c) { return known->node(level, r, c); });
            return false;
        });
    if (picture != nullptr)
        exact = undecided_nodes(
            region, threads, *picture, top, std::move(exact),
            [&](int row, int column, double error_m) {
                set_below(row, column, [&](int level, int, int) {
                    // What light passes must not be higher than it is known to be.
                    return MadeNode{picture->may_cast ? unmeasured_node(region, level).error_m
                                                      : static_cast<float>(error_m),
                                    0.0F};
                });
            },
            [&](int row, int column, const MadeNode& node) {
                if (picture->may_cast)
                    set_below(row, column, [&](int, int, int) { return MadeNode{node.error_m, 0.0F}; });
                levels_.front().at(row, column) = node;
            });
    const BlockNodes nodes(region, top.level, std::move(exact));
    if (nodes.empty()) return;
    const PartMeasurement measured(region, top.level, measured_against(top.level), nodes, threads);
    const Level& all = levels_.front();
    for (int row = all.first_row; row < all.first_row + all.rows; ++row)
        for (int column = all.first_column; column < all.first_column + all.columns; ++column)
            if (nodes.exact().has(row, column))
                set_exact(row, column, [&](int level, int r, int c) { return measured.node(level, r, c); });
}

std::uint64_t MeasuredBlock::bytes() const {
    std::uint64_t nodes = 0;
    for (const Level& level : levels_) nodes += level.nodes.size();
    return nodes * sizeof(MadeNode) + is_exact_.size() + sizeof(MeasuredBlock);
}

}  // namespace oro
