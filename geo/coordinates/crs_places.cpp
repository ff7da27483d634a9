#include "geo/coordinates/crs_places.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string_view>
#include <utility>
#include <vector>

#include "geo/files/raster_library.h"
#include "geo/sources/raster_crs.h"

namespace oro {
namespace {

Error no_place(const std::string& what) {
    return {ErrorKind::usage, "", what};
}

std::string shown(double value) {
    std::array<char, 40> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value);
    return {digits.data(), end.ptr};
}

std::string without_spaces_around(std::string_view text) {
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    if (first == std::string_view::npos) return "";
    return std::string(text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1));
}

// A number whose thousands may be marked by ' or U+2019, between digits.
std::optional<double> coordinate(std::string_view text) {
    std::string digits = without_spaces_around(text);
    for (const std::string_view mark : {std::string_view("'"), std::string_view("\u2019")}) {
        for (std::size_t at = 0; (at = digits.find(mark, at)) != std::string::npos;) {
            const auto is_digit = [&](std::size_t i) {
                return i < digits.size() && digits[i] >= '0' && digits[i] <= '9';
            };
            if (at == 0 || !is_digit(at - 1) || !is_digit(at + mark.size())) return std::nullopt;
            digits.erase(at, mark.size());
        }
    }
    const std::size_t sign = digits.starts_with('+') && !digits.starts_with("+-") ? 1 : 0;
    double value = 0.0;
    const char* const end = digits.data() + digits.size();
    const auto read = std::from_chars(digits.data() + sign, end, value);
    if (read.ec != std::errc{} || read.ptr != end || !std::isfinite(value)) return std::nullopt;
    return value;
}

template <std::size_t count>
std::optional<std::array<double, count>> coordinates_between(const std::string& text, char mark) {
    std::array<double, count> all{};
    std::size_t begin = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t end = text.find(mark, begin);
        if ((end == std::string::npos) != (i + 1 == count)) return std::nullopt;
        const auto one = coordinate(std::string_view(text).substr(begin, end - begin));
        if (!one) return std::nullopt;
        all[i] = *one;
        begin = end + 1;
    }
    return all;
}

// Of the side of a box: values at places that lie evenly along it, the first and the last at its ends.
struct ValueRange {
    double low{1e300}, high{-1e300};

    void add(double value) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
    // Between places, too: at the top of the parabola through three that follow each other.
    void add_along(const std::vector<double>& values) {
        for (const double value : values) add(value);
        for (std::size_t i = 1; i + 1 < values.size(); ++i) {
            const double before = values[i - 1], at = values[i], after = values[i + 1];
            const double bend = before - 2.0 * at + after, slope = 0.5 * (after - before);
            if (bend != 0.0 && std::abs(slope) <= std::abs(bend)) add(at - slope * slope / (2.0 * bend));
        }
    }
};

}  // namespace

std::optional<std::array<double, 2>> two_coordinates(const std::string& text) {
    const std::string plain = without_spaces_around(text);
    for (const char mark : {',', '/', ' '}) {
        if (plain.find(mark) == std::string::npos) continue;
        if (mark != ' ') return coordinates_between<2>(plain, mark);
        // Any number of spaces.
        const std::size_t gap = plain.find(' '), second = plain.find_first_not_of(' ', gap);
        return coordinates_between<2>(plain.substr(0, gap) + " " + plain.substr(second), ' ');
    }
    return std::nullopt;
}

std::optional<std::array<double, 4>> four_coordinates(const std::string& text) {
    return coordinates_between<4>(text, ',');
}

struct CrsPlaces::Transformation {
    SpatialReference crs;
    CoordinateTransformation to_wgs84, from_wgs84;
    std::string name;
    double turn{};                     // of a CRS of degrees: all around, in its unit; else 0
    std::optional<BoundingBox> reach;  // east may be beyond 180; nothing: anywhere

    [[nodiscard]] static bool apply(const CoordinateTransformation& way, double& x, double& y) {
        const GdalMessages messages;
        int done = 0;
        OCTTransformEx(way.get(), 1, &x, &y, nullptr, &done);
        return done != 0 && std::isfinite(x) && std::isfinite(y);
    }
    // The latitude and longitude, where turning them back gives the coordinates again: far from where a
    // projection is made for, its inverse gives numbers that mean nothing.
    [[nodiscard]] std::optional<std::array<double, 2>> lat_lon(double x, double y) const {
        double lon_deg = x, lat_deg = y;
        if (!apply(to_wgs84, lon_deg, lat_deg) || !(std::abs(lat_deg) <= 90.0)) return std::nullopt;
        double back_x = lon_deg, back_y = lat_deg;
        if (!apply(from_wgs84, back_x, back_y)) return std::nullopt;
        double off_x = back_x - x;
        if (turn > 0.0) off_x = std::remainder(off_x, turn);
        const double most = turn > 0.0 ? turn * 1e-9 : 0.01;  // 4 cm, 1 cm; feet are shorter
        if (!(std::hypot(off_x, back_y - y) <= most)) return std::nullopt;
        return std::array{lat_deg, std::remainder(lon_deg, 360.0)};
    }
    [[nodiscard]] bool is_within_reach(double lat_deg, double lon_deg) const {
        if (!reach) return true;
        if (lat_deg < reach->south_deg || lat_deg > reach->north_deg) return false;
        for (const double turned_deg : {lon_deg - 360.0, lon_deg, lon_deg + 360.0})
            if (turned_deg >= reach->west_deg && turned_deg <= reach->east_deg) return true;
        return false;
    }
};

namespace {

// The area that a CRS is made for, and half of its size more on each side. Nothing where it states none.
std::optional<BoundingBox> reach_of(OGRSpatialReferenceH crs) {
    BoundingBox area;
    if (!OSRGetAreaOfUse(crs, &area.west_deg, &area.south_deg, &area.east_deg, &area.north_deg, nullptr))
        return std::nullopt;
    if (area.south_deg < -90.0 || area.north_deg > 90.0 || area.west_deg < -180.0 || area.east_deg > 180.0)
        return std::nullopt;  // unknown
    if (area.east_deg < area.west_deg) area.east_deg += 360.0;
    const double wide_deg = 0.5 * (area.east_deg - area.west_deg),
                 tall_deg = 0.5 * (area.north_deg - area.south_deg);
    return BoundingBox{area.west_deg - wide_deg, area.south_deg - tall_deg, area.east_deg + wide_deg,
                       area.north_deg + tall_deg};
}

}  // namespace

CrsPlaces::CrsPlaces(std::unique_ptr<Transformation> transformation)
    : transformation_(std::move(transformation)) {}
CrsPlaces::CrsPlaces(CrsPlaces&& other) noexcept = default;
CrsPlaces& CrsPlaces::operator=(CrsPlaces&& other) noexcept = default;
CrsPlaces::~CrsPlaces() = default;

Result<CrsPlaces> CrsPlaces::of(const std::string& crs, Reach reach) {
    start_gdal();
    const GdalMessages messages;
    const SpatialReference whole = crs_from_text(crs);
    if (!whole) return no_place(unknown_crs_words(crs, "EPSG:2056"));
    if (OSRIsLocal(whole.get()) || (!OSRIsGeographic(whole.get()) && !OSRIsProjected(whole.get())))
        return no_place("places nothing on the Earth: name a projected CRS or one of degrees");
    auto made = std::make_unique<Transformation>();
    made->crs = horizontal_part(whole.get());
    made->name = crs_name(made->crs.get());
    made->to_wgs84.reset(OCTNewCoordinateTransformation(made->crs.get(), wgs84_degrees().get()));
    made->from_wgs84.reset(OCTNewCoordinateTransformation(wgs84_degrees().get(), made->crs.get()));
    if (!made->to_wgs84 || !made->from_wgs84)
        return no_place("PROJ knows no way from it to WGS84: " + messages.last("no reason is told"));
    if (OSRIsGeographic(made->crs.get()))
        made->turn = 2.0 * std::numbers::pi / OSRGetAngularUnits(made->crs.get(), nullptr);
    // A compound CRS states the area of both its parts; the horizontal one alone may state none.
    if (reach == Reach::area_of_use) {
        made->reach = reach_of(made->crs.get());
        if (!made->reach) made->reach = reach_of(whole.get());
    }
    return CrsPlaces(std::move(made));
}

const std::string& CrsPlaces::name() const {
    return transformation_->name;
}

bool CrsPlaces::is_projected() const {
    return transformation_->turn == 0.0;
}

Result<Place> CrsPlaces::place(double x, double y) const {
    const auto lat_lon = transformation_->lat_lon(x, y);
    if (!lat_lon || !transformation_->is_within_reach((*lat_lon)[0], (*lat_lon)[1])) {
        const bool is_swapped = [&] {
            const auto other = transformation_->lat_lon(y, x);
            return other && transformation_->reach &&
                   transformation_->is_within_reach((*other)[0], (*other)[1]);
        }();
        std::string what = shown(x) + "," + shown(y) +
                           (lat_lon ? " is outside the area of use of " : " has no place in ") + name();
        if (is_swapped)
            what += "; the easting comes first: the two may be swapped, " + shown(y) + "," + shown(x);
        return no_place(what);
    }
    Place place;
    place.lat_deg = (*lat_lon)[0] + 0.0;
    place.lon_deg = (*lat_lon)[1] == -180.0 ? 180.0 : (*lat_lon)[1] + 0.0;
    place.form = name();
    return place;
}

std::optional<std::array<double, 2>> CrsPlaces::coordinates(double lat_deg, double lon_deg) const {
    double x = lon_deg, y = lat_deg;
    if (!Transformation::apply(transformation_->from_wgs84, x, y)) return std::nullopt;
    return std::array{x, y};
}

Result<BoundingBox> CrsPlaces::box(double low_x, double low_y, double high_x, double high_y) const {
    const double turn = transformation_->turn;
    if (turn > 0.0 && low_x > high_x) high_x += turn;
    if (!(low_x < high_x) || !(low_y < high_y))
        return no_place("is no box; the order is west,south,east,north: XMIN,YMIN,XMAX,YMAX in " + name());
    const double middle_x = 0.5 * (low_x + high_x), middle_y = 0.5 * (low_y + high_y);
    ORO_TRY(const Place middle, place(middle_x, middle_y));
    constexpr int steps = 512;  // of a side
    const double corners[5][2] = {
        {low_x, low_y}, {high_x, low_y}, {high_x, high_y}, {low_x, high_y}, {low_x, low_y}};
    ValueRange lat, lon;
    double lon_deg = middle.lon_deg, first_lon_deg = 0.0;  // without a jump
    for (int side = 0; side < 4; ++side) {
        std::vector<double> lats, lons;
        for (int i = 0; i <= steps; ++i) {
            const double share = static_cast<double>(i) / steps;
            const double x = std::lerp(corners[side][0], corners[side + 1][0], share);
            const double y = std::lerp(corners[side][1], corners[side + 1][1], share);
            const auto there = transformation_->lat_lon(x, y);
            if (!there)
                return no_place("a part of the box has no place in " + name() + ": " + shown(x) + "," +
                                shown(y));
            lon_deg += std::remainder((*there)[1] - lon_deg, 360.0);
            if (side == 0 && i == 0) first_lon_deg = lon_deg;
            lats.push_back((*there)[0]);
            lons.push_back(lon_deg);
        }
        lat.add_along(lats);
        lon.add_along(lons);
    }
    // Once around: a pole is inside.
    if (std::abs(lon_deg - first_lon_deg) > 180.0)
        return middle.lat_deg > 0.0 ? BoundingBox{-180.0, lat.low, 180.0, 90.0}
                                    : BoundingBox{-180.0, -90.0, 180.0, lat.high};
    if (lon.high - lon.low >= 360.0) return BoundingBox{-180.0, lat.low, 180.0, lat.high};
    const auto turned = [](double angle_deg) {
        return std::abs(angle_deg) <= 180.0 ? angle_deg : std::remainder(angle_deg, 360.0);
    };
    return BoundingBox{turned(lon.low), std::max(lat.low, -90.0), turned(lon.high), std::min(lat.high, 90.0)};
}

}  // namespace oro
