#include "apps/window/playing.h"

#include <utility>

#include "apps/window/motion.h"
#include "apps/window/viewer.h"

namespace oro {

Camera camera_of_key(const Camera& camera, const CameraKey& key) {
    Camera there = camera;
    there.eye = key.eye;
    there.attitude = key.attitude;
    there.vertical_fov_deg = key.vertical_fov_deg;
    return there;
}

void play(Viewer& viewer, CameraPath path, const std::string& arrival) {
    viewer.flies = false;
    viewer.playing = Playing{std::move(path), motion_clock_s(), arrival};
    viewer.wants_picture = true;
}

void stop_playing(Viewer& viewer) {
    if (!viewer.playing) return;
    viewer.playing.reset();
    tell(viewer, "stopped");
}

bool advance_playing(Viewer& viewer) {
    if (!viewer.playing) return false;
    const CameraPath& path = viewer.playing->path;
    const double since_s = motion_clock_s() - viewer.playing->began_s;
    const double begins_s = path.keys().front().time_s;
    take_camera(viewer, camera_of_key(viewer.view.camera, path.at(begins_s + since_s)));
    if (since_s < path.duration_s()) return true;
    const std::string arrival = std::exchange(viewer.playing->arrival, "");
    viewer.playing.reset();
    tell(viewer, arrival);
    return true;
}

}  // namespace oro
