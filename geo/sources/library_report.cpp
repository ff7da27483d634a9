#include "geo/sources/library_report.h"

#include <gdal.h>
#include <proj.h>

#include <GeographicLib/Config.h>

#include "geo/datum/vertical_datum.h"

namespace oro {
namespace {

std::string file_name(const std::string& path) {
    return path.substr(path.find_last_of('/') + 1);
}

// `file` is the name of the grid where there is none.
GeoidGridReport look_for(const std::string& name, const std::string& heights_crs, const std::string& file,
                         const std::string& with, const std::string& without) {
    const GridState state = grid_state(heights_crs);
    if (!state.damage.empty())
        return {name, file_name(state.path), true, state.damage,
                "nothing that needs it is drawn: install it anew (proj-data)"};
    if (state.path.empty()) return {name, file, false, "", without};
    return {name, file_name(state.path), true, "", with};
}

}  // namespace

LibraryReport report_versions() {
    LibraryReport report;
    report.gdal = GDALVersionInfo("RELEASE_NAME");
    const PJ_INFO proj = proj_info();
    report.proj = proj.version;
    report.geographiclib = GEOGRAPHICLIB_VERSION_STRING;
    return report;
}

LibraryReport report_libraries() {
    LibraryReport report = report_versions();
    report.geoids = {
        look_for("EGM96", "EPSG:4326+5773", "egm96_15.gtx",
                 "SRTM heights are lifted onto the ellipsoid by it",
                 "N = 0 stands in: heights above the ellipsoid are off by up to 107 m (install proj-data)"),
        look_for("EGM2008", "EPSG:4326+3855", "us_nga_egm08_25.tif",
                 "heights that state EGM2008 are honoured",
                 "EGM96 stands in for heights that state EGM2008 (differences are mostly below 1 m); "
                 "--strict-datum refuses them"),
    };
    return report;
}

}  // namespace oro
