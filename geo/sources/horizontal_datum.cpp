#include "geo/sources/horizontal_datum.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string_view>
#include <tuple>
#include <utility>

#include "geo/datum/proj_operations.h"
#include "geo/files/raster_library.h"
#include "geo/sources/notes.h"
#include "geo/sources/source_words.h"

namespace oro {
namespace {

// Two answers in degrees that are the same one: 0.1 mm.
constexpr double same_place_deg = 1e-9;

struct Spot {
    double lon_deg;
    double lat_deg;
};

bool same_place(const Spot& a, const Spot& b) {
    return std::abs(std::remainder(a.lon_deg - b.lon_deg, 360.0)) <= same_place_deg &&
           std::abs(a.lat_deg - b.lat_deg) <= same_place_deg;
}

// Where the posts are put: GDAL chooses one of PROJ's operations.
std::optional<Spot> placed(const std::string& crs_wkt, double x, double y) {
    const GdalMessages messages;
    const SpatialReference crs = spatial_reference(crs_wkt);
    if (!crs) return std::nullopt;
    const CoordinateTransformation transformation(
        OCTNewCoordinateTransformation(crs.get(), wgs84_degrees().get()));
    int done = 0;
    if (!transformation || !OCTTransformEx(transformation.get(), 1, &x, &y, nullptr, &done) || !done)
        return std::nullopt;
    return Spot{x, y};
}

bool covers(PJ_CONTEXT* context, const PJ* operation, const Spot& spot) {
    double west = 0.0, south = 0.0, east = 0.0, north = 0.0;
    if (!proj_get_area_of_use(context, operation, &west, &south, &east, &north, nullptr) || south < -90.0)
        return true;  // not stated
    if (spot.lat_deg < south || spot.lat_deg > north) return false;
    const double across = east < west ? east + 360.0 - west : east - west;
    const double from_west = spot.lon_deg - west;
    return from_west - 360.0 * std::floor(from_west / 360.0) <= across;
}

std::optional<double> accuracy_of(PJ_CONTEXT* context, const PJ* operation) {
    const double accuracy_m = proj_coordoperation_get_accuracy(context, operation);
    return accuracy_m >= 0.0 ? std::optional(accuracy_m) : std::nullopt;
}

// WGS84 by any of the names that it goes by where PROJ's database cannot be asked.
bool is_wgs84(PJ_CONTEXT* context, const PJ* geographic) {
    const ProjObject datum(proj_crs_get_datum_forced(context, geographic));
    if (!datum) return false;
    const ProjObject wgs84(proj_create(context, "EPSG:4326"));
    const ProjObject its(wgs84 ? proj_crs_get_datum_forced(context, wgs84.get()) : nullptr);
    if (its && proj_is_equivalent_to_with_ctx(context, datum.get(), its.get(), PJ_COMP_EQUIVALENT))
        return true;
    const char* const name = proj_get_name(datum.get());
    constexpr std::array<std::string_view, 3> names{"World Geodetic System 1984",
                                                    "World Geodetic System 1984 ensemble", "WGS_1984"};
    return name && std::ranges::find(names, std::string_view(name)) != names.end();
}

// Datums that all the world takes for WGS84, by EPSG's null operations, with how far they are from it.
// NAD83's origin is some 2.2 m from the Earth's middle (R. Snay & T. Soler, Modern Terrestrial Reference
// Systems, Professional Surveyor, 2000); ETRS89 moves with Europe, 2.5 cm a year since 1989 (EPSG operation
// 1149 states 1 m).
bool is_one_to_two_metres(PJ_CONTEXT* context, const PJ* geographic) {
    const ProjObject datum(proj_crs_get_datum_forced(context, geographic));
    const char* const name = datum ? proj_get_name(datum.get()) : nullptr;
    const std::string_view its = name ? name : "";
    return its == "North American Datum 1983" || its == "European Terrestrial Reference System 1989" ||
           its == "European Terrestrial Reference System 1989 ensemble";
}

void set_frame_epoch(PJ_CONTEXT* context, const PJ* geographic, HorizontalDatum& found) {
    const ProjObject datum(proj_crs_get_datum(context, geographic));
    if (!datum || proj_get_type(datum.get()) != PJ_TYPE_DYNAMIC_GEODETIC_REFERENCE_FRAME) return;
    const double year = proj_dynamic_datum_get_frame_reference_epoch(context, datum.get());
    if (year > 0.0) found.frame_epoch = year;
}

// The same point by an operation of PROJ's, longitude first.
std::optional<Spot> taken_by(PJ_CONTEXT* context, const PJ* operation, double x, double y) {
    if (!proj_coordoperation_is_instantiable(context, operation)) return std::nullopt;
    const ProjObject way(proj_normalize_for_visualization(context, operation));
    if (!way) return std::nullopt;
    std::vector<double> lon{x}, lat{y}, z{0.0};
    lift(way.get(), lon, lat, z);
    if (!std::isfinite(lon[0]) || !std::isfinite(lat[0])) return std::nullopt;
    return Spot{lon[0], lat[0]};
}

// The operation that puts posts where they are put, or null.
const PJ* operation_at(PJ_CONTEXT* context, const std::vector<ProjObject>& operations, double x, double y,
                       const Spot& spot) {
    const PJ* chosen = nullptr;
    for (const ProjObject& operation : operations) {
        if (!grids_of(context, operation.get()).missing.empty()) continue;
        const auto taken = taken_by(context, operation.get(), x, y);
        if (!taken || !same_place(*taken, spot)) continue;
        // Among those that say the same here, one that is meant for this place.
        if (!chosen || (!covers(context, chosen, spot) && covers(context, operation.get(), spot)))
            chosen = operation.get();
    }
    return chosen;
}

void tell_operation(PJ_CONTEXT* context, const PJ* chosen, HorizontalDatum& found) {
    if (!chosen) return;
    found.ballpark = proj_coordoperation_has_ballpark_transformation(context, chosen) != 0;
    remember_grids(grids_of(context, chosen).paths);
    const char* const name = proj_get_name(chosen);
    found.operation = name ? name : "unnamed";
    found.accuracy_m = accuracy_of(context, chosen);
}

// The most accurate one that lacks a grid, where it is better than `good_to_m`.
void find_missing(PJ_CONTEXT* context, const std::vector<ProjObject>& operations, const Spot& spot,
                  std::optional<double> good_to_m, HorizontalDatum& found) {
    for (const ProjObject& operation : operations) {
        std::vector<std::string> missing = grids_of(context, operation.get()).missing;
        const auto accuracy_m = accuracy_of(context, operation.get());
        if (missing.empty() || !accuracy_m || !covers(context, operation.get(), spot)) continue;
        if (good_to_m && *good_to_m <= *accuracy_m) continue;
        good_to_m = accuracy_m;
        found.missing_grids = std::move(missing);
        found.accuracy_with_grids_m = accuracy_m;
    }
}

// Sources of one CRS in one place have the same answer.
using Asked = std::tuple<std::string, double, double, double, double>;

BoundingBox whole_degrees(const Source& source) {
    return {std::floor(source.lon.west_deg), std::floor(source.south_deg), std::ceil(source.lon.east_deg),
            std::ceil(source.north_deg)};
}

std::string remedy(const HorizontalDatum& datum) {
    if (datum.missing_grids.empty()) return "";
    return " (install them where PROJ looks, or leave out --strict-datum)";
}

}  // namespace

HorizontalDatum horizontal_datum(const std::string& crs_wkt, double x, double y,
                                 const BoundingBox& unwrapped) {
    HorizontalDatum found;
    const ProjContext owned = new_proj_context();
    PJ_CONTEXT* const context = owned.get();
    const auto stated = [&] { return ProjObject(proj_create(context, crs_wkt.c_str())); };
    const ProjObject crs = stated(), plain = unbound(context, stated());
    const ProjObject geographic(plain ? proj_crs_get_geodetic_crs(context, plain.get()) : nullptr);
    if (!geographic || is_wgs84(context, geographic.get())) return found;
    found.is_wgs84 = false;
    found.name = code_and_name(geographic.get());
    set_frame_epoch(context, geographic.get(), found);
    const ProjObject to(proj_create(context, "EPSG:4326"));
    const std::optional<Spot> spot = placed(crs_wkt, x, y);
    if (!spot || !to) return found;
    const auto operations = operations_between(context, crs.get(), to.get(), unwrapped, true);
    tell_operation(context, operation_at(context, operations, x, y, *spot), found);
    // Degrees of its own datum, from the map's coordinates, that are WGS84's as they are.
    const auto own = operations_between(context, plain.get(), geographic.get(), unwrapped, true);
    const auto in_own = own.empty() ? std::nullopt : taken_by(context, own.front().get(), x, y);
    found.unchanged = in_own && same_place(*in_own, *spot);
    found.one_to_two_metres = found.unchanged && is_one_to_two_metres(context, geographic.get());
    find_missing(context, operations, *spot, found.one_to_two_metres ? std::optional(2.0) : found.accuracy_m,
                 found);
    return found;
}

std::string pipeline_at(const std::string& crs_wkt, double x, double y, const BoundingBox& unwrapped) {
    const ProjContext owned = new_proj_context();
    PJ_CONTEXT* const context = owned.get();
    const ProjObject crs(proj_create(context, crs_wkt.c_str())), to(proj_create(context, "EPSG:4326"));
    const std::optional<Spot> spot = placed(crs_wkt, x, y);
    if (!crs || !spot || !to) return "";
    const auto operations = operations_between(context, crs.get(), to.get(), unwrapped, true);
    const PJ* const chosen = operation_at(context, operations, x, y, *spot);
    const char* const pipeline = chosen ? proj_as_proj_string(context, chosen, PJ_PROJ_5, nullptr) : nullptr;
    return pipeline ? pipeline : "";
}

Result<void> find_horizontal_datums(std::span<Source> sources, bool strict, std::vector<std::string>& notes) {
    std::map<Asked, HorizontalDatum> known;
    std::map<std::string, bool> is_plain;  // CRS on WGS84: the same everywhere
    for (Source& source : sources) {
        if (source.kind != SourceKind::raster) continue;
        HorizontalDatum& datum = source.report.horizontal_datum;
        const std::optional<double> epoch = datum.coordinate_epoch;
        if (!is_plain[source.crs_wkt]) {
            const BoundingBox box = whole_degrees(source);
            const Asked asked{source.crs_wkt, box.west_deg, box.south_deg, box.east_deg, box.north_deg};
            const auto [answer, is_new] = known.try_emplace(asked);
            if (is_new) {
                const auto& m = source.crs_from_post;
                const double column = 0.5 * (source.report.columns - 1);
                const double row = 0.5 * (source.report.rows - 1);
                answer->second = horizontal_datum(source.crs_wkt, m[0] + m[1] * column + m[2] * row,
                                                  m[3] + m[4] * column + m[5] * row, box);
                is_plain[source.crs_wkt] = answer->second.is_wgs84;
            }
            datum = answer->second;
        }
        datum.coordinate_epoch = epoch;
        if (datum.is_wgs84) continue;
        const std::string words = datum.name + ": " + horizontal_words(datum);
        const bool known_way = !datum.operation.empty() && !datum.ballpark;
        if (strict && (!known_way || !datum.missing_grids.empty()))
            return Error{ErrorKind::failed, source.report.path, "horizontal datum " + words + remedy(datum)};
        add_note(notes, words);
    }
    return {};
}

}  // namespace oro
