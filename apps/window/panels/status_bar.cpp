#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "apps/report/figures.h"
#include "apps/window/panels/panel_parts.h"
#include "apps/window/panels/panels.h"
#include "core/terrain/ground.h"

namespace oro {
namespace {

std::string metres_over(double value_m) {
    return metres(value_m) + " m";
}

// Where the pointer is, or the picture's middle where it is elsewhere.
void place_words(const Viewer& viewer) {
    const bool pointed = viewer.under_pointer.has_value();
    const auto& place = pointed ? viewer.under_pointer : viewer.in_middle;
    if (!place || !place->seen) {
        ImGui::TextDisabled(pointed ? "sky, or no data" : "no ground in the middle");
        tip("There is no ground of the data where the pointer is.");
        return;
    }
    const SeenPlace& seen = *place->seen;
    char text[320];
    std::snprintf(text, sizeof text, "%.5f, %.5f   %s m above sea", seen.lat_deg, seen.lon_deg,
                  metres(seen.H_m).c_str());
    ImGui::TextUnformatted(text);
    if (ImGui::IsItemHovered()) {
        std::snprintf(text, sizeof text,
                      "Latitude and longitude (WGS 84) %s.\nH %.2f m: height above sea level (the geoid)\n"
                      "h %.2f m: height above the ellipsoid\nA right click tells more.",
                      pointed ? "under the pointer" : "in the picture's middle", seen.H_m, seen.h_m);
        ImGui::SetTooltip("%s", text);
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
    const std::string text = ground_m ? who + metres_over(camera.eye.h_m - *ground_m) + " over ground"
                                      : "eye at " + metres_over(camera.eye.h_m - N_m);
    ImGui::TextUnformatted(text.c_str());
    if (!ImGui::IsItemHovered()) return;
    ImGui::SetTooltip(
        "The eye: %.6f, %.6f\nH %.1f m above sea level\nh %.1f m above the ellipsoid\n"
        "heading %.1f°, pitch %.1f°",
        camera.eye.lat_deg, camera.eye.lon_deg, camera.eye.h_m - N_m, camera.eye.h_m,
        camera.attitude.heading_deg, camera.attitude.pitch_deg);
}

// 1, 2 or 5 times a power of ten.
double round_length_m(double most_m) {
    const double power = std::pow(10.0, std::floor(std::log10(most_m)));
    for (const double digit : {5.0, 2.0})
        if (digit * power <= most_m) return digit * power;
    return power;
}

void scale_bar(const Viewer& viewer) {
    if (!viewer.in_middle || !viewer.in_middle->seen) return;
    const Camera& camera = viewer.view.camera;
    const double distance_m = viewer.in_middle->seen->seen_distance_m;
    const double m_per_px = 2.0 * camera.half_fov_tangent().y * distance_m / camera.height_px;
    const double most_px = static_cast<double>(scaled_px(96.0F));
    if (!(m_per_px > 0.0)) return;
    const double length_m = round_length_m(m_per_px * most_px);
    const auto length_px = static_cast<float>(length_m / m_per_px);
    char text[40];
    if (length_m >= 1000.0)
        std::snprintf(text, sizeof text, "%.0f km", length_m / 1000.0);
    else
        std::snprintf(text, sizeof text, length_m < 1.0 ? "%.1f m" : "%.0f m", length_m);
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
    ImGui::TextUnformatted(text);
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("The length of the bar in the picture's middle, %s m away.",
                          metres(distance_m).c_str());
}

std::string certificate_words(const Viewer& viewer) {
    if (const std::string progress = progress_words(viewer); !progress.empty()) return progress + " …";
    const DetailStep& step = viewer.drawn_at;
    const double within_px = viewer.view.tau_px * step.tau_factor / step.scale;
    char text[80];
    if (within_px <= 0.0) return "full resolution";
    std::snprintf(text, sizeof text, "detail within %s px", figure(within_px).c_str());
    return text;
}

void certificate(const Viewer& viewer) {
    ImGui::PushStyleColor(ImGuiCol_Text,
                          viewer.is_settled ? interface_colour::good : interface_colour::accent);
    ImGui::TextUnformatted(certificate_words(viewer).c_str());
    ImGui::PopStyleColor();
    if (!ImGui::IsItemHovered()) return;
    const DetailStep& step = viewer.drawn_at;
    char text[400];
    std::snprintf(text, sizeof text,
                  "Nothing that is drawn lies farther than this from where all posts of the data would put "
                  "it.\ntau %s px (the view asks for %s), of pixels %.0f %% as wide as the window's.\n%s",
                  figure(viewer.view.tau_px * step.tau_factor).c_str(), figure(viewer.view.tau_px).c_str(),
                  100.0 / step.scale,
                  viewer.is_settled ? "The picture is all that the view asks for."
                                    : "It is not yet all that the view asks for.");
    ImGui::SetTooltip("%s", text);
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
