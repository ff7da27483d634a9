#include "geo/sources/source_overrides.h"

#include <algorithm>
#include <cstdio>

#include "geo/files/raster_library.h"
#include "geo/sources/known_products.h"
#include "geo/sources/raster_crs.h"

namespace oro {
namespace {

// A CRS whose vertical part is meant; "" where it has none.
std::string with_heights(const std::string& text) {
    const SpatialReference crs = crs_from_text(text);
    if (!crs) return "";
    if (OSRIsCompound(crs.get()) || OSRGetAxesCount(crs.get()) == 3) return wkt_of(crs.get());
    const char* const authority = OSRGetAuthorityName(crs.get(), nullptr);
    const char* const code = OSRGetAuthorityCode(crs.get(), nullptr);
    if (!OSRIsVertical(crs.get()) || !authority || std::string(authority) != "EPSG" || !code) return "";
    return std::string("EPSG:4326+") + code;
}

// Of a product that is known by the file's name: puts what its heights refer to into the source. They are in
// metres upwards.
StatedDatum heights_of_product(Source& source) {
    if (source.kind != SourceKind::raster) return {};
    const auto known = known_file(source.report.path.substr(source.report.path.rfind('/') + 1));
    if (!known || known->heights_name.empty()) return {};
    source.vertical_crs = known->heights_crs;
    source.report.vertical_datum = {
        DatumFrom::product, std::string(known->heights_name) + ", of " + std::string(known->product), false};
    return {};
}

}  // namespace

std::optional<std::string> fault_of_source_crs(const std::string& text) {
    if (text.empty()) return std::nullopt;
    start_gdal();
    const GdalMessages messages;
    const SpatialReference crs = crs_from_text(text);
    if (!crs) return unknown_crs_words(text, "EPSG:2056");
    if (OSRIsLocal(crs.get()) || (!OSRIsGeographic(crs.get()) && !OSRIsProjected(crs.get())))
        return OSRIsVertical(crs.get()) ? "says what heights refer to, not places: --source-vertical takes it"
                                        : "is tied to no place on the Earth";
    return std::nullopt;
}

std::optional<std::string> fault_of_source_vertical(const std::string& text) {
    if (text.empty()) return std::nullopt;
    start_gdal();
    const GdalMessages messages;
    const std::string heights = with_heights(text);
    if (!heights.empty() && stated_datum(heights)) return std::nullopt;
    return "says nothing of heights that PROJ knows; e.g. EPSG:5728 (Switzerland, LN02), EPSG:5703 (NAVD88), "
           "EPSG:4979 (above the ellipsoid)";
}

Result<SourceOverrides> source_overrides(const RegionRequest& request) {
    SourceOverrides overrides{request.height_unit, request.source_crs, "", {}};
    if (const auto fault = fault_of_source_crs(request.source_crs))
        return Error{ErrorKind::usage, "--source-crs " + request.source_crs, *fault};
    if (const auto fault = fault_of_source_vertical(request.source_vertical))
        return Error{ErrorKind::usage, "--source-vertical " + request.source_vertical, *fault};
    if (request.source_vertical.empty()) return overrides;
    overrides.vertical_crs = with_heights(request.source_vertical);
    overrides.vertical = stated_datum(overrides.vertical_crs).value_or(StatedDatum{});
    return overrides;
}

StatedDatum SourceOverrides::heights_of(Source& source) const {
    if (vertical_crs.empty()) return heights_of_product(source);
    source.vertical_crs = vertical_crs;
    source.report.vertical_datum = {DatumFrom::specified, vertical.name, false};
    return vertical;
}

std::string without_crs(const std::string& local, const std::optional<std::array<double, 6>>& cell,
                        int columns, int rows) {
    const std::string what =
        (local.empty() ? std::string("states no coordinate reference system")
                       : "its coordinate reference system (" + local + ") is tied to no place on the Earth") +
        ", so where it lies is unknown. ";
    const std::string how = "--source-crs EPSG:CODE tells it; gdal_edit.py -a_srs writes it into the file";
    if (!cell) return what + how;
    const auto& m = *cell;
    const double far_x = m[0] + m[1] * columns + m[2] * rows, far_y = m[3] + m[4] * columns + m[5] * rows;
    const double west = std::min(m[0], far_x), east = std::max(m[0], far_x);
    const double south = std::min(m[3], far_y), north = std::max(m[3], far_y);
    const bool degrees = west >= -180.0 && east <= 360.0 && south >= -90.0 && north <= 90.0;
    char text[200];
    std::snprintf(text, sizeof text, "Its x run from %.10g to %.10g, its y from %.10g to %.10g: ", west, east,
                  south, north);
    return what + text +
           (degrees ? "they look like degrees (--source-crs EPSG:4326, if they are of WGS84). "
                    : "metres or feet of a projection; whoever made the file knows of which. ") +
           how;
}

}  // namespace oro
