// What the mouse and the keys of a window do to its view; no window system is asked here.
//
//     left drag                the ground under the cursor stays under it
//     right, middle or Ctrl+left drag   turns the eye round the place under the cursor, and tilts
//     any drag of an eye that stands on the ground, or that begins on the sky   looks round
//     wheel                    nearer to and farther from what is under the cursor
//     double click             flies to what is under the cursor
//     W A S D, arrows          forward, left, back, right; Space, E up; Q down; with Shift faster
//     R F, Ctrl+arrows         looks up, down; and left, right
//     K                        walks: down to the ground, and along it; once more: flies again
//     N, Home                  north up; all of the region
//     U or Backspace, Shift+U  the view before; again
#pragma once

#include <array>
#include <functional>
#include <glm/vec2.hpp>
#include <optional>

#include "apps/navigation/camera_flight.h"
#include "apps/navigation/flight_step.h"
#include "apps/navigation/grab.h"
#include "apps/navigation/view_history.h"

namespace oro {

enum class PointerButton { left, middle, right };

// The keys that move the eye, by what is written on them (of a US keyboard).
enum class ViewKey {
    w,
    a,
    s,
    d,
    q,
    e,
    r,
    f,
    k,
    n,
    u,
    space,
    arrow_up,
    arrow_down,
    arrow_left,
    arrow_right,
    home,
    backspace,
    shift,
    control,
    count
};

// What the user did. Pixels are those of the picture, from the top left corner; times are of any clock that
// advance() is asked with, too.
struct ViewEvent {
    enum class Kind { press, release, cursor, wheel, key_down, key_up, focus_lost };
    Kind kind{};
    PointerButton button{};  // of press and release
    ViewKey key{};           // of key_down and key_up
    glm::dvec2 point_px{};   // where the cursor is: of all but keys
    double notches{};        // of the wheel: above 0 is nearer
    bool shift{};            // held meanwhile
    bool control{};
    double time_s{};
};

// A button went down and up again with the cursor less than drag_starts_px away.
struct PictureClick {
    PointerButton button{};
    glm::dvec2 point_px{};  // where it went down
};
inline constexpr double drag_starts_px = 4.0;

struct GestureOutcome {
    Camera camera;  // the view from now on
    bool moved{};   // whether that is another than before
    std::optional<PictureClick> click;
};

// What gestures ask of the region that is shown. All is asked on the thread that gives the events.
struct NavigationScene {
    // What a camera's picture has at a pixel, as it is drawn (heights exaggerated); nothing for the sky.
    std::function<std::optional<Ecef>(const Camera& camera, glm::dvec2 point_px)> pick;
    GroundHeightAt ground_h_m;  // as it is drawn
    // The view of all of the region, of the size of `camera`; nothing where there is none.
    std::function<std::optional<Camera>(const Camera& camera)> home;
    Air air{};
    double roll_deg{};  // the user's own (apps/window/jump.h)
};

// Keeps what a gesture needs from event to event, the flight that is under way, and the views that the eye
// rested at. The camera is the caller's: it gives the one that is shown, and takes the outcome's. One thread.
class Gestures {
  public:
    explicit Gestures(NavigationScene scene) : scene_(std::move(scene)) {}

    // The view after an event. A press, the wheel and keys that move break a flight off.
    GestureOutcome take(const ViewEvent& event, const Camera& camera);
    // The view at a time, once before each frame: flies on, moves by the keys that are held, and remembers
    // views where the eye has rested for rest_s. A camera that something else has set is taken as it is.
    GestureOutcome advance(const Camera& camera, double time_s);
    // Flies to a view, from the one that is shown, which is remembered.
    void fly_to(const Camera& to, const Camera& camera, double time_s);

    [[nodiscard]] bool is_walking() const { return walking_; }
    // Whether the next frame will differ without any event.
    [[nodiscard]] bool is_moving() const { return flight_ || moves(step_of_keys(Camera())); }
    static constexpr double rest_s = 0.4;

  private:
    struct Drag {
        PointerButton button{};
        bool orbits{};
        bool begun{};
        bool picked{};
        GrabStart start;
    };
    struct Zoom {
        Camera after;
        glm::dvec2 point_px;
        Ecef place;
    };
    [[nodiscard]] static bool moves(const FlightStep& step);
    [[nodiscard]] FlightStep step_of_keys(const Camera& camera) const;
    [[nodiscard]] bool holds(ViewKey key) const { return held_[static_cast<std::size_t>(key)]; }
    // Walking, or with the eye no more than 5 m over the ground.
    [[nodiscard]] bool stands(const Camera& camera) const;
    void press(const ViewEvent& event, const Camera& camera);
    void release(const ViewEvent& event, GestureOutcome& outcome);
    [[nodiscard]] Camera dragged(const ViewEvent& event, const Camera& camera);
    [[nodiscard]] Camera wheeled(const ViewEvent& event, const Camera& camera);
    void key_down(const ViewEvent& event, const Camera& camera);
    void fly_near(const ViewEvent& event, const Camera& camera);
    void toggle_walking(const Camera& camera, double time_s);
    void undo(const Camera& camera, bool again, double time_s);
    void begin_flight(const Camera& from, const Camera& to, double time_s);
    void begin_drag_anew(const Camera& camera);

    NavigationScene scene_;
    ViewHistory history_;
    std::array<bool, static_cast<std::size_t>(ViewKey::count)> held_{};
    bool shift_{};
    bool control_{};
    bool walking_{};
    glm::dvec2 cursor_px_{};
    std::optional<Drag> drag_;
    std::optional<Zoom> zoom_;
    std::optional<Flight> flight_;
    double flight_began_s_{};
    std::optional<PictureClick> last_click_;  // of the left button
    double last_click_s_{};
    std::optional<Camera> last_;  // as it was given last
    std::optional<double> last_s_;
    double moved_s_{};
    bool rests_{};
};

}  // namespace oro
