#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cstdio>

#include "apps/report/figures.h"
#include "apps/view/model_names.h"
#include "apps/view/style.h"
#include "apps/window/panels/panel_parts.h"
#include "apps/window/panels/panels.h"
#include "apps/window/window_start.h"

namespace oro {
namespace {

ImU32 colour_on_ramp(double share) {
    const auto [red, green, blue] = ramp_colour(share, 1.0);
    return IM_COL32(red, green, blue, 255);
}

// A switch and a number: as in the first view, or another one. True where that is to be shown.
bool other_number(const char* name, const char* unit, const char* tip_text, double of_first, double low,
                  double high, std::optional<double>& chosen) {
    ImGui::PushID(name);
    bool is_other = chosen.has_value();
    bool changed = ImGui::Checkbox(name, &is_other);
    tip(tip_text);
    if (changed) chosen = is_other ? std::optional(of_first) : std::nullopt;
    if (chosen) {
        ImGui::SameLine(scaled_px(140.0F));
        ImGui::SetNextItemWidth(scaled_px(110.0F));
        ImGui::InputDouble(unit, &*chosen, 0.0, 0.0, "%.4g");
        if (ImGui::IsItemDeactivatedAfterEdit()) {
            chosen = std::clamp(*chosen, low, high);
            changed = true;
        }
    }
    ImGui::PopID();
    return changed;
}

// A list of words of which the first stands for "as in the first view". True where another one was chosen.
bool other_word(const char* name, const char* tip_text, const std::vector<const char*>& words,
                std::size_t& chosen) {
    bool changed = false;
    ImGui::SetNextItemWidth(scaled_px(170.0F));
    if (ImGui::BeginCombo(name, words[chosen])) {
        for (std::size_t i = 0; i < words.size(); ++i) {
            if (!ImGui::Selectable(words[i], i == chosen)) continue;
            chosen = i;
            changed = true;
        }
        ImGui::EndCombo();
    }
    tip(tip_text);
    return changed;
}

constexpr const char* as_first = "as the first view";

bool earth_choice(SecondChoice& choice) {
    std::vector<const char*> words{as_first};
    std::size_t chosen = 0;
    for (const auto& [name, earth] : earth_names) {
        if (choice.earth == earth) chosen = words.size();
        words.push_back(name);
    }
    if (!other_word("Earth", "The ellipsoid WGS 84, a sphere of the mean radius, or a plane at the eye",
                    words, chosen))
        return false;
    choice.earth.reset();
    if (chosen > 0) choice.earth = earth_names[chosen - 1].second;
    return true;
}

bool air_choice(SecondChoice& choice) {
    const std::vector<const char*> words{as_first, "straight", "standard air", "k 0.13 everywhere"};
    const std::array<Air, 3> airs{{Air{}, standard_air, {usual_refraction_k, AirLaw::constant}}};
    std::size_t chosen = 0;
    for (std::size_t i = 0; i < airs.size(); ++i)
        if (choice.air == airs[i]) chosen = i + 1;
    if (!other_word("Light", "How the air bends it: not at all, as standard air does, or with k 0.13", words,
                    chosen))
        return false;
    choice.air.reset();
    if (chosen > 0) choice.air = airs[chosen - 1];
    return true;
}

bool style_choice_of_second(SecondChoice& choice) {
    static const std::vector<std::string> names = style_names();
    std::vector<const char*> words{as_first};
    std::size_t chosen = 0;
    for (const std::string& name : names) {
        if (choice.style == name) chosen = words.size();
        words.push_back(name.c_str());
    }
    if (!other_word("Style", "How the ground becomes colours", words, chosen)) return false;
    choice.style = chosen > 0 ? names[chosen - 1] : "";
    return true;
}

bool text_choice(const char* name, const char* hint, const char* tip_text, std::string& text) {
    ImGui::SetNextItemWidth(scaled_px(170.0F));
    ImGui::InputTextWithHint(name, hint, &text);
    const bool changed = ImGui::IsItemDeactivatedAfterEdit();
    tip(tip_text);
    return changed;
}

bool source_choice(Viewer& viewer, SecondChoice& choice) {
    static std::string path;
    if (!ImGui::IsAnyItemActive()) path = choice.paths.empty() ? "" : choice.paths.front();
    bool changed =
        text_choice("Source", "this one's data", "A file or a folder of other elevation data", path);
    if (changed) choice.paths = path.empty() ? std::vector<std::string>() : std::vector<std::string>{path};
    if (viewer.recent.empty()) return changed;
    ImGui::SetNextItemWidth(scaled_px(170.0F));
    if (ImGui::BeginCombo("##recent", "opened last")) {
        for (const std::vector<std::string>& paths : viewer.recent) {
            ImGui::PushID(&paths);
            if (ImGui::Selectable(name_of_paths(paths).c_str())) {
                choice.paths = paths;
                changed = true;
            }
            tip(paths.front().c_str());
            ImGui::PopID();
        }
        ImGui::EndCombo();
    }
    return changed;
}

bool choices(Viewer& viewer, SecondChoice& choice) {
    const View& first = viewer.view;
    bool changed = other_number("Other tau", "px", "How exact it is drawn: its largest error, in pixels",
                                first.tau_px, 0.0, 100.0, choice.tau_px);
    changed = other_number("Other heights", "times", "How high heights are drawn", first.exaggeration, 0.1,
                           20.0, choice.exaggeration) ||
              changed;
    changed = earth_choice(choice) || changed;
    changed = air_choice(choice) || changed;
    if (first.has_geoid) {
        changed = ImGui::Checkbox("Without the geoid", &choice.leaves_geoid_out) || changed;
        tip("Heights above sea level are taken for heights above the ellipsoid; the eye is as high over the "
            "ground as in the first view");
    }
    changed = style_choice_of_second(choice) || changed;
    changed = text_choice("Sun", "2026-06-21T05:30+02:00", "A date and a time; nothing: as the first view",
                          choice.sun_time) ||
              changed;
    return source_choice(viewer, choice) || changed;
}

void layout_choice(Viewer& viewer) {
    TwoViews& two = viewer.two;
    for (const auto& [words, layout] : {std::pair("Side by side", TwoViewsLayout::side_by_side),
                                        std::pair("With a line", TwoViewsLayout::swipe)}) {
        if (ImGui::RadioButton(words, two.layout == layout)) {
            two.layout = layout;
            viewer.wants_picture = true;
        }
        ImGui::SameLine();
    }
    ImGui::NewLine();
}

// The colours of a difference, from the least to the greatest that the ramp tells apart.
void difference_ramp(const SourceDifference& difference, float width) {
    constexpr int parts = 24;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float high = scaled_px(12.0F);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    for (int i = 0; i < parts; ++i) {
        const float left = at.x + width * static_cast<float>(i) / parts;
        list.AddRectFilled({left, at.y}, {at.x + width * static_cast<float>(i + 1) / parts, at.y + high},
                           colour_on_ramp(2.0 * (i + 0.5) / parts - 1.0));
    }
    ImGui::Dummy({width, high});
    const std::string limit = figure(difference.limit_m) + " m";
    ImGui::TextUnformatted(("-" + limit).c_str());
    ImGui::SameLine(0.5F * width);
    ImGui::TextUnformatted("0");
    ImGui::SameLine(width - ImGui::CalcTextSize(limit.c_str()).x);
    ImGui::TextUnformatted(limit.c_str());
}

std::string metres_at(double m, const PostPlace& place) {
    char text[100];
    std::snprintf(text, sizeof text, "%.2f m at %.6f, %.6f", m, place.lat_deg, place.lon_deg);
    return text;
}

void show_figures(Viewer& viewer) {
    const SourceDifference& difference = *viewer.comparing.found;
    const HeightDifference& found = difference.found;
    char text[100];
    ImGui::TextWrapped("%s", difference.title.c_str());
    value_line("At", counted(found.posts, "post", "posts"), difference.posts.c_str());
    std::snprintf(text, sizeof text, "%.3f m", found.mean_m);
    value_line("Mean", text, "Each post counts once");
    std::snprintf(text, sizeof text, "%.3f m", found.rms_m);
    value_line("RMS", text, "The root of the mean square");
    value_line("Least", metres_at(found.least_m, found.least_at));
    value_line("Greatest", metres_at(found.greatest_m, found.greatest_at));
    bool is_shown = viewer.comparing.is_shown;
    if (ImGui::Checkbox("Over the ground", &is_shown))
        viewer.wishes.push_back([is_shown](Viewer& v) { return show_difference(v, is_shown); });
    tip("Over the first view. Pictures by P leave it out: their files hold what draws them again");
    ImGui::SameLine();
    if (ImGui::Button("Save as GeoTIFF"))
        viewer.wishes.push_back([](Viewer& v) {
            save_difference(v);
            return Result<void>();
        });
    tip("The differences of all posts, in metres, into the working folder");
}

void difference_choice(Viewer& viewer) {
    const auto& second = viewer.two.second;
    if (!second || second->choice.paths.empty()) return;
    heading("Difference of the sources");
    if (viewer.comparing.work) {
        ImGui::ProgressBar(static_cast<float>(viewer.comparing.work->share()), {scaled_px(200.0F), scaled_px(10.0F)}, "");
        ImGui::SameLine();
        if (ImGui::Button("Stop##comparing")) stop_comparing(viewer);
    } else if (!viewer.comparing.found) {
        if (ImGui::Button("Compare heights")) compare_sources(viewer);
        tip("H of the first source minus H of the second, at the posts of the finer one");
    }
    if (viewer.comparing.found) show_figures(viewer);
}

// What differs, at the top of each half, and the line between them, which a swipe takes hold of.
void label_of_half(const std::string& words, float border, bool is_first) {
    const ImVec2 size = ImGui::CalcTextSize(words.c_str());
    const float gap = scaled_px(8.0F), pad = scaled_px(5.0F), top = scaled_px(54.0F);
    const float left = is_first ? border - gap - size.x - pad : border + gap + pad;
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    list.AddRectFilled({left - pad, top - pad}, {left + size.x + pad, top + size.y + pad},
                       interface_colour::paper, scaled_px(4.0F));
    list.AddText({left, top}, interface_colour::ink, words.c_str());
}

void swipe_line(Viewer& viewer, float border) {
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const float width = scaled_px(14.0F);
    ImGui::SetNextWindowPos({border - 0.5F * width, 0.0F});
    ImGui::SetNextWindowSize({width, display.y});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.0F, 0.0F});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0.0F);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1.0F, 1.0F});
    ImGui::Begin("##swipe", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav |
                     ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoBringToFrontOnFocus);
    ImGui::InvisibleButton("##line", {width, display.y});
    const bool is_held = ImGui::IsItemActive(), is_near = is_held || ImGui::IsItemHovered();
    if (is_near) ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
    if (is_held && display.x > 0.0F)
        viewer.two.line = std::clamp(static_cast<double>(ImGui::GetIO().MousePos.x / display.x), 0.02, 0.98);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float radius = scaled_px(6.0F);
    list.AddCircleFilled({border, 0.5F * display.y}, radius,
                         is_near ? interface_colour::accent : interface_colour::ink);
    ImGui::End();
    ImGui::PopStyleVar(3);
}

}  // namespace

void build_two_views(Viewer& viewer) {
    const auto& second = viewer.two.second;
    if (!second || shows_panorama(viewer)) return;
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const TwoHalves halves = two_halves(viewer.two.layout, viewer.two.line, static_cast<int>(display.x));
    const auto border = static_cast<float>(halves.begins_px);
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    list.AddLine({border, 0.0F}, {border, display.y}, interface_colour::shadow, scaled_px(4.0F));
    list.AddLine({border, 0.0F}, {border, display.y}, interface_colour::ink, scaled_px(2.0F));
    const DifferenceWords words = difference_words(viewer.view, second->choice, source_names(viewer));
    label_of_half(words.first, border, true);
    label_of_half(words.second, border, false);
    if (viewer.two.layout == TwoViewsLayout::swipe) swipe_line(viewer, border);
    if (!viewer.comparing.found || !viewer.comparing.is_shown) return;
    begin_area("##difference", {scaled_px(10.0F), display.y - scaled_px(40.0F)}, {0.0F, 1.0F});
    ImGui::TextUnformatted(viewer.comparing.found->title.c_str());
    difference_ramp(*viewer.comparing.found, scaled_px(220.0F));
    ImGui::End();
}

void build_two_views_panel(Viewer& viewer) {
    bool& is_open = viewer.panels.two_views;
    if (!is_open) return;
    TwoViews& two = viewer.two;
    if (begin_panel("Two views", is_open, PanelCorner::upper_left, 330.0F)) {
        layout_choice(viewer);
        heading("What the second has otherwise");
        const bool changed = choices(viewer, two.choice);
        if (changed && (two.second || two.work))
            viewer.wishes.push_back([choice = two.choice](Viewer& v) { return show_second(v, choice); });
        if (two.work) {
            ImGui::ProgressBar(static_cast<float>(two.work->share()), {scaled_px(200.0F), scaled_px(10.0F)}, "");
            ImGui::SameLine();
            if (ImGui::Button("Stop##preparing")) stop_second(viewer);
        } else if (!two.second && ImGui::Button("Show two views")) {
            viewer.wishes.push_back([choice = two.choice](Viewer& v) { return show_second(v, choice); });
        }
        if (two.second && ImGui::Button("Show one view")) viewer.wishes.push_back(close_second);
        difference_choice(viewer);
    }
    ImGui::End();
}

}  // namespace oro
