// A grid of PROJ's as GDAL reads it: the second way of asking what PROJ says of a height. PROJ gives
// infinity, an old value or none for a grid that is cut off or cannot be read, and no error.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/terrain/post_grid.h"
#include "geo/files/raster_library.h"

namespace oro {

// What to say of a grid that is there and wrong.
Error damaged_grid(const std::string& path, const std::string& what);

class ShiftGrid {
  public:
    // True for the formats whose vertical grids GDAL reads as PROJ does (.gtx, GeoTIFF), by the file's name.
    static bool can_read(const std::string& path);
    // Errors: GDAL cannot open it, it is shorter than its header says, it is no upright grid of one band.
    static Result<ShiftGrid> open(const std::string& path);

    [[nodiscard]] const std::string& path() const { return path_; }
    // The grid's value at a place, bilinear; nothing where the grid has none: outside, and beside nodes
    // without a value. `margin` leaves out so many cells along its rim. Errors: it cannot be read there.
    // Cheap along a row.
    Result<std::optional<double>> at_m(double lat_deg, double lon_deg, double margin = 0.0);
    // Reads every node. Errors: the first row that cannot be read.
    Result<void> read_all();

  private:
    struct Row {
        int number{-1};
        std::vector<double> values;
    };
    ShiftGrid() = default;
    Result<const Row*> row(int number);
    [[nodiscard]] bool is_value(double value) const;

    std::string path_;
    Dataset dataset_;
    int rows_{};
    int columns_{};
    double north_deg_{}, west_deg_{}, lat_step_deg_{},
        lon_step_deg_{};  // of nodes; the first step is negative
    bool wraps_longitude_{};
    std::optional<double> no_value_;
    std::array<Row, 2> kept_;  // rows that were asked for last
};

// Holds N, as PROJ has given it at the nodes of a field, against the grid that it comes from, to within 1 mm,
// and against what EGM96 can be: GDAL reads zeros where zeros were written. Errors: N that is not finite or
// not what the grid says, and neighbours that no geoid has.
Result<void> check_undulation(const UndulationField& field, ShiftGrid& grid);

}  // namespace oro
