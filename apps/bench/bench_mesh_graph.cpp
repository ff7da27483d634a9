// orograph-bench-mesh-graph: how many triangles of a mesh an error takes, in its graph, in the same graph by
// meshoptimizer, and without groups.
#include <CLI/CLI.hpp>
#include <array>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "apps/bench/las_triangles.h"
#include "apps/bench/meshopt_groups.h"
#include "apps/bench/whole_collapses.h"
#include "core/base/parallel.h"
#include "core/cluster_frame/cluster_cut.h"
#include "geo/meshes/mesh_file.h"
#include "geo/meshes/source_mesh_graph.h"

namespace oro {
namespace {

struct GraphBench {
    std::vector<std::string> paths;
    std::string crs;    // of meshes that state none
    double across_m{};  // above 0: each mesh is made as large
    std::vector<double> errors_m{0.1, 0.5, 2.0};
    double kept_share{MeshGraphOptions{}.kept_share};
    bool without_whole{};
};

struct MeshoptWay {
    const char* name;
    MeshoptRims rims;
    MeshoptLimit limit;
};
constexpr std::array<MeshoptWay, 6> meshopt_ways{
    {{"rims stay, no limit", MeshoptRims::stay, MeshoptLimit::none},
     {"rims stay, limit by its own word", MeshoptRims::stay, MeshoptLimit::own},
     {"rims stay, limit measured", MeshoptRims::stay, MeshoptLimit::measured},
     {"rims move, no limit", MeshoptRims::move, MeshoptLimit::none},
     {"rims move, limit by its own word", MeshoptRims::move, MeshoptLimit::own},
     {"rims move, limit measured", MeshoptRims::move, MeshoptLimit::measured}}};

Result<MetricMesh> opened(const std::string& path, const GraphBench& bench) {
    const bool is_las = std::filesystem::path(path).extension() == ".las";
    ORO_TRY(SourceMesh source, is_las ? triangles_of_las(path) : read_mesh(path));
    if (source.crs.empty()) source.crs = bench.crs;
    if (bench.across_m > 0.0) {
        glm::dvec3 low = source.vertices.front(), high = low;
        for (const glm::dvec3& at : source.vertices) low = glm::min(low, at), high = glm::max(high, at);
        const double scale = bench.across_m / glm::distance(low, high);
        for (glm::dvec3& at : source.vertices) at = scale * (at - low);
        source.unit.clear(), source.crs.clear();
    }
    return metric_mesh(source);
}

std::vector<std::size_t> counts_of(const MetricMesh& mesh, const GraphBench& bench,
                                   const CustomSimplifier* simplifier) {
    MeshGraphOptions options;
    options.threads = thread_count(), options.kept_share = bench.kept_share;
    options.simplifier = simplifier;
    const MeshGraph graph = build_mesh_graph(mesh.vertices, mesh.triangles, mesh.first_m, options);
    std::vector<std::size_t> counts;
    for (const double error_m : bench.errors_m)
        counts.push_back(triangles_of_cut(graph.clusters, cut_by_metres(graph.clusters, error_m)));
    return counts;
}

void print_ways(const MetricMesh& mesh, const GraphBench& bench, const std::vector<std::size_t>& own) {
    for (const MeshoptWay& way : meshopt_ways) {
        const CustomSimplifier simplifier = simplifier_by_meshopt(way.rims, way.limit);
        const std::vector<std::size_t> counts = counts_of(mesh, bench, &simplifier);
        std::printf("  meshopt, %-32s", way.name);
        for (std::size_t i = 0; i < counts.size(); ++i)
            std::printf(" %9zu %6.3f", counts[i],
                        static_cast<double>(own[i]) / static_cast<double>(counts[i]));
        std::printf("\n"), std::fflush(stdout);
    }
}

void print_whole(const MetricMesh& mesh, const GraphBench& bench, const std::vector<std::size_t>& own) {
    const std::vector<WholeMesh> whole = whole_collapses(mesh.vertices, mesh.triangles, bench.errors_m);
    const auto print = [&](const char* name, std::size_t WholeMesh::*count) {
        std::printf("  %-41s", name);
        for (std::size_t i = 0; i < whole.size(); ++i)
            std::printf(" %9zu %6.3f", whole[i].*count,
                        static_cast<double>(own[i]) / static_cast<double>(whole[i].*count));
        std::printf("\n");
    };
    print("own collapses without groups", &WholeMesh::triangles);
    print("... that believe to be within", &WholeMesh::believed);
    std::printf("  %-41s", "... and are within, m");
    for (const WholeMesh& one : whole) std::printf(" %9.3f %6s", one.true_m, "");
    std::printf("\n"), std::fflush(stdout);
}

Result<void> print_tables(const GraphBench& bench) {
    for (const std::string& path : bench.paths) {
        ORO_TRY(const MetricMesh mesh, opened(path, bench));
        std::printf("%s: %zu triangles; beside each count this graph's share of it\n",
                    std::filesystem::path(path).filename().c_str(), mesh.triangles.size());
        std::printf("  %-41s", "within, m");
        for (const double error_m : bench.errors_m) std::printf(" %9g %6s", error_m, "");
        const std::vector<std::size_t> own = counts_of(mesh, bench, nullptr);
        std::printf("\n  %-41s", "this graph");
        for (const std::size_t count : own) std::printf(" %9zu %6s", count, "");
        std::printf("\n"), std::fflush(stdout);
        print_ways(mesh, bench, own);
        if (!bench.without_whole) print_whole(mesh, bench, own);
    }
    return {};
}

}  // namespace
}  // namespace oro

int main(int argc, char** argv) {
    CLI::App app{
        "Counts the triangles that an error of a mesh takes: in its graph, in the same graph by "
        "meshoptimizer, and without groups. Every error is a proven bound.",
        "orograph-bench-mesh-graph"};
    oro::GraphBench bench;
    app.add_option("MESH", bench.paths, "Meshes, as orograph takes them, and LAS files")->required();
    app.add_option("--mesh-crs", bench.crs, "CRS of meshes that state none, for its unit");
    app.add_option("--across", bench.across_m, "Metres: make the diagonal of each mesh's box as long");
    app.add_option("--errors", bench.errors_m, "Errors, metres, rising")->delimiter(',');
    app.add_option("--kept-share", bench.kept_share, "Of a group's triangles, in what comes out of it");
    app.add_flag("--without-whole", bench.without_whole, "Leave out collapses without groups");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        if (e.get_exit_code() == 0) return app.exit(e);
        std::fprintf(stderr, "orograph-bench-mesh-graph: %s\n", e.what());
        return static_cast<int>(oro::ErrorKind::usage);
    }
    const oro::Result<void> printed = oro::print_tables(bench);
    if (printed.ok()) return 0;
    std::fprintf(stderr, "orograph-bench-mesh-graph: %s\n", printed.error().line().c_str());
    return static_cast<int>(printed.error().kind);
}
