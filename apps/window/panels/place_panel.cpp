#include <cstdio>

#include "apps/report/feature_words.h"
#include "apps/report/figures.h"
#include "apps/window/panels/panel_parts.h"
#include "apps/window/panels/panels.h"
#include "apps/window/places.h"
#include "core/base/one_line.h"
#include "geo/places/place_forms.h"

namespace oro {
namespace {

template <class... Values>
std::string written(const char* form, Values... values) {
    char text[240];
    std::snprintf(text, sizeof text, form, values...);
    return text;
}

// In the CRS that the data are in, or that --coordinates names.
void in_crs_of_data(const Viewer& viewer, const SeenPlace& seen) {
    const auto& crs = viewer.index.crs();
    if (!crs) return;
    const auto numbers = crs->coordinates(seen.lat_deg, seen.lon_deg);
    if (!numbers) return;
    value_line(crs->is_projected() ? "E, N" : "x, y",
               written(crs->is_projected() ? "%.2f, %.2f" : "%.7f, %.7f", (*numbers)[0], (*numbers)[1]),
               ("Easting and northing in " + crs->name() + ", in its own unit").c_str());
}

void how_exact(const PickedPlace& picked) {
    const auto& bound = picked.certificate;
    if (!bound) return;
    value_line(
        "Drawn within", figure(bound->error_px) + " px, " + figure(bound->error_m) + " m",
        bound->level == 0
            ? "Every post of the data is drawn there."
            : written("No point that is drawn there lies farther than this from where all posts of the "
                      "data would put it: the certificate of its patch, which has one post in %d of a row.",
                      1 << bound->level)
                  .c_str());
}

void all_about(const Viewer& viewer, const PickedPlace& picked) {
    const SeenPlace& seen = *picked.seen;
    value_line("Place", written("%.7f, %.7f", seen.lat_deg, seen.lon_deg), "Latitude, longitude, WGS 84");
    value_line("DMS", dms_text(seen.lat_deg, seen.lon_deg), "Degrees, minutes, seconds");
    value_line("UTM", utm_text(seen.lat_deg, seen.lon_deg), "Zone, easting and northing in metres");
    value_line("MGRS", mgrs_text(seen.lat_deg, seen.lon_deg), "The square of one metre that it is in");
    in_crs_of_data(viewer, seen);
    ImGui::Separator();
    value_line("Height H", written("%.2f m", seen.H_m), "Above the geoid, which is about sea level");
    value_line("Height h", written("%.2f m", seen.h_m),
               "Above the ellipsoid of WGS 84, as satellites have it");
    value_line("Geoid N", written("%.2f m", seen.h_m - seen.H_m),
               "The geoid's height above the ellipsoid: h = H + N");
    if (!picked.geoid.empty())
        value_line("  its model", picked.geoid, "The model of the geoid that N comes from, and its file");
    if (picked.slope_deg)
        value_line("Slope", written("%.1f°", *picked.slope_deg),
                   "Of the triangle of the data that it lies on");
    if (picked.aspect_deg)
        value_line("Falls to",
                   written("%s, %.0f°", compass_point(static_cast<int>(*picked.aspect_deg / 22.5 + 0.5) % 16),
                           *picked.aspect_deg),
                   "Where the ground falls to: its aspect, clockwise from true north");
    if (seen.cover)
        value_line("Land cover", written("%s (%d)", seen.cover->name.c_str(), seen.cover->code),
                   "The class that the file of land cover has there, and its code");
    if (seen.canopy_m)
        value_line("Canopy", written("%.1f m", *seen.canopy_m),
                   seen.canopy_invented ? "Top of what grows there, over the ground: invented by its class"
                                        : "Top of what grows there, over the ground");
    ImGui::Separator();
    value_line("Distance", written("%.2f m", seen.seen_distance_m), "Along the line of sight");
    value_line("On the map", written("%.2f m", seen.distance_m), "Along the ellipsoid, from under the eye");
    value_line("Bearing", written("%.2f°", seen.bearing_deg), "True, from the eye, clockwise from north");
    value_line("Source", seen.source.empty() ? "unknown" : seen.source.substr(seen.source.rfind('/') + 1),
               "The file that its height comes from");
    if (seen.feature) {
        value_line("Feature", words_of(*seen.feature), "The thing of the mesh: a building, say");
        for (const auto& [name, text] : seen.feature->attributes)
            value_line(("  " + one_line(name)).c_str(), one_line(text), "An attribute that its file gives");
    }
    if (picked.source_spacing_m)
        value_line("  its posts", metres(*picked.source_spacing_m) + " m apart",
                   "From post to post of that file, north to south");
    if (!picked.source_crs.empty())
        value_line("  its CRS", picked.source_crs, "The coordinate reference system that the file states");
    how_exact(picked);
    value_line("Cell", written("row %d, column %d", seen.row, seen.column),
               "The square between four posts; rows from the north, columns from the west");
}

// What else may be asked of the place.
void questions_from(Viewer& viewer, const LatLon& place) {
    if (ImGui::Button("What can be seen")) {
        SeenAroundChoice choice = viewer.looking.choice.value_or(SeenAroundChoice{});
        choice.place = place;
        viewer.looking.choice = choice;
        viewer.panels.open(&Panels::viewshed);
    }
    tip("Its viewshed, as a tint over the ground");
    ImGui::SameLine();
    if (ImGui::Button("Panorama")) {
        PanoramaChoice choice = viewer.panorama.choice.value_or(PanoramaChoice{});
        choice.place = place;
        viewer.panorama.choice = choice;
        viewer.panels.open(&Panels::panorama);
    }
    tip("All around, with rulers and the names of what is seen");
}

}  // namespace

void build_place_panel(Viewer& viewer) {
    bool& is_open = viewer.panels.place;
    if (!is_open || !viewer.picked) return;
    if (begin_panel("Place", is_open, PanelCorner::upper_right, 330.0F)) {
        if (const auto& seen = viewer.picked->seen) questions_from(viewer, {seen->lat_deg, seen->lon_deg});
        if (!viewer.picked->seen) {
            quiet_text("No ground there: sky, or a place without data.");
        } else {
            all_about(viewer, *viewer.picked);
            if (ImGui::Button("Copy all")) ImGui::SetClipboardText(line_of(viewer.picked->seen).c_str());
        }
    }
    ImGui::End();
}

}  // namespace oro
