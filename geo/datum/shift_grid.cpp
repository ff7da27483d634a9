#include "geo/datum/shift_grid.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "geo/files/letter_case.h"

namespace oro {
namespace {

constexpr double agreement_m = 1e-3;
// EGM96 at its 15' nodes: -106.99 to 85.39 m; neighbours differ by at most 9.74 m; no node is 0.
constexpr double largest_N_m = 110.0;
constexpr double largest_step_m = 15.0;

std::string place_and_value(double lat_deg, double lon_deg, double N_m) {
    char text[120];
    if (!std::isfinite(N_m)) {
        std::snprintf(text, sizeof text, "no N at %.6g,%.6g", lat_deg, lon_deg);
        return text;
    }
    std::snprintf(text, sizeof text, "N = %.4g m at %.6g,%.6g", N_m, lat_deg, lon_deg);
    return text;
}

// The bytes that a .gtx of this size must have: 40 of header, 4 for each node.
std::uintmax_t gtx_bytes(int rows, int columns) {
    return 40 + std::uintmax_t{4} * static_cast<std::uintmax_t>(rows) * static_cast<std::uintmax_t>(columns);
}

}  // namespace

Error damaged_grid(const std::string& path, const std::string& what) {
    return Error{ErrorKind::failed, path,
                 what + ": the grid is damaged or cannot be read (package proj-data has it)"};
}

bool ShiftGrid::can_read(const std::string& path) {
    const std::string name = lower_case(path);
    return name.ends_with(".gtx") || name.ends_with(".tif") || name.ends_with(".tiff");
}

Result<ShiftGrid> ShiftGrid::open(const std::string& path) {
    start_gdal();
    const GdalMessages messages;
    const char* const drivers[] = {"GTX", "GTiff", nullptr};
    ShiftGrid grid;
    grid.path_ = path;
    grid.dataset_.reset(GDALOpenEx(path.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR,
                                   drivers, nullptr, nullptr));
    if (!grid.dataset_)
        return damaged_grid(path, "is no grid that GDAL can open (" + messages.last("unknown") + ")");
    grid.rows_ = GDALGetRasterYSize(grid.dataset_.get());
    grid.columns_ = GDALGetRasterXSize(grid.dataset_.get());
    std::array<double, 6> cell{};
    if (GDALGetRasterCount(grid.dataset_.get()) < 1 || grid.rows_ < 2 || grid.columns_ < 2 ||
        GDALGetGeoTransform(grid.dataset_.get(), cell.data()) != CE_None || cell[2] != 0.0 ||
        cell[4] != 0.0 || cell[1] <= 0.0 || cell[5] >= 0.0)
        return damaged_grid(path, "its header describes no grid");
    std::error_code fault;
    if (lower_case(path).ends_with(".gtx")) {
        const std::uintmax_t bytes = std::filesystem::file_size(path, fault);
        const std::uintmax_t due = gtx_bytes(grid.rows_, grid.columns_);
        if (fault) return damaged_grid(path, "cannot be asked for its size: " + fault.message());
        if (bytes < due)
            return damaged_grid(path, "has " + std::to_string(bytes) + " bytes, where its header tells of " +
                                          std::to_string(due));
    }
    grid.lat_step_deg_ = cell[5];
    grid.lon_step_deg_ = cell[1];
    grid.north_deg_ = cell[3] + 0.5 * cell[5];
    grid.west_deg_ = cell[0] + 0.5 * cell[1];
    grid.wraps_longitude_ = grid.columns_ + 1e-6 >= 360.0 / cell[1];
    int declared = 0;
    const double no_value = GDALGetRasterNoDataValue(GDALGetRasterBand(grid.dataset_.get(), 1), &declared);
    if (declared) grid.no_value_ = no_value;
    return grid;
}

bool ShiftGrid::is_value(double value) const {
    constexpr double rounding = 1e-5;  // no-data of a float, told as a double
    return std::isfinite(value) && !(no_value_ && std::abs(value - *no_value_) < rounding);
}

Result<const ShiftGrid::Row*> ShiftGrid::row(int number) {
    Row& kept = kept_[static_cast<std::size_t>(number % 2)];
    if (kept.number == number) return &kept;
    const GdalMessages messages;
    kept.number = -1;
    kept.values.resize(static_cast<std::size_t>(columns_));
    if (GDALRasterIO(GDALGetRasterBand(dataset_.get(), 1), GF_Read, 0, number, columns_, 1,
                     kept.values.data(), columns_, 1, GDT_Float64, 0, 0) != CE_None)
        return damaged_grid(path_, "row " + std::to_string(number) +
                                       " cannot be read: " + messages.last("the file ends early"));
    kept.number = number;
    return &kept;
}

Result<std::optional<double>> ShiftGrid::at_m(double lat_deg, double lon_deg, double margin) {
    constexpr double on_node = 1e-6;
    const auto snapped = [](double index) {
        const double whole = std::round(index);
        return std::abs(index - whole) < on_node ? whole : index;
    };
    const double y = snapped((lat_deg - north_deg_) / lat_step_deg_);
    const double turn = 360.0 / lon_step_deg_;
    double x = snapped((lon_deg - west_deg_) / lon_step_deg_);
    x = snapped(x - std::floor(x / turn) * turn);
    if (wraps_longitude_ && x >= turn) x -= turn;
    const std::optional<double> none;
    if (!(y >= margin && y <= rows_ - 1 - margin)) return none;
    if (!wraps_longitude_ && !(x >= margin && x <= columns_ - 1 - margin)) return none;
    const int north = std::min(static_cast<int>(y), rows_ - 2);
    const int west = wraps_longitude_ ? static_cast<int>(x) : std::min(static_cast<int>(x), columns_ - 2);
    const double v = y - north, u = x - west;
    double sum = 0.0;
    for (const int r : {0, 1}) {
        ORO_TRY(const Row* const values, row(north + r));
        for (const int c : {0, 1}) {
            const double weight = (r == 0 ? 1.0 - v : v) * (c == 0 ? 1.0 - u : u);
            if (weight == 0.0) continue;
            const double value = values->values[static_cast<std::size_t>((west + c) % columns_)];
            if (!is_value(value)) return none;
            sum += weight * value;
        }
    }
    return std::optional<double>(sum);
}

Result<void> ShiftGrid::read_all() {
    for (int number = 0; number < rows_; ++number) {
        ORO_TRY(const Row* const read, row(number));
        (void)read;
    }
    return {};
}

Result<void> check_undulation(const UndulationField& field, ShiftGrid& grid) {
    const auto columns = static_cast<std::size_t>(field.lon.count);
    for (int r = 0; r < field.lat.count; ++r) {
        const double lat_deg = field.lat.at_deg(r);
        for (std::size_t c = 0; c < columns; ++c) {
            const std::size_t node = static_cast<std::size_t>(r) * columns + c;
            const double N_m = field.N_m[node];
            const double lon_deg = field.lon.at_deg(static_cast<std::int64_t>(c));
            ORO_TRY(const std::optional<double> second, grid.at_m(lat_deg, lon_deg));
            if (!second || !(std::abs(*second - N_m) <= agreement_m))
                return damaged_grid(grid.path(), "PROJ takes " + place_and_value(lat_deg, lon_deg, N_m) +
                                                     " from it, and GDAL reads " +
                                                     (second ? std::to_string(*second) + " m" : "none"));
            const auto differs = [&](std::size_t neighbour) {
                const double neighbour_m = field.N_m[neighbour];
                return std::abs(N_m - neighbour_m) > largest_step_m || (N_m == 0.0 && neighbour_m == 0.0);
            };
            if (std::abs(N_m) > largest_N_m || (c > 0 && differs(node - 1)) ||
                (r > 0 && differs(node - columns)))
                return damaged_grid(grid.path(), "it says " + place_and_value(lat_deg, lon_deg, N_m) +
                                                     ", which is not EGM96");
        }
    }
    return {};
}

}  // namespace oro
