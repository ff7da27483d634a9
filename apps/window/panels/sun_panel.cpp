#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "apps/report/json_text.h"
#include "apps/window/changes.h"
#include "apps/window/motion.h"
#include "apps/window/panels/panel_parts.h"
#include "apps/window/panels/panels.h"
#include "core/light/sun_position.h"
#include "core/light/utc_time.h"

namespace oro {
namespace {

constexpr int day_min = 1440;

// "2026-06-21T05:30+02:00"
std::string time_of(const SunClock& clock) {
    char text[60];
    std::snprintf(text, sizeof text, "%sT%02d:%02d%c%02d:00", clock.date.c_str(), clock.minute / 60 % 24,
                  clock.minute % 60, clock.zone_h < 0 ? '-' : '+', std::abs(clock.zone_h));
    return text;
}

// Where the view's sun stands in time, by the clock of the eye's place: whole hours from UTC.
SunClock clock_of(const Viewer& viewer) {
    SunClock clock;
    clock.zone_h = static_cast<int>(std::lround(viewer.view.camera.eye.lon_deg / 15.0));
    const auto& sun = viewer.view.sun;
    const std::int64_t utc_s = sun && sun->time ? sun->time->utc_s : time_now_s();
    const std::int64_t there_s = utc_s + clock.zone_h * 3600;
    clock.date = time_text(there_s).substr(0, 10);
    clock.minute = static_cast<int>((there_s % 86400 + 86400) % 86400 / 60);
    return clock;
}

// The sun's way over that day, above a plain horizon.
void day_arc(const SunClock& clock, std::int64_t midnight_utc_s, const Geodetic& place) {
    const ImVec2 size(ImGui::GetContentRegionAvail().x, scaled_px(92.0F)), at = ImGui::GetCursorScreenPos();
    ImGui::Dummy(size);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.PushClipRect(at, {at.x + size.x, at.y + size.y}, true);
    const auto point = [&](double minute, double elevation_deg) {
        return ImVec2(at.x + size.x * static_cast<float>(minute / day_min),
                      at.y + size.y * static_cast<float>(0.72 - elevation_deg / 125.0));
    };
    const ImVec2 level = point(0.0, 0.0);
    list.AddRectFilled(at, {at.x + size.x, level.y}, IM_COL32(120, 170, 220, 40), scaled_px(4.0F));
    list.AddRectFilled({at.x, level.y}, {at.x + size.x, at.y + size.y}, IM_COL32(0, 0, 0, 70),
                       scaled_px(4.0F));
    list.AddLine(level, {at.x + size.x, level.y}, interface_colour::line, scaled_px(1.0F));
    const auto sun_at = [&](double minute) {
        return sun_position(static_cast<double>(midnight_utc_s) + 60.0 * minute, place);
    };
    ImVec2 before = point(0.0, sun_at(0.0).elevation_deg);
    for (int minute = 10; minute <= day_min; minute += 10) {
        const double elevation_deg = sun_at(minute).elevation_deg;
        const ImVec2 next = point(minute, elevation_deg);
        list.AddLine(before, next, elevation_deg > 0.0 ? interface_colour::accent : interface_colour::quiet,
                     scaled_px(2.0F));
        before = next;
    }
    const SunPosition now = sun_at(clock.minute);
    const ImVec2 disc = point(clock.minute, now.elevation_deg);
    list.AddCircleFilled(disc, scaled_px(6.0F),
                         now.elevation_deg > 0.0 ? IM_COL32(255, 222, 120, 255) : interface_colour::quiet);
    list.PopClipRect();
    char text[60];
    std::snprintf(text, sizeof text, "%.1f°", now.azimuth_deg);
    value_line("Azimuth", text, "Of the sun, true, clockwise from north");
    std::snprintf(text, sizeof text, "%.1f°", now.elevation_deg);
    value_line("Elevation", text, "Of the sun's middle as it is seen, above level");
}

std::string hour_words(double utc_s, int zone_h) {
    const auto minute = static_cast<std::int64_t>(std::floor(utc_s / 60.0 + 0.5)) + zone_h * 60;
    const auto of_day = static_cast<int>((minute % day_min + day_min) % day_min);
    char text[20];
    std::snprintf(text, sizeof text, "%02d:%02d", of_day / 60, of_day % 60);
    return text;
}

// A button for each time at which the sun comes up or goes down. Whether one was pressed: the clock has its
// time then.
bool rises(SunClock& clock, std::int64_t midnight_utc_s, const Geodetic& place) {
    const SunDayEvents day =
        sun_day(static_cast<double>(midnight_utc_s), {place.lat_deg, place.lon_deg, 0.0});
    if (day.crossings.empty())
        quiet_text(day.day == SunDay::up_all_day ? "The sun is up all day" : "The sun is down all day");
    bool chosen = false;
    for (const SunCrossing& crossing : day.crossings) {
        if (&crossing != &day.crossings.front()) ImGui::SameLine();
        const std::string words = std::string(crossing.rising ? "Sunrise " : "Sunset ") +
                                  hour_words(crossing.time_utc_s, clock.zone_h);
        if (ImGui::Button(words.c_str())) {
            const double since_min = (crossing.time_utc_s - static_cast<double>(midnight_utc_s)) / 60.0;
            clock.minute = std::clamp(static_cast<int>(std::lround(since_min)), 0, day_min - 1);
            chosen = true;
        }
        tip("Over a plain horizon, as almanacs have it; orograph sun tells it over the terrain");
    }
    return chosen;
}

// Turns the eye to where the sun is, or to where it went down.
void look_at_sun_button(Viewer& viewer, const SunPosition& sun) {
    if (ImGui::Button("Look at the sun")) {
        Camera there = viewer.view.camera;
        there.attitude.heading_deg = sun.azimuth_deg;
        there.attitude.pitch_deg = std::clamp(sun.elevation_deg, 0.0, 85.0);
        fly_to(viewer, there, "Backspace goes back");
    }
    tip("Turns to it; at night to where it is below the horizon");
}

}  // namespace

void build_sun_panel(Viewer& viewer) {
    bool& is_open = viewer.panels.sun;
    if (!is_open) {
        viewer.sun_clock.reset();
        return;
    }
    if (!viewer.sun_clock) viewer.sun_clock = clock_of(viewer);
    SunClock& clock = *viewer.sun_clock;
    if (begin_panel("Sun", is_open, PanelCorner::upper_right, 340.0F)) {
        bool is_usual = !viewer.view.sun || viewer.view.sun->is_usual;
        bool changed = false;
        if (ImGui::Checkbox("Usual light", &is_usual)) {
            if (is_usual)
                viewer.wishes.push_back([](Viewer& v) { return choose_sun(v, ""); });
            else
                changed = true;
        }
        tip("The light of maps: ten o'clock by the sun. Without it the sun stands where it does at a date "
            "and a time.");
        ImGui::SetNextItemWidth(scaled_px(110.0F));
        std::string date = clock.date;
        date.resize(10);
        if (ImGui::InputText("##date", date.data(), date.size() + 1, ImGuiInputTextFlags_AlwaysOverwrite)) {
            if (utc_time_from(date + "T00:00Z").ok()) changed = true;
            clock.date = date;
        }
        tip("Year-month-day");
        ImGui::SameLine();
        ImGui::SetNextItemWidth(scaled_px(110.0F));
        if (ImGui::InputInt("h from UTC", &clock.zone_h)) {
            clock.zone_h = std::clamp(clock.zone_h, -12, 14);
            changed = true;
        }
        tip("How many hours clocks there are ahead of UTC");
        char hour[20];
        std::snprintf(hour, sizeof hour, "%02d:%02d", clock.minute / 60, clock.minute % 60);
        // Beside the slider, whose handle would lie over it.
        ImGui::SetNextItemWidth(-scaled_px(52.0F));
        changed = ImGui::SliderInt("##time", &clock.minute, 0, day_min - 1, "",
                                   ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_NoInput) ||
                  changed;
        ImGui::SameLine();
        ImGui::TextUnformatted(hour);
        const auto midnight = utc_time_from(clock.date + "T00:00Z");
        if (midnight.ok()) {
            const std::int64_t midnight_utc_s = *midnight - clock.zone_h * 3600;
            day_arc(clock, midnight_utc_s, viewer.view.camera.eye);
            changed = rises(clock, midnight_utc_s, viewer.view.camera.eye) || changed;
            look_at_sun_button(viewer, sun_position(static_cast<double>(midnight_utc_s) + 60.0 * clock.minute,
                                                    viewer.view.camera.eye));
        }
        if (changed && midnight.ok())
            viewer.wishes.push_back([time = time_of(clock)](Viewer& v) { return choose_sun(v, time); });
    }
    ImGui::End();
}

}  // namespace oro
