// orograph-bench-clusters: builds the cluster graph of a region file, and counts what its cuts take beside
// blocks and meshes that are as small as can be. Links core alone.
#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "apps/bench/bench_blocks.h"
#include "apps/bench/bench_path.h"
#include "apps/bench/bench_tin.h"
#include "core/baked/file_pages.h"
#include "core/base/container.h"
#include "core/base/parallel.h"
#include "core/cluster_file/cluster_file.h"
#include "core/cluster_frame/cluster_cut.h"
#include "core/clusters/graph_builder.h"
#include "core/clusters/simplify_group.h"
#include "core/lod/levels.h"
#include "core/surface/grid_surface.h"

namespace oro {
namespace {

struct ClustersOptions {
    std::string region;
    std::vector<double> errors_m{5.0, 10.0, 30.0, 100.0};
    int threads{1};
    double kept_share{GraphOptions{}.kept_share};
    bool references{false};
    bool bytes{false};
    std::string path;
    std::vector<double> taus_px{1.0};
    std::string out;  // a file of the region with its clusters
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

// What the graph takes in a file, group by group, and the time that coding takes both ways on one thread.
Result<void> print_bytes(const std::string& region, const PostCounts& posts, const OriginalSurface& surface,
                         const GroundBounds& bounds, const ClusterGraph& graph) {
    const std::string path = region + ".clusters-bench";
    double before_s = processor_s();
    ORO_CHECK(write_cluster_graph(path, graph, posts, 0, true));
    const double write_s = processor_s() - before_s;
    ORO_TRY(const ClusterFile file, ClusterFile::open(path));
    before_s = processor_s();
    std::size_t triangles = 0;
    for (std::uint32_t i = 0; i < file.outline().groups; ++i) {
        GroupPart part;
        ORO_CHECK(file.part(i, part));
        triangles += part.triangles.size();
    }
    const double groups_s = processor_s() - before_s;
    before_s = processor_s();
    ORO_TRY(const ClusterGraph read, file.graph(surface, bounds));
    const double graph_s = processor_s() - before_s;
    if (read.triangles != graph.triangles) return Error{ErrorKind::failed, path, "holds another graph"};
    std::printf("above the leaves: %.3f MB in a file without heights, %.2f bits a triangle\n",
                1.0e-6 * static_cast<double>(file.bytes()),
                8.0 * static_cast<double>(file.bytes()) / static_cast<double>(triangles));
    std::printf(
        "processor time: %.2f s to write, %.2f s to read all groups, %.2f s to read and check the graph\n",
        write_s, groups_s, graph_s);
    std::remove(path.c_str());
    return {};
}

// The region file and the graph in one file, for machines that orograph bake does not run on.
Result<void> write_out(const std::string& out, const RegionFile& file, const PostCounts& posts,
                       const ClusterGraph& graph, int threads) {
    const std::string clusters_path = out + ".clusters";
    ORO_CHECK(write_cluster_graph(clusters_path, graph, posts, file.fingerprint(), true, threads));
    ORO_TRY(OpenFile whole, OpenFile::open(out, OpenFile::Use::write));
    ORO_CHECK(whole.resize(0));
    std::uint64_t at = 0;
    const std::array<ContainerPart, 2> parts{{{file.path(), 0}, {clusters_path, 0}}};
    ORO_CHECK(join_containers(parts, [&](std::span<const std::byte> bytes) {
        const std::uint64_t first = at;
        at += bytes.size();
        return whole.write(first, bytes);
    }));
    std::remove(clusters_path.c_str());
    return {};
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
        const std::size_t blocks = block_mesh(pyramid_, heights_, error_m).triangles.size();
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
        const double found_m = every_place_m(heights, GridSurface(heights), graph, cut);
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

// Triangles in view: of the clusters that a view's error asks for, and of the nodes. Both are counted where
// their own sphere meets the picture's frustum; nothing is left out for another reason.
class InView {
  public:
    explicit InView(const Camera& camera)
        : eye_m_(camera.eye_ecef().m),
          view_(camera.view_from_ecef()),
          tile_{0, 0, camera.width_px, camera.height_px, {0.5, 0.5}},
          planes_(frustum_planes_view(projection_of_tile(camera, tile_))) {}

    [[nodiscard]] const Tile& tile() const { return tile_; }
    [[nodiscard]] bool meets(const glm::dvec3& centre_m, double radius_m) const {
        return !beyond_frustum(planes_, view_ * (centre_m - eye_m_), radius_m);
    }
    [[nodiscard]] std::size_t triangles(const OriginalSurface& surface, const GroundBounds& bounds,
                                        const ClusterGraph& graph,
                                        const std::vector<std::uint32_t>& cut) const {
        std::size_t triangles = 0;
        for (const std::uint32_t i : cut) {
            std::vector<glm::dvec3> places_m;
            for (const VertexTriangle& triangle : graph.triangles_of(graph.clusters[i])) {
                for (const VertexNumber vertex : triangle)
                    places_m.push_back(bounds.ecef(surface.vertex(vertex)).m);
            }
            glm::dvec3 lowest = places_m.front(), highest = lowest;
            for (const glm::dvec3& place : places_m) {
                lowest = glm::min(lowest, place);
                highest = glm::max(highest, place);
            }
            const glm::dvec3 centre_m = 0.5 * (lowest + highest);
            double radius_m = 0.0;
            for (const glm::dvec3& place : places_m)
                radius_m = std::max(radius_m, glm::distance(centre_m, place));
            if (meets(centre_m, radius_m)) triangles += graph.clusters[i].triangles;
        }
        return triangles;
    }
    [[nodiscard]] std::size_t triangles(const LevelPyramid& pyramid, const NodeSelection& selection) const {
        std::size_t triangles = 0;
        for (const DrawnNode& drawn : selection.nodes) {
            const PyramidLevel& level = pyramid.levels[static_cast<std::size_t>(drawn.level)];
            const PageSummary& page = level.page_of_node(drawn.row, drawn.column).summary;
            const gpu::MeshletBounds& node = level.node(drawn.row, drawn.column);
            if (meets(page.origin_ecef.m + page.ecef_from_page * glm::dvec3(node.centre),
                      static_cast<double>(node.radius)))
                triangles += static_cast<std::size_t>(2 * level.grid.row.quads_of_node(drawn.row) *
                                                      level.grid.column.quads_of_node(drawn.column));
        }
        return triangles;
    }

  private:
    glm::dvec3 eye_m_;
    glm::dmat3 view_;
    Tile tile_;
    std::array<Plane, 5> planes_;
};

Result<void> print_views(const ClustersOptions& options, const RegionFile& file, const HeightField& field,
                         const DrawnHeights& heights, const OriginalSurface& surface,
                         const GroundBounds& bounds, const ClusterGraph& graph) {
    ORO_TRY(const std::vector<BenchEye> eyes, read_bench_path(options.path, field.undulation, 1920, 1080));
    const LevelPyramid pyramid = build_pyramid(field.grid, file.outline().shape, heights, options.threads);
    std::printf("in view, 1920 x 1080 px\n%-28s %6s %10s %10s %6s\n", "eye", "tau px", "clusters", "blocks",
                "times");
    for (const BenchEye& eye : eyes) {
        const InView view(eye.camera);
        for (const double tau_px : options.taus_px) {
            const std::size_t clusters =
                view.triangles(surface, bounds, graph, cut_by_pixels(graph, eye.camera, tau_px));
            const std::size_t blocks =
                view.triangles(pyramid, select_nodes(pyramid, eye.camera, view.tile(), tau_px));
            std::printf(
                "%-28s %6g %10zu %10zu %6.2f\n", eye.name.c_str(), tau_px, clusters, blocks,
                static_cast<double>(blocks) / static_cast<double>(std::max<std::size_t>(1, clusters)));
        }
    }
    return {};
}

Result<void> report(const ClustersOptions& options) {
    ORO_TRY(const RegionFile file, RegionFile::open(options.region));
    if (options.references && file.outline().voids > 0)
        return Error{ErrorKind::usage, options.region, "has voids, around which a TIN cannot be compared"};
    ORO_TRY(const HeightField field, field_in_memory(file));
    const DrawnHeights heights = drawn_heights(field, 1.0, options.threads);
    const GridSurface surface(heights, {.wraps_longitude = field.grid.wraps_longitude()});
    const GridBounds bounds(field.grid, heights.highest_steps);
    const double before_s = processor_s();
    const ClusterGraph graph = build_cluster_graph(surface, bounds, {options.threads, options.kept_share});
    std::printf("%s: %d x %d posts, %.1f s of processor time\n", options.region.c_str(), heights.rows,
                heights.columns, processor_s() - before_s);
    print_levels(graph);
    if (options.bytes)
        ORO_CHECK(print_bytes(options.region, {heights.rows, heights.columns}, surface, bounds, graph));
    if (!options.out.empty())
        ORO_CHECK(write_out(options.out, file, {heights.rows, heights.columns}, graph, options.threads));
    if (!options.path.empty()) ORO_CHECK(print_views(options, file, field, heights, surface, bounds, graph));
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
    app.add_option("--path", options.path, "A file of eyes: count what their views take, too");
    app.add_option("--tau", options.taus_px, "Largest errors in these views, pixels")
        ->delimiter(',')
        ->check(CLI::Range(0.0, 1000.0));
    app.add_flag("--references", options.references,
                 "Count blocks, greedy triangulations (TIN) and collapses without groups, too");
    app.add_flag("--bytes", options.bytes,
                 "Write a file of the graph beside the region, tell what it takes, and remove it");
    app.add_option("--out", options.out, "Write the region and its clusters into one file (.oro)");
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
