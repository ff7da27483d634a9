#include "geo/canopy/canopy_source.h"

#include <array>
#include <string_view>

#include "geo/drape/raster_opening.h"
#include "geo/files/guarded_files.h"
#include "geo/files/letter_case.h"

namespace oro {
namespace {

Error no_heights(const std::string& what) {
    return Error{ErrorKind::failed, "", what};
}

Result<void> check_unit(GDALRasterBandH band) {
    constexpr std::array<std::string_view, 6> metres{"", "m", "metre", "metres", "meter", "meters"};
    const std::string unit = GDALGetRasterUnitType(band);
    for (const std::string_view one : metres)
        if (lower_case(unit) == one) return {};
    return no_heights("its heights are in " + unit + ", not in metres");
}

Result<void> take_band(CanopySource& source, GDALDatasetH dataset) {
    if (GDALGetRasterCount(dataset) == 0)
        return no_heights("holds no raster of its own (a container of several?): name the one to open");
    const GDALRasterBandH band = GDALGetRasterBand(dataset, 1);
    if (GDALDataTypeIsComplex(GDALGetRasterDataType(band)) != 0)
        return no_heights("holds complex numbers, not heights in metres");
    const GDALColorInterp colours = GDALGetRasterColorInterpretation(band);
    if (colours == GCI_RedBand) return no_heights("holds colours, not heights in metres");
    if (colours == GCI_PaletteIndex)
        return no_heights(
            "holds codes of classes, not heights in metres: --landcover FILE --canopy class takes heights "
            "from "
            "classes");
    ORO_CHECK(check_unit(band));
    int there = 0;
    const double no_data = GDALGetRasterNoDataValue(band, &there);
    if (there != 0) source.no_data = no_data;
    const double scale = GDALGetRasterScale(band, &there);
    if (there != 0) source.scale = scale;
    const double offset = GDALGetRasterOffset(band, &there);
    if (there != 0) source.offset = offset;
    return {};
}

Result<void> describe_canopy(CanopySource& source, const GdalMessages& messages) {
    ORO_TRY(const Dataset dataset, open_dataset(source, messages));
    ORO_CHECK(take_band(source, dataset.get()));
    return place_raster(source, dataset.get());
}

}  // namespace

Result<CanopySource> open_canopy_source(const std::string& file) {
    start_gdal();
    const GdalMessages messages;
    const FileWatch watch(opening_limit_s);
    CanopySource source;
    source.file = file;
    const Result<void> described = describe_canopy(source, messages);
    if (!watch.fault().empty()) return Error{ErrorKind::failed, file, watch.fault()};
    if (!described.ok()) return with_file(file, described.error());
    ORO_TRY(source.fingerprint, files_fingerprint(source.files));
    return source;
}

}  // namespace oro
