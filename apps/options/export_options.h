// What the command line says of `orograph export`.
#pragma once

#include <optional>
#include <string>

#include "apps/options/options.h"

namespace oro {

struct ExportOptions {
    RegionOptions region;
    std::optional<std::string> to;        // cog, terrain-rgb
    std::string out;                      // a file of cog, a folder of terrain-rgb
    std::optional<std::string> zoom;      // LOW:HIGH
    std::optional<double> hole_height_m;  // what pixels without ground hold
    bool overwrite{false};
    bool json{false};
    bool quiet{false};
};

}  // namespace oro
