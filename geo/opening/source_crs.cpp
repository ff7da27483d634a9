#include "geo/opening/source_crs.h"

#include <algorithm>
#include <regex>
#include <utility>

#include "geo/opening/open_region.h"
#include "geo/opening/region_files.h"
#include "geo/opening/region_sources.h"

namespace oro {
namespace {

void add_once(std::vector<std::string>& all, const std::string& crs) {
    if (!crs.empty() && std::ranges::find(all, crs) == all.end()) all.push_back(crs);
}

// "EPSG:2056" of "EPSG:2056 CH1903+ / LV95"; "" of a name without a code.
std::string code_in(const std::string& code_and_name) {
    static const std::regex form("^([A-Za-z]+:[0-9A-Za-z]+)( .*)?$");
    std::smatch part;
    return std::regex_match(code_and_name, part, form) ? part[1].str() : "";
}

}  // namespace

std::vector<std::string> source_crs_of(const Region& region) {
    std::vector<std::string> all;
    for (const RegionGrid& grid : region.grids) {
        if (grid.posts_crs) {
            add_once(all, grid.posts_crs->wkt);
            continue;
        }
        for (const SourceReport& source : grid.sources) add_once(all, code_in(source.crs));
    }
    return all;
}

Result<std::string> one_source_crs(const RegionRequest& request) {
    RegionRequest whole = request;
    whole.box.reset();
    whole.allow_multiple_grids = true;
    std::vector<std::string> all, names;
    const std::string where = request.paths.empty() ? "" : request.paths.front();
    ORO_TRY(const RegionFiles files, find_files(whole));
    if (!files.baked.empty()) {
        ORO_TRY(const Region region, open_region(whole, {}));
        all = source_crs_of(region);
        for (const RegionGrid& grid : region.grids)
            for (const SourceReport& source : grid.sources) add_once(names, source.crs);
    } else {
        ORO_TRY(const RegionSources found, probe_files(files, whole, {}));
        if (found.sources.empty())
            return Error{
                ErrorKind::no_data, where,
                "no elevation data" + (found.first_skipped.empty() ? "" : " (" + found.first_skipped + ")")};
        for (const Source& source : found.sources) {
            add_once(all, source.crs_wkt.empty() ? code_in(source.report.crs) : source.crs_wkt);
            add_once(names, source.report.crs);
        }
    }
    if (all.size() == 1) return all.front();
    if (all.empty()) return Error{ErrorKind::usage, where, "its CRS is not known by a code"};
    std::string list;
    constexpr std::size_t most_named = 4;
    for (std::size_t i = 0; i < std::min(names.size(), most_named); ++i)
        list += (list.empty() ? "" : ", ") + names[i];
    if (names.size() > most_named) list += ", ...";
    return Error{ErrorKind::usage, where, "the data are in several CRSs (" + list + "): name one of them"};
}

}  // namespace oro
