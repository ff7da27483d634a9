#include "geo/places/place_forms.h"

#include <GeographicLib/MGRS.hpp>
#include <GeographicLib/UTMUPS.hpp>
#include <cmath>
#include <cstdio>
#include <exception>
#include <optional>

namespace oro {
namespace {

// 46°34'35.12"N
std::string dms_of(double angle_deg, const char* letters) {
    constexpr long long per_degree = 360'000;  // hundredths of a second
    const long long all = std::llround(std::abs(angle_deg) * per_degree);
    char text[40];
    std::snprintf(text, sizeof text, "%lld°%02lld'%05.2f\"%c", all / per_degree, all / 6000 % 60,
                  static_cast<double>(all % 6000) / 100.0, letters[angle_deg < 0.0 && all > 0 ? 1 : 0]);
    return text;
}

// A place on the grids of UTM or UPS, and its square of MGRS with so many digits a side.
struct GridPlace {
    double x_m{}, y_m{};
    std::string mgrs;
};
std::optional<GridPlace> grid_place(double lat_deg, double lon_deg, int digits) {
    try {
        int zone = 0;
        bool is_north = false;
        GridPlace at;
        GeographicLib::UTMUPS::Forward(lat_deg, lon_deg, zone, is_north, at.x_m, at.y_m);
        GeographicLib::MGRS::Forward(zone, is_north, at.x_m, at.y_m, lat_deg, digits, at.mgrs);
        return at;
    } catch (const std::exception&) {
        return std::nullopt;
    }
}

}  // namespace

std::string dms_text(double lat_deg, double lon_deg) {
    return dms_of(lat_deg, "NS") + " " + dms_of(lon_deg, "EW");
}

std::string utm_text(double lat_deg, double lon_deg) {
    const std::optional<GridPlace> at = grid_place(lat_deg, lon_deg, 0);
    if (!at) return "";
    // Its beginning, before two letters of 100 km: 32T, or A of the poles.
    std::string grid_zone = at->mgrs.substr(0, at->mgrs.size() - 2);
    // S alone may be the band from 32 to 40 degrees north, or the southern hemisphere.
    if (grid_zone.size() > 1 && grid_zone.back() == 'S') grid_zone.replace(grid_zone.size() - 1, 1, "north");
    char text[80];
    std::snprintf(text, sizeof text, "%s %.0f %.0f", grid_zone.c_str(), at->x_m, at->y_m);
    return text;
}

std::string mgrs_text(double lat_deg, double lon_deg) {
    const std::optional<GridPlace> at = grid_place(lat_deg, lon_deg, 5);
    return at ? at->mgrs : "";
}

}  // namespace oro
