#include "geo/drape/image_source.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geo/drape/image_values.h"
#include "geo/drape/raster_opening.h"
#include "geo/drape/window_read.h"
#include "geo/files/guarded_files.h"
#include "geo/files/raster_library.h"

namespace oro {
namespace {

Error fault(const std::string& what) {
    return Error{ErrorKind::failed, "", what};
}

// Red, green and blue by what the bands say of themselves, else the first three; of fewer the first.
Result<void> choose_bands(ImageSource& image, GDALDatasetH dataset) {
    const int count = GDALGetRasterCount(dataset);
    if (count == 0)
        return fault("holds no raster of its own (a container of several?): name the one to open");
    const auto interpretation = [&](int band) {
        return GDALGetRasterColorInterpretation(GDALGetRasterBand(dataset, band));
    };
    std::vector<int> recorded;
    for (const GDALColorInterp colour : {GCI_RedBand, GCI_GreenBand, GCI_BlueBand}) {
        for (int band = 1; band <= count; ++band) {
            if (interpretation(band) != colour) continue;
            recorded.push_back(band);
            break;
        }
    }
    if (recorded.size() == 3) {
        image.bands = recorded;
    } else if (count >= 3) {
        image.bands = {1, 2, 3};
    } else {
        image.bands = {1};
    }
    const GDALRasterBandH first = GDALGetRasterBand(dataset, image.bands.front());
    image.palette = image.bands.size() == 1 && GDALGetRasterColorTable(first) != nullptr;
    for (const int band : image.bands) {
        if (GDALDataTypeIsComplex(GDALGetRasterDataType(GDALGetRasterBand(dataset, band))))
            return fault("holds complex numbers, no image");
    }
    return {};
}

// Values of all bands of an image that are some, at most 512 x 512 pixels of it.
Result<std::vector<float>> sample_of(const ImageSource& image, GDALDatasetH dataset,
                                     const GdalMessages& messages, FileWatch& watch) {
    constexpr int most = 512;
    const int columns = std::min(image.columns, most), rows = std::min(image.rows, most);
    const PixelWindow all{0, 0, image.columns, image.rows};
    std::vector<float> values, sample;
    std::vector<unsigned char> valid;
    for (const int number : image.bands) {
        const GDALRasterBandH band = GDALGetRasterBand(dataset, number), mask = GDALGetMaskBand(band);
        const bool follows = (GDALGetMaskFlags(band) & (GMF_NODATA | GMF_ALL_VALID)) != 0;
        if (!read_window({band, band, all, columns, rows, GRIORA_NearestNeighbour}, watch, values) ||
            !read_window({mask, follows ? band : mask, all, columns, rows, GRIORA_NearestNeighbour}, watch,
                         valid))
            return fault("cannot be read: " +
                         (watch.fault().empty() ? messages.last("the file is damaged") : watch.fault()));
        for (std::size_t i = 0; i < values.size(); ++i) {
            if (valid[i] != 0 && std::isfinite(values[i])) sample.push_back(values[i]);
        }
    }
    return sample;
}

// Of light 2 in 100 of a sample are darker than black, 2 lighter than white.
void stretch(ImageSource& image, std::vector<float> sample) {
    const auto at = [&](double share) {
        const auto place =
            sample.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(sample.size() - 1));
        std::ranges::nth_element(sample, place);
        return static_cast<double>(*place);
    };
    image.black = at(0.02);
    image.white = std::max(at(0.98), std::nextafter(image.black, INFINITY));
}

Result<void> choose_range(ImageSource& image, GDALDatasetH dataset, ImageValues values,
                          const GdalMessages& messages, FileWatch& watch) {
    if (image.palette) return {};
    const bool are_bytes = std::ranges::all_of(image.bands, [&](int band) {
        return GDALGetRasterDataType(GDALGetRasterBand(dataset, band)) == GDT_Byte;
    });
    if (values == ImageValues::by_file) values = values_in(dataset, image.bands);
    image.is_light = values == ImageValues::reflectance;
    if (are_bytes && !image.is_light) return {};
    ORO_TRY(std::vector<float> sample, sample_of(image, dataset, messages, watch));
    if (sample.empty()) return {};
    if (image.is_light) {
        stretch(image, std::move(sample));
    } else {
        const auto largest = static_cast<double>(*std::ranges::max_element(sample));
        for (const int band : image.bands)
            image.white = std::max(band == image.bands.front() ? 0.0 : image.white,
                                   white_code(GDALGetRasterBand(dataset, band), largest));
    }
    char text[160];
    std::snprintf(text, sizeof text, ": its values are %staken for %s; %.6g is shown as black, %.6g as white",
                  are_bytes ? "" : "no bytes and ", image.is_light ? "linear light" : "sRGB codes",
                  image.black, image.white);
    image.notes.push_back(image.file + text);
    return {};
}

Result<void> describe(ImageSource& image, ImageValues values, const GdalMessages& messages,
                      FileWatch& watch) {
    ORO_TRY(const Dataset dataset, open_dataset(image, messages));
    ORO_CHECK(choose_bands(image, dataset.get()));
    ORO_CHECK(place_raster(image, dataset.get()));
    ORO_CHECK(choose_range(image, dataset.get(), values, messages, watch));
    return {};
}

}  // namespace

Result<ImageSource> open_image(const std::string& file, ImageValues values) {
    start_gdal();
    const GdalMessages messages;
    FileWatch watch(opening_limit_s);
    ImageSource image;
    image.file = file;
    const Result<void> described = describe(image, values, messages, watch);
    if (!watch.fault().empty()) return Error{ErrorKind::failed, file, watch.fault()};
    if (!described.ok()) return with_file(file, described.error());
    ORO_TRY(image.fingerprint, files_fingerprint(image.files));
    return image;
}

}  // namespace oro
