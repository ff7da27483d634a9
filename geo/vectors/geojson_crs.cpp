#include "geo/vectors/geojson_crs.h"

#include <cpl_conv.h>
#include <ogr_api.h>
#include <ogr_spatialref.h>
#include <array>
#include <nlohmann/json.hpp>
#include <span>
#include <string_view>
#include <vector>

#include "core/base/open_file.h"
#include "geo/files/foreign_text.h"
#include "geo/sources/raster_library.h"

namespace oro {
namespace {

// Whether a file has these bytes somewhere.
Result<bool> has(const std::string& name, std::string_view what, FileWatch& watch) {
    ORO_TRY(const OpenFile file, OpenFile::open(name, OpenFile::Use::read));
    ORO_TRY(const std::uint64_t size, file.size());
    std::vector<std::byte> bytes(std::size_t{1} << 20U);
    for (std::uint64_t at = 0; at < size && !watch.spent(); at += bytes.size() - what.size()) {
        const std::span<std::byte> part =
            std::span(bytes).first(std::min<std::uint64_t>(bytes.size(), size - at));
        ORO_CHECK(file.read(at, part));
        const std::string_view text(reinterpret_cast<const char*>(part.data()), part.size());
        if (text.find(what) != std::string_view::npos) return true;
    }
    return false;
}

// What the file says beside its features.
std::string native_data(const std::string& file) {
    static constexpr std::array<const char*, 2> only{"GeoJSON", nullptr}, whole{"NATIVE_DATA=YES", nullptr};
    const GdalMessages unsaid;
    const Dataset dataset(
        GDALOpenEx(file.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY, only.data(), whole.data(), nullptr));
    const OGRLayerH layer = dataset ? GDALDatasetGetLayer(dataset.get(), 0) : nullptr;
    const char* const text = layer ? GDALGetMetadataItem(layer, "NATIVE_DATA", "NATIVE_DATA") : nullptr;
    return text ? text : "";
}

}  // namespace

Result<void> check_geojson_crs(const std::string& file, FileWatch& watch) {
    ORO_TRY(const bool may_have, has(file, "\"crs\"", watch));
    if (!may_have) return {};
    const nlohmann::json told = nlohmann::json::parse(native_data(file), nullptr, false);
    if (!told.is_object() || !told.contains("crs") || told["crs"].is_null()) return {};
    const nlohmann::json name =
        told["crs"].value(nlohmann::json::json_pointer("/properties/name"), nlohmann::json());
    const std::string words = name.is_string() ? foreign_text(name.get<std::string>()) : told["crs"].dump();
    OGRSpatialReference crs;
    const GdalMessages unsaid;
    // As OGR does: no files and no network.
    const std::array<const char*, 3> limits{"ALLOW_NETWORK_ACCESS=NO", "ALLOW_FILE_ACCESS=NO", nullptr};
    if (name.is_string() && crs.SetFromUserInput(words.c_str(), limits.data()) == OGRERR_NONE) return {};
    return Error{ErrorKind::failed, "",
                 "names a coordinate reference system that PROJ does not know (" + words + ")"};
}

}  // namespace oro
