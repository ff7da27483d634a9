#include "geo/rasters/map_frame.h"

#include <cpl_conv.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>

#include "geo/files/letter_case.h"
#include "geo/files/raster_library.h"
#include "geo/sources/area_of_use.h"
#include "geo/sources/raster_crs.h"

namespace oro {
namespace {

constexpr double widest_utm_deg = 12.0;
constexpr double most_side_px = 65500.0;

Error refused_crs(const std::optional<std::string>& text, const std::string& what) {
    return Error{ErrorKind::usage, text ? "--crs " + *text : "--crs", what};
}

// What a grid covers; longitudes in a turn near those of the first.
struct GridBox {
    const PostGrid* grid;
    double north_deg, south_deg, west_deg, east_deg;
};
std::vector<GridBox> boxes_of(std::span<const PostGrid* const> grids) {
    std::vector<GridBox> boxes;
    const auto middle_deg = [](const PostGrid& grid) { return 0.5 * (grid.west_deg() + grid.east_deg()); };
    for (const PostGrid* const grid : grids) {
        const double turn_deg = 360.0 * std::round((middle_deg(*grids.front()) - middle_deg(*grid)) / 360.0);
        boxes.push_back({grid, grid->north_deg(), grid->south_deg(), grid->west_deg() + turn_deg,
                         grid->east_deg() + turn_deg});
    }
    return boxes;
}

std::string usual_crs(const std::vector<GridBox>& boxes) {
    GridBox all = boxes.front();
    for (const GridBox& box : boxes) {
        all.north_deg = std::max(all.north_deg, box.north_deg);
        all.south_deg = std::min(all.south_deg, box.south_deg);
        all.west_deg = std::min(all.west_deg, box.west_deg);
        all.east_deg = std::max(all.east_deg, box.east_deg);
    }
    if (all.east_deg - all.west_deg > widest_utm_deg) return "EPSG:4326";
    const double lat_deg = 0.5 * (all.north_deg + all.south_deg);
    const double lon_deg = std::remainder(0.5 * (all.west_deg + all.east_deg), 360.0);
    if (lat_deg >= 84.0) return "EPSG:5041";
    if (lat_deg <= -80.0) return "EPSG:5042";
    const int zone = std::clamp(static_cast<int>(std::floor((lon_deg + 180.0) / 6.0)) + 1, 1, 60);
    return "EPSG:" + std::to_string((lat_deg >= 0.0 ? 32600 : 32700) + zone);
}

Result<SpatialReference> crs_named(const MapRequest& request, const std::vector<GridBox>& boxes) {
    start_gdal();
    const GdalMessages messages;
    const std::string text = request.crs ? *request.crs : usual_crs(boxes);
    const SpatialReference crs = crs_from_text(text);
    if (!crs) return refused_crs(request.crs, unknown_crs_words(text, "EPSG:32632"));
    if (OSRIsLocal(crs.get()) || (!OSRIsGeographic(crs.get()) && !OSRIsProjected(crs.get())))
        return refused_crs(request.crs,
                           "is no map's coordinate reference system: name a projected one or one of degrees");
    return horizontal_part(crs.get());
}

// Where in the CRS grids' rims and insides lie; longitudes of a CRS of degrees in the first grid's own turn.
class GridInCrs {
  public:
    explicit GridInCrs(OGRSpatialReferenceH crs)
        : crs_(crs), to_crs_(OCTNewCoordinateTransformation(wgs84_degrees().get(), crs)) {}

    [[nodiscard]] bool usable() const { return to_crs_ != nullptr; }

    [[nodiscard]] bool place(double lat_deg, double lon_deg, double& x, double& y) const {
        x = std::remainder(lon_deg, 360.0);
        y = lat_deg;
        int done = 0;
        OCTTransformEx(to_crs_.get(), 1, &x, &y, nullptr, &done);
        if (done == 0 || !std::isfinite(x) || !std::isfinite(y)) return false;
        if (OSRIsGeographic(crs_)) {
            const double per_turn = 2.0 * std::numbers::pi / OSRGetAngularUnits(crs_, nullptr);
            const double shift = (lon_deg / 360.0 - x / per_turn);
            x += per_turn * std::round(shift);
        }
        return true;
    }

    // False where a part of the grid has no place, or where the CRS is cut through it.
    [[nodiscard]] bool measure(const GridBox& grid) {
        constexpr int steps = 128;
        double longest = 0.0;
        for (int i = 0; i <= steps; ++i) {
            const double lat_deg = mix(grid.north_deg, grid.south_deg, i, steps);
            double last_x = 0.0, last_y = 0.0;
            for (int j = 0; j <= steps; ++j) {
                double x = 0.0, y = 0.0;
                if (!place(lat_deg, mix(grid.west_deg, grid.east_deg, j, steps), x, y)) return false;
                low_x = std::min(low_x, x);
                high_x = std::max(high_x, x);
                low_y = std::min(low_y, y);
                high_y = std::max(high_y, y);
                if (j > 0) longest = std::max(longest, std::hypot(x - last_x, y - last_y));
                last_x = x;
                last_y = y;
            }
        }
        // A step to the next place that is half as long as all: from one end of the CRS to the other.
        return longest < 0.5 * std::hypot(high_x - low_x, high_y - low_y);
    }

    double low_x{1e300}, high_x{-1e300}, low_y{1e300}, high_y{-1e300};

  private:
    static double mix(double from, double to, int i, int steps) { return from + (to - from) * i / steps; }

    OGRSpatialReferenceH crs_;
    CoordinateTransformation to_crs_;
};

// About a post's spacing from north to south, in the CRS's unit; of lengths two digits.
double usual_resolution(const GridBox& box, const GridInCrs& in_crs, OGRSpatialReferenceH crs) {
    const PostGrid& grid = *box.grid;
    const double lat_deg = 0.5 * (box.north_deg + box.south_deg);
    const double lon_deg = 0.5 * (box.west_deg + box.east_deg);
    double x = 0.0, y = 0.0, next_x = 0.0, next_y = 0.0;
    const double step_deg =
        grid.net ? deg_from_radians(Radians(grid.row_step_rad())) : grid.lat.spacing_deg();
    if (!in_crs.place(lat_deg, lon_deg, x, y) || !in_crs.place(lat_deg - step_deg, lon_deg, next_x, next_y))
        return 0.0;
    const double spacing = std::hypot(next_x - x, next_y - y);
    if (OSRIsGeographic(crs)) return step_deg * spacing / std::abs(next_y - y);
    const double digit = std::pow(10.0, std::floor(std::log10(spacing)) - 1.0);
    return std::floor(spacing / digit) * digit;
}

Result<void> lay_pixels(const MapRequest& request, const GridInCrs& in_crs, double usual, MapFrame& frame) {
    const double wide = in_crs.high_x - in_crs.low_x, tall = in_crs.high_y - in_crs.low_y;
    double left = in_crs.low_x, top = in_crs.high_y, pixel = 0.0, columns = 0.0, rows = 0.0;
    if (request.size_px) {
        columns = (*request.size_px)[0];
        rows = (*request.size_px)[1];
        pixel = std::max(wide / columns, tall / rows);
        left -= 0.5 * (columns * pixel - wide);
        top += 0.5 * (rows * pixel - tall);
    } else {
        pixel = request.resolution.value_or(usual);
        if (!(pixel > 0.0) || !std::isfinite(pixel))
            return Error{ErrorKind::usage, "--resolution", "must be more than 0"};
        // Rounding must not add a row.
        constexpr double slack = 1.0e-6;
        left = std::floor(left / pixel + slack) * pixel;
        top = std::ceil(top / pixel - slack) * pixel;
        columns = std::ceil((in_crs.high_x - left) / pixel - slack);
        rows = std::ceil((top - in_crs.low_y) / pixel - slack);
    }
    if (!(columns >= 1.0 && rows >= 1.0 && columns <= most_side_px && rows <= most_side_px)) {
        char text[160];
        std::snprintf(text, sizeof text,
                      "makes a map of %.0f x %.0f pixels; each side must be between 1 and 65500", columns,
                      rows);
        return Error{ErrorKind::usage, "--resolution", text};
    }
    frame.crs_from_pixel = {left, pixel, 0.0, top, 0.0, -pixel};
    frame.width_px = static_cast<int>(columns);
    frame.height_px = static_cast<int>(rows);
    return {};
}

}  // namespace

Result<MapFrame> map_frame(const MapRequest& request, std::span<const PostGrid* const> grids) {
    const std::vector<GridBox> boxes = boxes_of(grids);
    ORO_TRY(const SpatialReference crs, crs_named(request, boxes));
    const GdalMessages messages;
    GridInCrs in_crs(crs.get());
    if (!in_crs.usable() ||
        !std::ranges::all_of(boxes, [&](const GridBox& box) { return in_crs.measure(box); }))
        return refused_crs(request.crs,
                           "cannot hold this region: a part of it has no place there, or the CRS is cut "
                           "through it; choose one made for the region");
    MapFrame frame;
    frame.crs = text_of_crs(crs.get());
    double finest = 0.0;
    for (const GridBox& box : boxes) {
        const double resolution = usual_resolution(box, in_crs, crs.get());
        if (resolution > 0.0 && (finest == 0.0 || resolution < finest)) finest = resolution;
    }
    ORO_CHECK(lay_pixels(request, in_crs, finest, frame));
    return frame;
}

Result<MapFrame> map_frame(const MapRequest& request, const PostGrid& grid) {
    const PostGrid* const one = &grid;
    return map_frame(request, {&one, 1});
}

std::string map_crs_name(const std::string& text) {
    const GdalMessages messages;
    const SpatialReference crs = crs_from_text(text);
    return crs ? crs_name(crs.get()) : "";
}

std::string map_unit(const std::string& text) {
    const GdalMessages messages;
    const SpatialReference crs = crs_from_text(text);
    if (!crs) return "";
    char* name = nullptr;
    if (OSRIsGeographic(crs.get()))
        OSRGetAngularUnits(crs.get(), &name);
    else
        OSRGetLinearUnits(crs.get(), &name);
    return name ? name : "";
}

std::string note_of_map_area(const MapFrame& frame, const MapPlace& middle) {
    const GdalMessages messages;
    const SpatialReference crs = crs_from_text(frame.crs);
    const auto area = crs ? area_of_use(crs.get(), frame.crs) : std::nullopt;
    const double outside_deg =
        area ? outside_area_deg(*area, {middle.lon_deg, middle.lat_deg, middle.lon_deg, middle.lat_deg})
             : 0.0;
    if (!(outside_deg > 0.0)) return "";
    char degrees[40];
    std::snprintf(degrees, sizeof degrees, outside_deg < 10.0 ? "%.2g" : "%.0f", outside_deg);
    return "the map's middle lies " + std::string(degrees) +
           " degrees outside the area that its coordinate " + "reference system, " + crs_name(crs.get()) +
           ", is made for (" + area_words(*area) + "): the system may be wrong";
}

struct MapPlaces::Transformation {
    MapFrame frame;
    SpatialReference crs;
    CoordinateTransformation to_wgs84;
    std::vector<double> x, y;
    std::vector<int> done;
};

MapPlaces::MapPlaces(std::unique_ptr<Transformation> transformation)
    : transformation_(std::move(transformation)) {}
MapPlaces::MapPlaces(MapPlaces&& other) noexcept = default;
MapPlaces& MapPlaces::operator=(MapPlaces&& other) noexcept = default;
MapPlaces::~MapPlaces() = default;

Result<MapPlaces> MapPlaces::of(const MapFrame& frame) {
    start_gdal();
    const GdalMessages messages;
    auto made = std::make_unique<Transformation>();
    made->frame = frame;
    made->crs = crs_from_text(frame.crs);
    if (made->crs)
        made->to_wgs84.reset(OCTNewCoordinateTransformation(made->crs.get(), wgs84_degrees().get()));
    if (!made->to_wgs84)
        return Error{ErrorKind::usage, "--crs", "PROJ knows no way from it to WGS84: " + messages.last("")};
    return MapPlaces(std::move(made));
}

void MapPlaces::row(double x_px, double y_px, int count, std::vector<std::optional<MapPlace>>& places) {
    Transformation& t = *transformation_;
    const auto size = static_cast<std::size_t>(count);
    t.x.resize(size);
    t.y.resize(size);
    t.done.assign(size, 0);
    const auto& m = t.frame.crs_from_pixel;
    for (std::size_t i = 0; i < size; ++i) {
        const double column = x_px + static_cast<double>(i) + 0.5, row = y_px + 0.5;
        t.x[i] = m[0] + m[1] * column + m[2] * row;
        t.y[i] = m[3] + m[4] * column + m[5] * row;
    }
    const GdalMessages messages;
    OCTTransformEx(t.to_wgs84.get(), count, t.x.data(), t.y.data(), nullptr, t.done.data());
    places.assign(size, std::nullopt);
    for (std::size_t i = 0; i < size; ++i)
        if (t.done[i] != 0 && std::isfinite(t.x[i]) && std::abs(t.y[i]) <= 90.0)
            places[i] = MapPlace{t.y[i], t.x[i]};
}

std::optional<MapPlace> MapPlaces::at(double x_px, double y_px) {
    std::vector<std::optional<MapPlace>> places;
    row(x_px - 0.5, y_px - 0.5, 1, places);
    return places.front();
}

std::string world_file(const MapFrame& frame) {
    const auto& m = frame.crs_from_pixel;
    std::string text;
    // Of the middle of the first pixel.
    for (const double value :
         {m[1], m[4], m[2], m[5], m[0] + 0.5 * (m[1] + m[2]), m[3] + 0.5 * (m[4] + m[5])}) {
        char line[40];
        std::snprintf(line, sizeof line, "%.17g\n", value);
        text += line;
    }
    return text;
}

std::string world_file_path(const std::string& picture) {
    const std::filesystem::path path(picture);
    const std::string ending = lower_case(path.extension().string());
    const char* const world = ending == ".png"                        ? ".pgw"
                              : ending == ".jpg" || ending == ".jpeg" ? ".jgw"
                                                                      : ".tfw";
    return std::filesystem::path(path).replace_extension(world).string();
}

}  // namespace oro
