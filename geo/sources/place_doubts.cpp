#include "geo/sources/raster_place.h"

#include <cpl_conv.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <mutex>
#include <optional>

#include "geo/files/foreign_text.h"

namespace oro {
namespace {

// Degrees; east below west across the antimeridian.
struct AreaOfUse {
    double west_deg, south_deg, east_deg, north_deg;
};

std::optional<AreaOfUse> stated_area(OGRSpatialReferenceH crs) {
    AreaOfUse area{};
    if (!OSRGetAreaOfUse(crs, &area.west_deg, &area.south_deg, &area.east_deg, &area.north_deg, nullptr))
        return std::nullopt;
    if (area.south_deg < -90.0 || area.north_deg > 90.0 || area.west_deg < -180.0 || area.east_deg > 180.0)
        return std::nullopt;  // unknown
    return area;
}

std::string code_of(OGRSpatialReferenceH crs) {
    const char* const authority = OSRGetAuthorityName(crs, nullptr);
    const char* const code = OSRGetAuthorityCode(crs, nullptr);
    return authority != nullptr && code != nullptr ? std::string(authority) + ":" + code : "";
}

// The code of the CRS of PROJ's database that is the same; "" for none. Esri's .prj files have no codes.
std::string code_in_database(OGRSpatialReferenceH crs) {
    if (std::string code = code_of(crs); !code.empty()) return code;
    int count = 0;
    int* confidences = nullptr;
    OGRSpatialReferenceH* const matches = OSRFindMatches(crs, nullptr, &count, &confidences);
    constexpr int equivalent = 70;  // per cent, as GDAL counts
    const std::string code = count > 0 && confidences[0] >= equivalent ? code_of(matches[0]) : "";
    OSRFreeSRSArray(matches);
    CPLFree(confidences);
    return code;
}

// Asked of the database where the CRS states none, as the horizontal part of a compound one does not. The
// search takes tenths of a second: answers are kept by the CRS's text.
std::optional<AreaOfUse> area_of(OGRSpatialReferenceH crs, const std::string& wkt) {
    if (const auto area = stated_area(crs)) return area;
    static std::mutex mutex;
    static std::map<std::string, std::optional<AreaOfUse>> answers;
    const std::scoped_lock lock(mutex);
    if (const auto known = answers.find(wkt); known != answers.end()) return known->second;
    const GdalMessages messages;
    const std::string code = code_in_database(crs);
    const SpatialReference same(code.empty() ? nullptr : OSRNewSpatialReference(nullptr));
    const bool is_known = same && OSRSetFromUserInput(same.get(), code.c_str()) == OGRERR_NONE;
    return answers[wkt] = is_known ? stated_area(same.get()) : std::nullopt;
}

// Degrees between a source's box and an area, along a meridian or a parallel, whichever is more; 0 where they
// meet.
double outside_by_deg(const Source& source, const AreaOfUse& area) {
    const double north_south =
        std::max({0.0, area.south_deg - source.north_deg, source.south_deg - area.north_deg});
    double east = area.east_deg;
    if (east < area.west_deg) east += 360.0;
    double east_west = 360.0;
    for (const double turn : {-360.0, 0.0, 360.0})
        east_west = std::min(east_west, std::max({0.0, area.west_deg - (source.lon.east_deg + turn),
                                                  source.lon.west_deg + turn - east}));
    return std::max(north_south, source.full_circle ? 0.0 : east_west);
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

std::string area_words(const AreaOfUse& area) {
    char text[160];
    const auto side = [](double value, char positive, char negative) {
        char one[40];
        std::snprintf(one, sizeof one, "%.4g %c", std::abs(value), value < 0.0 ? negative : positive);
        return std::string(one);
    };
    std::snprintf(text, sizeof text, "%s to %s, %s to %s", side(area.south_deg, 'N', 'S').c_str(),
                  side(area.north_deg, 'N', 'S').c_str(), side(area.west_deg, 'E', 'W').c_str(),
                  side(area.east_deg, 'E', 'W').c_str());
    return text;
}

}  // namespace

Result<void> check_place(const Source& source, OGRSpatialReferenceH horizontal,
                         std::vector<std::string>& doubts) {
    if (!OSRIsProjected(horizontal)) return {};
    const auto area = area_of(horizontal, source.crs_wkt);
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
