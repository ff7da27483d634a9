// A camera's path that a window's eye goes along by itself.
#pragma once

#include <string>

#include "apps/film/camera_path.h"

namespace oro {

struct Viewer;

struct Playing {
    CameraPath path;
    double began_s{};     // of motion_clock_s()
    std::string arrival;  // what is said at its end
};

// Goes along a path from now on, in place of what was played before. arrival: what is said at its end.
void play(Viewer& viewer, CameraPath path, const std::string& arrival);
// Stays where it is.
void stop_playing(Viewer& viewer);
// The camera of now, once before each frame; false where nothing is played. At the end it has the last key's
// to the bit.
bool advance_playing(Viewer& viewer);

// A camera of the same size and kind as `camera` that sees what a key does.
Camera camera_of_key(const Camera& camera, const CameraKey& key);

}  // namespace oro
