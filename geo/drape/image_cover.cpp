#include "geo/drape/image_cover.h"

#include "geo/drape/image_pixels.h"
#include "geo/drape/pixel_values.h"
#include "geo/drape/shared_raster.h"

namespace oro {

Result<std::vector<bool>> hidden_by_images(std::span<const ImageSource> images,
                                           std::span<const double> lat_deg, std::span<const double> lon_deg) {
    std::vector<bool> hidden(lat_deg.size());
    constexpr float opaque = 0.999F;
    for (const ImageSource& image : images) {
        const SharedRaster shared(image);
        std::vector<PixelValue> pixels;
        ORO_CHECK(read_pixels_at(image, shared, lat_deg, lon_deg, [&](const PixelValue& pixel) {
            if (!hidden[pixel.place]) pixels.push_back(pixel);
            return Result<void>();
        }));
        if (pixels.empty()) continue;
        ORO_TRY(const OpenRaster open, shared.take());
        for (const PixelValue& pixel : pixels) {
            ORO_TRY(const ImagePixels read,
                    read_pixels(image, open.dataset.get(), {pixel.column, pixel.row, 1, 1}, 1));
            hidden[pixel.place] = read.colours.front()[3] >= opaque;
        }
    }
    return hidden;
}

}  // namespace oro
