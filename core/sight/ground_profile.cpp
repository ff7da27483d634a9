#include "core/sight/ground_profile.h"

#include <algorithm>
#include <cmath>

namespace oro {

ProfilePoint profile_point(const TrueGround& ground, const Geodetic& place, double along_m) {
    ProfilePoint point{along_m, place.lat_deg, place.lon_deg, false, 0.0, 0.0};
    if (const std::optional<double> h_m = ground.h_m(place.lat_deg, place.lon_deg)) {
        point.has_ground = true;
        point.h_m = *h_m;
        point.H_m = *h_m - ground.N_m(place.lat_deg, place.lon_deg);
    }
    return point;
}

void add_profile(const TrueGround& ground, const Way& way, double from_m, double to_m,
                 std::vector<ProfilePoint>& points, const ProfileProgress& progress) {
    // A post lies on three edges: their crossings are one place.
    constexpr double same_m = 1.0e-3;
    const auto add = [&](double along_m) {
        points.push_back(profile_point(ground, way(along_m), along_m));
        ProfilePoint& point = points.back();
        // On the rim of the data, or of a void, a rounded place may lie beyond it.
        constexpr double offset_m = 0.02;
        for (const double at_m : {along_m - offset_m, along_m + offset_m}) {
            if (point.has_ground || at_m < from_m || at_m > to_m) continue;
            const ProfilePoint near_by = profile_point(ground, way(at_m), at_m);
            point.has_ground = near_by.has_ground;
            point.H_m = near_by.H_m;
            point.h_m = near_by.h_m;
        }
    };
    if (points.empty()) add(from_m);
    double last_m = from_m;
    for (const double along_m : edge_crossings(ground, way, from_m, to_m)) {
        if (along_m - last_m < same_m || to_m - along_m < same_m) continue;
        // What lies between two crossings over no ground is told by a place in it: its ends are on the rim.
        const Geodetic middle = way(0.5 * (last_m + along_m));
        if (!ground.h_m(middle.lat_deg, middle.lon_deg)) add(0.5 * (last_m + along_m));
        add(along_m);
        if (progress) progress(along_m);
        last_m = along_m;
    }
    const Geodetic middle = way(0.5 * (last_m + to_m));
    if (!ground.h_m(middle.lat_deg, middle.lon_deg)) add(0.5 * (last_m + to_m));
    if (to_m > from_m) add(to_m);
}

namespace {

// One part of a line, as its heights come.
class Turns {
  public:
    explicit Turns(double threshold_m) : threshold_m_(threshold_m) {}

    void add(double H_m) {
        switch (way_) {
            case Way::unbegun:
                low_m_ = high_m_ = H_m;
                way_ = Way::level;
                return;
            case Way::level:
                low_m_ = std::min(low_m_, H_m);
                high_m_ = std::max(high_m_, H_m);
                if (is_enough(H_m - low_m_)) way_ = Way::up;
                if (is_enough(high_m_ - H_m)) way_ = Way::down;
                return;
            case Way::up:
                if (H_m > high_m_) high_m_ = H_m;
                if (!is_enough(high_m_ - H_m)) return;
                climb_.up_m += high_m_ - low_m_;
                low_m_ = H_m;
                way_ = Way::down;
                return;
            case Way::down:
                if (H_m < low_m_) low_m_ = H_m;
                if (!is_enough(H_m - low_m_)) return;
                climb_.down_m += high_m_ - low_m_;
                high_m_ = H_m;
                way_ = Way::up;
                return;
        }
    }
    void end() {
        if (way_ == Way::up) climb_.up_m += high_m_ - low_m_;
        if (way_ == Way::down) climb_.down_m += high_m_ - low_m_;
        way_ = Way::unbegun;
    }
    [[nodiscard]] const Climb& climb() const { return climb_; }

  private:
    enum class Way { unbegun, level, up, down };
    [[nodiscard]] bool is_enough(double change_m) const { return change_m > 0.0 && change_m >= threshold_m_; }

    double threshold_m_;
    Way way_{Way::unbegun};
    double low_m_{}, high_m_{};  // of the way since the last turn
    Climb climb_;
};

}  // namespace

Climb climb_over(const std::vector<ProfilePoint>& points, double threshold_m) {
    Turns turns(threshold_m);
    for (const ProfilePoint& point : points) {
        if (point.has_ground)
            turns.add(point.H_m);
        else
            turns.end();
    }
    turns.end();
    return turns.climb();
}

ProfileSums sums_of(const std::vector<ProfilePoint>& points, double climb_threshold_m) {
    ProfileSums sums;
    const Climb climb = climb_over(points, climb_threshold_m);
    sums.climb_threshold_m = climb_threshold_m;
    sums.climbed_m = climb.up_m;
    sums.went_down_m = climb.down_m;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const ProfilePoint& here = points[i];
        if (here.has_ground) {
            if (!sums.highest || here.H_m > points[*sums.highest].H_m) sums.highest = i;
            if (!sums.lowest || here.H_m < points[*sums.lowest].H_m) sums.lowest = i;
        }
        if (i == 0) continue;
        const ProfilePoint& before = points[i - 1];
        if (!here.has_ground || !before.has_ground) {
            sums.without_data_m += here.along_m - before.along_m;
            continue;
        }
        const double rise_m = here.H_m - before.H_m;
        (rise_m > 0.0 ? sums.ascent_m : sums.descent_m) += std::abs(rise_m);
    }
    return sums;
}

}  // namespace oro
