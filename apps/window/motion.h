// How what a window's user does moves its eye (apps/navigation/gestures.h).
#pragma once

#include <optional>

#include "apps/window/viewer.h"

namespace oro {

// What gestures ask of the region that is shown. Asks the viewer, which outlives what is returned.
NavigationScene navigation_of(Viewer& viewer);
// An event as gestures take it; nothing of what does not move the eye. time_s: of any clock.
std::optional<ViewEvent> view_event_of(const WindowEvent& event, double time_s);

// As the user presses a key that moves the eye, and lets it go.
void press_key(Viewer& viewer, ViewKey key);
// Gives gestures an event; what was clicked at is returned.
std::optional<PictureClick> take_view_event(Viewer& viewer, const ViewEvent& event);
// Flies on, and moves by the keys that are held: once before each frame.
void advance_eye(Viewer& viewer);
// The eye flies to a camera; once it is there, `message` is said.
void fly_to(Viewer& viewer, const Camera& camera, const std::string& message);
// The eye is elsewhere from now on: detail yields, and what is written over pictures waits until it rests.
void take_camera(Viewer& viewer, const Camera& camera);
// Seconds of the clock that gestures go by.
double motion_clock_s();

}  // namespace oro
