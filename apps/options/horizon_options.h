// The options of orograph horizon, as the command line takes them.
#pragma once

#include <optional>
#include <string>

#include "apps/options/options.h"

namespace oro {

struct HorizonOptions {
    RegionOptions region;
    ViewOptions view;                  // the air, and files whose names stand for places
    std::string at;                    // around this place alone, as a table; "": around posts, as rasters
    std::optional<double> altitude_m;  // of the eye at that place
    bool on_summit{false};             // likewise
    std::optional<int> directions;
    std::optional<double> radius_km;
    std::optional<double> above_m;
    std::string out;  // NAME.tif: NAME.horizon.tif and NAME.sky-view.tif are written; of a place a .csv
    bool overwrite{false};
    bool json{false};
    bool quiet{false};
};

// The two files of an --out NAME.tif or NAME.tiff.
struct HorizonFiles {
    std::string horizon, sky_view;
};
inline HorizonFiles horizon_files_of(const std::string& out) {
    const std::size_t dot = out.rfind('.');
    const std::string name = out.substr(0, dot), ending = dot == std::string::npos ? "" : out.substr(dot);
    return {name + ".horizon" + ending, name + ".sky-view" + ending};
}

}  // namespace oro
