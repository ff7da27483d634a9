#include "apps/navigation/gestures.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "apps/navigation/orbit.h"
#include "apps/navigation/zoom.h"

namespace oro {
namespace {

constexpr double double_click_s = 0.4;

// What the wheel goes to where the picture has no ground: a point in the sky, about as far away as the
// ground.
Ecef point_in_sky(const Camera& camera, glm::dvec2 point_px, const GroundHeightAt& ground_h_m) {
    const double ground_m = ground_h_m(camera.eye.lat_deg, camera.eye.lon_deg).value_or(0.0);
    const double distance_m = std::max(100.0, camera.eye.h_m - ground_m);
    return {camera.eye_ecef().m + camera.ecef_direction_at(point_px) * distance_m};
}

bool is_same_place(const Geodetic& a, const Geodetic& b) {
    return a.lat_deg == b.lat_deg && a.lon_deg == b.lon_deg && a.h_m == b.h_m;
}

}  // namespace

bool Gestures::moves(const FlightStep& step) {
    return step.forward != 0.0 || step.right != 0.0 || step.up != 0.0 || step.turn_right_deg != 0.0 ||
           step.turn_up_deg != 0.0;
}

FlightStep Gestures::step_of_keys(const Camera& camera) const {
    const auto axis = [&](bool plus, bool minus) { return (plus ? 1.0 : 0.0) - (minus ? 1.0 : 0.0); };
    using enum ViewKey;
    const bool goes = !control_;
    FlightStep step;
    step.forward = axis(holds(w) || (goes && holds(arrow_up)), holds(s) || (goes && holds(arrow_down)));
    step.right = axis(holds(d) || (goes && holds(arrow_right)), holds(a) || (goes && holds(arrow_left)));
    step.up = axis(holds(space) || holds(e), holds(q));
    step.fast = shift_;
    const double turn_deg_s = camera.vertical_fov_deg;
    step.turn_right_deg = turn_deg_s * axis(control_ && holds(arrow_right), control_ && holds(arrow_left));
    step.turn_up_deg = turn_deg_s * axis(holds(r) || (control_ && holds(arrow_up)),
                                         holds(f) || (control_ && holds(arrow_down)));
    return step;
}

void Gestures::begin_flight(const Camera& from, const Camera& to, double time_s) {
    // The ground may be higher than where the eye looked from: it was drawn so, or was no part of the data.
    flight_.emplace(from, above_ground(to, scene_.ground_h_m), scene_.ground_h_m);
    flight_began_s_ = time_s;
    walking_ = false;
}

void Gestures::fly_to(const Camera& to, const Camera& camera, double time_s) {
    if (!flight_) history_.rested(camera);
    begin_flight(camera, to, time_s);
}

void Gestures::press(const ViewEvent& event, const Camera& camera) {
    flight_.reset();
    if (drag_) return;
    drag_ = Drag{};
    drag_->button = event.button;
    drag_->orbits = event.button != PointerButton::left || event.control;
    drag_->start.camera = camera;
    drag_->start.pressed_px = event.point_px;
}

Camera Gestures::dragged(const ViewEvent& event, const Camera& camera) {
    if (!drag_) return camera;
    GrabStart& start = drag_->start;
    drag_->begun = drag_->begun || glm::distance(event.point_px, start.pressed_px) >= drag_starts_px;
    if (!drag_->begun) return camera;
    // Who stands on the ground looks round there.
    if (!drag_->picked && !stands(start.camera)) start.place = scene_.pick(start.camera, start.pressed_px);
    drag_->picked = true;
    Camera there;
    if (drag_->orbits && start.place) {
        const glm::dvec2 share =
            (event.point_px - start.pressed_px) / glm::dvec2(camera.width_px, camera.height_px);
        constexpr double turn_of_width_deg = 180.0, tilt_of_height_deg = 90.0;
        there = orbited(start.camera, *start.place, share.x * turn_of_width_deg,
                        -share.y * tilt_of_height_deg, scene_.ground_h_m, scene_.air);
    } else {
        there = grabbed(start, event.point_px, scene_.ground_h_m, scene_.air);
    }
    there.width_px = camera.width_px, there.height_px = camera.height_px;
    return there;
}

bool Gestures::stands(const Camera& camera) const {
    constexpr double standing_m = 5.0;
    const auto ground_h_m = scene_.ground_h_m(camera.eye.lat_deg, camera.eye.lon_deg);
    return walking_ || (ground_h_m && camera.eye.h_m - *ground_h_m < standing_m);
}

// What has moved the eye meanwhile holds; the drag goes on from there.
void Gestures::begin_drag_anew(const Camera& camera) {
    if (!drag_) return;
    drag_->start = {camera, cursor_px_, std::nullopt};
    drag_->picked = false;
}

void Gestures::release(const ViewEvent& event, GestureOutcome& outcome) {
    if (!drag_ || drag_->button != event.button) return;
    const Drag drag = *drag_;
    drag_.reset();
    if (drag.begun) return;
    const PictureClick click{drag.button, drag.start.pressed_px};
    const bool is_second = click.button == PointerButton::left && last_click_ &&
                           event.time_s - last_click_s_ <= double_click_s &&
                           glm::distance(last_click_->point_px, click.point_px) < drag_starts_px;
    last_click_.reset();
    if (is_second) return fly_near(event, outcome.camera);
    outcome.click = click;
    if (click.button != PointerButton::left) return;
    last_click_ = click;
    last_click_s_ = event.time_s;
}

// To a third of the distance, with the place in the middle of the picture.
void Gestures::fly_near(const ViewEvent& event, const Camera& camera) {
    const auto place = scene_.pick(camera, event.point_px);
    if (!place) return;
    constexpr double nearer = 1.0 / 3.0;
    Camera there = zoomed(camera, *place, nearer, scene_.ground_h_m, scene_.air);
    const glm::dvec2 middle_px(0.5 * camera.width_px, 0.5 * camera.height_px);
    there = turned_to_hold(there, seen_direction(there, *place, scene_.air), middle_px).camera;
    fly_to(there, camera, event.time_s);
}

Camera Gestures::wheeled(const ViewEvent& event, const Camera& camera) {
    flight_.reset();
    const bool goes_on = zoom_ && zoom_->point_px == event.point_px && is_same_view(zoom_->after, camera);
    const auto picked = goes_on ? std::optional(zoom_->place) : scene_.pick(camera, event.point_px);
    const Ecef place = picked ? *picked : point_in_sky(camera, event.point_px, scene_.ground_h_m);
    constexpr double notch = 0.85, most_notches = 10.0;
    const double factor = std::pow(notch, std::clamp(event.notches, -most_notches, most_notches));
    const Camera there = zoomed(camera, place, factor, scene_.ground_h_m, scene_.air);
    zoom_ = Zoom{there, event.point_px, place};
    begin_drag_anew(there);
    return there;
}

void Gestures::toggle_walking(const Camera& camera, double time_s) {
    if (walking_) {
        walking_ = false;
        return;
    }
    const Camera there = walked(camera, {}, scene_.ground_h_m);
    fly_to(there, camera, time_s);
    walking_ = true;
}

void Gestures::undo(const Camera& camera, bool again, double time_s) {
    const Camera& now = flight_ ? flight_->to() : camera;
    const auto there = again ? history_.again(now) : history_.undone(now);
    if (!there) return;
    const Camera lifted = above_ground(*there, scene_.ground_h_m);
    history_.correct(lifted);
    begin_flight(camera, lifted, time_s);
}

void Gestures::key_down(const ViewEvent& event, const Camera& camera) {
    // With Ctrl letters are the window's.
    if (control_ && event.key < ViewKey::arrow_up) return;
    held_[static_cast<std::size_t>(event.key)] = true;
    switch (event.key) {
        case ViewKey::home:
            if (const auto home = scene_.home(camera)) fly_to(*home, camera, event.time_s);
            return;
        case ViewKey::n: {
            const glm::dvec2 middle_px(0.5 * camera.width_px, 0.5 * camera.height_px);
            fly_to(north_up(camera, scene_.pick(camera, middle_px), scene_.roll_deg, scene_.ground_h_m,
                            scene_.air),
                   camera, event.time_s);
            return;
        }
        case ViewKey::k:
            return toggle_walking(camera, event.time_s);
        case ViewKey::u:
            return undo(camera, shift_, event.time_s);
        case ViewKey::backspace:
            return undo(camera, false, event.time_s);
        default:
            return;
    }
}

GestureOutcome Gestures::take(const ViewEvent& event, const Camera& camera) {
    using Kind = ViewEvent::Kind;
    GestureOutcome outcome{camera, false, std::nullopt};
    const bool is_key = event.kind == Kind::key_down || event.kind == Kind::key_up;
    if (!is_key && event.kind != Kind::focus_lost) cursor_px_ = event.point_px;
    shift_ = event.shift || (event.kind == Kind::key_down && event.key == ViewKey::shift);
    control_ = event.control || (event.kind == Kind::key_down && event.key == ViewKey::control);
    if (is_key && event.kind == Kind::key_up) {
        shift_ = shift_ && event.key != ViewKey::shift;
        control_ = control_ && event.key != ViewKey::control;
    }
    switch (event.kind) {
        case Kind::press:
            press(event, camera);
            break;
        case Kind::cursor:
            outcome.camera = dragged(event, camera);
            break;
        case Kind::release:
            release(event, outcome);
            break;
        case Kind::wheel:
            outcome.camera = wheeled(event, camera);
            break;
        case Kind::key_down:
            key_down(event, camera);
            break;
        case Kind::key_up:
            held_[static_cast<std::size_t>(event.key)] = false;
            break;
        case Kind::focus_lost:
            held_.fill(false);
            drag_.reset();
            shift_ = control_ = false;
            break;
    }
    outcome.moved = !is_same_view(outcome.camera, camera);
    if (outcome.moved) {
        moved_s_ = event.time_s;
        rests_ = false;
        walking_ = walking_ && is_same_place(outcome.camera.eye, camera.eye);
        last_ = outcome.camera;
    }
    return outcome;
}

GestureOutcome Gestures::advance(const Camera& camera, double time_s) {
    GestureOutcome outcome{camera, false, std::nullopt};
    constexpr double longest_step_s = 0.25;  // a slow frame must not become a leap
    const double elapsed_s = std::clamp(time_s - last_s_.value_or(time_s), 0.0, longest_step_s);
    if (last_ && !is_same_view(*last_, camera)) {
        flight_.reset();
        moved_s_ = time_s, rests_ = false;
    }
    FlightStep step = step_of_keys(camera);
    step.turn_right_deg *= elapsed_s, step.turn_up_deg *= elapsed_s;
    step.elapsed_s = elapsed_s;
    // Who begins to walk is let down to the ground first.
    if (moves(step) && !(flight_ && walking_)) {
        flight_.reset();
        walking_ = walking_ && step.up == 0.0;
        outcome.camera =
            walking_ ? walked(camera, step, scene_.ground_h_m) : flown(camera, step, scene_.ground_h_m);
        begin_drag_anew(outcome.camera);
    } else if (flight_) {
        const double since_s = time_s - flight_began_s_;
        outcome.camera = flight_->camera_at(since_s);
        outcome.camera.width_px = camera.width_px, outcome.camera.height_px = camera.height_px;
        if (since_s >= flight_->duration_s()) flight_.reset();
    }
    outcome.moved = !is_same_view(outcome.camera, camera);
    if (outcome.moved) moved_s_ = time_s, rests_ = false;
    const bool is_dragging = drag_ && drag_->begun;
    if (!rests_ && !flight_ && !is_dragging && time_s - moved_s_ >= rest_s) {
        history_.rested(outcome.camera);
        rests_ = true;
    }
    last_ = outcome.camera;
    last_s_ = time_s;
    return outcome;
}

}  // namespace oro
