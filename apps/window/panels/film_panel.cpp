#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "apps/film/film_keys.h"
#include "apps/window/motion.h"
#include "apps/window/panels/panel_parts.h"
#include "apps/window/panels/panels.h"

namespace oro {
namespace {

// What is asked of one key; done after all are listed.
struct KeyWish {
    enum class Kind { nothing, remove, up, down, look, play } kind{Kind::nothing};
    std::size_t number{};
};

void small_button(const char* words, const char* tip_text, KeyWish::Kind kind, std::size_t number,
                  KeyWish& wish) {
    ImGui::SameLine();
    if (ImGui::SmallButton(words)) wish = {kind, number};
    tip(tip_text);
}

void key_line(std::vector<CameraKey>& keys, std::size_t number, KeyWish& wish) {
    using Kind = KeyWish::Kind;
    const CameraKey& key = keys[number];
    ImGui::PushID(static_cast<int>(number));
    double time_s = key.time_s;
    ImGui::SetNextItemWidth(scaled_px(70.0F));
    ImGui::InputDouble("##time", &time_s, 0.0, 0.0, "%.2f s");
    if (ImGui::IsItemDeactivatedAfterEdit()) set_key_time(keys, number, time_s);
    tip("Its time in the film. All keys after it move along");
    small_button("go", "Shows what it sees", Kind::look, number, wish);
    small_button("play", "Plays the film from here", Kind::play, number, wish);
    small_button("up", "Earlier by one", Kind::up, number, wish);
    small_button("down", "Later by one", Kind::down, number, wish);
    small_button("x", "Removes it", Kind::remove, number, wish);
    char text[100];
    std::snprintf(text, sizeof text, "%.4f, %.4f  %.0f°", key.eye.lat_deg, key.eye.lon_deg,
                  key.attitude.heading_deg);
    ImGui::SameLine();
    ImGui::TextDisabled("%s", text);
    ImGui::PopID();
}

void grant(Viewer& viewer, const KeyWish& wish) {
    using Kind = KeyWish::Kind;
    std::vector<CameraKey>& keys = viewer.film.keys;
    if (wish.kind == Kind::remove) remove_key(keys, wish.number);
    if (wish.kind == Kind::up && wish.number > 0) swap_with_next(keys, wish.number - 1);
    if (wish.kind == Kind::down) swap_with_next(keys, wish.number);
    if (wish.kind == Kind::play) play_film(viewer, wish.number);
    if (wish.kind == Kind::look)
        fly_to(viewer, camera_of_key(viewer.view.camera, keys[wish.number]),
               "key " + std::to_string(wish.number + 1));
}

void list_keys(Viewer& viewer) {
    Film& film = viewer.film;
    if (film.keys.empty()) {
        quiet_text("Go somewhere and add what you see; then go on, and add the next view.");
        return;
    }
    KeyWish wish;
    const float most = ImGui::GetFrameHeightWithSpacing() * 6.5F;
    const float all = ImGui::GetFrameHeightWithSpacing() * static_cast<float>(film.keys.size()) + 8.0F;
    ImGui::BeginChild("##keys", {0.0F, std::min(all, most)});
    // Of a path along a track there are thousands.
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(film.keys.size()));
    while (clipper.Step())
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i)
            key_line(film.keys, static_cast<std::size_t>(i), wish);
    ImGui::EndChild();
    grant(viewer, wish);
}

void keep_film(Viewer& viewer) {
    Film& film = viewer.film;
    ImGui::SetNextItemWidth(scaled_px(230.0F));
    ImGui::InputText("##file", &film.file);
    tip("A .json of keys, a .kml with a tour, or a track. Saved as KML it has no angles of view");
    const auto button = [&](const char* words, void (*does)(Viewer&), const char* tip_text) {
        ImGui::SameLine();
        if (ImGui::Button(words))
            viewer.wishes.push_back([does](Viewer& v) {
                does(v);
                return Result<void>();
            });
        tip(tip_text);
    };
    button("Open", open_film, "In the place of these keys");
    button("Save the path", save_film, "As orograph film takes it, which draws the frames or the movie");
    copy_button(viewer, "Copy the command that films it", film_command(film.file, viewer.view));
    tip("The line for a shell that draws the film of that file as this window looks now");
}

// Draws what the keys say, here.
void draw_button(Viewer& viewer) {
    if (viewer.film.keys.size() < 2) return;
    ImGui::BeginDisabled(viewer.begun.work != nullptr);
    if (ImGui::Button("Draw the film"))
        viewer.wishes.push_back([](Viewer& v) {
            draw_film(v);
            return Result<void>();
        });
    ImGui::EndDisabled();
    tip("Into the working folder: a movie where ffmpeg is there, else a folder of pictures. The window goes "
        "on "
        "meanwhile");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(scaled_px(70.0F));
    if (ImGui::InputDouble("frames a second", &viewer.film.fps, 0.0, 0.0, "%.4g"))
        viewer.film.fps = std::clamp(viewer.film.fps, 0.01, 1000.0);
}

void choose_walk(Viewer& viewer) {
    LineWalk& walk = viewer.film.walk;
    ImGui::SetNextItemWidth(scaled_px(70.0F));
    ImGui::InputDouble("m/s", &walk.speed_m_s, 0.0, 0.0, "%.4g");
    tip("How fast: 1.4 is a walk, 5 a bicycle, 30 a train");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(scaled_px(70.0F));
    ImGui::InputDouble("m ahead", &walk.ahead_m, 0.0, 0.0, "%.4g");
    tip("What is looked at: the ground of the line, so far ahead");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(scaled_px(70.0F));
    ImGui::InputDouble("m up", &walk.above_m, 0.0, 0.0, "%.4g");
    tip("How high the eye is over the ground: 1.7 is a person's; coarse data look better from 50");
    const auto follow_button = [&](const std::string& words, auto wish) {
        if (ImGui::Button(words.c_str()))
            viewer.wishes.push_back([wish](Viewer& v) {
                wish(v);
                return Result<void>();
            });
        tip("The eye goes along it, so high over the ground. Any key stops");
    };
    bool any = false;
    if (viewer.measuring.found.profile) {
        follow_button("The measured line", follow_measured_line);
        any = true;
    }
    for (const std::string& file : viewer.view.vectors.overlay) {
        follow_button(std::filesystem::path(file).filename().string(),
                      [file, line = viewer.film.line](Viewer& v) { follow_file(v, file, line); });
        any = true;
    }
    if (!any) {
        quiet_text("Drop a track (GPX, KML, GeoJSON) on the window, or measure a line.");
    } else if (!viewer.view.vectors.overlay.empty()) {
        ImGui::SetNextItemWidth(scaled_px(70.0F));
        if (ImGui::InputInt("of its lines", &viewer.film.line, 0))
            viewer.film.line = std::max(1, viewer.film.line);
        tip("Which line of a file that has several, from 1");
    }
}

}  // namespace

void build_film_panel(Viewer& viewer) {
    bool& is_open = viewer.panels.film;
    if (!is_open) return;
    if (begin_panel("Film", is_open, PanelCorner::upper_left, 470.0F)) {
        // Above the list, which grows with each: the button stays where it is.
        if (ImGui::Button("Add this view")) add_shown_view(viewer);
        ImGui::SameLine();
        ImGui::SetNextItemWidth(scaled_px(70.0F));
        if (ImGui::InputDouble("s later", &viewer.film.gap_s, 0.0, 0.0, "%.4g"))
            viewer.film.gap_s = std::clamp(viewer.film.gap_s, least_key_gap_s, 1.0e5);
        if (!viewer.film.keys.empty()) {
            ImGui::SameLine();
            if (viewer.playing ? ImGui::Button("Stop") : ImGui::Button("Play")) {
                if (viewer.playing)
                    stop_playing(viewer);
                else
                    play_film(viewer, 0);
            }
            ImGui::SameLine();
            if (ImGui::Button("Clear")) viewer.film.keys.clear();
        }
        list_keys(viewer);
        draw_button(viewer);
        keep_film(viewer);
        heading("Follow a line");
        choose_walk(viewer);
    }
    ImGui::End();
}

}  // namespace oro
