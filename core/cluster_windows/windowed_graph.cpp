#include "core/cluster_windows/windowed_graph.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/checksum.h"
#include "core/base/parallel.h"
#include "core/cluster_windows/begun_graph.h"
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

// Counted up when the same ground comes to other groups: windows that another program left are built again.
constexpr std::uint64_t rules_of_groups = 4;

// What was to be built, of what.
std::uint64_t plan_of(const WindowedBake& how, const PostGrid& grid, const WindowSizes& sizes,
                      std::size_t number) {
    const std::array<std::uint64_t, 8> facts{how.fingerprint,
                                             static_cast<std::uint64_t>(grid.rows()),
                                             static_cast<std::uint64_t>(grid.columns()),
                                             sizes.posts,
                                             static_cast<std::uint64_t>(sizes.levels),
                                             static_cast<std::uint64_t>(sizes.above),
                                             xxh64(std::as_bytes(std::span(&sizes.kept_share, 1))),
                                             number};
    return xxh64(std::as_bytes(std::span(facts)), rules_of_groups);
}

// What a broken-off bake left behind may be replaced; what anybody else has under that name stays.
Result<void> check_path_of_window(const std::string& path) {
    for (const std::string& name : {path, path + ".partial"}) {
        const Result<OpenFile> file = OpenFile::open(name, OpenFile::Use::read);
        if (!file.ok()) continue;
        ORO_TRY(const FileBeginning begins, file_beginning(*file));
        if (begins == FileBeginning::foreign)
            return Error{ErrorKind::failed, name,
                         "is there already, and no bake has left it behind; move it away, or choose another "
                         "name for the region"};
    }
    return {};
}

// A stage of the windows, and how many windows those before it have.
struct Stage {
    WindowSizes sizes;
    std::size_t windows{};
    std::size_t before{};
};

// Those with more than one window: what one would build, it builds out of what is left in the end.
std::vector<Stage> stages_of(const WindowedBake& how, const PostGrid& grid) {
    std::vector<Stage> stages;
    std::size_t before = 0;
    int above = 0;
    for (WindowSizes sizes : how.stages) {
        sizes.above = above;
        const std::size_t windows = windows_of(grid.rows(), grid.columns(), sizes).size();
        if (windows == 1 && above > 0) break;
        stages.push_back({sizes, windows, before});
        before += windows;
        above = sizes.levels;
    }
    return stages;
}

// Builds a window unless its file is there; with wider margins where what it answers for asks for them.
// joined: of the stages before, if there are any.
Result<WindowFile> window_file(const WindowedRegion& region, const WindowedBake& how, const Stage& stage,
                               const JoinedWindows* joined, std::size_t number) {
    constexpr int attempts = 4;
    const std::string path = path_of_window(how.path, stage.before + number);
    const PostGrid& grid = region.field.grid;
    const std::uint64_t plan = plan_of(how, grid, stage.sizes, number);
    ORO_CHECK(check_path_of_window(path));
    Result<WindowFile> found = WindowFile::open(path);
    if (found.ok() && found->index().plan == plan) return found;
    WindowSizes sizes = stage.sizes;
    for (int i = 0; i < attempts; ++i, sizes.widened *= 1.5) {
        const RegionWindow window = windows_of(grid.rows(), grid.columns(), sizes)[number];
        bool done = false;
        if (joined) {
            ORO_TRY(BegunGraph begun,
                    begun_graph_in(*joined, {grid.rows(), grid.columns()}, window, region.threads));
            ORO_TRY(done, build_window_from(region, std::move(begun), plan, path));
        } else {
            ORO_TRY(done, build_window(region, window, plan, path));
        }
        if (done) return WindowFile::open(path);
    }
    return Error{ErrorKind::failed, how.path, "a window's groups depend on ground that is too far away"};
}

// Stage after stage, and all windows joined.
Result<JoinedWindows> all_windows(WindowedRegion region, const WindowedBake& how,
                                  const std::vector<Stage>& stages) {
    const PostCounts posts{region.field.grid.rows(), region.field.grid.columns()};
    const double all = static_cast<double>(stages.back().before + stages.back().windows);
    std::optional<JoinedWindows> joined;
    for (const Stage& stage : stages) {
        region.sizes = stage.sizes;
        std::vector<WindowFile> windows;
        for (std::size_t i = 0; i < stage.windows; ++i) {
            if (how.progress) how.progress(static_cast<double>(stage.before + i) / all);
            ORO_TRY(WindowFile window, window_file(region, how, stage, joined ? &*joined : nullptr, i));
            windows.push_back(std::move(window));
        }
        if (joined) {
            std::vector<WindowFile> before = std::move(*joined).take_windows();
            std::ranges::move(before, std::back_inserter(windows));
        }
        ORO_TRY(JoinedWindows more, JoinedWindows::join(std::move(windows), posts, stage.sizes.levels));
        joined.emplace(std::move(more));
    }
    return std::move(*joined);
}

// So little ground that it is one group on one of these levels, or cannot be made coarser: that is nothing a
// window could know.
bool ends_within(const std::vector<GraphLevel>& levels) {
    int without_progress = 0;
    return std::ranges::any_of(levels, [&](const GraphLevel& level) {
        without_progress = level.triangles_out < level.triangles_in ? 0 : without_progress + 1;
        return level.triangles_in <= one_group_triangles || without_progress >= most_without_progress;
    });
}

Result<void> bake_in_one_go(const HeightField& field, const GridBounds& bounds, const WindowedBake& how) {
    const DrawnHeights heights = drawn_heights(field, 1.0, how.threads);
    const GridSurface surface(heights);
    const ClusterGraph graph = build_cluster_graph(
        surface, bounds, {.threads = how.threads, .kept_share = how.stages.front().kept_share});
    return write_cluster_graph(how.path, graph, {heights.rows, heights.columns}, how.fingerprint,
                               how.overwrite, how.threads);
}

// The groups of the whole graph, one by one: from windows, and above their last level from memory.
class WholeGraph {
  public:
    // above: from the last two levels of windows on.
    WholeGraph(const JoinedWindows& joined, const BegunGraph& above)
        : joined_(joined),
          above_(above),
          first_group_(joined.first_group(std::max<std::size_t>(joined.levels().size(), 2) - 1)),
          first_cluster_(joined.first_made(first_group_)) {}

    [[nodiscard]] ClusterOutline outline(const PostCounts& posts, std::uint64_t fingerprint) const {
        const ClusterGraph& graph = above_.graph;
        ClusterOutline outline;
        outline.fingerprint = fingerprint;
        outline.posts = posts;
        outline.leaves = joined_.leaves();
        outline.groups = first_group_ + static_cast<std::uint32_t>(graph.groups.size());
        outline.clusters = first_cluster_ + static_cast<std::uint32_t>(graph.clusters.size());
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
        part = part_of(above_.graph, number - first_group_);
        part.number = number;
        first_made = part.group.first_made + first_cluster_;
        part.group.first_made = first_made;
        for (std::uint32_t& member : part.members) member += first_cluster_;
        if (is_last) part.members = std::move(members);
        part.group.members = static_cast<std::uint32_t>(part.members.size());
        for (Cluster& cluster : part.made) {
            cluster.made_by = number;
            if (cluster.used_by != no_group) cluster.used_by += first_group_;
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
    const std::uint32_t first_group_;    // of the region's graph, where `above_` begins
    const std::uint32_t first_cluster_;  // likewise
};

// The levels above those of windows, and the file.
Result<void> finish(const HeightField& field, const GridBounds& bounds, const JoinedWindows& joined,
                    const WindowedBake& how) {
    const PostCounts posts{field.grid.rows(), field.grid.columns()};
    ORO_TRY(BegunGraph begun, begun_graph(joined, posts, how.threads));
    {
        const DrawnHeights heights = drawn_heights(field, 1.0, how.threads);
        const GridSurface surface(heights);
        const VertexSubset subset(surface, begun.vertices);
        begun.graph =
            continue_cluster_graph(subset, bounds, std::move(begun.graph),
                                   {.threads = how.threads, .kept_share = how.stages.front().kept_share});
    }
    const WholeGraph whole(joined, begun);
    return write_cluster_groups(
        how.path, whole.outline(posts, how.fingerprint),
        [&](std::uint32_t number, GroupPart& part) { return whole.read(number, part); }, how.overwrite,
        how.threads);
}

}  // namespace

std::string path_of_window(const std::string& path, std::size_t number) {
    return path + ".window-" + std::to_string(number + 1);
}

Result<void> bake_in_windows(const HeightField& field, const WindowedBake& how) {
    const PostGrid& grid = field.grid;
    const std::shared_ptr<const CellDiagonals> diagonals = CellDiagonals::of(field, how.threads);
    const GridBounds bounds(grid, highest_steps_of(field, how.threads));
    const std::vector<Stage> stages = stages_of(how, grid);
    const WindowSizes& last = stages.back().sizes;
    if (stages.front().windows == 1) return bake_in_one_go(field, bounds, how);
    ORO_TRY(const JoinedWindows joined,
            all_windows({field, diagonals.get(), bounds, last, how.threads}, how, stages));
    ORO_CHECK(ends_within(joined.levels()) ? bake_in_one_go(field, bounds, how)
                                           : finish(field, bounds, joined, how));
    for (std::size_t i = 0; i < stages.back().before + stages.back().windows; ++i)
        unlink(path_of_window(how.path, i).c_str());
    return {};
}

Result<std::size_t> bake_windows_of_part(const HeightField& field, const WindowedBake& how,
                                         std::size_t number, std::size_t count) {
    const Stage first = stages_of(how, field.grid).front();
    if (first.windows == 1) return std::size_t{0};
    const std::shared_ptr<const CellDiagonals> diagonals = CellDiagonals::of(field, how.threads);
    const GridBounds bounds(field.grid, highest_steps_of(field, how.threads));
    const WindowedRegion region{field, diagonals.get(), bounds, first.sizes, how.threads};
    std::size_t built = 0;
    for (std::size_t i = number - 1; i < first.windows; i += count, ++built) {
        if (how.progress) how.progress(static_cast<double>(i) / static_cast<double>(first.windows));
        if (const auto window = window_file(region, how, first, nullptr, i); !window.ok())
            return window.error();
    }
    return built;
}

}  // namespace oro
