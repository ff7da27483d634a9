// Any bytes as a tile: plain, in .gz and in .zip (the first byte says which). A region whose heights are
// plausible or void, or one line of error.
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "geo/opening/open_region.h"
#include "geo/region/region.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    static const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("orograph-hgt-fuzz-" + std::to_string(getpid()));
    std::filesystem::create_directories(folder);
    static const char* const names[] = {"N46E008.hgt", "N46E008.hgt.gz", "N46E008.hgt.zip",
                                        "S01W180.SRTMGL3.hgt.zip"};
    // A new name each time: GDAL remembers what is in an archive.
    static std::uint64_t run = 0;
    const auto place = folder / std::to_string(++run);
    std::filesystem::create_directories(place);
    const auto file = place / names[data[0] % 4];
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(data) + 1, static_cast<std::streamsize>(size - 1));
    oro::RegionRequest request;
    request.paths = {file.string()};
    const auto region = oro::open_region(request);
    std::filesystem::remove_all(place);
    if (region.ok()) {
        for (const float height : region->grids[0].field.H_m)
            if (!oro::is_void(height) && !(height >= -12000.0F && height <= 9000.0F)) std::abort();
        return 0;
    }
    if (region.error().what.empty()) std::abort();
    for (const char c : region.error().line())
        if (static_cast<unsigned char>(c) < 0x20) std::abort();
    return 0;
}
