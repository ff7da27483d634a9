#include <algorithm>
#include <cmath>
#include <cstdio>

#include "apps/commands/sight/profile_text.h"
#include "apps/report/figures.h"
#include "apps/window/measuring.h"
#include "apps/window/panels/panel_parts.h"
#include "apps/window/panels/panels.h"

namespace oro {
namespace {

std::string length_words(double length_m) {
    char text[60];
    if (length_m >= 10'000.0)
        std::snprintf(text, sizeof text, "%.3f km", length_m / 1000.0);
    else
        std::snprintf(text, sizeof text, "%.2f m", length_m);
    return text;
}

// Heights along the line, with the lowest and the highest, and what is under the pointer.
void plot(const Profile& profile) {
    const ImVec2 size(ImGui::GetContentRegionAvail().x, scaled_px(120.0F));
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::InvisibleButton("##profile", size);
    const bool hovered = ImGui::IsItemHovered();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(at, {at.x + size.x, at.y + size.y}, IM_COL32(255, 255, 255, 14), scaled_px(4.0F));
    if (!profile.sums.highest || !profile.sums.lowest) return;
    const double low_m = profile.points[*profile.sums.lowest].H_m;
    const double high_m = std::max(profile.points[*profile.sums.highest].H_m, low_m + 1.0);
    const double length_m = profile.length_m();
    const float room = scaled_px(16.0F);
    const auto point_at = [&](double along_m, double H_m) {
        return ImVec2(
            at.x + size.x * static_cast<float>(along_m / length_m),
            at.y + room +
                (size.y - 2.0F * room) * static_cast<float>(1.0 - (H_m - low_m) / (high_m - low_m)));
    };
    // The lowest and the highest of each column of pixels.
    const auto columns = static_cast<std::size_t>(std::max(size.x, 2.0F));
    std::size_t next = 0;
    ImVec2 before{};
    bool has_before = false;
    for (std::size_t column = 0; column < columns; ++column) {
        const double end_m = length_m * static_cast<double>(column + 1) / static_cast<double>(columns);
        double lowest = high_m, highest = low_m;
        bool any = false;
        for (; next < profile.points.size() && profile.points[next].along_m <= end_m; ++next) {
            const ProfilePoint& point = profile.points[next];
            if (!point.has_ground) continue;
            any = true;
            lowest = std::min(lowest, point.H_m);
            highest = std::max(highest, point.H_m);
        }
        if (!any) continue;
        const ImVec2 top = point_at(end_m, highest), bottom = point_at(end_m, lowest);
        if (has_before) list.AddLine(before, top, interface_colour::accent, scaled_px(1.5F));
        if (bottom.y - top.y > 1.0F) list.AddLine(top, bottom, interface_colour::accent, scaled_px(1.5F));
        before = bottom;
        has_before = true;
    }
    const auto label = [&](ImVec2 place, const std::string& text) {
        list.AddText(place, interface_colour::quiet, text.c_str());
    };
    label({at.x + scaled_px(4.0F), at.y}, metres(high_m) + " m");
    label({at.x + scaled_px(4.0F), at.y + size.y - ImGui::GetTextLineHeight()}, metres(low_m) + " m");
    const std::string far = length_words(length_m);
    label({at.x + size.x - ImGui::CalcTextSize(far.c_str()).x - scaled_px(4.0F),
           at.y + size.y - ImGui::GetTextLineHeight()},
          far);
    if (!hovered) return;
    const double along_m = length_m * static_cast<double>((ImGui::GetIO().MousePos.x - at.x) / size.x);
    const auto point = std::ranges::lower_bound(profile.points, along_m, {}, &ProfilePoint::along_m);
    if (point == profile.points.end() || !point->has_ground) return;
    const ImVec2 dot = point_at(point->along_m, point->H_m);
    list.AddCircleFilled(dot, scaled_px(3.5F), interface_colour::ink);
    ImGui::SetTooltip("%s along: %.2f m above sea level\n%.6f, %.6f", length_words(point->along_m).c_str(),
                      point->H_m, point->lat_deg, point->lon_deg);
}

void sums(const Measurement& measurement) {
    char text[100];
    const Profile& profile = *measurement.profile;
    value_line("Distance", length_words(profile.length_m()),
               "Along the shortest way over the ellipsoid, from place to place.");
    std::snprintf(text, sizeof text, "%.2f°", profile.line.bearings_deg.back());
    value_line("Bearing", text, "True, clockwise from north, where the last part begins.");
    std::snprintf(text, sizeof text, "%.1f m up, %.1f m down", profile.sums.climbed_m,
                  profile.sums.went_down_m);
    value_line("Climb", text, "By rises and falls of 10 m or more, as guides and receivers count.");
    if (measurement.area) {
        std::snprintf(text, sizeof text, "%.6f km², %s around", measurement.area->area_m2 / 1e6,
                      length_words(measurement.area->perimeter_m).c_str());
        value_line("Area", text, "Of the polygon on the ellipsoid, the last place joined to the first.");
    }
    if (!measurement.sight) return;
    const SightReport& sight = *measurement.sight;
    if (!sight.obstacle) {
        std::snprintf(text, sizeof text, "free by %.1f m", sight.line.clearance_m);
    } else {
        std::snprintf(text, sizeof text, "hidden by ground %s away",
                      length_words(sight.obstacle_distance_m).c_str());
    }
    value_line("Line of sight", text,
               "From eyes 2 m over the first place to the ground of the last, through the view's air.");
}

// A line of a file that lies over the ground, in the place of one that is drawn.
void line_choice(Viewer& viewer) {
    if (!has_loaded_lines(viewer.view)) return;
    ImGui::SetNextItemWidth(-1.0F);
    if (!ImGui::BeginCombo("##line", "a line of a file")) return;
    int id = 0;
    for (const LoadedLine& line : loaded_lines(viewer.view)) {
        ImGui::PushID(id++);
        if (ImGui::Selectable(line.name.c_str()))
            viewer.wishes.push_back([line](Viewer& v) { return measure_loaded(v, line); });
        tip(line.file.c_str());
        ImGui::PopID();
    }
    ImGui::EndCombo();
}

void save_choice(Viewer& viewer) {
    for (const char* const ending : {".csv", ".svg", ".geojson"}) {
        const std::string words = "Save " + std::string(ending + 1);
        if (ImGui::Button(words.c_str()))
            viewer.wishes.push_back([ending](Viewer& v) { return save_profile(v, ending); });
        tip("Into the working folder, as orograph profile --out writes it");
        ImGui::SameLine();
    }
    ImGui::NewLine();
}

// The line over the picture, whatever ground lies before it.
void draw_line(const Viewer& viewer) {
    const Measuring& measuring = viewer.measuring;
    if (!measuring.found.profile && measuring.found.places.empty()) return;
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const Camera& shown = viewer.view.camera;
    // Of two views side by side in the first.
    list.PushClipRect({0.0F, 0.0F},
                      {static_cast<float>(shown.width_px), static_cast<float>(shown.height_px)});
    const auto join = [&](const std::optional<glm::dvec2>& from, const std::optional<glm::dvec2>& to) {
        if (!from || !to) return;
        const ImVec2 a(static_cast<float>(from->x), static_cast<float>(from->y)),
            b(static_cast<float>(to->x), static_cast<float>(to->y));
        list.AddLine(a, b, interface_colour::shadow, scaled_px(4.0F));
        list.AddLine(a, b, interface_colour::accent, scaled_px(2.0F));
    };
    for (std::size_t i = 0; i + 1 < measuring.line_ecef.size(); ++i)
        join(pixel_of(viewer.view.camera, measuring.line_ecef[i], viewer.view.model.air),
             pixel_of(viewer.view.camera, measuring.line_ecef[i + 1], viewer.view.model.air));
    for (const Ecef& corner : measuring.corners_ecef) {
        const auto at = pixel_of(viewer.view.camera, corner, viewer.view.model.air);
        if (!at) continue;
        const ImVec2 dot(static_cast<float>(at->x), static_cast<float>(at->y));
        list.AddCircleFilled(dot, scaled_px(5.0F), interface_colour::shadow);
        list.AddCircleFilled(dot, scaled_px(3.5F), interface_colour::ink);
    }
    list.PopClipRect();
}

}  // namespace

void build_measure_panel(Viewer& viewer) {
    bool& is_open = viewer.panels.measure;
    if (!is_open) return;
    draw_line(viewer);
    if (begin_panel("Measure", is_open, PanelCorner::upper_left, 380.0F)) {
        const Measurement& found = viewer.measuring.found;
        if (found.places.empty()) {
            quiet_text("Click at places of the ground, one after the other.");
            line_choice(viewer);
        } else if (!found.profile) {
            quiet_text("Click at the next place.");
        } else {
            plot(*found.profile);
            sums(found);
        }
        if (!found.places.empty()) {
            const bool is_drawn = !found.profile || found.profile->line.file.empty();
            if (is_drawn && ImGui::Button("Take back")) viewer.wishes.push_back(take_back_place);
            if (is_drawn) {
                tip("Removes the last place");
                ImGui::SameLine();
            }
            if (ImGui::Button("Clear")) viewer.wishes.push_back(clear_places);
        }
        if (found.profile) {
            ImGui::SameLine();
            if (ImGui::Button("Copy as table")) ImGui::SetClipboardText(profile_csv(*found.profile).c_str());
            tip("The profile as orograph profile writes it: CSV");
            ImGui::SameLine();
            if (found.profile->line.file.empty() && ImGui::Button("Copy the line"))
                ImGui::SetClipboardText(along_text(found.places).c_str());
            tip("For orograph profile --along");
            save_choice(viewer);
        }
    }
    ImGui::End();
}

}  // namespace oro
