#include "apps/window/motion.h"

#include <array>
#include <glm/common.hpp>
#include <utility>

#include "apps/eye/standpoint.h"
#include "apps/navigation/home.h"
#include "apps/window/playing.h"
#include "core/terrain/ground.h"
#include "core/truth/oracle.h"

namespace oro {
namespace {

// Where each key is on a US keyboard.
constexpr std::array<std::pair<int, ViewKey>, 24> view_keys{{{'W', ViewKey::w},
                                                             {'A', ViewKey::a},
                                                             {'S', ViewKey::s},
                                                             {'D', ViewKey::d},
                                                             {'Q', ViewKey::q},
                                                             {'E', ViewKey::e},
                                                             {'R', ViewKey::r},
                                                             {'F', ViewKey::f},
                                                             {'K', ViewKey::k},
                                                             {'N', ViewKey::n},
                                                             {'U', ViewKey::u},
                                                             {key::space, ViewKey::space},
                                                             {key::page_up, ViewKey::space},
                                                             {key::page_down, ViewKey::q},
                                                             {key::up, ViewKey::arrow_up},
                                                             {key::down, ViewKey::arrow_down},
                                                             {key::left, ViewKey::arrow_left},
                                                             {key::right, ViewKey::arrow_right},
                                                             {key::home, ViewKey::home},
                                                             {key::backspace, ViewKey::backspace},
                                                             {key::left_shift, ViewKey::shift},
                                                             {key::right_shift, ViewKey::shift},
                                                             {key::left_control, ViewKey::control},
                                                             {key::right_control, ViewKey::control}}};

// The centre of the pixel under the pointer.
glm::dvec2 pixel_middle(glm::dvec2 at_px) {
    return glm::floor(at_px) + 0.5;
}

PointerButton pointer_button(MouseButton button) {
    if (button == MouseButton::left) return PointerButton::left;
    return button == MouseButton::right ? PointerButton::right : PointerButton::middle;
}

std::optional<ViewEvent> key_event(const KeyChanged& changed, ViewEvent event) {
    if (changed.repeated) return std::nullopt;
    for (const auto& [code, of_view] : view_keys) {
        if (code != changed.key) continue;
        event.kind = changed.down ? ViewEvent::Kind::key_down : ViewEvent::Kind::key_up;
        event.key = of_view;
        event.shift = changed.shift;
        event.control = changed.control;
        return event;
    }
    return std::nullopt;
}

}  // namespace

void take_camera(Viewer& viewer, const Camera& camera) {
    viewer.view.camera = camera;
    viewer.moved = Clock::now();
    viewer.follows_eye = viewer.wants_picture = true;
    if (viewer.flies) return;
    viewer.message.clear();
    viewer.jumps.moved();
}

double motion_clock_s() {
    static const Clock::time_point since = Clock::now();
    return seconds_since(since);
}

NavigationScene navigation_of(Viewer& viewer) {
    NavigationScene scene;
    scene.pick = [&viewer](const Camera& camera, glm::dvec2 point_px) -> std::optional<Ecef> {
        const auto ground = ground_of(viewer);
        if (!ground.ok()) return std::nullopt;
        const auto hit = first_hit((*ground)->ground(), sight_from(camera.eye, viewer.view.model.air),
                                   camera.ecef_direction_at(point_px), sight_reach_m(camera.eye.h_m));
        if (!hit) return std::nullopt;
        return ecef_from_geodetic(hit->point);
    };
    scene.ground_h_m = [&viewer](double lat_deg, double lon_deg) {
        return ground_h_m(grid_at(viewer.region, lat_deg, lon_deg).field, lat_deg, lon_deg,
                          viewer.view.exaggeration);
    };
    scene.home = [&viewer](const Camera& camera) {
        return framed_home(camera, ground_points(viewer.region, viewer.view.exaggeration));
    };
    scene.air = viewer.view.model.air;
    scene.roll_deg = users_roll_deg(viewer.view.camera, viewer.options.view.roll_deg);
    return scene;
}

std::optional<ViewEvent> view_event_of(const WindowEvent& event, double time_s) {
    ViewEvent view;
    view.time_s = time_s;
    if (const auto* const changed = std::get_if<KeyChanged>(&event)) return key_event(*changed, view);
    if (const auto* const moved = std::get_if<PointerMoved>(&event)) {
        view.kind = ViewEvent::Kind::cursor;
        view.point_px = pixel_middle(moved->at_px);
        view.shift = moved->shift;
        view.control = moved->control;
        return view;
    }
    if (const auto* const button = std::get_if<ButtonChanged>(&event)) {
        view.kind = button->down ? ViewEvent::Kind::press : ViewEvent::Kind::release;
        view.button = pointer_button(button->button);
        view.point_px = pixel_middle(button->at_px);
        view.shift = button->shift;
        view.control = button->control;
        return view;
    }
    if (const auto* const wheel = std::get_if<WheelTurned>(&event)) {
        view.kind = ViewEvent::Kind::wheel;
        view.point_px = pixel_middle(wheel->at_px);
        view.notches = wheel->steps.y;
        view.shift = wheel->shift;
        view.control = wheel->control;
        return view;
    }
    const auto* const focus = std::get_if<FocusChanged>(&event);
    if (focus == nullptr || focus->has_focus) return std::nullopt;
    view.kind = ViewEvent::Kind::focus_lost;
    return view;
}

std::optional<PictureClick> take_view_event(Viewer& viewer, const ViewEvent& event) {
    using Kind = ViewEvent::Kind;
    // Whoever takes the eye in hand ends the flight of a jump.
    const bool is_touch =
        event.kind == Kind::press || event.kind == Kind::wheel ||
        (event.kind == Kind::key_down && event.key != ViewKey::shift && event.key != ViewKey::control);
    if (is_touch) viewer.flies = false;
    const GestureOutcome outcome = viewer.gestures->take(event, viewer.view.camera);
    if (outcome.moved) take_camera(viewer, outcome.camera);
    return outcome.click;
}

void press_key(Viewer& viewer, ViewKey key) {
    ViewEvent event;
    event.key = key;
    event.time_s = motion_clock_s();
    for (const auto kind : {ViewEvent::Kind::key_down, ViewEvent::Kind::key_up}) {
        event.kind = kind;
        take_view_event(viewer, event);
    }
}

void advance_eye(Viewer& viewer) {
    if (advance_playing(viewer)) return;
    const GestureOutcome outcome = viewer.gestures->advance(viewer.view.camera, motion_clock_s());
    if (outcome.moved) take_camera(viewer, outcome.camera);
    if (!viewer.flies || viewer.gestures->is_moving()) return;
    viewer.flies = viewer.follows_eye = false;
    viewer.wants_picture = true;
    tell(viewer, std::exchange(viewer.arrival, ""));
}

void fly_to(Viewer& viewer, const Camera& camera, const std::string& message) {
    viewer.gestures->fly_to(camera, viewer.view.camera, motion_clock_s());
    viewer.flies = true;
    viewer.arrival = message;
    viewer.message.clear();
}

}  // namespace oro
