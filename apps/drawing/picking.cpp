#include "apps/drawing/picking.h"

#include <cstdio>
#include <filesystem>

#include "apps/report/feature_words.h"
#include "core/truth/oracle.h"
#include "geo/canopy/raised_region.h"
#include "geo/places/geodesic.h"
#include "geo/posts/source_at.h"

namespace oro {

Result<std::optional<SeenPlace>> place_seen(const View& view, const RegionGround& ground,
                                            glm::dvec2 point_px) {
    const Camera& camera = view.camera;
    const auto hit = first_hit(ground.ground(), sight_from(camera.eye, view.model.air),
                               camera.ecef_direction_at(point_px), sight_reach_m(camera.eye.h_m));
    // What could not be read counts as void: the sight line went through it.
    ORO_CHECK(ground.ground().health());
    if (!hit) return std::optional<SeenPlace>();
    SeenPlace place;
    place.lat_deg = hit->point.lat_deg;
    place.lon_deg = hit->point.lon_deg;
    const RegionGrid& grid = ground.grid(hit->grid);
    const double N_m = grid.field.undulation.at_m(place.lat_deg, place.lon_deg);
    place.H_m = (hit->point.h_m - N_m) / view.exaggeration;
    place.canopy_m = canopy_over_ground_m(grid, place.lat_deg, place.lon_deg);
    place.canopy_invented = place.canopy_m && view.canopy && view.canopy->is_invented();
    place.H_m -= place.canopy_m.value_or(0.0);
    place.h_m = place.H_m + N_m;
    const GeodesicPath path =
        geodesic_between(camera.eye.lat_deg, camera.eye.lon_deg, place.lat_deg, place.lon_deg);
    place.bearing_deg = path.bearing_deg;
    place.distance_m = path.distance_m;
    place.seen_distance_m = hit->distance_m;
    place.row = hit->row;
    place.column = hit->column;
    place.on_mesh = hit->mesh > 0;
    if (const MeshFeature* const feature = ground.feature(*hit)) place.feature = *feature;
    if (place.on_mesh)
        place.source = ground.mesh(hit->mesh).path;
    else if (const SourceReport* const source = source_at(grid, place.lat_deg, place.lon_deg))
        place.source = source->path;
    if (view.cover) {
        ORO_TRY(const int code, view.cover->code_at(place.lat_deg, place.lon_deg));
        if (code != no_cover_code) place.cover = SeenPlace::Cover{code, view.cover->name_of(code)};
    }
    return std::optional(place);
}

Result<std::optional<SeenPlace>> place_in_middle(const View& view, const RegionGround& ground) {
    return place_seen(view, ground, {0.5 * view.camera.width_px, 0.5 * view.camera.height_px});
}

namespace {

// "  canopy 21.0 m over the ground, invented by class"
std::string canopy_text(const SeenPlace& place) {
    if (!place.canopy_m) return "";
    char text[80];
    std::snprintf(text, sizeof text, "  canopy %.1f m over the ground%s", *place.canopy_m,
                  place.canopy_invented ? ", invented by class" : "");
    return text;
}

std::string feature_text(const std::optional<MeshFeature>& feature) {
    return feature ? ", " + words_of(*feature) : "";
}

}  // namespace

std::string line_of(const std::optional<SeenPlace>& place) {
    if (!place) return "no terrain at this point: it shows sky, or a place without data";
    char text[240];
    std::snprintf(
        text, sizeof text,
        "%.6f° %.6f°  %.2f m above sea level (%.2f m above the ellipsoid)  %.2f m away  bearing %.2f°  cell "
        "in row %d, column %d of the posts  from ",
        place->lat_deg, place->lon_deg, place->H_m, place->h_m, place->seen_distance_m, place->bearing_deg,
        place->row, place->column);
    const std::string name = std::filesystem::path(place->source).filename().string();
    const std::string cover = place->cover ? "  " + one_line(place->cover->name) : "";
    return text + (name.empty() ? "an unknown source" : one_line(name)) + feature_text(place->feature) +
           cover + canopy_text(*place);
}

}  // namespace oro
