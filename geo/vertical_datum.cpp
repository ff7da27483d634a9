#include "geo/vertical_datum.h"

#include <proj.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/ellipsoid.h"

namespace oro {
namespace {

struct FreeContext {
    void operator()(PJ_CONTEXT* context) const { proj_context_destroy(context); }
};
struct FreeProj {
    void operator()(PJ* object) const { proj_destroy(object); }
};
struct FreeList {
    void operator()(PJ_OBJ_LIST* list) const { proj_list_destroy(list); }
};
struct FreeFactory {
    void operator()(PJ_OPERATION_FACTORY_CONTEXT* factory) const {
        proj_operation_factory_context_destroy(factory);
    }
};
using Context = std::unique_ptr<PJ_CONTEXT, FreeContext>;
using Proj = std::unique_ptr<PJ, FreeProj>;

constexpr const char* egm96_heights = "EPSG:4326+5773";
constexpr double egm96_nodes_per_deg = 4.0;

Context new_context() {
    Context context(proj_context_create());
    proj_log_level(context.get(), PJ_LOG_NONE);
    // Some of PROJ's functions write to the log whatever its level, such as a missing proj.db.
    proj_log_func(context.get(), nullptr, [](void*, int, const char*) {});
    proj_context_set_enable_network(context.get(), 0);
    return context;
}

std::string code_and_name(const PJ* object) {
    const char* const name = proj_get_name(object);
    const char* const authority = proj_get_id_auth_name(object, 0);
    const char* const code = proj_get_id_code(object, 0);
    const std::string text = name ? name : "unnamed";
    return authority && code ? std::string(authority) + ":" + code + " " + text : text;
}

// A CRS without the wrapping that TOWGS84 parameters or a geoid model give it.
Proj unbound(PJ_CONTEXT* context, Proj crs) {
    while (crs && proj_get_type(crs.get()) == PJ_TYPE_BOUND_CRS)
        crs.reset(proj_get_source_crs(context, crs.get()));
    return crs;
}

std::string wkt(PJ_CONTEXT* context, const PJ* crs) {
    const char* const text = proj_as_wkt(context, crs, PJ_WKT2_2019, nullptr);
    return text ? text : "";
}

int axis_count(PJ_CONTEXT* context, const PJ* crs) {
    const Proj system(proj_crs_get_coordinate_system(context, crs));
    return system ? proj_cs_get_axis_count(context, system.get()) : 0;
}

double metres_per_unit(PJ_CONTEXT* context, const PJ* crs, int axis) {
    const Proj system(proj_crs_get_coordinate_system(context, crs));
    double factor = 1.0;
    const char* direction = nullptr;
    if (!system || !proj_cs_get_axis_info(context, system.get(), axis, nullptr, nullptr, &direction, &factor,
                                          nullptr, nullptr, nullptr))
        return 1.0;
    return direction && std::string_view(direction) == "down" ? -factor : factor;
}

// The same heights over latitude and longitude: a geographic CRS with the vertical part of `crs`; null when
// there is none.
Proj geographic_with_heights(PJ_CONTEXT* context, const std::string& text, StatedDatum& datum) {
    const Proj crs = unbound(context, Proj(proj_create(context, text.c_str())));
    if (!crs) return nullptr;
    if (proj_get_type(crs.get()) == PJ_TYPE_COMPOUND_CRS) {
        const Proj horizontal = unbound(context, Proj(proj_crs_get_sub_crs(context, crs.get(), 0)));
        const Proj vertical = unbound(context, Proj(proj_crs_get_sub_crs(context, crs.get(), 1)));
        if (!horizontal || !vertical) return nullptr;
        datum = {code_and_name(vertical.get()), metres_per_unit(context, vertical.get(), 0)};
        const Proj geographic(proj_crs_get_geodetic_crs(context, horizontal.get()));
        if (!geographic) return nullptr;
        const std::string text_of_both = "COMPOUNDCRS[\"heights\"," + wkt(context, geographic.get()) + "," +
                                         wkt(context, vertical.get()) + "]";
        return Proj(proj_create(context, text_of_both.c_str()));
    }
    if (axis_count(context, crs.get()) != 3) return nullptr;
    Proj geographic(proj_crs_get_geodetic_crs(context, crs.get()));
    if (!geographic) return nullptr;
    datum = {"ellipsoidal height (" + code_and_name(geographic.get()) + ")",
             metres_per_unit(context, crs.get(), 2)};
    if (axis_count(context, geographic.get()) != 3) return nullptr;
    // Heights are fed to the operation in the unit of the file's own axis.
    if (std::abs(datum.metres_per_unit) != 1.0) datum.metres_per_unit = 1.0;
    return geographic;
}

struct Found {
    Proj operation;       // longitude, latitude, height to WGS84's; null when there is no usable one
    std::string grids;    // files that it uses
    std::string missing;  // what the best unusable one would need
};

std::string file_name(const std::string& path) {
    return path.substr(path.find_last_of('/') + 1);
}

// Grids of an operation; false when one of them is not on this machine.
bool grids_of(PJ_CONTEXT* context, const PJ* operation, std::string& names) {
    bool all = true;
    const int count = proj_coordoperation_get_grid_used_count(context, operation);
    for (int i = 0; i < count; ++i) {
        const char* short_name = nullptr;
        const char* full_name = nullptr;
        int available = 0;
        proj_coordoperation_get_grid_used(context, operation, i, &short_name, &full_name, nullptr, nullptr,
                                          nullptr, nullptr, &available);
        const bool located = available && full_name && *full_name;
        if (!names.empty()) names += ", ";
        names += located ? file_name(full_name) : short_name ? short_name : "unnamed grid";
        all = all && available;
    }
    return all;
}

Found find_operation(PJ_CONTEXT* context, const PJ* from, const BoundingBox& unwrapped) {
    Found found;
    const Proj to(proj_create(context, "EPSG:4979"));
    const std::unique_ptr<PJ_OPERATION_FACTORY_CONTEXT, FreeFactory> factory(
        proj_create_operation_factory_context(context, nullptr));
    if (!to || !factory) return found;
    PJ_OPERATION_FACTORY_CONTEXT* const f = factory.get();
    // A "ballpark" operation is the one that leaves heights as they are: never acceptable here.
    proj_operation_factory_context_set_allow_ballpark_transformations(context, f, 0);
    proj_operation_factory_context_set_spatial_criterion(context, f,
                                                         PROJ_SPATIAL_CRITERION_PARTIAL_INTERSECTION);
    proj_operation_factory_context_set_grid_availability_use(context, f,
                                                             PROJ_GRID_AVAILABILITY_USED_FOR_SORTING);
    if (unwrapped.east_deg - unwrapped.west_deg < 360.0)
        proj_operation_factory_context_set_area_of_interest(
            context, f, normalised_lon_deg(unwrapped.west_deg), unwrapped.south_deg,
            normalised_lon_deg(unwrapped.east_deg), unwrapped.north_deg);
    const std::unique_ptr<PJ_OBJ_LIST, FreeList> list(proj_create_operations(context, from, to.get(), f));
    const int count = list ? proj_list_get_count(list.get()) : 0;
    for (int i = 0; i < count; ++i) {
        const Proj operation(proj_list_get(context, list.get(), i));
        std::string grids;
        const bool complete = grids_of(context, operation.get(), grids);
        if (complete && proj_coordoperation_is_instantiable(context, operation.get()) &&
            !proj_coordoperation_has_ballpark_transformation(context, operation.get())) {
            found.operation.reset(proj_normalize_for_visualization(context, operation.get()));
            found.grids = grids;
            if (found.operation) return found;
        }
        if (!complete && found.missing.empty()) found.missing = grids;
    }
    return found;
}

// Lifts points in place; a point that the operation cannot take gets infinity.
void lift(PJ* operation, std::vector<double>& lon_deg, std::vector<double>& lat_deg, std::vector<double>& z) {
    proj_errno_reset(operation);
    proj_trans_generic(operation, PJ_FWD, lon_deg.data(), sizeof(double), lon_deg.size(), lat_deg.data(),
                       sizeof(double), lat_deg.size(), z.data(), sizeof(double), z.size(), nullptr, 0, 0);
}

}  // namespace

struct VerticalLibrary {
    Context context;
    Proj egm96;
};

std::optional<StatedDatum> stated_datum(const std::string& crs) {
    const Context context = new_context();
    StatedDatum datum;
    if (!geographic_with_heights(context.get(), crs, datum)) return std::nullopt;
    return datum;
}

GeoidOfRegion::GeoidOfRegion() = default;
GeoidOfRegion::GeoidOfRegion(GeoidOfRegion&&) noexcept = default;
GeoidOfRegion& GeoidOfRegion::operator=(GeoidOfRegion&&) noexcept = default;
GeoidOfRegion::~GeoidOfRegion() = default;

Result<GeoidOfRegion> GeoidOfRegion::open(bool strict) {
    GeoidOfRegion geoid;
    geoid.library_ = std::make_unique<VerticalLibrary>();
    geoid.library_->context = new_context();
    PJ_CONTEXT* const context = geoid.library_->context.get();
    const Proj heights(proj_create(context, egm96_heights));
    Found found = heights ? find_operation(context, heights.get(), {-180.0, -90.0, 180.0, 90.0}) : Found{};
    if (found.operation) {
        geoid.library_->egm96 = std::move(found.operation);
        geoid.name_ = "EGM96 (" + found.grids + ")";
        return geoid;
    }
    const std::string missing =
        found.missing.empty() ? "its database or grid for EGM96 (egm96_15.gtx)" : found.missing;
    if (strict)
        return Error{ErrorKind::failed, "vertical datum EGM96",
                     "PROJ lacks " + missing + " (package proj-data)"};
    geoid.name_ = "none (N = 0 stands in for EGM96)";
    geoid.note_ =
        "PROJ lacks " + missing +
        ": N = 0 stands in for EGM96, heights above the ellipsoid are off by up to 107 m (install proj-data)";
    return geoid;
}

UndulationField GeoidOfRegion::undulation(const BoundingBox& unwrapped) const {
    UndulationField field;
    if (!library_->egm96) return field;
    const double per_deg = egm96_nodes_per_deg;
    const auto node = [&](double angle_deg) { return angle_deg * per_deg; };
    const auto north = static_cast<std::int64_t>(std::ceil(node(unwrapped.north_deg)));
    const auto south = static_cast<std::int64_t>(std::floor(node(unwrapped.south_deg)));
    const auto west = static_cast<std::int64_t>(std::floor(node(unwrapped.west_deg)));
    const auto east = static_cast<std::int64_t>(std::ceil(node(unwrapped.east_deg)));
    field.lat = {per_deg, 0.0, north, -1, static_cast<int>(north - south + 1)};
    field.lon = {per_deg, 0.0, west, +1, static_cast<int>(east - west + 1)};
    const auto columns = static_cast<std::size_t>(field.lon.count);
    std::vector<double> lon(columns), lat(columns), z(columns);
    for (int r = 0; r < field.lat.count; ++r) {
        for (std::size_t c = 0; c < columns; ++c) {
            lon[c] = normalised_lon_deg(field.lon.at_deg(static_cast<std::int64_t>(c)));
            lat[c] = field.lat.at_deg(r);
            z[c] = 0.0;
        }
        lift(library_->egm96.get(), lon, lat, z);
        for (const double N_m : z) field.N_m.push_back(std::isfinite(N_m) ? static_cast<float>(N_m) : 0.0F);
    }
    return field;
}

GeoidOfRegion::Shift::Shift() = default;
GeoidOfRegion::Shift::Shift(Shift&&) noexcept = default;
GeoidOfRegion::Shift& GeoidOfRegion::Shift::operator=(Shift&&) noexcept = default;
GeoidOfRegion::Shift::~Shift() = default;
void GeoidOfRegion::Shift::Free::operator()(void* operation) const {
    proj_destroy(static_cast<PJ*>(operation));
}

Result<GeoidOfRegion::Shift> GeoidOfRegion::shift_from(const std::string& crs, const BoundingBox& unwrapped,
                                                       bool strict) const {
    Shift shift;
    PJ_CONTEXT* const context = library_->context.get();
    StatedDatum datum;
    const Proj heights = geographic_with_heights(context, crs, datum);
    if (!heights || datum.name.find("EGM96 height") != std::string::npos || !library_->egm96) return shift;
    Found found = find_operation(context, heights.get(), unwrapped);
    if (found.operation) {
        shift.operation_.reset(found.operation.release());
        shift.metres_per_unit_ = datum.metres_per_unit;
        return shift;
    }
    const std::string why = found.missing.empty()
                                ? "PROJ knows no way from " + datum.name + " to ellipsoidal heights"
                                : "PROJ lacks " + found.missing + " for " + datum.name;
    if (strict) return Error{ErrorKind::failed, "vertical datum", why};
    shift.note_ = why + ": EGM96 stands in";
    return shift;
}

void GeoidOfRegion::Shift::apply(const UndulationField& undulation, double lat_deg,
                                 std::span<const double> lon_deg, std::span<float> H_m) {
    if (does_nothing()) return;
    std::vector<std::size_t> where;
    std::vector<double> lon, lat, z;
    for (std::size_t i = 0; i < H_m.size(); ++i) {
        if (is_void(H_m[i])) continue;
        where.push_back(i);
        lon.push_back(normalised_lon_deg(lon_deg[i]));
        lat.push_back(lat_deg);
        z.push_back(static_cast<double>(H_m[i]) / metres_per_unit_);
    }
    if (where.empty()) return;
    lift(static_cast<PJ*>(operation_.get()), lon, lat, z);
    for (std::size_t k = 0; k < where.size(); ++k) {
        if (!std::isfinite(z[k])) {
            ++beyond_grid_;
            continue;
        }
        H_m[where[k]] = static_cast<float>(z[k] - undulation.at_m(lat_deg, lon_deg[where[k]]));
    }
}

}  // namespace oro
