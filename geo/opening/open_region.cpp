#include "geo/opening/open_region.h"

#include <new>
#include <optional>
#include <utility>

#include "core/base/files_read.h"
#include "geo/files/library_faults.h"
#include "geo/files/raster_library.h"
#include "geo/opening/baked_region.h"
#include "geo/opening/grid_choice.h"
#include "geo/opening/grid_describing.h"
#include "geo/opening/grid_mosaic.h"
#include "geo/opening/region_sources.h"
#include "geo/region/region_grid.h"
#include "geo/together/feather.h"

namespace oro {
namespace {

// Reads sources as one grid, or as several: the five steps.
Result<Region> read_region(const RegionRequest& request, const Progress& progress) {
    if (request.paths.empty()) return Error{ErrorKind::no_data, "", "no path to elevation data was given"};
    ORO_TRY(RegionSources found, probe_sources(request, progress));
    const std::vector<std::string> notes = found.notes;
    ORO_TRY(std::vector<ChosenGrid> chosen, choose_grids(std::move(found), request));
    const auto count = static_cast<double>(chosen.size());
    std::vector<RegionGrid> grids;
    std::vector<Error> empty;
    for (ChosenGrid& one : chosen) {
        const double before = static_cast<double>(grids.size()) / count;
        const Progress part = [&](double share, const std::string& what) {
            if (progress) progress(before + share / count, what);
        };
        const auto read = [&]() -> Result<RegionGrid> {
            ORO_TRY(LaidGrid laid, lay_grid(std::move(one), request,
                                            grids.empty() ? notes : std::vector<std::string>(), part));
            return describe_grid(std::move(laid), request);
        };
        Result<RegionGrid> grid = read();
        if (!grid && chosen.size() > 1 && grid.error().kind == ErrorKind::no_data) {
            // The others have ground.
            empty.push_back(grid.error());
            continue;
        }
        if (!grid) return grid.error();
        grids.push_back(std::move(*grid));
    }
    if (grids.empty()) return empty.front();
    if (progress) progress(1.0, "region read");
    Region region = describe_region(std::move(grids), empty);
    if (request.feather_m > 0.0 && region.grids.size() > 1) ORO_CHECK(feather(region, request.feather_m));
    return region;
}

// Of a box without data: whether its numbers, taken as latitude first, are one with data. Then that is said.
Error with_order_of_box(Error fault, const RegionRequest& request, const std::optional<std::string>& baked) {
    if (fault.kind != ErrorKind::no_data || !request.box) return fault;
    RegionRequest other = request;
    other.box = with_latitude_first(*request.box);
    if (!other.box) return fault;
    if (baked) {
        if (!open_baked_region(*baked, other, {}).ok()) return fault;
    } else {
        auto found = probe_sources(other, {});
        if (!found.ok() || found->sources.empty() || !choose_extent(found->sources, other.box)) return fault;
    }
    fault.what +=
        ", but in " + bounding_box_text(*other.box) + ": longitude comes first (west,south,east,north)";
    return fault;
}

}  // namespace

Result<Region> open_region(const RegionRequest& request, const Progress& progress) {
    try {
        const std::optional<std::string> baked = baked_path(request.paths);
        if (!baked) start_gdal();
        Result<Region> region =
            baked ? open_baked_region(*baked, request, progress) : read_region(request, progress);
        if (region.ok()) ORO_CHECK(libraries_are_sound());
        // Also where it could not be read: a file that is being rewritten is not damaged.
        ORO_CHECK(check_files_unchanged());
        if (!region.ok()) return with_order_of_box(region.error(), request, baked);
        return region;
    } catch (const std::bad_alloc&) {
        return Error{ErrorKind::failed, "region too large",
                     "not enough memory for its posts; narrow it with --bbox"};
    } catch (const std::exception& fault) {
        return Error{ErrorKind::failed, "reading a region", fault.what()};
    }
}

}  // namespace oro
