#include "geo/drape/window_read.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace oro {
namespace {

// Below so many pixels GDAL is as quick as the question whether there are any.
constexpr std::int64_t worth_asking = std::int64_t{1} << 22;
// Of the buffer: smaller parts are not split further.
constexpr int least_part = 16;

// A rectangle of the buffer.
struct BufferPart {
    int column{}, row{};
    int columns{}, rows{};
};

template <class T>
class PartReader {
  public:
    PartReader(const WindowRequest& request, FileWatch& watch, std::vector<T>& to)
        : request_(request), watch_(watch), to_(to) {}

    // NOLINTNEXTLINE(misc-no-recursion): each part is at most half of the one before
    bool read(const BufferPart& part) {
        if (watch_.spent()) return false;
        const PixelWindow pixels = pixels_of(part);
        if (std::int64_t{pixels.columns} * pixels.rows < worth_asking) return read_all(part, pixels);
        const int held = GDALGetDataCoverageStatus(request_.held_as, pixels.column, pixels.row,
                                                   pixels.columns, pixels.rows, 0, nullptr);
        const bool has_data = (held & GDAL_DATA_COVERAGE_STATUS_DATA) != 0;
        const bool has_gaps = (held & GDAL_DATA_COVERAGE_STATUS_EMPTY) != 0;
        if (has_gaps && !has_data) return fill(part, pixels);
        if (!has_gaps || std::max(part.columns, part.rows) <= least_part) return read_all(part, pixels);
        return read_quarters(part);
    }

  private:
    // NOLINTNEXTLINE(misc-no-recursion)
    bool read_quarters(const BufferPart& part) {
        const int left = part.columns > least_part ? part.columns / 2 : part.columns,
                  upper = part.rows > least_part ? part.rows / 2 : part.rows;
        for (const auto& [row, rows] : {std::pair{0, upper}, std::pair{upper, part.rows - upper}}) {
            for (const auto& [column, columns] : {std::pair{0, left}, std::pair{left, part.columns - left}}) {
                if (rows == 0 || columns == 0) continue;
                if (!read({part.column + column, part.row + row, columns, rows})) return false;
            }
        }
        return true;
    }

    // Of the whole raster's columns (or rows) where a column of the buffer begins.
    [[nodiscard]] double column_at(int column) const {
        return request_.window.column +
               static_cast<double>(column) * request_.window.columns / request_.columns;
    }
    [[nodiscard]] double row_at(int row) const {
        return request_.window.row + static_cast<double>(row) * request_.window.rows / request_.rows;
    }

    [[nodiscard]] PixelWindow pixels_of(const BufferPart& part) const {
        const auto west = static_cast<int>(std::floor(column_at(part.column))),
                   north = static_cast<int>(std::floor(row_at(part.row)));
        const int east = std::min(request_.window.column + request_.window.columns,
                                  static_cast<int>(std::ceil(column_at(part.column + part.columns)))),
                  south = std::min(request_.window.row + request_.window.rows,
                                   static_cast<int>(std::ceil(row_at(part.row + part.rows))));
        return {west, north, std::max(1, east - west), std::max(1, south - north)};
    }

    [[nodiscard]] T* at(const BufferPart& part) const {
        return to_.data() + static_cast<std::size_t>(part.row) * static_cast<std::size_t>(request_.columns) +
               static_cast<std::size_t>(part.column);
    }

    bool read_all(const BufferPart& part, const PixelWindow& pixels) {
        GDALRasterIOExtraArg more;
        INIT_RASTERIO_EXTRA_ARG(more);
        more.eResampleAlg = request_.how;
        more.pfnProgress = [](double, const char*, void* data) -> int {
            return static_cast<FileWatch*>(data)->spent() ? FALSE : TRUE;
        };
        more.pProgressData = &watch_;
        if (part.columns < request_.columns || part.rows < request_.rows) {
            more.bFloatingPointWindowValidity = TRUE;
            more.dfXOff = column_at(part.column);
            more.dfYOff = row_at(part.row);
            more.dfXSize = column_at(part.column + part.columns) - more.dfXOff;
            more.dfYSize = row_at(part.row + part.rows) - more.dfYOff;
        }
        const auto line = static_cast<GSpacing>(sizeof(T)) * request_.columns;
        return GDALRasterIOEx(request_.band, GF_Read, pixels.column, pixels.row, pixels.columns, pixels.rows,
                              at(part), part.columns, part.rows, sizeof(T) == 1 ? GDT_Byte : GDT_Float32, 0,
                              line, &more) == CE_None;
    }

    // All pixels have the value of one.
    bool fill(const BufferPart& part, const PixelWindow& pixels) {
        T value{};
        if (GDALRasterIO(request_.band, GF_Read, pixels.column, pixels.row, 1, 1, &value, 1, 1,
                         sizeof(T) == 1 ? GDT_Byte : GDT_Float32, 0, 0) != CE_None)
            return false;
        for (int row = 0; row < part.rows; ++row)
            std::fill_n(at({part.column, part.row + row, 0, 0}), part.columns, value);
        return true;
    }

    const WindowRequest& request_;
    FileWatch& watch_;
    std::vector<T>& to_;
};

}  // namespace

double share_held(GDALRasterBandH band, const PixelWindow& window) {
    double percent = 100.0;
    if (std::int64_t{window.columns} * window.rows < worth_asking) return 1.0;
    (void)GDALGetDataCoverageStatus(band, window.column, window.row, window.columns, window.rows, 0,
                                    &percent);
    return std::isfinite(percent) && percent >= 0.0 ? std::min(1.0, 0.01 * percent) : 1.0;
}

template <class T>
bool read_window(const WindowRequest& request, FileWatch& watch, std::vector<T>& to) {
    to.resize(static_cast<std::size_t>(request.columns) * static_cast<std::size_t>(request.rows));
    return PartReader<T>(request, watch, to).read({0, 0, request.columns, request.rows});
}

template bool read_window<float>(const WindowRequest&, FileWatch&, std::vector<float>&);
template bool read_window<unsigned char>(const WindowRequest&, FileWatch&, std::vector<unsigned char>&);

}  // namespace oro
