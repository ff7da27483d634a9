#include "geo/cover/cover_source.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "geo/cover/cover_polygons.h"
#include "geo/drape/raster_opening.h"
#include "geo/drape/window_read.h"
#include "geo/files/guarded_files.h"

namespace oro {
namespace {

constexpr double most_pixels_looked_at = 1 << 24;
constexpr int squares_along = 16, square_px = 256;
constexpr std::size_t most_codes = 4096;
// Whole numbers up to it are floats.
constexpr float largest_code = 1 << 24;

Error no_cover(const std::string& what) {
    return Error{ErrorKind::failed, "", what};
}

Result<void> check_band(GDALDatasetH dataset) {
    if (GDALGetRasterCount(dataset) == 0)
        return no_cover("holds no raster of its own (a container of several?): name the one to open");
    const GDALRasterBandH band = GDALGetRasterBand(dataset, 1);
    if (GDALDataTypeIsComplex(GDALGetRasterDataType(band)))
        return no_cover("holds complex numbers, not the codes of classes");
    if (GDALGetRasterColorInterpretation(band) == GCI_RedBand)
        return no_cover("holds colours, not the codes of classes: --drape lays it over the ground");
    return {};
}

// Adds the codes of a window.
Result<void> add_codes(CoverSource& source, GDALRasterBandH band, const PixelWindow& window,
                       const GdalMessages& messages, FileWatch& watch, std::vector<float>& values) {
    if (!read_window({band, band, window, window.columns, window.rows, GRIORA_NearestNeighbour}, watch,
                     values))
        return no_cover("cannot be read: " +
                        (watch.fault().empty() ? messages.last("the file is damaged") : watch.fault()));
    float before = NAN;
    for (const float value : values) {
        if (value == before || std::isnan(value)) continue;
        before = value;
        if (value != std::trunc(value) || std::abs(value) > largest_code)
            return no_cover("holds " + std::to_string(value) + ", which is no code of a class");
        if (const int code = static_cast<int>(value); code != source.no_data) source.codes.insert(code);
        if (source.codes.size() > most_codes)
            return no_cover("holds more than 4096 different codes: it is no raster of classes");
    }
    return {};
}

Result<void> look_for_codes(CoverSource& source, GDALDatasetH dataset, const GdalMessages& messages,
                            FileWatch& watch) {
    const GDALRasterBandH band = GDALGetRasterBand(dataset, 1);
    int has_no_data = 0;
    const double no_data = GDALGetRasterNoDataValue(band, &has_no_data);
    if (has_no_data != 0 && std::abs(no_data) <= static_cast<double>(largest_code))
        source.no_data = static_cast<int>(no_data);
    std::vector<float> values;
    if (static_cast<double>(source.columns) * source.rows <= most_pixels_looked_at)
        return add_codes(source, band, {0, 0, source.columns, source.rows}, messages, watch, values);
    const int columns = std::min(square_px, source.columns), rows = std::min(square_px, source.rows);
    for (int i = 0; i < squares_along * squares_along; ++i) {
        const auto first = [](int number, int all, int taken) {
            return static_cast<int>(static_cast<double>(all - taken) * number / (squares_along - 1));
        };
        ORO_CHECK(add_codes(source, band,
                            {first(i % squares_along, source.columns, columns),
                             first(i / squares_along, source.rows, rows), columns, rows},
                            messages, watch, values));
    }
    return {};
}

Result<void> describe_cover(CoverSource& source, const GdalMessages& messages, FileWatch& watch) {
    ORO_TRY(const Dataset dataset, open_dataset(source, messages));
    ORO_CHECK(check_band(dataset.get()));
    ORO_CHECK(place_raster(source, dataset.get()));
    return look_for_codes(source, dataset.get(), messages, watch);
}

}  // namespace

Result<CoverSource> open_cover_source(const std::string& file) {
    if (is_vector_file(file)) return open_cover_polygons(file);
    start_gdal();
    const GdalMessages messages;
    FileWatch watch(opening_limit_s);
    CoverSource source;
    source.file = file;
    const Result<void> described = describe_cover(source, messages, watch);
    if (!watch.fault().empty()) return Error{ErrorKind::failed, file, watch.fault()};
    if (!described.ok()) return with_file(file, described.error());
    ORO_TRY(source.fingerprint, files_fingerprint(source.files));
    return source;
}

}  // namespace oro
