// Where the texels of a tile fall in an image.
#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "core/drape/ground_image.h"
#include "geo/drape/placed_raster.h"
#include "geo/files/raster_library.h"

namespace oro {

// A place of an image, in pixels from the corner of its first one; no number where PROJ has none.
struct PixelPlace {
    double column{};
    double row{};
    [[nodiscard]] bool there() const { return std::isfinite(column) && std::isfinite(row); }
};

// From the places of a region to those of an image, by PROJ. Not for several threads at a time.
class ImagePlacing {
  public:
    // Null where PROJ knows no way from WGS84 to the image's CRS.
    static std::optional<ImagePlacing> of(const PlacedRaster& raster);

    // lon_deg and lat_deg are WGS84's and become places of the image. Longitudes of a geographic CRS are
    // given in the turn that is nearest to `near_lon_deg`.
    void place(std::vector<double>& lon_deg, std::vector<double>& lat_deg, double near_lon_deg,
               std::vector<PixelPlace>& places) const;
    // The place on the Earth of one pixel, WGS84 degrees; nothing where PROJ has none.
    struct Spot {
        double lon_deg;
        double lat_deg;
    };
    [[nodiscard]] std::optional<Spot> spot(const PixelPlace& place) const;
    // What a whole turn is in pixels; nothing where longitudes do not go round.
    [[nodiscard]] std::optional<PixelPlace> turn() const;

  private:
    explicit ImagePlacing(const PlacedRaster& raster) : raster_(&raster) {}
    const PlacedRaster* raster_;
    CoordinateTransformation to_image_, from_image_;
};

// Where the texels of one tile fall: found by PROJ at the nodes of a net, bilinear between them. The net is
// so fine that half way between its nodes that is off by at most 1/20 of a texel.
class TilePlacing {
  public:
    TilePlacing(const PostGrid& grid, const ImageTile& tile, const ImagePlacing& placing);

    // u and v: columns and rows of texels, 0 the middle of the tile's first one, -1 .. 256 with its rim.
    [[nodiscard]] PixelPlace at(double u, double v) const;
    // The rectangle that holds them all; false where there is none.
    [[nodiscard]] bool bounds(PixelPlace& low, PixelPlace& high) const;
    // Pixels from one texel to the next, along rows (x) and columns (y) of texels; on average.
    [[nodiscard]] PixelPlace per_texel() const { return per_texel_; }

  private:
    void lay(int cells, const ImagePlacing& placing);
    [[nodiscard]] bool holds(const ImagePlacing& placing) const;
    [[nodiscard]] std::vector<PixelPlace> places(const std::vector<double>& u, const std::vector<double>& v,
                                                 const ImagePlacing& placing) const;
    void measure();

    const PostGrid* grid_;
    ImageTile tile_;
    int cells_{};
    std::vector<PixelPlace> nodes_;
    PixelPlace per_texel_;
};

}  // namespace oro
