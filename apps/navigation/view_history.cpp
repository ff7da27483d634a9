#include "apps/navigation/view_history.h"

namespace oro {

bool is_same_view(const Camera& a, const Camera& b) {
    return a.eye.lat_deg == b.eye.lat_deg && a.eye.lon_deg == b.eye.lon_deg && a.eye.h_m == b.eye.h_m &&
           a.attitude.heading_deg == b.attitude.heading_deg && a.attitude.pitch_deg == b.attitude.pitch_deg &&
           a.attitude.roll_deg == b.attitude.roll_deg && a.vertical_fov_deg == b.vertical_fov_deg;
}

void ViewHistory::rested(const Camera& camera) {
    if (!views_.empty()) {
        if (is_same_view(views_[at_], camera)) return;
        views_.resize(at_ + 1);
    }
    views_.push_back(camera);
    if (views_.size() > most_) views_.erase(views_.begin());
    at_ = views_.size() - 1;
}

std::optional<Camera> ViewHistory::undone(const Camera& camera) {
    rested(camera);
    if (at_ == 0) return std::nullopt;
    --at_;
    return sized(camera);
}

std::optional<Camera> ViewHistory::again(const Camera& camera) {
    if (views_.empty() || !is_same_view(views_[at_], camera) || at_ + 1 == views_.size()) return std::nullopt;
    ++at_;
    return sized(camera);
}

Camera ViewHistory::sized(const Camera& camera) const {
    Camera there = views_[at_];
    there.width_px = camera.width_px;
    there.height_px = camera.height_px;
    return there;
}

}  // namespace oro
