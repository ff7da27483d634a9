#include "geo/rasters/cloud_raster.h"

#include <cpl_string.h>
#include <cpl_vsi.h>
#include <gdal.h>
#include <gdal_frmts.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <vector>

#include "geo/files/raster_library.h"
#include "geo/files/whole_file.h"
#include "geo/rasters/post_raster_place.h"

namespace oro {
namespace {

constexpr float lowest_whole = -32767.0F, highest_whole = 32767.0F, no_whole = -32768.0F;

// A file in GDAL's memory, of a name that no other call has.
struct FileInMemory {
    FileInMemory() {
        static std::atomic<int> number{0};
        path = "/vsimem/orograph-cloud-raster-" + std::to_string(number++) + ".tif";
    }
    FileInMemory(const FileInMemory&) = delete;
    FileInMemory& operator=(const FileInMemory&) = delete;
    ~FileInMemory() { VSIUnlink(path.c_str()); }
    std::string path;
};

// It writes alone, and is no format that terrain is read from (trusted_drivers()).
GDALDriverH cog_driver() {
    if (GDALGetDriverByName("COG") == nullptr) GDALRegister_COG();
    return GDALGetDriverByName("COG");
}

CPLStringList cog_options(bool whole, int threads) {
    CPLStringList options;
    for (const char* option : {"COMPRESS=DEFLATE", "LEVEL=6", "BLOCKSIZE=512", "OVERVIEWS=IGNORE_EXISTING",
                               "RESAMPLING=AVERAGE", "BIGTIFF=IF_SAFER"})
        options.AddString(option);
    options.AddString(whole ? "PREDICTOR=STANDARD" : "PREDICTOR=FLOATING_POINT");
    options.SetNameValue("NUM_THREADS", std::to_string(threads).c_str());
    return options;
}

// The band as GDAL copies from it; `whole` holds its values where they are whole numbers.
Dataset source_of(const PostRaster& raster, std::vector<std::int16_t>& whole) {
    const auto& values = raster.bands.front().values;
    if (whole.empty()) {
        // GDAL reads it alone, and takes no pointer to const.
        return dataset_over(const_cast<float*>(values.data()), GDT_Float32, raster.part.columns,
                            raster.part.rows);
    }
    std::ranges::transform(values, whole.begin(),
                           [](float value) { return static_cast<std::int16_t>(value); });
    return dataset_over(whole.data(), GDT_Int16, raster.part.columns, raster.part.rows);
}

}  // namespace

bool are_whole_numbers(const PostRaster& raster) {
    return !raster.fractions && raster.no_value == no_whole &&
           std::ranges::all_of(raster.bands.front().values, [](float value) {
               return value == no_whole ||
                      (value >= lowest_whole && value <= highest_whole && value == std::trunc(value));
           });
}

Result<CloudRasterWritten> write_cloud_raster(const std::string& path, bool overwrite,
                                              const PostRaster& raster, int threads) {
    start_gdal();
    ORO_TRY(WholeFile file, WholeFile::create(path, overwrite));
    const GdalMessages messages;
    const auto failed = [&] {
        return Error{ErrorKind::failed, path, "cannot be written: " + messages.last("GDAL says no more")};
    };
    CloudRasterWritten written{are_whole_numbers(raster), 0};
    std::vector<std::int16_t> whole(written.whole_numbers ? raster.bands.front().values.size() : 0);
    const Dataset source = source_of(raster, whole);
    if (!source || !place_posts(source.get(), raster)) return failed();
    const GDALRasterBandH band = GDALGetRasterBand(source.get(), 1);
    GDALSetDescription(band, raster.bands.front().name.c_str());
    GDALSetRasterUnitType(band, raster.bands.front().unit);
    GDALSetRasterNoDataValue(band, static_cast<double>(raster.no_value));
    const FileInMemory made;
    Dataset copy(GDALCreateCopy(cog_driver(), made.path.c_str(), source.get(), TRUE,
                                cog_options(written.whole_numbers, threads).List(), nullptr, nullptr));
    if (!copy) return failed();
    copy.reset();
    if (!messages.last("").empty()) return failed();
    vsi_l_offset size = 0;
    const GByte* const bytes = VSIGetMemFileBuffer(made.path.c_str(), &size, FALSE);
    if (bytes == nullptr) return failed();
    written.bytes = size;
    ORO_CHECK(file.write(bytes, static_cast<std::size_t>(size)));
    ORO_CHECK(file.commit());
    return written;
}

}  // namespace oro
