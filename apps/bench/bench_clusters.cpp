// orograph-bench-clusters: builds the cluster graph of a region file, and counts what its cuts take beside
// blocks and meshes that are as small as can be. Links core alone.
#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "apps/bench/bench_blocks.h"
#include "apps/bench/bench_tin.h"
#include "core/baked/file_pages.h"
#include "core/base/parallel.h"
#include "core/clusters/cluster_cut.h"
#include "core/clusters/graph_builder.h"
#include "core/clusters/simplify_group.h"
#include "core/surface/grid_surface.h"

namespace oro {
namespace {

struct ClustersOptions {
    std::string region;
    std::vector<double> errors_m{5.0, 10.0, 30.0, 100.0};
    int threads{1};
    double kept_share{GraphOptions{}.kept_share};
    bool references{false};
};

// User time of this process.
double processor_s() {
    rusage used{};
    getrusage(RUSAGE_SELF, &used);
    return static_cast<double>(used.ru_utime.tv_sec) + 1.0e-6 * static_cast<double>(used.ru_utime.tv_usec);
}

// The farthest that a mesh is from the full resolution at any place, metres.
double every_place_m(const DrawnHeights& heights, const std::vector<MeshTriangle>& mesh) {
    double largest_m = 0.0;
    for (const MeshTriangle& triangle : mesh)
        largest_m = std::max(largest_m, worst_place(heights, triangle).error_m);
    return largest_m;
}

// Of clusters as drawn, with the check's own reckoning.
double every_place_m(const DrawnHeights& heights, const GridSurface& surface, const ClusterGraph& graph,
                     const std::vector<std::uint32_t>& cut) {
    double largest_m = 0.0;
    for (const std::uint32_t i : cut) {
        for (const VertexTriangle& triangle : graph.triangles_of(graph.clusters[i])) {
            MeshTriangle posts;
            for (std::size_t j = 0; j < 3; ++j)
                posts[j] = {surface.vertex(triangle[j]).row, surface.vertex(triangle[j]).column};
            largest_m = std::max(largest_m, worst_place(heights, posts).error_m);
        }
    }
    return largest_m;
}

void print_levels(const ClusterGraph& graph) {
    std::printf("%5s %10s %10s %7s %9s %6s %8s %9s %7s %6s\n", "level", "triangles", "coarser", "groups",
                "clusters", "stuck", "largest", "error m", "locked", "twice");
    int number = 0;
    for (const GraphLevel& level : graph.levels)
        std::printf("%5d %10zu %10zu %7zu %9zu %6zu %8zu %9.2f %7zu %6zu\n", ++number, level.triangles_in,
                    level.triangles_out, level.groups, level.clusters_out, level.stuck_groups,
                    level.largest_group, level.largest_error_m, level.locked, level.locked_twice);
    std::size_t above = 0;
    for (const GraphLevel& level : graph.levels) above += level.triangles_out;
    std::printf("above the leaves: %zu triangles\n", above);
}

// Meshes of the whole region for an error, beside the graph's. From the largest error to the smallest; the
// collapses the other way, as they only take away.
class References {
  public:
    References(const PostGrid& grid, const RegionShape& shape, const DrawnHeights& heights)
        : heights_(heights),
          surface_(heights),
          pyramid_(build_pyramid(grid, shape, heights, 1)),
          tin_(heights),
          every_place_(heights, true) {}

    Result<void> print(double error_m) {
        const std::size_t blocks = block_mesh(pyramid_, error_m).triangles.size();
        tin_.refine(error_m);
        every_place_.refine(error_m);
        const double tin_m = every_place_m(heights_, tin_.mesh());
        const double every_m = every_place_m(heights_, every_place_.mesh());
        if (every_m > error_m) return Error{ErrorKind::failed, "TIN", "has a place that is farther off"};
        std::printf(" %10zu %10zu %8.2f %10zu %8.2f %10d", blocks, tin_.triangles(), tin_m,
                    every_place_.triangles(), every_m, collapsed(error_m));
        triangles_ = every_place_.triangles();
        return {};
    }
    [[nodiscard]] std::size_t every_place_triangles() const { return triangles_; }

  private:
    // What the same collapses leave where there are no groups.
    int collapsed(double error_m) {
        std::vector<VertexTriangle> all;
        for (const auto& leaf : surface_.leaves()) all.insert(all.end(), leaf.begin(), leaf.end());
        GroupMesh mesh;
        mesh.start(surface_, all, [](VertexNumber) { return false; });
        GroupSimplifier(surface_).simplify(mesh, {.triangles = 0, .limit = error_m / height_step_m});
        return mesh.triangles();
    }

    const DrawnHeights& heights_;
    GridSurface surface_;
    LevelPyramid pyramid_;
    GreedyTin tin_;
    GreedyTin every_place_;
    std::size_t triangles_{};
};

Result<void> print_cuts(const ClustersOptions& options, const RegionFile& file, const PostGrid& grid,
                        const DrawnHeights& heights, const ClusterGraph& graph) {
    const GridSurface surface(heights);
    std::vector<double> errors_m = options.errors_m;
    std::sort(errors_m.begin(), errors_m.end(), std::greater<>());
    std::vector<References> references;
    if (options.references) references.emplace_back(grid, file.outline().shape, heights);
    std::printf("%8s %9s %10s %8s", "error m", "clusters", "triangles", "found m");
    if (options.references)
        std::printf(" %10s %10s %8s %10s %8s %10s %12s", "blocks", "TIN posts", "found m", "TIN places",
                    "found m", "no groups", "clusters/TIN");
    std::printf("\n");
    for (const double error_m : errors_m) {
        const auto cut = cut_by_metres(graph, error_m);
        const std::size_t triangles = triangles_of_cut(graph, cut);
        const double found_m = every_place_m(heights, surface, graph, cut);
        std::printf("%8g %9zu %10zu %8.2f", error_m, cut.size(), triangles, found_m);
        if (found_m > error_m)
            return Error{ErrorKind::failed, "clusters", "have a place that is farther off"};
        for (References& reference : references) {
            ORO_CHECK(reference.print(error_m));
            std::printf(" %12.2f", static_cast<double>(triangles) /
                                       static_cast<double>(reference.every_place_triangles()));
        }
        std::printf("\n");
    }
    return {};
}

Result<void> report(const ClustersOptions& options) {
    ORO_TRY(const RegionFile file, RegionFile::open(options.region));
    if (options.references && file.outline().voids > 0)
        return Error{ErrorKind::usage, options.region, "has voids, around which a TIN cannot be compared"};
    ORO_TRY(const HeightField field, field_in_memory(file));
    const DrawnHeights heights = drawn_heights(field, 1.0, options.threads);
    const GridSurface surface(heights);
    const GridBounds bounds(field.grid, heights.highest_steps);
    const double before_s = processor_s();
    const ClusterGraph graph = build_cluster_graph(surface, bounds, {options.threads, options.kept_share});
    std::printf("%s: %d x %d posts, %.1f s of processor time\n", options.region.c_str(), heights.rows,
                heights.columns, processor_s() - before_s);
    print_levels(graph);
    return print_cuts(options, file, field.grid, heights, graph);
}

}  // namespace
}  // namespace oro

int main(int argc, char** argv) {
    CLI::App app{"Builds the cluster graph of a region, and counts the triangles of its cuts.",
                 "orograph-bench-clusters"};
    oro::ClustersOptions options;
    app.add_option("REGION", options.region, "A region file (orograph bake makes one)")->required();
    app.add_option("--errors", options.errors_m, "Largest errors, metres")
        ->delimiter(',')
        ->check(CLI::Range(0.0, 10000.0));
    app.add_option("--threads", options.threads, "Threads")->check(CLI::Range(1, 64));
    app.add_option("--kept", options.kept_share, "Share of a group's triangles that is kept")
        ->check(CLI::Range(0.1, 0.9));
    app.add_flag("--references", options.references,
                 "Count blocks, greedy triangulations (TIN) and collapses without groups, too");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        if (e.get_exit_code() == 0) return app.exit(e);
        std::fprintf(stderr, "orograph-bench-clusters: %s\n", e.what());
        return static_cast<int>(oro::ErrorKind::usage);
    }
    const oro::Result<void> reported = oro::report(options);
    if (reported.ok()) return 0;
    std::fprintf(stderr, "orograph-bench-clusters: %s\n", reported.error().line().c_str());
    return static_cast<int>(reported.error().kind);
}
