#include "geo/library_report.h"

#include <gdal.h>
#include <proj.h>

#include <GeographicLib/Config.h>

namespace oro {
namespace {

// True when PROJ can open a grid by this name (resource folders, PROJ_DATA).
bool has_grid(const char* name) {
    const PJ_GRID_INFO info = proj_grid_info(name);
    return info.filename[0] != '\0';
}

GeoidGridReport look_for(const std::string& name, std::initializer_list<const char*> files,
                         const std::string& with, const std::string& without) {
    for (const char* file : files) {
        if (has_grid(file)) return {name, file, true, with};
    }
    return {name, *files.begin(), false, without};
}

}  // namespace

LibraryReport report_libraries() {
    LibraryReport report;
    report.gdal = GDALVersionInfo("RELEASE_NAME");
    const PJ_INFO proj = proj_info();
    report.proj = proj.version;
    report.geographiclib = GEOGRAPHICLIB_VERSION_STRING;
    report.geoids = {
        look_for("EGM96", {"egm96_15.gtx", "us_nga_egm96_15.tif"},
                 "SRTM heights are lifted onto the ellipsoid by it",
                 "N = 0 stands in: heights above the ellipsoid are off by up to 107 m (install proj-data)"),
        look_for("EGM2008", {"egm08_25.gtx", "us_nga_egm08_25.tif"},
                 "heights that state EGM2008 are honoured",
                 "EGM96 stands in for heights that state EGM2008 (differences are mostly below 1 m); "
                 "--strict-datum refuses them"),
    };
    return report;
}

}  // namespace oro
