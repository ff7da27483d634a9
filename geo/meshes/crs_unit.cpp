#include "geo/meshes/crs_unit.h"

#include "geo/datum/proj_operations.h"

namespace oro {

std::optional<double> crs_unit_m(const std::string& crs) {
    const ProjContext context = new_proj_context();
    ProjObject object = unbound(context.get(), ProjObject(proj_create(context.get(), crs.c_str())));
    if (object && proj_get_type(object.get()) == PJ_TYPE_COMPOUND_CRS)
        object = unbound(context.get(), ProjObject(proj_crs_get_sub_crs(context.get(), object.get(), 0)));
    if (!object || proj_get_type(object.get()) != PJ_TYPE_PROJECTED_CRS) return std::nullopt;
    const ProjObject axes(proj_crs_get_coordinate_system(context.get(), object.get()));
    double metres = 0.0;
    if (!axes ||
        proj_cs_get_axis_info(context.get(), axes.get(), 0, nullptr, nullptr, nullptr, &metres, nullptr,
                              nullptr, nullptr) == 0 ||
        !(metres > 0.0))
        return std::nullopt;
    return metres;
}

}  // namespace oro
