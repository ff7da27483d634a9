#include "apps/window/second_choice.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "apps/view/model_names.h"
#include "apps/view/style.h"

namespace oro {
namespace {

std::string written_value(const char* format, double value) {
    char text[60];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

std::string words_of_air(const Air& air) {
    if (air.k == 0.0) return "straight light";
    return air == standard_air ? "standard air" : written_value("refraction k %g", air.k);
}

std::string words_of_sun(const View& view) {
    const auto& sun = view.sun;
    if (!sun || sun->is_usual) return "usual light";
    if (sun->time) return "sun " + sun->time->text;
    return written_value("sun from %.0f°", sun->azimuth_deg);
}

}  // namespace

Result<View> differing_view(View view, const SecondChoice& choice) {
    if (choice.tau_px) view.tau_px = *choice.tau_px;
    if (choice.exaggeration) view.exaggeration = *choice.exaggeration;
    if (choice.air) view.model.air = *choice.air;
    if (choice.earth) view.model.earth = *choice.earth;
    if (choice.leaves_geoid_out) view.has_geoid = false;
    if (!choice.style.empty() && choice.style != view.style) {
        view.style = choice.style;
        view.style_text.reset();
        if (!view.sun || view.sun->is_usual) {
            view.sun.reset();
            if (has_sun_by_place(view)) view.sun = usual_sun();
        }
    }
    if (!choice.sun_time.empty()) {
        ORO_TRY(const SunTime time, parse_time("--sun-time", choice.sun_time));
        view.sun = SunDirection{0.0, 0.0, time};
    }
    if (view.mesh != "grid") view.mesh = "auto";
    aim_sun(view.sun, view.camera.eye);
    return view;
}

Camera second_camera(const Camera& first, int width_px, double N_m) {
    Camera camera = first;
    camera.width_px = width_px;
    camera.eye.h_m -= N_m;
    return camera;
}

DifferenceWords difference_words(const View& first, const SecondChoice& choice,
                                 const DifferenceWords& sources) {
    DifferenceWords words;
    const auto add = [&](const std::string& one, const std::string& other) {
        words.first += (words.first.empty() ? "" : ", ") + one;
        words.second += (words.second.empty() ? "" : ", ") + other;
    };
    if (!choice.paths.empty()) add(sources.first, sources.second);
    if (choice.tau_px && *choice.tau_px != first.tau_px)
        add(written_value("tau %.2f px", first.tau_px), written_value("tau %.2f px", *choice.tau_px));
    if (choice.exaggeration && *choice.exaggeration != first.exaggeration)
        add(written_value("heights x %.2f", first.exaggeration),
            written_value("heights x %.2f", *choice.exaggeration));
    if (choice.earth && *choice.earth != first.model.earth)
        add(name_in(earth_names, first.model.earth), name_in(earth_names, *choice.earth));
    if (choice.air && !(*choice.air == first.model.air))
        add(words_of_air(first.model.air), words_of_air(*choice.air));
    if (choice.leaves_geoid_out && first.has_geoid) add("with geoid", "no geoid");
    if (!choice.style.empty() && choice.style != first.style) add(first.style, choice.style);
    if (!choice.sun_time.empty()) add(words_of_sun(first), "sun " + choice.sun_time);
    if (words.first.empty()) return {"first view", "second view"};
    return words;
}

TwoHalves two_halves(TwoViewsLayout layout, double line, int window_px) {
    TwoHalves halves;
    if (layout == TwoViewsLayout::swipe) {
        halves.begins_px = static_cast<int>(std::lround(std::clamp(line, 0.0, 1.0) * window_px));
        halves.first_px = halves.second_px = std::max(1, window_px);
        return halves;
    }
    halves.begins_px = std::max(1, window_px / 2);
    halves.first_px = halves.begins_px;
    halves.second_px = std::max(1, window_px - halves.begins_px);
    return halves;
}

glm::dvec2 PointerOverHalves::point_of_first(glm::dvec2 at_px, int begins_px) const {
    if (begins_px == 0) return at_px;
    const bool is_in_second = buttons_down_ > 0 ? drags_second_ : at_px.x >= begins_px;
    if (is_in_second) at_px.x -= begins_px;
    return at_px;
}

void PointerOverHalves::button(bool down, glm::dvec2 at_px, int begins_px) {
    if (down && buttons_down_ == 0) drags_second_ = begins_px > 0 && at_px.x >= begins_px;
    buttons_down_ = std::max(0, buttons_down_ + (down ? 1 : -1));
}

}  // namespace oro
