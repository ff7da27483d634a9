// GDAL writes a GeoTIFF of one pixel into memory; its tags are then those of any picture in the same place.
#include <cpl_vsi.h>
#include <gdal.h>

#include <cstring>
#include <span>

#include "geo/files/raster_library.h"
#include "geo/rasters/map_frame.h"
#include "geo/sources/raster_crs.h"

namespace oro {
namespace {

constexpr const char* in_memory = "/vsimem/orograph-geotiff-tags.tif";

struct MemoryFile {
    MemoryFile() = default;
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;
    ~MemoryFile() { VSIUnlink(in_memory); }
    [[nodiscard]] static std::span<const std::uint8_t> bytes() {
        vsi_l_offset size = 0;
        const GByte* const data = VSIGetMemFileBuffer(in_memory, &size, FALSE);
        return {data, static_cast<std::size_t>(size)};
    }
};

template <class T>
T number_at(std::span<const std::uint8_t> bytes, std::size_t at) {
    T value{};
    if (at + sizeof value <= bytes.size()) std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
}

template <class T>
std::vector<T> numbers_at(std::span<const std::uint8_t> bytes, std::size_t at, std::size_t count) {
    std::vector<T> values(at + count * sizeof(T) <= bytes.size() ? count : 0);
    if (!values.empty()) std::memcpy(values.data(), bytes.data() + at, count * sizeof(T));
    return values;
}

// Of the first directory of a classic TIFF in this machine's byte order, which is what GDAL was asked for.
GeoTiffTags tags_in(std::span<const std::uint8_t> bytes) {
    GeoTiffTags tags;
    const std::size_t directory = number_at<std::uint32_t>(bytes, 4);
    const std::size_t entries = number_at<std::uint16_t>(bytes, directory);
    for (std::size_t i = 0; i < entries; ++i) {
        const std::size_t entry = directory + 2 + 12 * i;
        const auto tag = number_at<std::uint16_t>(bytes, entry);
        const std::size_t count = number_at<std::uint32_t>(bytes, entry + 4);
        const std::size_t each = tag == 34735 ? 2 : tag == 34737 ? 1 : 8;
        // Values of up to four bytes stand in the entry itself.
        const std::size_t at = count * each <= 4 ? entry + 8 : number_at<std::uint32_t>(bytes, entry + 8);
        if (tag == 33550) tags.pixel_scale = numbers_at<double>(bytes, at, count);
        if (tag == 33922) tags.tie_points = numbers_at<double>(bytes, at, count);
        if (tag == 34264) tags.transformation = numbers_at<double>(bytes, at, count);
        if (tag == 34735) tags.keys = numbers_at<std::uint16_t>(bytes, at, count);
        if (tag == 34736) tags.doubles = numbers_at<double>(bytes, at, count);
        if (tag != 34737) continue;
        for (const char c : numbers_at<char>(bytes, at, count))
            if (c != '\0') tags.text += c;
    }
    return tags;
}

// A GeoTIFF says nothing of the order of latitude and longitude (OGC:CRS84 differs from EPSG:4326 in that
// alone): its x is always the longitude, as here.
bool reads_back(const SpatialReference& crs) {
    const Dataset again(GDALOpen(in_memory, GA_ReadOnly));
    const OGRSpatialReferenceH read = again ? GDALGetSpatialRef(again.get()) : nullptr;
    const char* const how[] = {"IGNORE_DATA_AXIS_TO_SRS_AXIS_MAPPING=YES",
                               "CRITERION=EQUIVALENT_EXCEPT_AXIS_ORDER_GEOGCRS", nullptr};
    return read != nullptr && OSRIsSameEx(read, crs.get(), how) != 0;
}

}  // namespace

Result<GeoTiffTags> geotiff_tags(const MapFrame& frame) {
    start_gdal();
    const GdalMessages messages;
    const MemoryFile file;
    const Error failed{ErrorKind::usage, "--crs", "a GeoTIFF cannot hold it; choose another, or write .png"};
    const SpatialReference crs = crs_from_text(frame.crs);
    const char* const options[] = {"ENDIANNESS=NATIVE", "BIGTIFF=NO", nullptr};
    Dataset dataset(
        GDALCreate(GDALGetDriverByName("GTiff"), in_memory, 1, 1, 1, GDT_Byte, const_cast<char**>(options)));
    if (!crs || !dataset) return failed;
    auto corners = frame.crs_from_pixel;
    if (GDALSetGeoTransform(dataset.get(), corners.data()) != CE_None ||
        GDALSetSpatialRef(dataset.get(), crs.get()) != CE_None)
        return failed;
    dataset.reset();
    GeoTiffTags tags = tags_in(MemoryFile::bytes());
    if (tags.keys.empty() || !reads_back(crs)) return failed;
    return tags;
}

}  // namespace oro
