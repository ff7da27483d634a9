// orograph-bench-diagonals: which diagonal of a cell lies nearer to the ground. Every second post is
// withheld; those left make cells twice as large, and in the middle of each lies a post that no rule has
// seen.
#include <CLI/CLI.hpp>
#include <array>
#include <cmath>
#include <cstdio>
#include <mutex>
#include <string>
#include <vector>

#include "apps/bench/diagonal_rules.h"
#include "core/base/parallel.h"
#include "geo/opening/open_region.h"
#include "geo/region/region.h"

namespace oro {
namespace {

// Of one rule, over all withheld posts in the middles of cells.
struct RuleErrors {
    double squares_m2{};
    double sum_m{};
    double largest_m{};
    double chose_better{};  // cells whose chosen diagonal is the nearer one

    void add(double error_m, double other_m) {
        squares_m2 += error_m * error_m;
        sum_m += error_m;
        largest_m = std::max(largest_m, error_m);
        chose_better += error_m <= other_m ? 1.0 : 0.0;
    }
    void add(const RuleErrors& more) {
        squares_m2 += more.squares_m2;
        sum_m += more.sum_m;
        largest_m = std::max(largest_m, more.largest_m);
        chose_better += more.chose_better;
    }
};

constexpr std::array<const char*, 6> rule_names{"north-west to south-east",   "north-east to south-west",
                                                "nearest heights joined",     "least bend along it",
                                                "nearest to a smooth middle", "the nearer one (a bound)"};

struct DiagonalErrors {
    std::array<RuleErrors, rule_names.size()> rules{};
    double cells{};
};

// The heights of every second post around the cell whose middle is a post; false where one is void.
bool heights_around(const HeightField& field, int row, int column, CellHeights& heights, double& middle_m) {
    for (int i = 0; i < 4; ++i) {
        for (int k = 0; k < 4; ++k) {
            const float H_m = field.H_at_post_m(row + 2 * i - 3, column + 2 * k - 3);
            if (is_void(H_m)) return false;
            heights[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)] = H_m;
        }
    }
    const float H_m = field.H_at_post_m(row, column);
    middle_m = H_m;
    return !is_void(H_m);
}

void add_cell(const CellHeights& heights, double truth_m, DiagonalErrors& errors) {
    const auto error_m = [&](Diagonal diagonal) { return std::abs(middle_m(heights, diagonal) - truth_m); };
    const double nw_se_m = error_m(Diagonal::nw_se), sw_ne_m = error_m(Diagonal::sw_ne);
    const std::array<Diagonal, rule_names.size()> chosen{Diagonal::nw_se,          Diagonal::sw_ne,
                                                         nearest_heights(heights), least_bend(heights),
                                                         nearest_smooth(heights),  lesser(nw_se_m, sw_ne_m)};
    for (std::size_t rule = 0; rule < chosen.size(); ++rule) {
        const bool nw_se = chosen[rule] == Diagonal::nw_se;
        errors.rules[rule].add(nw_se ? nw_se_m : sw_ne_m, nw_se ? sw_ne_m : nw_se_m);
    }
    errors.cells += 1.0;
}

DiagonalErrors measured(const HeightField& field) {
    DiagonalErrors all;
    std::mutex adding;
    const int rows = (field.grid.rows() - 5) / 2, columns = (field.grid.columns() - 5) / 2;
    in_parallel(std::max(rows, 0), thread_count(), [&](int i) {
        DiagonalErrors of_row;
        for (int k = 0; k < columns; ++k) {
            CellHeights heights{};
            double truth_m = 0.0;
            if (heights_around(field, 3 + 2 * i, 3 + 2 * k, heights, truth_m))
                add_cell(heights, truth_m, of_row);
        }
        const std::lock_guard lock(adding);
        for (std::size_t rule = 0; rule < all.rules.size(); ++rule) all.rules[rule].add(of_row.rules[rule]);
        all.cells += of_row.cells;
    });
    return all;
}

Result<void> print_errors(const std::vector<std::string>& paths) {
    RegionRequest request;
    request.paths = paths;
    ORO_TRY(const Region region, open_region(request));
    const DiagonalErrors errors = measured(region.grids.front().field);
    ORO_CHECK(region.grids.front().field.health());
    if (errors.cells == 0.0)
        return Error{ErrorKind::no_data, paths.front(),
                     "has no cell whose 16 posts around and middle have heights"};
    std::printf("%.0f cells of every second post; the post in the middle of each was withheld\n",
                errors.cells);
    std::printf("%-28s %9s %9s %9s %9s %14s\n", "diagonal", "RMS m", "of first", "mean m", "worst m",
                "chose nearer %");
    const double first_m = std::sqrt(errors.rules[0].squares_m2 / errors.cells);
    for (std::size_t rule = 0; rule < rule_names.size(); ++rule) {
        const RuleErrors& of = errors.rules[rule];
        const double rms_m = std::sqrt(of.squares_m2 / errors.cells);
        std::printf("%-28s %9.3f %9.3f %9.3f %9.1f %14.1f\n", rule_names[rule], rms_m, rms_m / first_m,
                    of.sum_m / errors.cells, of.largest_m, 100.0 * of.chose_better / errors.cells);
    }
    return {};
}

}  // namespace
}  // namespace oro

int main(int argc, char** argv) {
    CLI::App app{"Measures, at posts that were withheld, which diagonal of a cell lies nearer to the ground.",
                 "orograph-bench-diagonals"};
    std::vector<std::string> paths;
    app.add_option("PATH", paths, "Elevation data, as orograph takes them")->required();
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        if (e.get_exit_code() == 0) return app.exit(e);
        std::fprintf(stderr, "orograph-bench-diagonals: %s\n", e.what());
        return static_cast<int>(oro::ErrorKind::usage);
    }
    const oro::Result<void> printed = oro::print_errors(paths);
    if (printed.ok()) return 0;
    std::fprintf(stderr, "orograph-bench-diagonals: %s\n", printed.error().line().c_str());
    return static_cast<int>(printed.error().kind);
}
