#include "apps/window/session/turn.h"

#include <algorithm>
#include <utility>

#include "apps/window/frames.h"
#include "apps/window/measuring.h"
#include "apps/window/motion.h"
#include "apps/window/opening.h"
#include "apps/window/panels/panels.h"
#include "apps/window/pictures.h"
#include "apps/window/places.h"
#include "apps/window/projects.h"
#include "apps/window/search.h"
#include "apps/window/work.h"

namespace oro {
namespace {

void open_search(Viewer& viewer) {
    viewer.search.is_open = viewer.search.takes_focus = true;
}

// What is open on top is closed; a window is never left so.
void dismiss(Viewer& viewer) {
    Panels& panels = viewer.panels;
    if (viewer.search.is_open || !viewer.search.error.empty()) {
        viewer.search.is_open = false;
        viewer.search.error.clear();
        return;
    }
    if (std::exchange(panels.place, false)) return;
    viewer.jumped_to.reset();
    const bool hidden = panels.hidden;
    panels = {};
    panels.hidden = hidden;
}

// Letters and panels a step larger or smaller, or as the screen has them.
void scale_panels(Viewer& viewer, int code) {
    constexpr double step = 1.1, least = 0.5, most = 4.0;
    double& scale = viewer.settings.ui_scale;
    if (code == '0') scale = 1.0;
    if (code == key::equal || code == key::keypad_add) scale = std::min(scale * step, most);
    if (code == key::minus || code == key::keypad_subtract) scale = std::max(scale / step, least);
}

// Keys that come with Control.
void take_chord(Viewer& viewer, int code) {
    scale_panels(viewer, code);
    if (code == 'Q') viewer.leaves = true;
    if (code == 'L') open_search(viewer);
    if (code == 'O') viewer.panels.toggle(&Panels::files);
    if (code == 'S') save_or_ask(viewer);
}

// A turn of the wheel over the picture's middle.
void zoom_by_key(Viewer& viewer, double notches) {
    ViewEvent event;
    event.kind = ViewEvent::Kind::wheel;
    event.point_px = 0.5 * glm::dvec2(viewer.view.camera.width_px, viewer.view.camera.height_px);
    event.notches = notches;
    event.time_s = motion_clock_s();
    take_view_event(viewer, event);
}

Result<void> take_key(Session& session, const KeyChanged& event) {
    Viewer& viewer = session.viewer;
    if (!event.down) return {};
    if (event.control) {
        if (!event.repeated) take_chord(viewer, event.key);
        return {};
    }
    if (event.key == key::equal || event.key == key::keypad_add) zoom_by_key(viewer, 1.0);
    if (event.key == key::minus || event.key == key::keypad_subtract) zoom_by_key(viewer, -1.0);
    if (event.repeated) return {};
    switch (event.key) {
        case key::escape:
            dismiss(viewer);
            break;
        case key::enter:
        case key::keypad_enter:
            stand(viewer);
            break;
        case key::tab:
            viewer.panels.hidden = !viewer.panels.hidden;
            break;
        case key::f1:
        case 'H':
            viewer.panels.toggle(&Panels::keys);
            break;
        case key::f11:
            viewer.window.toggle_full_screen();
            break;
        case 'P':
            if (event.shift) {
                viewer.panels.toggle(&Panels::picture);
                break;
            }
            viewer.wants_picture = true;  // it may bring finer detail
            return take_picture(viewer);
        default:
            break;
    }
    return {};
}

void take_character(Viewer& viewer, char32_t code) {
    if (code == U'g' || code == U'G' || code == U'/') open_search(viewer);
    if (code == U'?') viewer.panels.toggle(&Panels::keys);
    if (code == U'2') viewer.wishes.push_back(choose_next_layout);
}

// What was clicked at, and not dragged.
Result<void> take_click(Viewer& viewer, const PictureClick& click) {
    if (click.button == PointerButton::right) return pick(viewer, click.point_px);
    if (click.button == PointerButton::left && viewer.panels.measure && !viewer.panels.hidden)
        return add_place(viewer, click.point_px);
    return {};
}

// Control and S saves, and does not move.
bool is_save_chord(const WindowEvent& event) {
    const auto* const pressed = std::get_if<KeyChanged>(&event);
    return pressed != nullptr && pressed->down && pressed->control && pressed->key == 'S';
}

// Any key, any button and the wheel end what is played.
bool takes_eye_in_hand(const WindowEvent& event) {
    if (const auto* const pressed = std::get_if<KeyChanged>(&event)) return pressed->down;
    if (const auto* const button = std::get_if<ButtonChanged>(&event)) return button->down;
    return std::holds_alternative<WheelTurned>(event);
}

// Of two views side by side each shows the same places: what the pointer does in the second half it does
// there in the first.
void take_over_halves(Viewer& viewer, ViewEvent& event) {
    using Kind = ViewEvent::Kind;
    const int border_px = pointer_border_px(viewer);
    if (event.kind == Kind::press) viewer.two.pointer.button(true, event.point_px, border_px);
    const glm::dvec2 at_px = event.point_px;
    const bool has_point = event.kind == Kind::press || event.kind == Kind::release ||
                           event.kind == Kind::cursor || event.kind == Kind::wheel;
    if (has_point) event.point_px = viewer.two.pointer.point_of_first(at_px, border_px);
    if (event.kind == Kind::release) viewer.two.pointer.button(false, at_px, border_px);
}

Result<void> take_event(Session& session, const WindowEvent& event) {
    Viewer& viewer = session.viewer;
    if (viewer.playing && takes_eye_in_hand(event)) {
        stop_playing(viewer);
        return {};
    }
    if (const auto* const pressed = std::get_if<KeyChanged>(&event)) ORO_CHECK(take_key(session, *pressed));
    if (const auto* const typed = std::get_if<CharacterTyped>(&event)) take_character(viewer, typed->code);
    if (const auto* const dropped = std::get_if<PathsDropped>(&event))
        return open_paths(viewer, dropped->paths);
    if (is_save_chord(event)) return {};
    auto of_view = view_event_of(event, motion_clock_s());
    if (!of_view) return {};
    take_over_halves(viewer, *of_view);
    const auto click = take_view_event(viewer, *of_view);
    return click ? take_click(viewer, *click) : Result<void>();
}

// What is asked of the ground for what is always there. Not while the eye moves: it would take a part of each
// frame's time.
Result<void> look_around(Session& session, const WindowInput& input, bool is_new) {
    Viewer& viewer = session.viewer;
    if (!viewer.has_picture || viewer.panels.hidden) return {};
    const Camera& camera = viewer.view.camera;
    if (is_new) {
        ORO_TRY(viewer.in_middle, picked_at(viewer, {0.5 * camera.width_px, 0.5 * camera.height_px}));
    }
    const glm::dvec2 at = viewer.two.pointer.point_of_first(input.pointer_px, pointer_border_px(viewer));
    const bool is_over = at.x >= 0.0 && at.y >= 0.0 && at.x < camera.width_px && at.y < camera.height_px &&
                         !session.interface.has_pointer();
    if (!is_over) {
        viewer.under_pointer.reset();
        return {};
    }
    const glm::dvec2 pixel = glm::floor(at) + 0.5;
    if (!is_new && viewer.under_pointer && viewer.under_pointer->point_px == pixel) return {};
    ORO_TRY(viewer.under_pointer, picked_at(viewer, pixel));
    return {};
}

// Whether the ground is there to be asked, which is made beside the window. What was left out for it is made
// up for then.
Result<bool> can_look_around(Session& session) {
    Viewer& viewer = session.viewer;
    if (!viewer.has_picture || (viewer.panels.hidden && !viewer.waits_for_writing)) return true;
    ORO_TRY(const RegionGround* const ground, ground_so_far(viewer));
    if (ground == nullptr) {
        session.looks_under_pointer = true;
        return false;
    }
    viewer.wants_picture = std::exchange(viewer.waits_for_writing, false) || viewer.wants_picture;
    return true;
}

std::optional<glm::dvec2> point_under_pointer(const Viewer& viewer) {
    if (!viewer.under_pointer) return std::nullopt;
    return viewer.under_pointer->point_px;
}

Result<void> grant_wishes(Viewer& viewer) {
    // What a wish wishes for comes after the next picture.
    const auto wishes = std::exchange(viewer.wishes, {});
    for (const auto& wish : wishes) ORO_CHECK(wish(viewer));
    return {};
}

double wait_s(const Session& session) {
    const Viewer& viewer = session.viewer;
    if (viewer.window.extent().width == 0) return 0.05;  // minimised
    if (session.changed || session.frames_due > 0 || viewer.gestures->is_moving()) return 0.0;
    const bool lacks_second = viewer.two.second && viewer.two.second->is_missing;
    const bool lacks_meshes =
        !are_chosen_for(viewer.meshes, viewer.view, viewer.view.camera) || lacks_second_meshes(viewer);
    return viewer.is_missing || lacks_second || lacks_meshes || viewer.coming || viewer.world.measured ? 0.005
                                                                                                       : 0.05;
}

Result<void> show(Session& session, bool is_new) {
    Viewer& viewer = session.viewer;
    // A cursor blinks, and toasts go.
    const bool lives = session.interface.takes_text() || has_toasts(viewer) || is_coarse(viewer) ||
                       viewer.opening || has_work(viewer);
    if (is_new || lives || viewer.is_exposed) session.frames_due = std::max(session.frames_due, 1);
    if (session.frames_due == 0) return {};
    ORO_TRY(std::optional<WindowPicture> picture, picture_to_show(viewer));
    if (!picture) return {};
    session.interface.set_user_scale(viewer.settings.ui_scale);
    ORO_CHECK(session.interface.follow_scale());
    const ImDrawData* const over = session.interface.lists([&] { build_panels(viewer); });
    const WindowPicture whole{picture->picture, picture->part, over, picture->beside};
    ORO_TRY(bool shown, viewer.window.show(whole));
    // One that is still being drawn is presented when the next one is begun.
    if (shown && viewer.under_way.empty()) {
        ORO_TRY(shown, viewer.window.present());
    }
    viewer.is_exposed = !shown;
    if (!shown) return {};
    --session.frames_due;
    say_what_is_shown(viewer);
    return {};
}

// A picture of an eye that rests may take long: what is asked for is seen to be taken up before.
Result<void> say_that_it_is_outdated(Session& session) {
    Viewer& viewer = session.viewer;
    if (is_moving(viewer) || !viewer.is_shown || viewer.is_outdated) return {};
    viewer.is_outdated = true;
    return show(session, true);
}

// Where another frame may follow at once, the last one is drawn beside it. Else nothing is left under way.
Result<void> finish_turn(const Session& session) {
    Viewer& viewer = session.viewer;
    if (wait_s(session) == 0.0) return take_reports(viewer, frames_in_flight - 1);
    ORO_TRY(const bool shown, viewer.window.present());
    viewer.is_exposed = viewer.is_exposed || !shown;
    return take_reports(viewer, 0);
}

}  // namespace

Result<bool> turn(Session& session) {
    Viewer& viewer = session.viewer;
    ORO_CHECK(take_opened(viewer));
    take_gazetteers(viewer);
    ORO_CHECK(refine(viewer, session.changed));
    ORO_CHECK(take_finished_work(viewer));
    ORO_TRY(const bool is_new, draw_frame(viewer, session.changed));
    if (is_new) session.looks_under_pointer = true;
    ORO_CHECK(show(session, is_new));
    ORO_CHECK(finish_turn(session));
    const WindowInput input = viewer.window.poll(wait_s(session));
    viewer.polled = Clock::now();
    if (input.closed) return false;
    viewer.is_exposed = viewer.is_exposed || input.exposed;
    if (!input.events.empty()) session.frames_due = 4;
    const auto build = [&] { build_panels(viewer); };
    const auto take = [&](const WindowEvent& event) -> Result<void> {
        ORO_CHECK(grant_wishes(viewer));
        return take_event(session, event);
    };
    ORO_CHECK(session.interface.feed(input, build, take));
    ORO_CHECK(grant_wishes(viewer));
    if (viewer.leaves) return false;
    const bool wants_another = viewer.wants_picture;
    advance_eye(viewer);
    if (wants_another) ORO_CHECK(say_that_it_is_outdated(session));
    // Panels know that the pointer has come to them or left them once they have been shown again.
    const bool is_asked = session.looks_under_pointer || !input.events.empty();
    ORO_TRY(const bool can_look, can_look_around(session));
    if (can_look && !is_moving(viewer) && (is_asked || session.frames_due > 0)) {
        const auto before = point_under_pointer(viewer);
        ORO_CHECK(look_around(session, input, std::exchange(session.looks_under_pointer, false)));
        if (is_asked || point_under_pointer(viewer) != before)
            session.frames_due = std::max(session.frames_due, 1);
    }
    session.changed = std::exchange(viewer.wants_picture, false) || session.changed;
    // The eye stands on ground that was asked for: it ends as a page does that cannot be drawn.
    ORO_CHECK(viewer.region.health());
    trace_state(viewer);
    return true;
}

}  // namespace oro
