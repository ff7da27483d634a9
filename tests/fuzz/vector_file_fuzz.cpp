// Vector files of strangers: GPX, KML, GeoJSON and GeoPackage.
#include <unistd.h>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "geo/vectors/vector_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const std::string name = "/tmp/vector_file_fuzz." + std::to_string(getpid());
    std::FILE* const file = std::fopen(name.c_str(), "wb");
    if (file == nullptr) return 0;
    std::fwrite(data, 1, size, file);
    std::fclose(file);
    const auto read = oro::read_vectors(name);
    if (read.ok()) {
        for (const oro::VectorLayer& layer : read->layers) {
            for (const oro::VectorShape& shape : layer.shapes) {
                if (shape.paths.empty() || shape.record >= layer.records.size()) std::abort();
                for (const auto& path : shape.paths) {
                    for (const oro::VectorPlace& place : path) {
                        if (!(std::abs(place.lat_deg) <= 90.0) || !(std::abs(place.lon_deg) <= 180.0))
                            std::abort();
                    }
                }
            }
        }
    } else if (read.error().line().find('\n') != std::string::npos) {
        std::abort();
    }
    return 0;
}
