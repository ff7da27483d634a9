#include "core/cluster_windows/window_groups.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/parallel.h"
#include "core/cluster_windows/window_file.h"
#include "core/clusters/graph_builder.h"
#include "core/clusters/group_assignment.h"
#include "core/surface/vertex_subset.h"

namespace oro {
namespace {

// A built window, and what of it is the window's own.
class BuiltWindow {
  public:
    // begun: null where it is built from the original on; else its graph is taken.
    BuiltWindow(const WindowedRegion& region, const RegionWindow& window, const DrawnHeights& heights,
                BegunGraph* begun)
        : region_(region), window_(window), surface_(heights, window.window) {
        const GraphOptions options{.threads = region.threads,
                                   .kept_share = region.sizes.kept_share,
                                   .last_level = region.sizes.levels,
                                   .whole_alone = true,
                                   .tiles = &tiles_};
        if (begun) {
            tiles_ = begun->tiles;
            begun_triangles_in_ = begun->triangles_in;
            vertices_ = std::move(begun->vertices);
            subset_.emplace(surface_, vertices_);
            if (!tiles_.empty())
                graph_ = continue_cluster_graph(*subset_, region.bounds, std::move(begun->graph), options);
        } else {
            graph_ = build_cluster_graph(surface_, region.bounds, options);
        }
        for (int level = 0; level < region.sizes.levels; ++level)
            tilings_.emplace_back(level + 1, region.sizes.kept_share);
    }

    [[nodiscard]] const ClusterGraph& graph() const { return graph_; }
    [[nodiscard]] const GroupTile& tile(std::uint32_t group) const { return tiles_[group]; }

    // Those of its own; nothing where one of them, or of their users, is not whole.
    [[nodiscard]] std::optional<std::vector<std::uint32_t>> own_groups() const {
        std::vector<std::uint32_t> own;
        for (std::uint32_t i = 0; i < graph_.groups.size(); ++i) {
            const ClusterGroup& group = graph_.groups[i];
            const SurfaceVertex middle = middle_of(tilings_[group.level - 1], tiles_[i],
                                                   region_.field.grid.rows(), region_.field.grid.columns());
            if (static_cast<int>(group.level) < region_.sizes.above) continue;
            if (!window_.owns(middle.row, middle.column)) continue;
            own.push_back(i);
            if (static_cast<int>(group.level) > region_.sizes.above && !group.complete) return std::nullopt;
            for (std::uint32_t j = group.first_made; j < group.first_made + group.made; ++j)
                if (!is_used_whole(graph_.clusters[j])) return std::nullopt;
        }
        return own;
    }

    [[nodiscard]] std::optional<std::vector<WindowLeaf>> own_leaves() const {
        std::vector<WindowLeaf> own;
        for (const Cluster& cluster : graph_.clusters) {
            if (cluster.made_by != no_group) break;
            // No triangle has all of its vertices on its leaf's far sides.
            SurfaceVertex first = surface_.vertex(graph_.triangles_of(cluster).front()[0]);
            for (const VertexTriangle& triangle : graph_.triangles_of(cluster)) {
                for (const VertexNumber number : triangle) {
                    const SurfaceVertex vertex = surface_.vertex(number);
                    first.row = std::min(first.row, vertex.row);
                    first.column = std::min(first.column, vertex.column);
                }
            }
            const std::int32_t row = first.row / leaf_side, column = first.column / leaf_side;
            if (!window_.owns(std::int64_t{row} * leaf_side, std::int64_t{column} * leaf_side)) continue;
            if (!is_used_whole(cluster)) return std::nullopt;
            own.push_back({row, column, tiles_[cluster.used_by]});
        }
        return own;
    }

    // As the builder counts them, of the window's own posts; of levels that it has built.
    [[nodiscard]] std::vector<WindowLocks> locks() const {
        std::vector<WindowLocks> counts(static_cast<std::size_t>(region_.sizes.levels));
        VertexLocks locks(over().vertex_count());
        std::uint32_t group = 0;
        for (std::size_t level = 0; level < graph_.levels.size(); ++level) {
            locks.begin_level();
            for (; group < graph_.groups.size() && graph_.groups[group].level == level + 1; ++group)
                see(locks, group);
            locks.end_level();
            if (static_cast<int>(level) < region_.sizes.above) continue;
            for (VertexNumber i = 0; i < over().vertex_count(); ++i) {
                if (!locks.is_locked(i)) continue;
                const SurfaceVertex place = over().vertex(i);
                if (!window_.owns(place.row, place.column)) continue;
                ++counts[level].locked;
                counts[level].twice += locks.levels(i) > 1 ? 1U : 0U;
            }
        }
        return counts;
    }

    [[nodiscard]] WindowGroup indexed_group(std::uint32_t number) const {
        const ClusterGroup& group = graph_.groups[number];
        WindowGroup indexed;
        indexed.level = group.level;
        indexed.tile = tiles_[number];
        indexed.made = group.made;
        indexed.error_m = group.error_m;
        indexed.centre = group.centre;
        indexed.radius_m = group.radius_m;
        if (number < begun_triangles_in_.size()) indexed.triangles_in = begun_triangles_in_[number];
        for (const std::uint32_t member : graph_.members_of(group))
            indexed.triangles_in += graph_.clusters[member].triangles;
        const SurfaceVertex first =
            over().vertex(graph_.triangles_of(graph_.clusters[group.first_made]).front()[0]);
        indexed.extent = {first.row, first.row, first.column, first.column};
        for (std::uint32_t i = group.first_made; i < group.first_made + group.made; ++i) {
            indexed.triangles_out += graph_.clusters[i].triangles;
            for (const VertexTriangle& triangle : graph_.triangles_of(graph_.clusters[i]))
                for (const VertexNumber vertex : triangle) widen(indexed.extent, over().vertex(vertex));
        }
        return indexed;
    }

    // With posts of the window.
    [[nodiscard]] GroupPart part(std::uint32_t number) const {
        GroupPart part = part_of(graph_, number);
        if (subset_)
            for (VertexTriangle& triangle : part.triangles)
                for (VertexNumber& vertex : triangle) vertex = vertices_[vertex];
        return part;
    }

  private:
    [[nodiscard]] const OriginalSurface& over() const {
        if (subset_) return *subset_;
        return surface_;
    }

    // What a group made has the same border as what it uses, which is not known of those that are not built
    // here.
    void see(VertexLocks& locks, std::uint32_t group) const {
        const auto see_all = [&](const Cluster& cluster) {
            for (const VertexTriangle& triangle : graph_.triangles_of(cluster))
                for (const VertexNumber vertex : triangle) locks.see(vertex, group);
        };
        const ClusterGroup& of = graph_.groups[group];
        if (group < begun_triangles_in_.size()) {
            for (std::uint32_t i = of.first_made; i < of.first_made + of.made; ++i)
                see_all(graph_.clusters[i]);
        } else {
            for (const std::uint32_t member : graph_.members_of(of)) see_all(graph_.clusters[member]);
        }
    }

    static void widen(PlaneBox& box, const SurfaceVertex& place) {
        box = {std::min<std::int64_t>(box.first_row, place.row),
               std::max<std::int64_t>(box.last_row, place.row),
               std::min<std::int64_t>(box.first_column, place.column),
               std::max<std::int64_t>(box.last_column, place.column)};
    }

    [[nodiscard]] bool is_used_whole(const Cluster& cluster) const {
        if (cluster.used_by != no_group) return graph_.groups[cluster.used_by].complete;
        return cluster.made_by != no_group &&
               static_cast<int>(graph_.groups[cluster.made_by].level) == region_.sizes.levels;
    }

    const WindowedRegion& region_;
    const RegionWindow& window_;
    GridSurface surface_;
    std::vector<VertexNumber> vertices_;  // of the subset
    std::optional<VertexSubset> subset_;
    std::vector<std::uint32_t> begun_triangles_in_;
    ClusterGraph graph_;
    std::vector<GroupTile> tiles_;
    std::vector<GroupTiling> tilings_;  // by level
};

Result<bool> write_own(const WindowedRegion& region, const RegionWindow& window, const BuiltWindow& built,
                       std::uint64_t plan, const std::string& path) {
    const auto groups = built.own_groups();
    auto leaves = built.own_leaves();
    if (!groups || !leaves) return false;
    WindowIndex index{plan,
                      {window.rows, window.columns},
                      window.window.first_row,
                      window.window.first_column,
                      std::move(*leaves),
                      {},
                      built.locks()};
    std::vector<std::vector<std::byte>> blocks(groups->size());
    in_parallel(static_cast<int>(groups->size()), region.threads, [&](int i) {
        const auto at = static_cast<std::size_t>(i);
        const GroupPart part = built.part((*groups)[at]);
        std::vector<GroupTile> users;
        for (const Cluster& cluster : part.made)
            if (cluster.used_by != no_group) users.push_back(built.tile(cluster.used_by));
        blocks[at] = window_block(part, users, index.posts);
    });
    for (const std::uint32_t group : *groups) index.groups.push_back(built.indexed_group(group));
    ORO_CHECK(write_window(path, std::move(index), blocks));
    return true;
}

}  // namespace

DrawnHeights heights_of(const WindowedRegion& region, const RegionWindow& window) {
    DrawnHeights heights;
    heights.rows = window.rows;
    heights.columns = window.columns;
    const auto columns = static_cast<std::size_t>(window.columns);
    heights.steps.resize(static_cast<std::size_t>(window.rows) * columns);
    in_parallel(window.rows, region.threads, [&](int row) {
        for (int column = 0; column < window.columns; ++column) {
            const int r = window.window.first_row + row, c = window.window.first_column + column;
            heights.steps[static_cast<std::size_t>(row) * columns + static_cast<std::size_t>(column)] =
                is_void(region.field.H_at_post_m(r, c)) ? void_height_steps
                                                        : height_steps(drawn_h_m(region.field, r, c, 1.0));
        }
    });
    if (!heights.steps.empty()) heights.highest_steps = *std::ranges::max_element(heights.steps);
    heights.diagonals = region.diagonals->part(window.window.first_row, window.window.first_column,
                                               window.rows - 1, window.columns - 1);
    return heights;
}

Result<bool> build_window(const WindowedRegion& region, const RegionWindow& window, std::uint64_t plan,
                          const std::string& path) {
    const DrawnHeights heights = heights_of(region, window);
    return write_own(region, window, BuiltWindow(region, window, heights, nullptr), plan, path);
}

Result<bool> build_window_from(const WindowedRegion& region, BegunGraph begun, std::uint64_t plan,
                               const std::string& path) {
    const DrawnHeights heights = heights_of(region, begun.window);
    const BuiltWindow built(region, begun.window, heights, &begun);
    return write_own(region, begun.window, built, plan, path);
}

}  // namespace oro
