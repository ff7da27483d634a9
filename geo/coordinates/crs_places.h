// Places by the coordinates of a CRS, eastings and northings for most, as maps and data in it have them.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>

#include "core/base/result.h"
#include "geo/places/bounding_box.h"
#include "geo/places/place.h"

namespace oro {

// Two coordinates as people write them: easting (or x, or longitude), then northing, between them a comma, a
// slash or spaces; 2'642'950 is 2642950. Nothing for any other text.
std::optional<std::array<double, 2>> two_coordinates(const std::string& text);
// Four with commas between them. Nothing for any other text.
std::optional<std::array<double, 4>> four_coordinates(const std::string& text);

// Turns coordinates of one CRS into places of WGS84 and back, by PROJ, the way that posts of data in that CRS
// are placed. x is the easting or the longitude, whatever order of axes the CRS states; both are in the CRS's
// own unit. Not safe to use from several threads. Errors are of usage, and say the reason alone: `where` is
// empty.
class CrsPlaces {
  public:
    enum class Reach {
        area_of_use,  // places near the area that the CRS is made for, half of its size beyond it at most
        anywhere,     // whatever PROJ can place: for data that lie there
    };
    // crs: as PROJ takes it (EPSG:2056, WKT and others); its heights do not count. Errors: PROJ does not know
    // it, or it places nothing on the Earth.
    static Result<CrsPlaces> of(const std::string& crs, Reach reach = Reach::area_of_use);
    CrsPlaces(CrsPlaces&& other) noexcept;
    CrsPlaces& operator=(CrsPlaces&& other) noexcept;
    ~CrsPlaces();

    // "EPSG:2056 CH1903+ / LV95"
    [[nodiscard]] const std::string& name() const;
    [[nodiscard]] bool is_projected() const;

    // The place (without a height or a cell) at coordinates. Its `form` is name(). Errors: coordinates that
    // have no place in the CRS, or lie beyond its reach.
    [[nodiscard]] Result<Place> place(double x, double y) const;
    // The coordinates of a place; nothing where it has none.
    [[nodiscard]] std::optional<std::array<double, 2>> coordinates(double lat_deg, double lon_deg) const;
    // The box of latitudes and longitudes around the box from (low_x, low_y) to (high_x, high_y): it holds
    // all of it, by at most some mm more. Its edges are followed, so it counts that they are bent. Around a
    // pole it has all longitudes. In a CRS of degrees low_x may be more than high_x: the box then crosses the
    // 180th meridian. Errors: a box that is none; those of place().
    [[nodiscard]] Result<BoundingBox> box(double low_x, double low_y, double high_x, double high_y) const;

  private:
    struct Transformation;
    explicit CrsPlaces(std::unique_ptr<Transformation> transformation);
    std::unique_ptr<Transformation> transformation_;
};

}  // namespace oro
