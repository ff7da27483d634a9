#include "geo/opening/grid_choice.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "geo/posts/seams.h"
#include "geo/sources/source_report.h"
#include "geo/together/lattices.h"

namespace oro {
namespace {

Error no_sources(const RegionRequest& request, const std::string& first_skipped) {
    const std::string where = paths_words(request);
    if (request.box)
        return {ErrorKind::no_data, where, "no elevation data in " + bounding_box_text(*request.box)};
    return {ErrorKind::no_data, where,
            "no elevation data" + (first_skipped.empty() ? "" : " (" + first_skipped + ")")};
}

// Which of the groups wins where several have ground: as their first files are listed, where that counts;
// else the finest first, among equals the one named first.
std::vector<std::size_t> ranks_of(const std::vector<std::vector<Source>>& groups) {
    std::vector<std::size_t> order(groups.size()), ranks(groups.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto spacing_deg = [&](std::size_t group) {
        std::pair<int, double> first{std::numeric_limits<int>::max(), 1.0e9};
        for (const Source& source : groups[group]) {
            const Precedence rank = precedence_of(source.report);
            first.first = std::min(first.first, rank.listed);
            first.second = std::min(first.second, std::sqrt(rank.lat_spacing_deg * rank.lon_spacing_deg));
        }
        return first;
    };
    std::ranges::stable_sort(order,
                             [&](std::size_t a, std::size_t b) { return spacing_deg(a) < spacing_deg(b); });
    for (std::size_t i = 0; i < order.size(); ++i) ranks[order[i]] = i;
    return ranks;
}

Result<std::vector<ChosenGrid>> choose_baked(std::vector<BakedGrid> grids, const RegionRequest& request) {
    if (grids.size() > 1 && !request.allow_multiple_grids)
        return Error{ErrorKind::usage, grids.front().region->path(),
                     "holds " + std::to_string(grids.size()) +
                         " grids of posts, and this takes one: bake the files with --resample"};
    std::vector<ChosenGrid> chosen;
    for (BakedGrid& grid : grids) {
        const int rank = static_cast<int>(grid.rank);
        chosen.push_back({{}, {}, rank, std::move(grid)});
    }
    return chosen;
}

}  // namespace

std::string paths_words(const RegionRequest& request) {
    std::string text;
    for (const std::string& path : request.paths) text += (text.empty() ? "" : ", ") + path;
    return text;
}

Result<std::vector<ChosenGrid>> choose_grids(RegionSources found, const RegionRequest& request) {
    if (!found.baked.empty()) return choose_baked(std::move(found.baked), request);
    if (found.sources.empty() && !request.box) return no_sources(request, found.first_skipped);
    const auto extent = choose_extent(found.sources, request.box);
    if (!extent && request.box) return no_sources(request, "");
    if (!extent)
        return Error{ErrorKind::no_data, paths_words(request),
                     "its posts lie on a line or a point, and cover no area"};
    std::vector<std::vector<Source>> groups = grids_of_sources(std::move(found.sources), request);
    const std::vector<std::size_t> rank_of = ranks_of(groups);
    std::vector<ChosenGrid> chosen;
    for (std::size_t number = 0; number < groups.size(); ++number) {
        const auto own = groups.size() == 1 ? extent : region_extent(groups[number], request.box);
        if (!own) continue;  // on a line or a point
        chosen.push_back({std::move(groups[number]), *own, static_cast<int>(rank_of[number]), {}});
    }
    if (chosen.empty())
        return Error{ErrorKind::no_data, paths_words(request), "no file's posts cover an area"};
    return chosen;
}

}  // namespace oro
