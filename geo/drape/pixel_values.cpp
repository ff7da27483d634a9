#include "geo/drape/pixel_values.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "geo/files/guarded_files.h"

namespace oro {
namespace {

// Columns and rows of pixels.
struct BoxSize {
    int columns{1};
    int rows{1};
};

struct PixelBox {
    int column{}, row{};  // of its first pixel
    BoxSize size;
};

// So many pixels are read at a time: 512 KiB of doubles.
constexpr int pixels_at_a_time = 65536;

// The middle of a raster's longitudes, where it has some: places are looked for in the turn around it.
double middle_lon_deg(const PlacedRaster& raster) {
    const auto& m = raster.crs_from_pixel;
    return m[0] + 0.5 * (m[1] * raster.columns + m[2] * raster.rows);
}

void find_places(const PlacedRaster& raster, const ImagePlacing& placing, std::vector<double> lat_deg,
                 std::vector<double> lon_deg, std::vector<PixelPlace>& places) {
    placing.place(lon_deg, lat_deg, raster.geographic ? middle_lon_deg(raster) : 0.0, places);
}

bool is_inside(const PlacedRaster& raster, const PixelPlace& place) {
    if (!place.there()) return false;
    const double x = std::floor(place.column), y = std::floor(place.row);
    return x >= 0.0 && y >= 0.0 && x < raster.columns && y < raster.rows;
}

// The odd number of pixels that is nearest to a length of so many: at least one, at most the raster's.
int odd_count(double pixels, int all) {
    const double most = std::max(all, 1);
    return 2 * static_cast<int>(std::clamp(0.5 * pixels, 0.0, 0.5 * most)) + 1;
}

// How many pixels a cell around the first place in the raster takes.
BoxSize box_of_cell(const PlacedRaster& raster, const ImagePlacing& placing, std::span<const double> lat_deg,
                    std::span<const double> lon_deg, std::span<const PixelPlace> places,
                    const CellSize& cell) {
    const auto first =
        std::ranges::find_if(places, [&](const PixelPlace& place) { return is_inside(raster, place); });
    if (first == places.end() || !(cell.lat_deg > 0.0 && cell.lon_deg > 0.0)) return {};
    const auto i = static_cast<std::size_t>(first - places.begin());
    const double half_lat_deg = 0.5 * cell.lat_deg, half_lon_deg = 0.5 * cell.lon_deg;
    std::vector<PixelPlace> ends;
    find_places(raster, placing,
                {lat_deg[i] - half_lat_deg, lat_deg[i] + half_lat_deg, lat_deg[i], lat_deg[i]},
                {lon_deg[i], lon_deg[i], lon_deg[i] - half_lon_deg, lon_deg[i] + half_lon_deg}, ends);
    if (!std::ranges::all_of(ends, &PixelPlace::there)) return {};
    const double columns =
        std::abs(ends[1].column - ends[0].column) + std::abs(ends[3].column - ends[2].column);
    const double rows = std::abs(ends[1].row - ends[0].row) + std::abs(ends[3].row - ends[2].row);
    return {odd_count(columns, raster.columns), odd_count(rows, raster.rows)};
}

// The part of the box around a place that lies in the raster.
PixelBox box_around(const PlacedRaster& raster, const PixelPlace& place, const BoxSize& size) {
    const auto column = static_cast<int>(std::floor(place.column)),
               row = static_cast<int>(std::floor(place.row));
    PixelBox box{std::max(column - size.columns / 2, 0), std::max(row - size.rows / 2, 0), {}};
    box.size.columns = std::min(column + size.columns / 2 + 1, raster.columns) - box.column;
    box.size.rows = std::min(row + size.rows / 2 + 1, raster.rows) - box.row;
    return box;
}

// Reads boxes of pixels, some rows of a box at a time.
class BoxReader {
  public:
    BoxReader(const PlacedRaster& raster, GDALDatasetH dataset)
        : raster_(&raster), band_(GDALGetRasterBand(dataset, 1)) {}

    Result<void> read(std::size_t place, const PixelBox& box, const PixelSink& sink) {
        const int rows_at_a_time = std::max(pixels_at_a_time / box.size.columns, 1);
        for (int row = box.row; row < box.row + box.size.rows; row += rows_at_a_time) {
            const int rows = std::min(rows_at_a_time, box.row + box.size.rows - row);
            ORO_CHECK(read_rows(box, row, rows));
            for (std::size_t i = 0; i < values_.size(); ++i) {
                const int n = static_cast<int>(i);
                ORO_CHECK(sink(PixelValue{place, box.column + n % box.size.columns,
                                          row + n / box.size.columns, values_[i]}));
            }
        }
        return {};
    }

  private:
    Result<void> read_rows(const PixelBox& box, int row, int rows) {
        values_.resize(static_cast<std::size_t>(box.size.columns) * static_cast<std::size_t>(rows));
        const bool is_read =
            band_ != nullptr &&
            GDALRasterIO(band_, GF_Read, box.column, row, box.size.columns, rows, values_.data(),
                         box.size.columns, rows, GDT_Float64, 0, 0) == CE_None;
        if (is_read && watch_.fault().empty()) return {};
        return Error{ErrorKind::failed, raster_->file,
                     !watch_.fault().empty() ? watch_.fault()
                                             : "cannot be read near row " + std::to_string(row) + ": " +
                                                   messages_.last("the file is damaged")};
    }

    const PlacedRaster* raster_;
    GDALRasterBandH band_;
    GdalMessages messages_;
    FileWatch watch_{reading_limit_s};
    std::vector<double> values_;
};

}  // namespace

Result<void> read_pixels_at(const PlacedRaster& raster, const SharedRaster& shared,
                            std::span<const double> lat_deg, std::span<const double> lon_deg,
                            const PixelSink& sink) {
    return read_pixels_around(raster, shared, lat_deg, lon_deg, CellSize{}, sink);
}

Result<void> read_pixels_around(const PlacedRaster& raster, const SharedRaster& shared,
                                std::span<const double> lat_deg, std::span<const double> lon_deg,
                                const CellSize& cell, const PixelSink& sink) {
    ORO_TRY(OpenRaster open, shared.take());
    std::vector<PixelPlace> places;
    find_places(raster, open.placing, {lat_deg.begin(), lat_deg.end()}, {lon_deg.begin(), lon_deg.end()},
                places);
    const BoxSize size = box_of_cell(raster, open.placing, lat_deg, lon_deg, places, cell);
    BoxReader reader(raster, open.dataset.get());
    for (std::size_t i = 0; i < places.size(); ++i)
        if (is_inside(raster, places[i]))
            ORO_CHECK(reader.read(i, box_around(raster, places[i], size), sink));
    shared.give_back(std::move(open));
    return {};
}

}  // namespace oro
