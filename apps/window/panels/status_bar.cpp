#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "apps/report/figures.h"
#include "apps/window/panels/panel_parts.h"
#include "apps/window/panels/panels.h"
#include "apps/window/unit_words.h"
#include "core/terrain/ground.h"

namespace oro {
namespace {

// The place that the bar tells of: under the pointer, or in the picture's middle where it is elsewhere.
const std::optional<PickedPlace>& reported_place(const Viewer& viewer) {
    return viewer.under_pointer ? viewer.under_pointer : viewer.in_middle;
}

// A line of the easting and the northing in the CRS of the data; "" where they have none.
std::string in_crs(const Viewer& viewer, const SeenPlace& seen) {
    const auto& crs = viewer.index.crs();
    if (!crs || !crs->is_projected()) return "";
    const auto numbers = crs->coordinates(seen.lat_deg, seen.lon_deg);
    if (!numbers) return "";
    char text[60];
    std::snprintf(text, sizeof text, "E %.1f, N %.1f", (*numbers)[0], (*numbers)[1]);
    return text + std::string(" in ") + crs->name() + "\n";
}

// Where the pointer is, or the picture's middle where it is elsewhere; while the eye moves, where that is.
void place_words(const Viewer& viewer) {
    if (!viewer.has_picture && !viewer.is_shown) return ImGui::TextDisabled("loading the ground");
    if (is_moving(viewer)) {
        const Geodetic& eye = viewer.view.camera.eye;
        return ImGui::TextDisabled("the eye is at %.5f, %.5f", eye.lat_deg, eye.lon_deg);
    }
    const bool pointed = viewer.under_pointer.has_value();
    const auto& place = reported_place(viewer);
    if (!place || !place->seen) {
        ImGui::TextDisabled(pointed ? "sky, or no data" : "no ground in the middle");
        tip("There is no ground of the data where the pointer is.");
        return;
    }
    const SeenPlace& seen = *place->seen;
    char text[320];
    std::snprintf(text, sizeof text, "%.5f, %.5f   %s above sea", seen.lat_deg, seen.lon_deg,
                  height_in_units(seen.H_m, viewer.settings.units).c_str());
    ImGui::TextUnformatted(text);
    if (ImGui::IsItemHovered()) {
        std::snprintf(text, sizeof text,
                      "Latitude and longitude (WGS 84) %s.\n%sH %.2f m: height above sea level (the geoid)\n"
                      "h %.2f m: height above the ellipsoid\nA right click tells more.",
                      pointed ? "under the pointer" : "in the picture's middle", in_crs(viewer, seen).c_str(),
                      seen.H_m, seen.h_m);
        tip(text);
    }
    if (seen.cover) {
        ImGui::SameLine();
        ImGui::TextDisabled("%s", seen.cover->name.c_str());
        tip("The land cover there, as its file has it.");
    }
    if (!place->slope_deg) return;
    ImGui::SameLine();
    ImGui::TextDisabled("slope %.0f°", *place->slope_deg);
    tip("How steep the ground is there: the triangle of the data that the place lies on.");
}

void height_words(const Viewer& viewer) {
    const Camera& camera = viewer.view.camera;
    const auto ground_m =
        ground_h_m(field_below(viewer), camera.eye.lat_deg, camera.eye.lon_deg, viewer.view.exaggeration);
    const HeightField& field = field_below(viewer);
    const double N_m = field.undulation.at_m(camera.eye.lat_deg, camera.eye.lon_deg);
    const std::string who = viewer.gestures && viewer.gestures->is_walking() ? "you walk " : "eye ";
    const auto height = [&](double height_m) { return height_in_units(height_m, viewer.settings.units); };
    const std::string text = ground_m ? who + height(camera.eye.h_m - *ground_m) + " over ground"
                                      : "eye at " + height(camera.eye.h_m - N_m);
    ImGui::TextUnformatted(text.c_str());
    if (!ImGui::IsItemHovered()) return;
    char words[300];
    std::snprintf(
        words, sizeof words,
        "The eye: %.6f, %.6f\nH %.1f m: its height above sea level (the geoid)\nh %.1f m: above the "
        "ellipsoid of WGS 84\nIt looks to %.1f°, clockwise from true north, and %.1f° %s the horizon.",
        camera.eye.lat_deg, camera.eye.lon_deg, camera.eye.h_m - N_m, camera.eye.h_m,
        camera.attitude.heading_deg, std::abs(camera.attitude.pitch_deg),
        camera.attitude.pitch_deg < 0.0 ? "below" : "above");
    tip(words);
}

// Not while the eye moves: what is in the middle is looked for at rest.
void scale_bar(const Viewer& viewer) {
    if (is_moving(viewer) || !viewer.in_middle || !viewer.in_middle->seen) return;
    const Camera& camera = viewer.view.camera;
    const double distance_m = viewer.in_middle->seen->seen_distance_m;
    const double m_per_px = 2.0 * camera.half_fov_tangent().y * distance_m / camera.height_px;
    const double most_px = static_cast<double>(scaled_px(96.0F));
    if (!(m_per_px > 0.0)) return;
    const RoundLength round = round_length(m_per_px * most_px, viewer.settings.units);
    const auto length_px = static_cast<float>(round.length_m / m_per_px);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float height = ImGui::GetTextLineHeight(), thick = std::max(1.0F, scaled_px(1.5F));
    const float base = at.y + 0.72F * height, tooth = scaled_px(5.0F);
    list.AddLine({at.x, base}, {at.x + length_px, base}, interface_colour::ink, thick);
    list.AddLine({at.x, base - tooth}, {at.x, base + 1.0F}, interface_colour::ink, thick);
    list.AddLine({at.x + length_px, base - tooth}, {at.x + length_px, base + 1.0F}, interface_colour::ink,
                 thick);
    ImGui::Dummy({length_px, height});
    ImGui::SameLine(0.0F, scaled_px(6.0F));
    ImGui::TextUnformatted(round.words.c_str());
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("The length of the bar in the picture's middle, %s m away.",
                          metres(distance_m).c_str());
}

std::string certificate_words(const Viewer& viewer) {
    if (const std::string progress = progress_words(viewer); !progress.empty()) return progress + " …";
    if (!viewer.has_picture && !viewer.is_shown) return "";
    const DetailStep& step = viewer.drawn_at;
    const double within_px = viewer.view.tau_px * step.tau_factor / step.scale;
    char text[80];
    if (within_px <= 0.0) return "full resolution";
    std::snprintf(text, sizeof text, "detail within %s px", figure(within_px).c_str());
    const bool has_room = ImGui::GetIO().DisplaySize.x >= scaled_px(1000.0F);
    const auto& place = reported_place(viewer);
    if (!has_room || !viewer.is_settled || !place || !place->certificate) return text;
    return text + std::string(", here ") + figure(place->certificate->error_px) + " px";
}

// What the certificates say of the place that the bar tells of.
std::string certificate_there(const Viewer& viewer) {
    const auto& place = reported_place(viewer);
    if (!viewer.is_settled || !place || !place->certificate) return "";
    const SampledDetail::Bound& bound = *place->certificate;
    return std::string(viewer.under_pointer ? "Under the pointer" : "In the picture's middle") +
           " it lies within " + figure(bound.error_px) + " px, " + figure(bound.error_m) + " m.\n";
}

void certificate(const Viewer& viewer) {
    ImGui::PushStyleColor(ImGuiCol_Text, viewer.is_settled && progress_words(viewer).empty()
                                             ? interface_colour::good
                                             : interface_colour::accent);
    ImGui::TextUnformatted(certificate_words(viewer).c_str());
    ImGui::PopStyleColor();
    if (!ImGui::IsItemHovered()) return;
    const DetailStep& step = viewer.drawn_at;
    char text[600];
    std::snprintf(text, sizeof text,
                  "Nothing that is drawn lies farther than this from where all posts of the data would put "
                  "it.\n%stau %s px (the view asks for %s), of pixels %.0f %% as wide as the window's.\n%s",
                  certificate_there(viewer).c_str(), figure(viewer.view.tau_px * step.tau_factor).c_str(),
                  figure(viewer.view.tau_px).c_str(), 100.0 / step.scale,
                  viewer.is_settled ? "The picture is all that the view asks for."
                  : viewer.lacks_memory
                      ? "It is not all that the view asks for: the GPU's memory is full (--gpu-memory)."
                      : "It is not yet all that the view asks for.");
    tip(text);
}

}  // namespace

void build_status_bar(Viewer& viewer) {
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowSize({display.x, 0.0F});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.0F);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0.0F);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {scaled_px(12.0F), scaled_px(5.0F)});
    ImGui::SetNextWindowPos({0.0F, display.y}, ImGuiCond_Always, {0.0F, 1.0F});
    ImGui::Begin("##status", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav |
                     ImGuiWindowFlags_NoBringToFrontOnFocus);
    const float right = ImGui::CalcTextSize(certificate_words(viewer).c_str()).x + scaled_px(12.0F);
    place_words(viewer);
    const auto fits = [&](float width) {
        return ImGui::GetItemRectMax().x + scaled_px(24.0F) + scaled_px(width) < display.x - right;
    };
    if (fits(160.0F)) {
        ImGui::SameLine(std::max(scaled_px(400.0F), ImGui::GetItemRectMax().x + scaled_px(24.0F)));
        height_words(viewer);
    }
    if (fits(170.0F)) {
        ImGui::SameLine(std::max(scaled_px(580.0F), ImGui::GetItemRectMax().x + scaled_px(24.0F)));
        scale_bar(viewer);
    }
    if (ImGui::GetItemRectMax().x < display.x - right) {
        ImGui::SameLine(display.x - right);
        certificate(viewer);
    }
    ImGui::End();
    ImGui::PopStyleVar(3);
}

}  // namespace oro
