#include "geo/datum/proj_operations.h"

#include <sys/stat.h>

#include <cstdlib>
#include <filesystem>
#include <string_view>

#include "core/base/files_read.h"
#include "core/earth/ellipsoid.h"
#include "geo/files/library_faults.h"

namespace oro {
namespace {

struct FreeList {
    void operator()(PJ_OBJ_LIST* list) const { proj_list_destroy(list); }
};
struct FreeFactory {
    void operator()(PJ_OPERATION_FACTORY_CONTEXT* factory) const {
        proj_operation_factory_context_destroy(factory);
    }
};

}  // namespace

void remember_grids(const std::vector<std::string>& paths) {
    for (const std::string& path : paths) {
        struct stat found {};
        if (stat(path.c_str(), &found) == 0) remember_file_read(path, found);
    }
}

OperationGrids grids_of(PJ_CONTEXT* context, const PJ* operation) {
    OperationGrids grids;
    const int count = proj_coordoperation_get_grid_used_count(context, operation);
    for (int i = 0; i < count; ++i) {
        const char* short_name = nullptr;
        const char* full_name = nullptr;
        int available = 0;
        proj_coordoperation_get_grid_used(context, operation, i, &short_name, &full_name, nullptr, nullptr,
                                          nullptr, nullptr, &available);
        const bool located = available && full_name && *full_name;
        if (located) grids.paths.emplace_back(full_name);
        const std::string name = located ? file_names({full_name}) : short_name ? short_name : "unnamed grid";
        grids.names += (grids.names.empty() ? "" : ", ") + name;
        if (!located) grids.missing.push_back(name);
    }
    return grids;
}

std::vector<ProjObject> operations_between(PJ_CONTEXT* context, const PJ* from, const PJ* to,
                                           const BoundingBox& unwrapped, bool with_ballpark) {
    std::vector<ProjObject> operations;
    const std::unique_ptr<PJ_OPERATION_FACTORY_CONTEXT, FreeFactory> factory(
        proj_create_operation_factory_context(context, nullptr));
    if (!from || !to || !factory) return operations;
    PJ_OPERATION_FACTORY_CONTEXT* const f = factory.get();
    proj_operation_factory_context_set_allow_ballpark_transformations(context, f, with_ballpark ? 1 : 0);
    proj_operation_factory_context_set_spatial_criterion(context, f,
                                                         PROJ_SPATIAL_CRITERION_PARTIAL_INTERSECTION);
    proj_operation_factory_context_set_grid_availability_use(context, f,
                                                             PROJ_GRID_AVAILABILITY_USED_FOR_SORTING);
    if (unwrapped.east_deg - unwrapped.west_deg < 360.0)
        proj_operation_factory_context_set_area_of_interest(
            context, f, normalised_lon_deg(unwrapped.west_deg), unwrapped.south_deg,
            normalised_lon_deg(unwrapped.east_deg), unwrapped.north_deg);
    const std::unique_ptr<PJ_OBJ_LIST, FreeList> list(proj_create_operations(context, from, to, f));
    const int count = list ? proj_list_get_count(list.get()) : 0;
    for (int i = 0; i < count; ++i) {
        ProjObject operation(proj_list_get(context, list.get(), i));
        if (operation) operations.push_back(std::move(operation));
    }
    return operations;
}

ProjObject unbound(PJ_CONTEXT* context, ProjObject crs) {
    while (crs && proj_get_type(crs.get()) == PJ_TYPE_BOUND_CRS)
        crs.reset(proj_get_source_crs(context, crs.get()));
    return crs;
}

std::string code_and_name(const PJ* object) {
    const char* const name = proj_get_name(object);
    const char* const authority = proj_get_id_auth_name(object, 0);
    const char* const code = proj_get_id_code(object, 0);
    const std::string text = name ? name : "unnamed";
    return authority && code ? std::string(authority) + ":" + code + " " + text : text;
}

ProjContext new_proj_context() {
    ProjContext context(proj_context_create());
    proj_log_level(context.get(), PJ_LOG_NONE);
    // Some of PROJ's functions write to the log whatever its level, such as a missing proj.db.
    proj_log_func(context.get(), nullptr, [](void*, int, const char*) {});
    proj_context_set_enable_network(context.get(), 0);
    return context;
}

std::string file_names(const std::vector<std::string>& paths) {
    std::string names;
    for (const std::string& path : paths)
        names += (names.empty() ? "" : ", ") + path.substr(path.find_last_of('/') + 1);
    return names;
}

LiftingOperation find_lifting_operation(PJ_CONTEXT* context, const PJ* from, const BoundingBox& unwrapped) {
    LiftingOperation found;
    const EndsWithoutMemory in_proj;
    const ProjObject to(proj_create(context, "EPSG:4979"));
    // A "ballpark" operation is the one that leaves heights as they are: never acceptable here.
    for (const ProjObject& operation : operations_between(context, from, to.get(), unwrapped, false)) {
        OperationGrids grids = grids_of(context, operation.get());
        if (!grids.missing.empty()) {
            if (found.missing.empty()) found.missing = grids.names;
            continue;
        }
        if (proj_coordoperation_has_ballpark_transformation(context, operation.get())) continue;
        if (proj_coordoperation_is_instantiable(context, operation.get()))
            found.operation.reset(proj_normalize_for_visualization(context, operation.get()));
        if (found.operation) {
            found.grids = std::move(grids.paths);
            remember_grids(found.grids);
            return found;
        }
        // Not the next best one in its stead: nobody would hear of it.
        if (!grids.paths.empty()) {
            found.unusable_grid = grids.paths.front();
            return found;
        }
    }
    return found;
}

void lift(PJ* operation, std::vector<double>& lon_deg, std::vector<double>& lat_deg, std::vector<double>& z) {
    proj_errno_reset(operation);
    proj_trans_generic(operation, PJ_FWD, lon_deg.data(), sizeof(double), lon_deg.size(), lat_deg.data(),
                       sizeof(double), lat_deg.size(), z.data(), sizeof(double), z.size(), nullptr, 0, 0);
}

std::string proj_file_there(PJ_CONTEXT* context, const std::vector<std::string>& names) {
    const char* const own = proj_context_get_user_writable_directory(context, 0);
    std::string folders = own ? own : "";
    // As PROJ does: where one of these is set, its own folders do not count.
    const char* folders_set = std::getenv("PROJ_DATA");
    if (folders_set == nullptr) folders_set = std::getenv("PROJ_LIB");
    const char* const others = folders_set != nullptr ? folders_set : proj_info().searchpath;
    folders += ":" + std::string(others ? others : "");
    for (std::size_t start = 0; start <= folders.size();) {
        const std::size_t end = std::min(folders.find(':', start), folders.size());
        const std::string folder = folders.substr(start, end - start);
        start = end + 1;
        if (folder.empty()) continue;
        for (const std::string& name : names) {
            std::error_code not_there;
            const std::filesystem::path path = std::filesystem::path(folder) / name;
            if (std::filesystem::exists(path, not_there)) return path.string();
        }
    }
    return "";
}

}  // namespace oro
