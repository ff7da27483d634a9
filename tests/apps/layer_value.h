// The values of a layer, as GDAL's program reads them.
#pragma once

#include <filesystem>
#include <string>

#include "tests/apps/program.h"

namespace oro::test {

// What gdallocationinfo reads at a pixel: no number where the layer has none, and a value that no layer has
// where there is no pixel.
inline double layer_value(const std::filesystem::path& file, int x, int y) {
    const Outcome outcome =
        run_program({"gdallocationinfo", "-valonly", file.string(), std::to_string(x), std::to_string(y)});
    return outcome.out.empty() ? -1e9 : std::stod(outcome.out);
}

}  // namespace oro::test
