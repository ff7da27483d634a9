// orograph-bench-triangles: how many triangles a region file takes at given errors, against the full grid and
// against meshes that are as small as can be. Links core alone.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <bit>
#include <cstdio>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/bench/bench_blocks.h"
#include "apps/bench/bench_rtin.h"
#include "apps/bench/bench_tin.h"
#include "apps/report/json_object.h"
#include "core/baked/file_pages.h"
#include "core/base/parallel.h"

namespace oro {
namespace {

using nlohmann::ordered_json;

struct TrianglesOptions {
    std::string region;
    std::vector<double> errors_m{5.0, 10.0, 30.0};
    bool json{false};
};

// A mesh that was checked against every post.
struct Counted {
    std::size_t triangles{};
    double largest_error_m{};

    [[nodiscard]] double times(const Counted& other) const {
        return static_cast<double>(triangles) / static_cast<double>(other.triangles);
    }
};

// Of one error. The last two: over the largest square of 2^k + 1 posts in the region's north-west.
struct ErrorRow {
    double error_m{};
    Counted blocks;
    std::vector<std::size_t> nodes;  // of the blocks, by level
    Counted tin;
    Counted square_rtin;
    Counted square_tin;
};

struct TrianglesReport {
    std::string region;
    int rows{};
    int columns{};
    Counted full;
    int square_posts{};
    std::vector<ErrorRow> errors;
};

Result<Counted> counted(const DrawnHeights& heights, const std::vector<MeshTriangle>& mesh, double error_m,
                        const std::string& what) {
    const MeshCheck check = check_mesh(heights, mesh, error_m);
    if (check.posts_beyond + check.posts_uncovered > 0)
        return Error{ErrorKind::failed, what,
                     std::to_string(check.posts_beyond) + " posts are farther than the error, " +
                         std::to_string(check.posts_uncovered) + " are not covered"};
    return Counted{mesh.size(), check.largest_error_m};
}

Result<void> check_region(const std::string& path, const RegionOutline& outline) {
    const PostGrid& grid = outline.grid;
    std::string reason;
    if (outline.voids > 0) reason = "has voids, around which a triangulation cannot be compared";
    if (grid.wraps_longitude()) reason = "goes round the Earth, which a triangulation does not";
    if (std::max(grid.rows(), grid.columns()) > most_mesh_posts)
        reason = "has more than " + std::to_string(most_mesh_posts) + " posts along an axis";
    if (std::min(grid.rows(), grid.columns()) < 3) reason = "has fewer than 3 posts along an axis";
    if (reason.empty()) return {};
    return Error{ErrorKind::usage, path, reason};
}

DrawnHeights north_west_square(const DrawnHeights& heights) {
    const auto quads = static_cast<unsigned>(std::min(heights.rows, heights.columns) - 1);
    DrawnHeights square;
    square.rows = square.columns = static_cast<int>(std::bit_floor(quads)) + 1;
    for (int row = 0; row < square.rows; ++row)
        square.steps.insert(square.steps.end(), heights.row(row), heights.row(row) + square.columns);
    square.highest_steps = *std::max_element(square.steps.begin(), square.steps.end());
    return square;
}

Result<TrianglesReport> count_triangles(const TrianglesOptions& options) {
    ORO_TRY(const RegionFile file, RegionFile::open(options.region));
    ORO_CHECK(check_region(options.region, file.outline()));
    ORO_TRY(const HeightField field, field_in_memory(file));
    if (field.grid.net)
        return Error{ErrorKind::usage, options.region,
                     "has posts in a CRS of their own; this counts triangles over latitudes and longitudes"};
    const int threads = thread_count();
    const DrawnHeights heights = drawn_heights(field, 1.0, threads);
    const LevelPyramid pyramid = build_pyramid(field.grid, file.outline().shape, heights, threads);
    const DrawnHeights square = north_west_square(heights);
    const BisectionMesh rtin(square);
    GreedyTin tin(heights), square_tin(square);
    TrianglesReport report{options.region,  heights.rows,
                           heights.columns, {static_cast<std::size_t>(file.outline().triangles), 0.0},
                           square.rows,     {}};
    // A triangulation only grows: from the largest error to the smallest.
    std::vector<double> errors_m = options.errors_m;
    std::sort(errors_m.begin(), errors_m.end(), std::greater<>());
    for (const double error_m : errors_m) {
        ErrorRow row;
        row.error_m = error_m;
        BlockMesh blocks = block_mesh(pyramid, heights, error_m);
        row.nodes = std::move(blocks.nodes);
        tin.refine(error_m);
        square_tin.refine(error_m);
        ORO_TRY(row.blocks, counted(heights, blocks.triangles, error_m, "blocks"));
        ORO_TRY(row.tin, counted(heights, tin.mesh(), error_m, "TIN"));
        ORO_TRY(row.square_rtin, counted(square, rtin.mesh(error_m), error_m, "RTIN"));
        ORO_TRY(row.square_tin, counted(square, square_tin.mesh(), error_m, "TIN of the square"));
        report.errors.insert(report.errors.begin(), std::move(row));
    }
    return report;
}

ordered_json counted_json(const Counted& mesh) {
    return json_object("triangles", mesh.triangles, "largest_error_m", mesh.largest_error_m);
}

void print_json(const TrianglesReport& report) {
    ordered_json json = json_object("region", report.region, "posts", json_list(report.rows, report.columns),
                                    "full_grid_triangles", report.full.triangles, "square_posts",
                                    report.square_posts, "errors", ordered_json::array());
    for (const ErrorRow& row : report.errors) {
        ordered_json one = json_object("error_m", row.error_m, "blocks", counted_json(row.blocks));
        one["blocks"]["nodes_by_level"] = row.nodes;
        one["tin"] = counted_json(row.tin);
        one["square_rtin"] = counted_json(row.square_rtin);
        one["square_tin"] = counted_json(row.square_tin);
        one["blocks_per_tin"] = row.blocks.times(row.tin);
        one["full_grid_per_tin"] = report.full.times(row.tin);
        one["full_grid_per_blocks"] = report.full.times(row.blocks);
        one["square_rtin_per_tin"] = row.square_rtin.times(row.square_tin);
        json["errors"].push_back(std::move(one));
    }
    std::printf("%s\n", json.dump().c_str());
}

void print_table(const TrianglesReport& report) {
    std::printf("%s: %d x %d posts; RTIN and its TIN over the north-western %d x %d posts\n",
                report.region.c_str(), report.rows, report.columns, report.square_posts, report.square_posts);
    std::printf("%8s %10s %10s %9s %10s %10s %11s %9s %11s %10s %9s  %s\n", "error m", "full grid", "blocks",
                "worst m", "TIN", "worst m", "blocks/TIN", "full/TIN", "full/blocks", "RTIN", "RTIN/TIN",
                "nodes by level");
    for (const ErrorRow& row : report.errors) {
        std::string nodes;
        for (const std::size_t count : row.nodes) nodes += " " + std::to_string(count);
        std::printf("%8g %10zu %10zu %9.3f %10zu %10.3f %11.2f %9.2f %11.2f %10zu %9.2f %s\n", row.error_m,
                    report.full.triangles, row.blocks.triangles, row.blocks.largest_error_m,
                    row.tin.triangles, row.tin.largest_error_m, row.blocks.times(row.tin),
                    report.full.times(row.tin), report.full.times(row.blocks), row.square_rtin.triangles,
                    row.square_rtin.times(row.square_tin), nodes.c_str());
    }
}

}  // namespace
}  // namespace oro

int main(int argc, char** argv) {
    CLI::App app{
        "Counts the triangles that a region takes at given errors: in blocks, as they are drawn, in "
        "right triangles (RTIN), and in a greedy triangulation (TIN).",
        "orograph-bench-triangles"};
    oro::TrianglesOptions options;
    app.add_option("REGION", options.region, "A region file (orograph bake makes one)")->required();
    app.add_option("--errors", options.errors_m, "Largest errors, metres")
        ->delimiter(',')
        ->check(CLI::Range(0.0, 10000.0));
    app.add_flag("--json", options.json, "Print one JSON object");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        if (e.get_exit_code() == 0) return app.exit(e);
        std::fprintf(stderr, "orograph-bench-triangles: %s\n", e.what());
        return static_cast<int>(oro::ErrorKind::usage);
    }
    const oro::Result<oro::TrianglesReport> report = oro::count_triangles(options);
    if (report.ok()) {
        options.json ? oro::print_json(*report) : oro::print_table(*report);
        return 0;
    }
    std::fprintf(stderr, "orograph-bench-triangles: %s\n", report.error().line().c_str());
    return static_cast<int>(report.error().kind);
}
