#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "geo/sources/area_of_use.h"
#include "geo/sources/raster_place.h"

namespace oro {
namespace {

// 0 where they meet, or where the source goes round along parallels.
double outside_by_deg(const Source& source, const AreaOfUse& area) {
    AreaOfUse box{source.lon.west_deg, source.south_deg, source.lon.east_deg, source.north_deg};
    if (source.full_circle) box.west_deg = -180.0, box.east_deg = 180.0;
    return outside_area_deg(area, box);
}

struct Span {
    double low, high;
};

Span span_of(double start, double per_column, double per_row, const Source& source) {
    const double x = per_column * (source.report.columns - 1), y = per_row * (source.report.rows - 1);
    return {start + std::min(0.0, x) + std::min(0.0, y), start + std::max(0.0, x) + std::max(0.0, y)};
}

std::string number_words(double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%.10g", value);
    return text;
}

}  // namespace

Result<void> check_place(const Source& source, OGRSpatialReferenceH horizontal,
                         std::vector<std::string>& doubts) {
    if (!OSRIsProjected(horizontal)) return {};
    const auto area = area_of_use(horizontal, source.crs_wkt);
    const double outside_deg = area ? outside_by_deg(source, *area) : 0.0;
    const auto& m = source.crs_from_post;
    const Span x = span_of(m[0], m[1], m[2], source), y = span_of(m[3], m[4], m[5], source);
    const auto within = [](const Span& span, double low, double high) {
        return span.low >= low && span.high <= high;
    };
    const bool looks_like_degrees = (within(x, -180.0, 360.0) && within(y, -90.0, 90.0)) ||
                                    (within(y, -180.0, 360.0) && within(x, -90.0, 90.0));
    // A survey of one room may lie around the origin of a CRS made for it, which has no area of use.
    constexpr double closest_m = 0.2, far_deg = 0.5;
    // Under any CRS: posts of no survey are so close, those of degrees are an arc second to 15.
    constexpr double closest_of_all_m = 0.005;
    const bool too_close = source.report.spacing_m <= (area ? closest_m : closest_of_all_m);
    if (looks_like_degrees && (too_close || outside_deg > far_deg)) {
        char spacing[40];
        std::snprintf(spacing, sizeof spacing, "%.3g", source.report.spacing_m);
        return Error{
            ErrorKind::failed, "",
            "its coordinates (x " + number_words(x.low) + " to " + number_words(x.high) + ", y " +
                number_words(y.low) + " to " + number_words(y.high) +
                ") look like degrees, and its coordinate reference system, " + source.report.crs +
                ", counts in metres or feet: by it posts lie " + spacing +
                " m apart. If they are degrees of WGS84, gdal_edit.py -a_srs EPSG:4326 mends the file"};
    }
    // Neighbouring zones are used far beyond their area: all of Norway in zone 33.
    constexpr double too_far_deg = 10.0;
    if (area && outside_deg > too_far_deg)
        doubts.push_back("its posts lie " + std::to_string(std::lround(outside_deg)) +
                         " degrees outside the area that its coordinate reference system is made for (" +
                         area_words(*area) + "): its coordinates or the system may be wrong");
    return {};
}

}  // namespace oro
