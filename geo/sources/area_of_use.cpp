#include "geo/sources/area_of_use.h"

#include <cpl_conv.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <mutex>

namespace oro {
namespace {

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

}  // namespace

// Asked of the database where the CRS states none, as the horizontal part of a compound one does not. The
// search takes tenths of a second: answers are kept by the CRS's text.
std::optional<AreaOfUse> area_of_use(OGRSpatialReferenceH crs, const std::string& wkt) {
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

double outside_area_deg(const AreaOfUse& area, const AreaOfUse& box) {
    const double north_south =
        std::max({0.0, area.south_deg - box.north_deg, box.south_deg - area.north_deg});
    double east = area.east_deg;
    if (east < area.west_deg) east += 360.0;
    double east_west = 360.0;
    for (const double turn : {-360.0, 0.0, 360.0})
        east_west = std::min(
            east_west, std::max({0.0, area.west_deg - (box.east_deg + turn), box.west_deg + turn - east}));
    return std::max(north_south, east_west);
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

}  // namespace oro
