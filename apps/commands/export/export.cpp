// orograph export: heights in the formats of others.
#include "apps/command_line/refusals.h"
#include "apps/commands/commands.h"
#include "apps/commands/export/exported_region.h"
#include "apps/options/region_option_table.h"
#include "apps/output/overwrite_guard.h"
#include "apps/report/different_words.h"
#include "apps/report/region_json.h"
#include "apps/view/view.h"
#include "geo/files/letter_case.h"
#include "geo/opening/open_region.h"
#include "geo/sources/source_words.h"
#include "geo/together/covered_grids.h"

namespace oro {
namespace {

Result<void> check_file(const ExportOptions& options) {
    if (options.zoom) return refused("--zoom", *options.zoom, "needs --to terrain-rgb");
    if (options.hole_height_m) return refused("--hole-height", "", "needs --to terrain-rgb");
    const std::string name = lower_case(options.out);
    if (!name.ends_with(".tif") && !name.ends_with(".tiff"))
        return refused("--out", options.out, "the file's name must end in .tif");
    return check_may_write(options.out, options.overwrite);
}

Result<void> check_words(const ExportOptions& options) {
    if (!options.to) return refused("--to", "", "is missing: choose cog or terrain-rgb");
    if (options.out.empty())
        return refused("--out", "",
                       *options.to == "cog" ? "is missing: name the file to write (.tif)"
                                            : "is missing: name the folder to write");
    if (*options.to == "cog") return check_file(options);
    return check_zoom(options);
}

}  // namespace

std::string heights_words(const Region& region) {
    DifferentWords geoids;
    for (const RegionGrid& grid : region.grids) geoids.add(grid.geoid);
    return "H, above the geoid " + geoids.all();
}

std::string source_heights_words(const Region& region) {
    DifferentWords datums;
    for (const RegionGrid& grid : region.grids)
        for (const SourceReport& source : grid.sources) datums.add(datum_words(source.vertical_datum));
    return datums.all();
}

Result<void> run_export(const ExportOptions& options) {
    ORO_CHECK(check_words(options));
    ORO_CHECK(check_without_meshes(options.region, "does not go into exports, which are of terrain alone"));
    ORO_TRY(const RegionRequest request, region_request(options.region));
    ProgressBar bar(options.quiet);
    ORO_TRY(Region region, open_region(request, bar.progress()));
    leave_covered_grids_out(region);
    ORO_CHECK(spare_inputs({options.out}, {files_of_ground(options.region.paths, region)}));
    return *options.to == "cog" ? export_cog(options, region, bar) : export_terrain_rgb(options, region, bar);
}

}  // namespace oro
