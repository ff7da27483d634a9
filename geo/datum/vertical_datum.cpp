#include "geo/datum/vertical_datum.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/earth/ellipsoid.h"
#include "geo/datum/proj_operations.h"
#include "geo/datum/shift_grid.h"

namespace oro {
namespace {

constexpr const char* egm96_heights = "EPSG:4326+5773";
// The same in full: PROJ 9.1 looks through its whole database for what may stand on the left of a short
// name's colon (12 ms of each start).
constexpr const char* egm96_heights_in_full = "urn:ogc:def:crs,crs:EPSG::4326,crs:EPSG::5773";
constexpr double egm96_nodes_per_deg = 4.0;

std::string wkt(PJ_CONTEXT* context, const PJ* crs) {
    const char* const text = proj_as_wkt(context, crs, PJ_WKT2_2019, nullptr);
    return text ? text : "";
}

int axis_count(PJ_CONTEXT* context, const PJ* crs) {
    const ProjObject system(proj_crs_get_coordinate_system(context, crs));
    return system ? proj_cs_get_axis_count(context, system.get()) : 0;
}

double metres_per_unit(PJ_CONTEXT* context, const PJ* crs, int axis) {
    const ProjObject system(proj_crs_get_coordinate_system(context, crs));
    double factor = 1.0;
    const char* direction = nullptr;
    if (!system || !proj_cs_get_axis_info(context, system.get(), axis, nullptr, nullptr, &direction, &factor,
                                          nullptr, nullptr, nullptr))
        return 1.0;
    return direction && std::string_view(direction) == "down" ? -factor : factor;
}

constexpr const char* egm96_datum = "5171";  // of EPSG
constexpr const char* egm2008_datum = "1027";

// True for heights above a geoid, in whatever unit: by the datum that PROJ knows as its own.
bool is_above(const char* datum_code, PJ_CONTEXT* context, const PJ* vertical_crs) {
    const ProjObject stated(proj_crs_get_datum_forced(context, vertical_crs));
    const ProjObject geoid(
        proj_create_from_database(context, "EPSG", datum_code, PJ_CATEGORY_DATUM, false, nullptr));
    return stated && geoid &&
           proj_is_equivalent_to_with_ctx(context, stated.get(), geoid.get(), PJ_COMP_EQUIVALENT) != 0;
}

// How far EGM96 may be from the geoid that it stands in for: without a grid of that one only what is known of
// the whole Earth. Source: P. Guth, U.S. Naval Academy, MICRODEM, geoid models: 0.5 m RMS, at most about 10
// m, over deep-sea trenches.
constexpr const char* egm2008_differs =
    ", which is 0.5 m (RMS) and at most about 10 m from EGM2008 over the whole Earth";
constexpr const char* differs_unknown = ", off by an amount that is not known here";

// A CRS's heights over latitude and longitude.
struct GeographicHeights {
    StatedDatum datum;
    bool is_egm2008{};
    ProjObject crs;  // geographic, with the vertical part of the CRS; null when it has none
    // Of the height that operations from `crs` take: a projected CRS may count in feet what the geographic
    // one below it counts in metres.
    double metres_per_unit{1.0};
};

// WKT that gives a compound's code may leave those of its parts out: the authority knows them.
ProjObject with_codes_of_parts(PJ_CONTEXT* context, ProjObject crs) {
    const char* const authority = crs ? proj_get_id_auth_name(crs.get(), 0) : nullptr;
    const char* const code = crs ? proj_get_id_code(crs.get(), 0) : nullptr;
    if (!authority || !code || proj_get_type(crs.get()) != PJ_TYPE_COMPOUND_CRS) return crs;
    ProjObject known(proj_create_from_database(context, authority, code, PJ_CATEGORY_CRS, false, nullptr));
    const bool is_same =
        known && proj_is_equivalent_to_with_ctx(context, known.get(), crs.get(),
                                                PJ_COMP_EQUIVALENT_EXCEPT_AXIS_ORDER_GEOGCRS) != 0;
    return is_same ? std::move(known) : std::move(crs);
}

GeographicHeights geographic_with_heights(PJ_CONTEXT* context, const std::string& text) {
    GeographicHeights heights;
    const ProjObject crs =
        with_codes_of_parts(context, unbound(context, ProjObject(proj_create(context, text.c_str()))));
    if (!crs) return heights;
    if (proj_get_type(crs.get()) == PJ_TYPE_COMPOUND_CRS) {
        const ProjObject horizontal =
            unbound(context, ProjObject(proj_crs_get_sub_crs(context, crs.get(), 0)));
        const ProjObject vertical = unbound(context, ProjObject(proj_crs_get_sub_crs(context, crs.get(), 1)));
        if (!horizontal || !vertical) return heights;
        heights.metres_per_unit = metres_per_unit(context, vertical.get(), 0);
        heights.datum = {code_and_name(vertical.get()), heights.metres_per_unit,
                         is_above(egm96_datum, context, vertical.get())};
        heights.is_egm2008 = is_above(egm2008_datum, context, vertical.get());
        const ProjObject geographic(proj_crs_get_geodetic_crs(context, horizontal.get()));
        if (!geographic) return heights;
        const std::string text_of_both = "COMPOUNDCRS[\"heights\"," + wkt(context, geographic.get()) + "," +
                                         wkt(context, vertical.get()) + "]";
        heights.crs.reset(proj_create(context, text_of_both.c_str()));
        return heights;
    }
    if (axis_count(context, crs.get()) != 3) return heights;
    ProjObject geographic(proj_crs_get_geodetic_crs(context, crs.get()));
    if (!geographic || axis_count(context, geographic.get()) != 3) return heights;
    heights.datum = {"ellipsoidal height (" + code_and_name(geographic.get()) + ")",
                     metres_per_unit(context, crs.get(), 2)};
    heights.metres_per_unit = metres_per_unit(context, geographic.get(), 2);
    heights.crs = std::move(geographic);
    return heights;
}

// Two ways of asking, each with grids that it has opened for itself, must give the same to this.
constexpr double same_answer_m = 1e-6;

constexpr BoundingBox whole_world{-180.0, -90.0, 180.0, 90.0};

// Why there is no operation for EGM96 although something is there that should give one; nothing where PROJ's
// database or the grid is not on this machine at all.
std::optional<Error> egm96_fault(PJ_CONTEXT* context, const LiftingOperation& found) {
    if (!found.unusable_grid.empty()) return damaged_grid(found.unusable_grid, "PROJ can do nothing with it");
    if (proj_context_get_database_path(context) == nullptr) {
        const std::string database = proj_file_there(context, {"proj.db"});
        if (database.empty()) return std::nullopt;
        return Error{
            ErrorKind::failed, database,
            "PROJ cannot read its own database, which is there (install it anew, package proj-data)"};
    }
    const std::string grid = proj_file_there(context, {"us_nga_egm96_15.tif", "egm96_15.gtx"});
    if (grid.empty()) return std::nullopt;
    return damaged_grid(grid, "is there, and PROJ makes no use of it");
}

}  // namespace

struct VerticalLibrary {
    ProjContext context;
    ProjObject egm96;
    std::string egm96_grid;  // its whole path
};

std::optional<StatedDatum> stated_datum(const std::string& crs) {
    const ProjContext context = new_proj_context();
    GeographicHeights heights = geographic_with_heights(context.get(), crs);
    if (!heights.crs) return std::nullopt;
    return std::move(heights.datum);
}

GridState grid_state(const std::string& heights_crs) {
    const ProjContext context = new_proj_context();
    const ProjObject heights(proj_create(context.get(), heights_crs.c_str()));
    const LiftingOperation found =
        heights ? find_lifting_operation(context.get(), heights.get(), whole_world) : LiftingOperation{};
    if (heights_crs == egm96_heights) {
        const auto geoid = GeoidOfRegion::open(false);
        if (!geoid) return {geoid.error().where, geoid.error().line()};
        const auto N = geoid->undulation(whole_world);
        return {found.grids.empty() ? "" : found.grids.front(), N ? "" : N.error().line()};
    }
    if (!found.unusable_grid.empty()) return {found.unusable_grid, "PROJ can do nothing with it"};
    for (const std::string& path : found.grids) {
        if (!ShiftGrid::can_read(path)) continue;
        auto grid = ShiftGrid::open(path);
        if (!grid) return {path, grid.error().line()};
        if (const auto read = grid->read_all(); !read.ok()) return {path, read.error().line()};
    }
    return {found.grids.empty() ? "" : found.grids.front(), ""};
}

GeoidOfRegion::GeoidOfRegion() = default;
GeoidOfRegion::GeoidOfRegion(GeoidOfRegion&&) noexcept = default;
GeoidOfRegion& GeoidOfRegion::operator=(GeoidOfRegion&&) noexcept = default;
GeoidOfRegion::~GeoidOfRegion() = default;

Result<GeoidOfRegion> GeoidOfRegion::open(bool strict) {
    GeoidOfRegion geoid;
    geoid.library_ = std::make_unique<VerticalLibrary>();
    geoid.library_->context = new_proj_context();
    PJ_CONTEXT* const context = geoid.library_->context.get();
    const ProjObject heights(proj_create(context, egm96_heights_in_full));
    LiftingOperation found =
        heights ? find_lifting_operation(context, heights.get(), whole_world) : LiftingOperation{};
    if (found.operation && !found.grids.empty()) {
        geoid.library_->egm96 = std::move(found.operation);
        geoid.library_->egm96_grid = found.grids.front();
        geoid.name_ = "EGM96 (" + file_names(found.grids) + ")";
        return geoid;
    }
    if (const auto fault = egm96_fault(context, found)) return *fault;
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

Result<UndulationField> GeoidOfRegion::undulation(const BoundingBox& unwrapped) const {
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
        for (const double N_m : z) field.N_m.push_back(static_cast<float>(N_m));
    }
    ORO_TRY(ShiftGrid grid, ShiftGrid::open(library_->egm96_grid));
    ORO_CHECK(check_undulation(field, grid));
    return field;
}

// PROJ's operation, the same once more with grids opened anew (null where it needs none), and these grids as
// GDAL reads them.
struct GeoidOfRegion::Shift::Ways {
    ProjObject first;
    ProjContext second_context;
    ProjObject second;
    std::vector<ShiftGrid> grids;
};

GeoidOfRegion::Shift::Shift() = default;
GeoidOfRegion::Shift::Shift(Shift&&) noexcept = default;
GeoidOfRegion::Shift& GeoidOfRegion::Shift::operator=(Shift&&) noexcept = default;
GeoidOfRegion::Shift::~Shift() = default;

Result<GeoidOfRegion::Shift> GeoidOfRegion::shift_from(const std::string& crs, const BoundingBox& unwrapped,
                                                       bool strict) const {
    Shift shift;
    PJ_CONTEXT* const context = library_->context.get();
    const GeographicHeights heights = geographic_with_heights(context, crs);
    const StatedDatum& datum = heights.datum;
    if (!library_->egm96 || (heights.crs && datum.is_egm96)) return shift;
    LiftingOperation found =
        heights.crs ? find_lifting_operation(context, heights.crs.get(), unwrapped) : LiftingOperation{};
    if (!found.unusable_grid.empty())
        return damaged_grid(found.unusable_grid, "PROJ can do nothing with it for " + datum.name);
    if (found.operation) {
        auto ways = std::make_unique<Shift::Ways>();
        ways->first = std::move(found.operation);
        if (!found.grids.empty()) {
            ways->second_context = new_proj_context();
            ways->second.reset(proj_clone(ways->second_context.get(), ways->first.get()));
            if (!ways->second)
                return Error{ErrorKind::failed, "vertical datum " + datum.name,
                             "PROJ cannot make its operation a second time (not enough memory?)"};
        }
        for (const std::string& path : found.grids) {
            if (!ShiftGrid::can_read(path)) continue;
            ORO_TRY(ShiftGrid grid, ShiftGrid::open(path));
            ways->grids.push_back(std::move(grid));
        }
        shift.ways_ = std::move(ways);
        shift.metres_per_unit_ = heights.metres_per_unit;
        shift.name_ = "vertical datum " + datum.name;
        return shift;
    }
    const std::string why = !heights.crs ? "PROJ cannot read what the CRS states of heights"
                            : found.missing.empty()
                                ? "PROJ knows no way from " + datum.name + " to ellipsoidal heights"
                                : "PROJ lacks " + found.missing + " for " + datum.name;
    if (strict) return Error{ErrorKind::failed, "vertical datum", why};
    shift.egm96_stands_in_ = true;
    shift.note_ = why + ": EGM96 stands in" + (heights.is_egm2008 ? egm2008_differs : differs_unknown);
    return shift;
}

Result<bool> GeoidOfRegion::Shift::is_beyond_grids(double lat_deg, double lon_deg) {
    // The datums' degrees differ by less than this many cells.
    constexpr double rim_cells = 2.0;
    if (ways_->grids.empty()) return true;
    for (ShiftGrid& grid : ways_->grids) {
        ORO_TRY(const std::optional<double> value, grid.at_m(lat_deg, lon_deg, rim_cells));
        if (!value) return true;
    }
    return false;
}

Result<void> GeoidOfRegion::Shift::apply(const UndulationField& undulation, double lat_deg,
                                         std::span<const double> lon_deg, std::span<float> H_m) {
    if (does_nothing()) return {};
    std::vector<std::size_t> where;
    std::vector<double> lon, lat, z;
    for (std::size_t i = 0; i < H_m.size(); ++i) {
        if (is_void(H_m[i])) continue;
        where.push_back(i);
        lon.push_back(normalised_lon_deg(lon_deg[i]));
        lat.push_back(lat_deg);
        z.push_back(static_cast<double>(H_m[i]) / metres_per_unit_);
    }
    if (where.empty()) return {};
    std::vector<double> lon_again = lon, lat_again = lat, z_again = z;
    lift(ways_->first.get(), lon, lat, z);
    if (ways_->second) lift(ways_->second.get(), lon_again, lat_again, z_again);
    const std::string& grid = ways_->grids.empty() ? name_ : ways_->grids.front().path();
    for (std::size_t k = 0; k < where.size(); ++k) {
        const double place_lon_deg = lon_deg[where[k]];
        const auto place = [&] {
            return " at " + std::to_string(lat_deg) + "," + std::to_string(place_lon_deg);
        };
        if (ways_->second &&
            (std::isfinite(z[k]) != std::isfinite(z_again[k]) || std::abs(z[k] - z_again[k]) > same_answer_m))
            return damaged_grid(grid, "PROJ gives " + std::to_string(z[k]) + " m and " +
                                          std::to_string(z_again[k]) + " m for the same post" + place());
        if (!std::isfinite(z[k])) {
            ORO_TRY(const bool beyond, is_beyond_grids(lat_deg, place_lon_deg));
            if (!beyond)
                return damaged_grid(grid, "PROJ gives no height" + place() + ", which lies inside it");
            ++beyond_grid_;
            continue;
        }
        H_m[where[k]] = static_cast<float>(z[k] - undulation.at_m(lat_deg, place_lon_deg));
    }
    return {};
}

}  // namespace oro
