#include "geo/drape/image_pixels.h"

#include <algorithm>
#include <cmath>

#include "geo/files/guarded_files.h"

namespace oro {
namespace {

// Numbers in a palette cannot be averaged: they are read so many times finer along either axis, then their
// colours are.
constexpr int finer_palette = 4;

class WindowReader {
  public:
    WindowReader(const ImageSource& image, GDALDatasetH dataset, const PixelWindow& window)
        : image_(image),
          dataset_(dataset),
          window_(window),
          watch_(reading_limit_s +
                 1e-7 * window.rows * static_cast<double>(window.columns) * share_held(band(0), window)) {}

    // False where a band could not be read. T: of one byte, or float. held_as: as WindowRequest has it.
    template <class T>
    bool read(GDALRasterBandH band, GDALRasterBandH held_as, int columns, int rows, GDALRIOResampleAlg how,
              std::vector<T>& to) {
        return read_window({band, held_as, window_, columns, rows, how}, watch_, to);
    }
    template <class T>
    bool read(GDALRasterBandH band, int columns, int rows, GDALRIOResampleAlg how, std::vector<T>& to) {
        return read(band, band, columns, rows, how, to);
    }
    [[nodiscard]] GDALRasterBandH band(std::size_t i) const {
        return GDALGetRasterBand(dataset_, image_.bands[i]);
    }
    [[nodiscard]] Error fault() const {
        return {ErrorKind::failed, image_.file,
                !watch_.fault().empty() ? watch_.fault() + " (overviews make it faster: gdaladdo)"
                                        : "cannot be read near row " + std::to_string(window_.row) + ": " +
                                              messages_.last("the file is damaged")};
    }
    // Some drivers go on after a failure.
    [[nodiscard]] bool is_well() const { return watch_.fault().empty() && messages_.last("").empty(); }

  private:
    const ImageSource& image_;
    GDALDatasetH dataset_;
    PixelWindow window_;
    GdalMessages messages_;
    FileWatch watch_;
};

bool hides_nothing(GDALRasterBandH band) {
    return (GDALGetMaskFlags(band) & GMF_ALL_VALID) != 0;
}

// Where any band has a value there is something.
bool read_alpha(WindowReader& reader, std::size_t bands, int columns, int rows, GDALRIOResampleAlg how,
                std::vector<unsigned char>& alpha) {
    std::vector<unsigned char> one;
    for (std::size_t i = 0; i < bands; ++i) {
        const GDALRasterBandH band = reader.band(i);
        const bool shared = (GDALGetMaskFlags(band) & GMF_PER_DATASET) != 0;
        if (hides_nothing(band)) {
            alpha.assign(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), 255);
            return true;
        }
        const GDALRasterBandH mask = GDALGetMaskBand(band);
        const bool follows = (GDALGetMaskFlags(band) & GMF_NODATA) != 0;
        if (!reader.read(mask, follows ? band : mask, columns, rows, how, one)) return false;
        if (i == 0) alpha = one;
        std::ranges::transform(alpha, one, alpha.begin(), [](auto a, auto b) { return std::max(a, b); });
        if (shared) return true;
    }
    return true;
}

// The code, 0 to 255, of light from 0 (black) to 255 (white). Source: IEC 61966-2-1:1999, 5.2.
float code_of_light(float light) {
    const float share = light / 255.0F;
    return 255.0F * (share <= 0.0031308F ? 12.92F * share : 1.055F * std::pow(share, 1.0F / 2.4F) - 0.055F);
}

Result<void> read_values(const ImageSource& image, WindowReader& reader, ImagePixels& pixels,
                         GDALRIOResampleAlg how) {
    std::vector<unsigned char> alpha;
    if (!read_alpha(reader, image.bands.size(), pixels.columns, pixels.rows, how, alpha))
        return reader.fault();
    pixels.colours.resize(alpha.size());
    std::vector<float> values;
    const auto scale = static_cast<float>(255.0 / (image.white - image.black));
    for (std::size_t i = 0; i < image.bands.size(); ++i) {
        if (!reader.read(reader.band(i), pixels.columns, pixels.rows, how, values) || !reader.is_well())
            return reader.fault();
        for (std::size_t at = 0; at < values.size(); ++at) {
            Colour& colour = pixels.colours[at];
            if (i == 0) colour[3] = static_cast<float>(alpha[at]) / 255.0F;
            if (!std::isfinite(values[at])) colour = {};
            const float code =
                std::clamp((values[at] - static_cast<float>(image.black)) * scale, 0.0F, 255.0F);
            if (colour[3] > 0.0F)
                colour[i] = (image.is_light ? code_of_light(code) : code) * colour[3];
            else
                colour[i] = 0.0F;
        }
    }
    if (image.bands.size() == 1) {
        for (Colour& colour : pixels.colours) colour[1] = colour[2] = colour[0];
    }
    return {};
}

Result<void> read_palette(const ImageSource&, WindowReader& reader, ImagePixels& pixels) {
    const int finer =
        pixels.columns < pixels.window.columns || pixels.rows < pixels.window.rows ? finer_palette : 1;
    const int columns = pixels.columns * finer, rows = pixels.rows * finer;
    std::vector<unsigned char> alpha, numbers;
    if (!read_alpha(reader, 1, columns, rows, GRIORA_NearestNeighbour, alpha) ||
        !reader.read(reader.band(0), columns, rows, GRIORA_NearestNeighbour, numbers) || !reader.is_well())
        return reader.fault();
    GDALColorTableH const table = GDALGetRasterColorTable(reader.band(0));
    std::array<Colour, 256> colours{};
    for (int i = 0; i < std::min(256, GDALGetColorEntryCount(table)); ++i) {
        GDALColorEntry entry{};
        if (!GDALGetColorEntryAsRGB(table, i, &entry)) continue;
        const float a = static_cast<float>(std::clamp<int>(entry.c4, 0, 255)) / 255.0F;
        colours[static_cast<std::size_t>(i)] = {static_cast<float>(entry.c1) * a,
                                                static_cast<float>(entry.c2) * a,
                                                static_cast<float>(entry.c3) * a, a};
    }
    pixels.colours.assign(static_cast<std::size_t>(pixels.columns) * static_cast<std::size_t>(pixels.rows),
                          Colour{});
    const float share = 1.0F / static_cast<float>(finer * finer);
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            const std::size_t from = static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                                     static_cast<std::size_t>(column);
            Colour& to = pixels.colours[static_cast<std::size_t>(row / finer) *
                                            static_cast<std::size_t>(pixels.columns) +
                                        static_cast<std::size_t>(column / finer)];
            const float weight = share * static_cast<float>(alpha[from]) / 255.0F;
            for (std::size_t i = 0; i < 4; ++i) to[i] += weight * colours[numbers[from]][i];
        }
    }
    return {};
}

}  // namespace

Colour ImagePixels::at(double column, double row) const {
    const double x = (column - window.column) * columns / window.columns - 0.5;
    const double y = (row - window.row) * rows / window.rows - 0.5;
    Colour sum{};
    if (!(x > -1.0 && y > -1.0 && x < columns && y < rows)) return sum;
    const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
    const auto right = static_cast<float>(x - x0), down = static_cast<float>(y - y0);
    const auto add = [&](int i, int j, float share) {
        if (i < 0 || j < 0 || i >= columns || j >= rows || share == 0.0F) return;
        const Colour& one = colours[static_cast<std::size_t>(j) * static_cast<std::size_t>(columns) +
                                    static_cast<std::size_t>(i)];
        for (std::size_t k = 0; k < 4; ++k) sum[k] += share * one[k];
    };
    add(x0, y0, (1.0F - right) * (1.0F - down));
    add(x0 + 1, y0, right * (1.0F - down));
    add(x0, y0 + 1, (1.0F - right) * down);
    add(x0 + 1, y0 + 1, right * down);
    return sum;
}

Result<ImagePixels> read_pixels(const ImageSource& image, GDALDatasetH dataset, const PixelWindow& window,
                                int step) {
    ImagePixels pixels;
    pixels.window = window;
    pixels.columns = (window.columns + step - 1) / step;
    pixels.rows = (window.rows + step - 1) / step;
    WindowReader reader(image, dataset, window);
    ORO_CHECK(image.palette
                  ? read_palette(image, reader, pixels)
                  : read_values(image, reader, pixels, step > 1 ? GRIORA_Average : GRIORA_NearestNeighbour));
    return pixels;
}

}  // namespace oro
