#include "apps/commands/shot/shot_json.h"

#include <span>

#include "apps/commands/drawn_meshes_json.h"
#include "apps/cover/canopy_words.h"
#include "apps/detail/detail_words.h"
#include "apps/layers/picture_layers.h"
#include "apps/report/feature_words.h"
#include "apps/report/json_object.h"
#include "apps/report/json_text.h"
#include "apps/report/near_trees_words.h"
#include "apps/report/region_json.h"
#include "apps/report/summit_words.h"
#include "apps/styles/growth_json.h"
#include "apps/view/model_names.h"
#include "apps/view/trees_of_view.h"
#include "apps/view/truth.h"
#include "geo/refined/refined_region.h"
#include "render/device/device_report.h"

namespace oro {
namespace {

using nlohmann::ordered_json;

ordered_json destination_json(const std::optional<SeenPlace>& place) {
    if (!place) return nullptr;
    ordered_json json = ordered_json::object();
    json["lat_deg"] = place->lat_deg;
    json["lon_deg"] = place->lon_deg;
    json["h_m"] = place->h_m;
    json["H_m"] = place->H_m;
    json["bearing_deg"] = place->bearing_deg;
    json["distance_m"] = place->distance_m;
    json["seen_distance_m"] = place->seen_distance_m;
    json["cell"] = json_object("row", place->row, "column", place->column);
    json["source"] = nullptr;
    if (!place->source.empty()) json["source"] = place->source;
    if (place->feature) json["feature"] = feature_json(*place->feature);
    if (place->canopy_m) json["canopy_m"] = *place->canopy_m;
    if (place->cover) json["cover"] = json_object("code", place->cover->code, "name", place->cover->name);
    return json;
}

ordered_json eye_json(const ShotResult& shot, const Geotags& tags) {
    const glm::dvec3 ecef = shot.view.camera.eye_ecef().m;
    ordered_json json = ordered_json::object();
    json["lat_deg"] = tags.lat_deg;
    json["lon_deg"] = tags.lon_deg;
    json["h_m"] = tags.h_m;
    json["H_m"] = tags.H_m;
    json["N_m"] = tags.N_m;
    json["geoid"] = tags.geoid;
    json["ecef_m"] = json_list(ecef.x, ecef.y, ecef.z);
    return json;
}

// How much of the terrain was drawn, and what was left out and why.
void put_counts(const ShotResult& shot, ordered_json& json) {
    const PictureReport& counts = shot.picture;
    json["triangles"] =
        json_object("drawn", counts.triangles_drawn, "at_full_resolution", shot.triangles_at_full_resolution);
    ordered_json& meshlets = json["meshlets"] = ordered_json::object();
    meshlets["drawn"] = counts.meshlets_drawn;
    meshlets["culled_by_frustum"] = counts.meshlets_beyond_frustum;
    meshlets["culled_by_horizon"] = counts.meshlets_beyond_horizon;
    meshlets["mesh_workgroups"] = counts.mesh_groups;
    ordered_json& pages = json["pages"] = ordered_json::object();
    pages["all"] = shot.pages;
    pages["drawn"] = counts.pages_drawn;
    pages["culled_by_frustum"] = counts.pages_beyond_frustum;
    pages["culled_by_horizon"] = counts.pages_beyond_horizon;
    pages["on_gpu"] = shot.pages_on_gpu;
    pages["bytes_on_gpu"] = shot.page_bytes;
    if (shot.meshes) json["meshes"] = drawn_meshes_json(*shot.meshes);
    ordered_json& clusters = json["clusters"] = nullptr;
    if (!shot.clusters) return;
    clusters =
        json_object("on_gpu", shot.clusters->on_gpu, "bytes_on_gpu", shot.clusters->bytes_on_gpu,
                    "groups_in_memory", shot.clusters->groups, "bytes_in_memory", shot.clusters->group_bytes);
}

// Of the picture, from the top down.
ordered_json labels_json(const std::vector<LineLabel>& labels) {
    ordered_json json = ordered_json::array();
    for (const LineLabel& label : labels)
        json.push_back(json_object("text", label.text, "H_m", label.H_m, "middle_px",
                                   json_list(label.middle_px.x, label.middle_px.y), "angle_deg",
                                   label.angle_deg, "length_px", label.length_px, "top_is_uphill",
                                   label.top_is_uphill));
    return json;
}

// Those that are in the picture, the most prominent first, and how many were not named.
ordered_json names_json(const NamesInView& names) {
    ordered_json json = ordered_json::array();
    for (const NameLabel& label : names.labels) {
        const SeenPoint& point = label.point;
        json.push_back(
            json_object("name", point.name, "lat_deg", point.lat_deg, "lon_deg", point.lon_deg, "place",
                        json_list(point.place.lat_deg, point.place.lon_deg), "moved", point.is_moved, "h_m",
                        point.place.h_m, "H_m", point.H_m, "distance_m", point.distance_m, "place_px",
                        json_list(point.place_px.x, point.place_px.y), "box_px",
                        json_list(label.box.left, label.box.top, label.box.right, label.box.bottom)));
    }
    return json_object("named", std::move(json), "hidden", names.counts.hidden, "outside",
                       names.counts.outside, "beyond_data", names.counts.beyond_data, "without_room",
                       names.without_room, "without_letters", names.without_letters);
}

// Null where neither --accuracy nor --tolerance chose.
ordered_json accuracy_json(const ShotResult& shot) {
    const bool named = !shot.view.accuracy.empty();
    if (!shot.choice && !named) return nullptr;
    ordered_json json = json_object("bundle", nullptr);
    if (named) json["bundle"] = shot.view.accuracy;
    if (!shot.choice) return json;
    json["options"] = shot.choice->bundle.options;
    json["tolerance_px"] = shot.choice->tolerance_px;
    json["predicted_px"] = shot.choice->predicted_px;
    json["holds"] = shot.choice->holds;
    return json;
}

ordered_json times_json(const ShotResult& shot) {
    ordered_json json = ordered_json::object();
    json["read"] = shot.times.read_s;
    json["pages"] = shot.times.pages_s;
    json["draw_and_write"] = shot.times.draw_s;
    if (shot.view.vectors_read) {
        json["overlay"] = shot.overlay.seconds;
        json["names_seen"] = shot.names.seeing_s;
        json["names_placed"] = shot.names.placing_s;
    }
    json["gpu_choose"] = shot.picture.choose_s;
    json["gpu_raster"] = shot.picture.raster_s;
    json["gpu_shade"] = shot.picture.shade_s;
    return json;
}

void put_map(const MapFrame& map, const PictureFiles& files, ordered_json& json) {
    const auto& m = map.crs_from_pixel;
    json["map"] =
        json_object("crs", map_crs_name(map.crs), "unit", map_unit(map.crs), "left", m[0], "top", m[3],
                    "pixel", json_list(m[1], m[5]), "world_file", world_file_path(files.picture));
}

// What the ground's colours are made from.
void put_style(const ShotResult& shot, const Style& style, ordered_json& json) {
    json["footprint"] = !shot.has_means                                  ? "point"
                        : style.frame.footprint == gpu::footprint_finest ? "finest"
                                                                         : "mean";
    // What says which materials the ground's colours are of; null: they are of none.
    json["cover"] = nullptr;
    if (style.frame.colour_by == gpu::colour_by_cover) json["cover"] = shot.view.cover ? "files" : "rule";
    if (style.frame.materials.on != 0)
        json["materials"] = shot.view.cover
                                ? "invented, by a rule: colours within a class, clefts and ledges of rock"
                                : "invented, by a rule: fields with hedges, clefts and ledges of rock";
    if (const ordered_json growth = growth_json(style, why_without_trees(shot.view)); !growth.empty())
        json["growth"] = growth;
    if (shot.picture.near_tree_px > 0)
        json["growth"]["near_eye"] = near_trees_json(near_trees_share(shot.picture, shot.view.camera));
    json["contour_interval_m"] = nullptr;
    if (style.frame.contours.interval_m > 0.0F) json["contour_interval_m"] = style.frame.contours.interval_m;
}

// The files by what is in them.
void put_layers(const LayersReport& layers, const ShotResult& shot, const PictureFiles& files,
                ordered_json& json) {
    ordered_json& layer_files = json["layers"] = ordered_json::object();
    for (const char* layer : layers_of_view(shot.view.cover != nullptr, has_meshes(shot.view, shot.region)))
        layer_files[layer] = layer_path(files.picture, layer);
    json["layer_pixels"] = json_object("ground", layers.ground_px, "beside", layers.missed_px);
    json["times_s"]["layers"] = shot.times.layers_s;
}

// All sources, the region, and those that lie apart from it.
void put_regions(const ShotResult& shot, ordered_json& json) {
    // Ground between posts has the sources of its data.
    std::vector<const RegionGrid*> grids;
    for (const RegionGrid& grid : shot.region.grids)
        if (!grid.detail) grids.push_back(&grid);
    json["sources"] = ordered_json::array();
    for (const RegionGrid* const grid : grids)
        for (ordered_json& source : sources_json(grid->sources)) json["sources"].push_back(std::move(source));
    json["region"] = region_json(*grids.front());
    for (const RegionGrid* const other : std::span(grids).subspan(1))
        json["apart"].push_back(region_json(*other));
}

// What the ground carries, and what of it is invented.
void put_invented(const ShotResult& shot, ordered_json& json) {
    if (shot.view.cover)
        json["landcover"] =
            json_object("table", shot.view.cover->table().name, "title", shot.view.cover->table().title);
    if (shot.view.canopy) json["canopy"] = canopy_json(*shot.view.canopy, shot.region);
    if (const RegionGrid* const detail = detail_of(shot.region))
        json["detail"] = detail_json(*detail->detail);
}

}  // namespace

ordered_json shot_json(const ShotResult& shot, const PictureFiles& files, const Gpu& gpu,
                       const Style& style) {
    const Geotags tags = geotags_of(shot.view, shot.region, shot.middle);
    ordered_json json = ordered_json::object();
    json["picture"] = files.picture;
    json["view"] = ordered_json::parse(view_to_json(shot.view, false));
    if (!shot.view.tells_paths) json["view"]["sources"] = ordered_json::array();
    json["eye"] = eye_json(shot, tags);
    if (shot.on_summit) json["on_summit"] = summit_json(*shot.on_summit);
    json["heading_deg"] = tags.heading_deg;
    json["pitch_deg"] = tags.pitch_deg;
    json["roll_deg"] = tags.roll_deg;
    json["fov_deg"] = tags.vertical_fov_deg;
    json["size_px"] = json_list(tags.width_px, tags.height_px);
    json["samples"] = shot.view.samples;
    json["exaggeration"] = shot.view.exaggeration;
    json["sun"] = json_object("azimuth_deg", style.sun.azimuth_deg, "elevation_deg", style.sun.elevation_deg,
                              "direct_light", direct_light(style.sun), "time", nullptr);
    if (style.sun.time) json["sun"]["time"] = style.sun.time->text;
    json["sun"]["usual"] = style.sun.is_usual;
    put_style(shot, style, json);
    json["labels"] = labels_json(shot.labels);
    if (shot.view.vectors_read) {
        json["names"] = names_json(shot.names);
        json["overlay"] = json_object("lines", shot.overlay.lines, "seen_px", shot.overlay.seen_px);
    }
    json["time"] = time_text(shot.view.time_utc_s);
    json["destination"] = destination_json(shot.middle);
    json["attribution"] = tags.attribution;
    put_regions(shot, json);
    put_invented(shot, json);
    put_counts(shot, json);
    json["tau_px"] = shot.view.tau_px;
    json["mesh_level"] = nullptr;
    if (shot.view.mesh_level) json["mesh_level"] = *shot.view.mesh_level;
    json["models"] = models_json(shot.view);
    json["accuracy"] = accuracy_json(shot);
    json["models"]["height_step_m"] = shot.height_step_m;
    json["light"] = light_json(shot.view.model.air, true_camera(shot.view, shot.region).eye.h_m);
    json["unseen"] = unseen_json(shot.unseen);
    json["settled"] = shot.picture.settled;
    json["tiles"] = shot.picture.tiles;
    json["times_s"] = times_json(shot);
    const DeviceReport& device = gpu.report();
    json["device"] = json_object("name", device.name, "type", kind_words(device.kind), "driver",
                                 device.driver, "api", version_words(device.vulkan_version));
    json["pipeline"] = name_of(shot.picture.path);
    if (shot.view.map) put_map(*shot.view.map, files, json);
    if (shot.layers) put_layers(*shot.layers, shot, files, json);
    if (shot.verification) {
        json["times_s"]["verify"] = shot.times.verify_s;
        json["error_picture"] = files.error;
        json["error"] = verification_json(*shot.verification);
        json["error"]["resampling"] = resampling_json(region_resampling(shot.region.grids.front()));
    }
    return json;
}

}  // namespace oro
