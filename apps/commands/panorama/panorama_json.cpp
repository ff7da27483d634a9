#include "apps/commands/panorama/panorama_json.h"

#include "apps/cover/canopy_words.h"
#include "apps/detail/detail_words.h"
#include "apps/report/json_object.h"
#include "apps/report/json_text.h"
#include "apps/report/near_trees_words.h"
#include "apps/report/region_json.h"
#include "apps/report/summit_words.h"
#include "apps/styles/growth_json.h"
#include "apps/view/model_names.h"
#include "apps/view/trees_of_view.h"
#include "geo/refined/refined_region.h"

namespace oro {
namespace {

using nlohmann::ordered_json;

ordered_json eye_json(const PanoramaReport& report) {
    const Geodetic& eye = report.view.camera.eye;
    const double N_m = report.region.grids.front().field.undulation.at_m(eye.lat_deg, eye.lon_deg);
    return json_object("lat_deg", eye.lat_deg, "lon_deg", eye.lon_deg, "h_m", eye.h_m, "H_m", eye.h_m - N_m,
                       "N_m", N_m, "geoid", report.region.grids.front().geoid);
}

// Azimuths and elevations to places: x = (azimuth - from) * px_per_deg, y = level_y - tan(elevation) *
// px_per_rad.
ordered_json scene_json(const PanoramaSheet& laid) {
    const Cylinder& around = laid.around;
    return json_object("from_deg", around.from_deg, "sweep_deg", around.sweep_deg, "low_deg",
                       around.elevation_deg_at(around.height_px()), "high_deg", around.elevation_deg_at(0.0),
                       "top_px", laid.sheet.scene_top_px, "height_px", around.height_px(), "level_y_px",
                       laid.sheet.scene_top_px + around.above_px, "px_per_deg",
                       around.width_px / around.sweep_deg, "px_per_rad", around.px_per_rad());
}

ordered_json rulers_json(const Rulers& rulers) {
    return json_object("azimuth_step_deg", rulers.azimuth_step_deg, "azimuth_tick_deg",
                       rulers.azimuth_tick_deg, "elevation_step_deg", rulers.elevation_step_deg,
                       "elevation_tick_deg", rulers.elevation_tick_deg, "text_px", rulers.em_px);
}

ordered_json names_json(const PanoramaSheet& laid) {
    ordered_json named = ordered_json::array();
    for (const PanoramaName& name : laid.names.named) {
        const SeenPoint& point = name.point;
        named.push_back(json_object("name", point.name, "lat_deg", point.lat_deg, "lon_deg", point.lon_deg,
                                    "place", json_list(point.place.lat_deg, point.place.lon_deg), "moved",
                                    point.is_moved, "h_m", point.place.h_m, "H_m", point.H_m, "distance_m",
                                    point.distance_m, "azimuth_deg", name.azimuth_deg, "elevation_deg",
                                    name.elevation_deg, "x_px", point.place_px.x, "y_px",
                                    laid.sheet.scene_top_px + point.place_px.y, "name_x_px", name.slot_px));
    }
    const PanoramaNames& names = laid.names;
    return json_object("named", std::move(named), "hidden", names.counts.hidden, "outside",
                       names.counts.outside, "beyond_data", names.counts.beyond_data, "without_room",
                       names.without_room, "without_letters", names.without_letters);
}

}  // namespace

ordered_json panorama_json(const PanoramaReport& report, const std::string& file, const Style& style) {
    const View& view = report.view;
    ordered_json json = ordered_json::object();
    json["picture"] = file;
    json["view"] = ordered_json::parse(view_to_json(view, false));
    if (!view.tells_paths) json["view"]["sources"] = ordered_json::array();
    json["eye"] = eye_json(report);
    if (report.on_summit) json["on_summit"] = summit_json(*report.on_summit);
    json["size_px"] = json_list(report.laid.sheet.width_px, report.laid.sheet.height_px);
    json["scene"] = scene_json(report.laid);
    json["rulers"] = rulers_json(report.laid.rulers);
    json["standpoint"] = nullptr;
    if (!report.laid.standpoint.empty()) json["standpoint"] = report.laid.standpoint;
    if (view.vectors_read) json["names"] = names_json(report.laid);
    json["sun"] = json_object("azimuth_deg", style.sun.azimuth_deg, "elevation_deg", style.sun.elevation_deg,
                              "time", nullptr);
    if (style.sun.time) json["sun"]["time"] = style.sun.time->text;
    json["sun"]["usual"] = style.sun.is_usual;
    json["time"] = time_text(view.time_utc_s);
    json["attribution"] = attribution_of(report.region);
    if (view.canopy) json["canopy"] = canopy_json(*view.canopy, report.region);
    if (const RegionGrid* const refined = detail_of(report.region))
        json["detail"] = detail_json(*refined->detail);
    if (const ordered_json growth =
            growth_json(style, view.trees ? why_without_trees(view) : "left out (--trees on draws them)");
        !growth.empty())
        json["growth"] = growth;
    if (report.scene.near_trees_share > 0.0)
        json["growth"]["near_eye"] = near_trees_json(report.scene.near_trees_share);
    json["models"] = models_json(view);
    json["light"] = light_json(view.model.air, view.camera.eye.h_m);
    json["tau_px"] = view.tau_px;
    json["mesh_level"] = nullptr;
    if (view.mesh_level) json["mesh_level"] = *view.mesh_level;
    json["pictures"] = report.scene.tiles;
    json["triangles"] = report.scene.report.triangles_drawn;
    json["pipeline"] = name_of(report.scene.report.path);
    json["times_s"] = json_object("read", report.read_s, "names", report.layout_s, "draw", report.draw_s);
    return json;
}

}  // namespace oro
