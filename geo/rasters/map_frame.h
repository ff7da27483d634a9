// Where the pixels of a map lie: a CRS, and a raster in it.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/terrain/post_grid.h"

namespace oro {

struct MapFrame {
    std::string crs;                         // EPSG:2056, or WKT2 where it has no such name; horizontal
    std::array<double, 6> crs_from_pixel{};  // as GDAL has it: x = [0] + [1] column + [2] row, y = [3] + ...
    int width_px{};
    int height_px{};
};

// What a user asks for.
struct MapRequest {
    std::optional<std::string>
        crs;  // as GDAL takes it: EPSG:2056, PROJ or WKT text; nothing: see map_frame()
    std::optional<double> resolution;  // of a pixel, in the CRS's unit; nothing: about the posts' spacing
    std::optional<std::array<int, 2>> size_px;  // instead
};

// A place of the Earth; the longitude in any whole turn.
struct MapPlace {
    double lat_deg;
    double lon_deg;
};

// A frame around all posts of some grids, at least one. Without a CRS: UTM on WGS84 of their middle (UPS near
// the poles), or longitude and latitude (EPSG:4326) where they are more than 12 degrees wide. Without a
// resolution that of the grid with the closest posts. By resolution its rims lie on
// whole multiples of it, as `gdalwarp -tap` has them. Errors (usage): a CRS that PROJ does not know or that
// lies nowhere on the Earth; one that cannot hold the grids; a resolution that is none; a map of more than
// 65,500 pixels a side.
Result<MapFrame> map_frame(const MapRequest& request, std::span<const PostGrid* const> grids);
Result<MapFrame> map_frame(const MapRequest& request, const PostGrid& grid);

// "EPSG:32632 WGS 84 / UTM zone 32N", and the name of its unit: "metre", "degree".
// Of text that is no CRS: "".
std::string map_crs_name(const std::string& crs);
std::string map_unit(const std::string& crs);
// What a user must know of a map whose middle lies outside the area that its CRS is made for; "" of others.
std::string note_of_map_area(const MapFrame& frame, const MapPlace& middle);

// Turns pixels of a map into places on WGS84, by PROJ. Not safe to ask from several threads.
class MapPlaces {
  public:
    // Errors: PROJ knows no way from there to WGS84.
    static Result<MapPlaces> of(const MapFrame& frame);
    MapPlaces(MapPlaces&& other) noexcept;
    MapPlaces& operator=(MapPlaces&& other) noexcept;
    ~MapPlaces();

    // Of so many pixels' middles from (x, y) on, eastwards; fractions are places between. Nothing where the
    // CRS has no place.
    void row(double x_px, double y_px, int count, std::vector<std::optional<MapPlace>>& places);
    [[nodiscard]] std::optional<MapPlace> at(double x_px, double y_px);

  private:
    struct Transformation;
    explicit MapPlaces(std::unique_ptr<Transformation> transformation);
    std::unique_ptr<Transformation> transformation_;
};

// The tags of a GeoTIFF that say where it lies, as GDAL writes them.
struct GeoTiffTags {
    std::vector<double> pixel_scale, tie_points, transformation;  // those that it needs; the others empty
    std::vector<std::uint16_t> keys;
    std::vector<double> doubles;
    std::string text;
};
// Errors (usage, of --crs): a CRS that a GeoTIFF cannot hold.
Result<GeoTiffTags> geotiff_tags(const MapFrame& frame);

// A world file's text: six lines.
std::string world_file(const MapFrame& frame);
// Its name beside a picture: p.tfw of p.tif, p.pgw of p.png, p.jgw of p.jpg.
std::string world_file_path(const std::string& picture);

}  // namespace oro
