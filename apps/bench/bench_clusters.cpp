// orograph-bench-clusters: builds the cluster graph of a region file and says what it takes. Links core alone.
#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "core/baked/file_pages.h"
#include "core/base/parallel.h"
#include "core/clusters/cluster_cut.h"
#include "core/clusters/graph_builder.h"
#include "core/clusters/grid_surface.h"

namespace oro {
namespace {

struct ClustersOptions {
    std::string region;
    std::vector<double> errors_m{5.0, 10.0, 30.0, 100.0};
    int threads{1};
    double kept_share{0.5};
};

double processor_s() {
    rusage used{};
    getrusage(RUSAGE_SELF, &used);
    return static_cast<double>(used.ru_utime.tv_sec) + 1.0e-6 * static_cast<double>(used.ru_utime.tv_usec);
}

Result<void> report(const ClustersOptions& options) {
    ORO_TRY(const RegionFile file, RegionFile::open(options.region));
    ORO_TRY(const HeightField field, field_in_memory(file));
    const DrawnHeights heights = drawn_heights(field, 1.0, options.threads);
    const GridSurface surface(heights);
    const GridBounds bounds(field.grid, heights.highest_steps);
    const double before_s = processor_s();
    const ClusterGraph graph =
        build_cluster_graph(surface, bounds, {options.threads, options.kept_share});
    std::printf("%s: %d x %d posts, %.1f s of processor time\n", options.region.c_str(), heights.rows,
                heights.columns, processor_s() - before_s);
    std::printf("%5s %10s %10s %7s %9s %6s %8s %9s %7s %6s\n", "level", "triangles", "coarser", "groups",
                "clusters", "stuck", "largest", "error m", "locked", "twice");
    int number = 0;
    for (const GraphLevel& level : graph.levels)
        std::printf("%5d %10zu %10zu %7zu %9zu %6zu %8zu %9.2f %7zu %6zu\n", ++number, level.triangles_in,
                    level.triangles_out, level.groups, level.clusters_out, level.stuck_groups,
                    level.largest_group, level.largest_error_m, level.locked, level.locked_twice);
    for (const double error_m : options.errors_m) {
        const auto cut = cut_by_metres(graph, error_m);
        std::printf("%8g m %10zu triangles in %zu clusters\n", error_m, triangles_of_cut(graph, cut), cut.size());
    }
    return {};
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
