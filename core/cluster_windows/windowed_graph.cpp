#include "core/cluster_windows/windowed_graph.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <memory>
#include <utility>
#include <vector>

#include "core/base/checksum.h"
#include "core/base/parallel.h"
#include "core/cluster_windows/joined_windows.h"
#include "core/cluster_windows/window_groups.h"
#include "core/clusters/graph_builder.h"
#include "core/surface/vertex_subset.h"

namespace oro {
namespace {

std::int32_t highest_steps_of(const HeightField& field, int threads) {
    std::vector<std::int32_t> highest(static_cast<std::size_t>(field.grid.rows()), void_height_steps);
    in_parallel(field.grid.rows(), threads, [&](int row) {
        std::int32_t& of_row = highest[static_cast<std::size_t>(row)];
        for (int column = 0; column < field.grid.columns(); ++column)
            if (!is_void(field.H_at_post_m(row, column)))
                of_row = std::max(of_row, height_steps(drawn_h_m(field, row, column, 1.0)));
    });
    return *std::ranges::max_element(highest);
}

// As the last two levels of windows have them: what the builder needs to go on, with vertices numbered anew.
struct BegunGraph {
    ClusterGraph graph;
    std::vector<VertexNumber> vertices;  // of the region, rising
    std::uint32_t first_group{};         // of the region's graph, where this one's begin
    std::uint32_t first_cluster{};       // likewise
};

// What was to be built, of what.
std::uint64_t plan_of(const WindowedBake& how, const PostGrid& grid, std::size_t number) {
    const std::array<std::uint64_t, 7> facts{how.fingerprint,
                                             static_cast<std::uint64_t>(grid.rows()),
                                             static_cast<std::uint64_t>(grid.columns()),
                                             how.sizes.posts,
                                             static_cast<std::uint64_t>(how.sizes.levels),
                                             xxh64(std::as_bytes(std::span(&how.sizes.kept_share, 1))),
                                             number};
    return xxh64(std::as_bytes(std::span(facts)), 2);
}

// What a broken-off bake left behind may be replaced; what anybody else has under that name stays.
Result<void> check_path_of_window(const std::string& path) {
    for (const std::string& name : {path, path + ".partial"}) {
        const Result<OpenFile> file = OpenFile::open(name, OpenFile::Use::read);
        if (!file.ok()) continue;
        ORO_TRY(const bool ours, begins_as_window(*file));
        if (!ours)
            return Error{ErrorKind::failed, name,
                         "is there already, and no bake has left it behind; move it away, or choose another "
                         "name for the region"};
    }
    return {};
}

// Builds a window unless its file is there; with wider margins where what it answers for asks for them.
Result<WindowFile> window_file(const WindowedRegion& region, const WindowedBake& how, std::size_t number) {
    constexpr int attempts = 4;
    const std::string path = path_of_window(how.path, number);
    const PostGrid& grid = region.field.grid;
    const std::uint64_t plan = plan_of(how, grid, number);
    ORO_CHECK(check_path_of_window(path));
    Result<WindowFile> found = WindowFile::open(path);
    if (found.ok() && found->index().plan == plan) return found;
    WindowSizes sizes = how.sizes;
    for (int i = 0; i < attempts; ++i, sizes.widened *= 1.5) {
        const RegionWindow window = windows_of(grid.rows(), grid.columns(), sizes)[number];
        ORO_TRY(const bool done, build_window(region, window, plan, path));
        if (done) return WindowFile::open(path);
    }
    return Error{ErrorKind::failed, how.path, "a window's groups depend on ground that is too far away"};
}

Result<std::vector<WindowFile>> all_windows(const WindowedRegion& region, const WindowedBake& how) {
    const PostGrid& grid = region.field.grid;
    const std::size_t count = windows_of(grid.rows(), grid.columns(), how.sizes).size();
    std::vector<WindowFile> windows;
    for (std::size_t i = 0; i < count; ++i) {
        if (how.progress) how.progress(static_cast<double>(i) / static_cast<double>(count));
        ORO_TRY(WindowFile window, window_file(region, how, i));
        windows.push_back(std::move(window));
    }
    return windows;
}

Result<BegunGraph> begun_of(const JoinedWindows& joined) {
    BegunGraph begun;
    begun.graph.levels = joined.levels();
    const std::size_t last = begun.graph.levels.size();
    begun.first_group = joined.first_group(last - 1);
    begun.first_cluster = joined.first_made(begun.first_group);
    GroupPart part;
    for (std::uint32_t number = begun.first_group; number < joined.groups(); ++number) {
        ORO_CHECK(joined.read(number, part));
        ClusterGroup group = part.group;
        group.first_made = static_cast<std::uint32_t>(begun.graph.clusters.size());
        group.members = 0;
        for (Cluster cluster : part.made) {
            cluster.first_triangle += static_cast<std::uint32_t>(begun.graph.triangles.size());
            cluster.made_by = number - begun.first_group;
            cluster.used_by = no_group;
            begun.graph.clusters.push_back(cluster);
        }
        begun.graph.triangles.insert(begun.graph.triangles.end(), part.triangles.begin(),
                                     part.triangles.end());
        begun.graph.groups.push_back(group);
    }
    for (const VertexTriangle& triangle : begun.graph.triangles)
        begun.vertices.insert(begun.vertices.end(), triangle.begin(), triangle.end());
    std::ranges::sort(begun.vertices);
    const auto rest = std::ranges::unique(begun.vertices);
    begun.vertices.erase(rest.begin(), rest.end());
    for (VertexTriangle& triangle : begun.graph.triangles)
        for (VertexNumber& vertex : triangle)
            vertex = static_cast<VertexNumber>(std::ranges::lower_bound(begun.vertices, vertex) -
                                               begun.vertices.begin());
    return begun;
}

// The groups of the whole graph, one by one: from windows, and above their last level from memory.
class WholeGraph {
  public:
    WholeGraph(const JoinedWindows& joined, const BegunGraph& above) : joined_(joined), above_(above) {}

    [[nodiscard]] ClusterOutline outline(const PostCounts& posts, std::uint64_t fingerprint) const {
        const ClusterGraph& graph = above_.graph;
        ClusterOutline outline;
        outline.fingerprint = fingerprint;
        outline.posts = posts;
        outline.leaves = joined_.leaves();
        outline.groups = above_.first_group + static_cast<std::uint32_t>(graph.groups.size());
        outline.clusters = above_.first_cluster + static_cast<std::uint32_t>(graph.clusters.size());
        outline.levels = graph.levels;
        for (std::size_t i = 0; i < joined_.levels().size(); ++i) {
            // What the builder counts of what it was given.
            if (i + 1 < joined_.levels().size())
                outline.levels[i].clusters_out = joined_.levels()[i].clusters_out;
        }
        outline.members = outline.clusters;
        for (const Cluster& cluster : graph.clusters)
            outline.members -= cluster.used_by == no_group && is_of_last(cluster) ? 1U : 0U;
        for (const GraphLevel& level : outline.levels) outline.triangles += level.triangles_out;
        return outline;
    }

    Result<void> read(std::uint32_t number, GroupPart& part) const {
        const std::uint32_t last = joined_.first_group(joined_.levels().size());
        if (number < last) return joined_.read(number, part);
        std::vector<std::uint32_t> members;
        std::uint32_t first_made = 0;
        const bool is_last = number < joined_.groups();
        if (is_last) {
            ORO_CHECK(joined_.read(number, part));
            members = std::move(part.members);
        }
        part = part_of(above_.graph, number - above_.first_group);
        part.number = number;
        first_made = part.group.first_made + above_.first_cluster;
        part.group.first_made = first_made;
        for (std::uint32_t& member : part.members) member += above_.first_cluster;
        if (is_last) part.members = std::move(members);
        part.group.members = static_cast<std::uint32_t>(part.members.size());
        for (Cluster& cluster : part.made) {
            cluster.made_by = number;
            if (cluster.used_by != no_group) cluster.used_by += above_.first_group;
        }
        for (VertexTriangle& triangle : part.triangles)
            for (VertexNumber& vertex : triangle) vertex = above_.vertices[vertex];
        return {};
    }

  private:
    [[nodiscard]] bool is_of_last(const Cluster& cluster) const {
        return above_.graph.groups[cluster.made_by].level == above_.graph.levels.size();
    }
    const JoinedWindows& joined_;
    const BegunGraph& above_;
};

}  // namespace

std::string path_of_window(const std::string& path, std::size_t number) {
    return path + ".window-" + std::to_string(number + 1);
}

Result<void> bake_in_windows(const HeightField& field, const WindowedBake& how) {
    const PostGrid& grid = field.grid;
    const std::shared_ptr<const CellDiagonals> diagonals = CellDiagonals::of(field, how.threads);
    const GridBounds bounds(grid, highest_steps_of(field, how.threads));
    const WindowedRegion region{field, diagonals.get(), bounds, how.sizes, how.threads};
    ORO_TRY(std::vector<WindowFile> windows, all_windows(region, how));
    const std::size_t count = windows.size();
    const PostCounts posts{grid.rows(), grid.columns()};
    ORO_TRY(const JoinedWindows joined, JoinedWindows::join(std::move(windows), posts, how.sizes.levels));
    ORO_TRY(BegunGraph begun, begun_of(joined));
    {
        DrawnHeights heights = drawn_heights(field, 1.0, how.threads);
        const GridSurface surface(heights);
        const VertexSubset subset(surface, begun.vertices);
        begun.graph = continue_cluster_graph(subset, bounds, std::move(begun.graph),
                                             {.threads = how.threads, .kept_share = how.sizes.kept_share});
    }
    const WholeGraph whole(joined, begun);
    ORO_CHECK(write_cluster_groups(
        how.path, whole.outline(posts, how.fingerprint),
        [&](std::uint32_t number, GroupPart& part) { return whole.read(number, part); }, how.overwrite,
        how.threads));
    for (std::size_t i = 0; i < count; ++i) unlink(path_of_window(how.path, i).c_str());
    return {};
}

}  // namespace oro
