#include "core/cluster_windows/begun_graph.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "core/base/parallel.h"

namespace oro {
namespace {

constexpr std::size_t groups_at_a_time = 512;

void widen(PlaneBox& box, const PlaneBox& by) {
    box = {std::min(box.first_row, by.first_row), std::max(box.last_row, by.last_row),
           std::min(box.first_column, by.first_column), std::max(box.last_column, by.last_column)};
}

// The window with as many posts more as groups need; its own ones and its open sides stay.
RegionWindow widened(RegionWindow window, const PlaneBox& extent) {
    window.window.first_row = static_cast<int>(extent.first_row / leaf_side * leaf_side);
    window.window.first_column = static_cast<int>(extent.first_column / leaf_side * leaf_side);
    window.rows = static_cast<int>(extent.last_row) - window.window.first_row + 1;
    window.columns = static_cast<int>(extent.last_column) - window.window.first_column + 1;
    return window;
}

// Where a window ends and the region goes on, nothing beyond it is known.
bool is_within(const PlaneBox& extent, const RegionWindow& window) {
    const PlaneBox box = window.box();
    return (!window.window.north_open || extent.first_row >= box.first_row) &&
           (!window.window.south_open || extent.last_row <= box.last_row) &&
           (!window.window.west_open || extent.first_column >= box.first_column) &&
           (!window.window.east_open || extent.last_column <= box.last_column);
}

class Beginning {
  public:
    Beginning(const JoinedWindows& joined, const PostCounts& region) : joined_(joined), region_(region) {
        begun_.graph.levels = joined.levels();
    }

    // Groups of a box, and whether each is whole.
    Result<BegunGraph> take(const std::vector<std::uint32_t>& numbers, const RegionWindow& window,
                            int threads) {
        begun_.window = window;
        PlaneBox extent = window.box();
        for (const std::uint32_t number : numbers) widen(extent, joined_.group(number).extent);
        begun_.window = widened(window, extent);
        for (std::size_t first = 0; first < numbers.size(); first += groups_at_a_time) {
            std::vector<GroupPart> parts(std::min(groups_at_a_time, numbers.size() - first));
            std::vector<Result<void>> read(parts.size());
            in_parallel(static_cast<int>(parts.size()), threads, [&](int i) {
                const auto at = static_cast<std::size_t>(i);
                read[at] = joined_.read(numbers[first + at], parts[at]);
            });
            for (std::size_t i = 0; i < parts.size(); ++i) {
                ORO_CHECK(read[i]);
                parts[i].group.complete = is_within(joined_.group(numbers[first + i]).extent, window);
                add(numbers[first + i], parts[i]);
            }
        }
        number_vertices();
        return std::move(begun_);
    }

  private:
    void add(std::uint32_t number, GroupPart& part) {
        ClusterGraph& graph = begun_.graph;
        const auto maker = static_cast<std::uint32_t>(graph.groups.size());
        part.group.first_made = static_cast<std::uint32_t>(graph.clusters.size());
        part.group.members = 0;
        for (Cluster cluster : part.made) {
            cluster.first_triangle += static_cast<std::uint32_t>(graph.triangles.size());
            cluster.made_by = maker;
            cluster.used_by = no_group;
            graph.clusters.push_back(cluster);
        }
        for (VertexTriangle triangle : part.triangles) {
            for (VertexNumber& vertex : triangle) {
                const SurfaceVertex place = region_.place(vertex);
                vertex = begun_.posts().number(place.row - begun_.window.window.first_row,
                                               place.column - begun_.window.window.first_column);
            }
            graph.triangles.push_back(triangle);
        }
        graph.groups.push_back(part.group);
        begun_.tiles.push_back(joined_.group(number).tile);
        begun_.triangles_in.push_back(joined_.group(number).triangles_in);
    }

    // In the order that they have among all posts of the window.
    void number_vertices() {
        constexpr std::size_t word = 64;
        const std::size_t posts =
            static_cast<std::size_t>(begun_.window.rows) * static_cast<std::size_t>(begun_.window.columns);
        std::vector<std::uint64_t> used(posts / word + 1);
        for (const VertexTriangle& triangle : begun_.graph.triangles)
            for (const VertexNumber vertex : triangle)
                used[vertex / word] |= std::uint64_t{1} << vertex % word;
        std::vector<VertexNumber> before(used.size());
        VertexNumber count = 0;
        for (std::size_t i = 0; i < used.size(); ++i) {
            before[i] = count;
            count += static_cast<VertexNumber>(std::popcount(used[i]));
        }
        begun_.vertices.reserve(count);
        for (std::size_t i = 0; i < used.size(); ++i)
            for (std::uint64_t rest = used[i]; rest != 0; rest &= rest - 1)
                begun_.vertices.push_back(
                    static_cast<VertexNumber>(i * word + static_cast<std::size_t>(std::countr_zero(rest))));
        for (VertexTriangle& triangle : begun_.graph.triangles)
            for (VertexNumber& vertex : triangle)
                vertex = before[vertex / word] +
                         static_cast<VertexNumber>(
                             std::popcount(used[vertex / word] & ((std::uint64_t{1} << vertex % word) - 1)));
    }

    const JoinedWindows& joined_;
    const PostCounts region_;
    BegunGraph begun_;
};

}  // namespace

Result<BegunGraph> begun_graph(const JoinedWindows& joined, const PostCounts& region, int threads) {
    const PlaneBox all{0, std::int64_t{region.rows} - 1, 0, std::int64_t{region.columns} - 1};
    return begun_graph_in(joined, region, {{}, region.rows, region.columns, all}, threads);
}

Result<BegunGraph> begun_graph_in(const JoinedWindows& joined, const PostCounts& region,
                                  const RegionWindow& window, int threads) {
    std::vector<std::uint32_t> numbers;
    const std::size_t last = joined.levels().size();
    for (std::uint32_t i = joined.first_group(std::max<std::size_t>(last - 1, 1)); i < joined.groups(); ++i)
        if (joined.group(i).extent.meets(window.box())) numbers.push_back(i);
    return Beginning(joined, region).take(numbers, window, threads);
}

}  // namespace oro
