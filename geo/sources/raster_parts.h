// The files that a raster is made of, looked at before GDAL opens it: what GDAL would pass over in silence is
// found here.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace oro {

// A VRT may be made of VRTs so deep, ...
inline constexpr int deepest_vrt = 4;
// A VRT may name so many sources, those of its sources counted each time they are named.
inline constexpr std::uint64_t most_vrt_sources = 100'000;
// A VRT may name each source so many times where it names more than a thousand.
inline constexpr std::uint64_t most_times_named = 16;
// A VRT may have so many bytes.
inline constexpr std::uint64_t most_vrt_bytes = std::uint64_t{64} << 20U;

struct RasterParts {
    // Files of this machine (archives instead of what is in them), each once: the raster, what it names, and
    // the side-cars that change its heights.
    std::vector<std::string> files;
    // What may be wrong and cannot be told, one line each without the raster's name.
    std::vector<std::string> doubts;
    // Why a VRT is no source: it is made of .hgt files, which are read here without GDAL; else "".
    std::string unfit;
};

// Looks at a raster by its name in GDAL's file system, and at all that a VRT names. Errors: a VRT beyond the
// limits above, that names itself, is no XML, or reads raw bytes, whose end GDAL does not tell from zeros; a
// damaged side-car (.aux.xml, .msk); a part that is shorter than its own header says where GDAL does not
// look.
Result<RasterParts> parts_of_raster(const std::string& file);

// The file of this machine that holds a file of GDAL's file system: /vsizip/{a.zip}/b.tif is in a.zip.
std::string local_file_of(const std::string& file);

// What a VRT names as `name` relative to itself, in GDAL's file system.
std::string file_relative_to(const std::string& vrt, const std::string& name);

}  // namespace oro
