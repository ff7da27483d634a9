// Which libraries and geoid grids this machine has, and what the lack of one means.
#pragma once

#include <string>
#include <vector>

namespace oro {

struct GeoidGridReport {
    std::string name;  // "EGM96"
    std::string file;  // the grid's file name, found or looked for
    bool found{};
    std::string damage;   // why what is there cannot be used, with its whole path; "" where all is well
    std::string meaning;  // what works with it, or what stands in without it
};

struct LibraryReport {
    std::string gdal;
    std::string proj;
    std::string geographiclib;
    std::vector<GeoidGridReport> geoids;
};

// This gives the versions alone, of the libraries that run, and reads no grid.
LibraryReport report_versions();
// Reads all of the geoid grids that are there.
LibraryReport report_libraries();

}  // namespace oro
